// SPDX-License-Identifier: MIT
#include <adapter/controller.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nav2_core/controller_exceptions.hpp>
#include <stdexcept>

namespace nav2_adapter {

namespace {

// Gives the log lines of nav2's code to this instance while one of its functions runs.
class LogScope {
 public:
  explicit LogScope(const LogSink& sink) { set_log_sink(&sink); }
  ~LogScope() { set_log_sink(nullptr); }
  LogScope(const LogScope&) = delete;
  LogScope& operator=(const LogScope&) = delete;
};

geometry_msgs::msg::PoseStamped stamped(const dmrp::Pose& pose, const rclcpp::Time& now) {
  geometry_msgs::msg::PoseStamped out;
  out.header.frame_id = "odom";
  out.header.stamp = now;
  out.pose.position.x = pose.x;
  out.pose.position.y = pose.y;
  out.pose.orientation = nav2_util::geometry_utils::orientationAroundZAxis(pose.theta);
  return out;
}

geometry_msgs::msg::Twist twist(const dmrp::Twist& velocity) {
  geometry_msgs::msg::Twist out;
  out.linear.x = velocity.v_x;
  out.linear.y = velocity.v_y;
  out.angular.z = velocity.omega;
  return out;
}

double cross(const geometry_msgs::msg::Point& o, const geometry_msgs::msg::Point& a,
             const geometry_msgs::msg::Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

// nav2 knows one polygon: the convex hull of the footprint's parts, counter-clockwise.
std::vector<geometry_msgs::msg::Point> hull(const dmrp::Footprint& footprint) {
  std::vector<geometry_msgs::msg::Point> points;
  for (const dmrp::Polygon& part : dmrp::parts(footprint)) {
    for (std::uint32_t i = 0; i < part.vertex_count; ++i) {
      geometry_msgs::msg::Point point;
      point.x = part.vertices[i].x;
      point.y = part.vertices[i].y;
      points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<geometry_msgs::msg::Point> outline;
  if (points.empty()) return outline;  // a disc
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = outline.size();
    for (const auto& point : points) {
      while (outline.size() >= begin + 2 && cross(outline.end()[-2], outline.end()[-1], point) <= 0.0)
        outline.pop_back();
      outline.push_back(point);
    }
    outline.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return outline;
}

}  // namespace

dmrp::Descriptor describe(const char* id, const char* class_name) {
  return dmrp::Descriptor(id, class_name, NAV2_VERSION)
      .summary(std::string("nav2's own ") + class_name)
      .license("Apache-2.0 AND BSD-3-Clause AND MIT")
      .source("github.com/ros-navigation/navigation2")
      .kinematics(1U << DMRP_KINEMATICS_DIFFERENTIAL | 1U << DMRP_KINEMATICS_HOLONOMIC |
                  1U << DMRP_KINEMATICS_ACKERMANN)
      .flags(DMRP_FLAG_BACKWARDS)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .uses(DMRP_EXT_ANNOTATE)
      .uses(DMRP_EXT_TIMING);
}

dmrp::Status Controller::start(const dmrp::Start& start) {
  end();
  costmap_ = &extension<dmrp_local_costmap>();
  annotate_ = find_extension<dmrp_annotate>();
  timing_ = find_extension<dmrp_timing>();
  robot_ = static_cast<std::uint32_t>(start.robot);
  log_sink_ = [this](bool is_error, const char* place, const std::string& line) {
    if (logged_places_.insert(place).second) log(is_error ? dmrp::LogLevel::error : dmrp::LogLevel::warning, line);
  };
  path_ = nav2_params->empty() ? published_file() : *nav2_params;
  file_ = path_.empty() ? ParameterFile() : read_parameter_file(path_);
  if (!file_.plugin.empty() && file_.plugin != class_name_)
    throw std::runtime_error(path_ + ": " + section + ".plugin is '" + file_.plugin + "', but this controller is '" +
                             class_name_ + "'");
  return dmrp::Status::ok;
}

// params/mppi.yaml beside the library for the id nav2.mppi; "" if there is none.
std::string Controller::published_file() const {
  const std::string id = id_;
  const auto path =
      std::filesystem::path(host().library_path()).parent_path() / "params" / (id.substr(id.rfind('.') + 1) + ".yaml");
  return std::filesystem::exists(path) ? path.string() : "";
}

// Everything of the trial goes, nav2's threads too.
void Controller::end() {
  if (controller_) {
    const LogScope scope(log_sink_);
    controller_->deactivate();
    controller_->cleanup();
  }
  controller_.reset();
  environment_.reset();
  course_ = Course();
  revision_ = 0;
  plan_key_ = PlanKey();
  arrived_ = false;
  logged_places_.clear();
}

void Controller::set_path(dmrp::Path path, std::uint64_t revision) {
  course_.set(path);
  revision_ = revision;
}

dmrp::Status Controller::step(const dmrp::Observation& now, dmrp::Command& command) {
  const LogScope scope(log_sink_);
  if (course_.empty()) return dmrp::Status::no_solution;
  const bool first = !environment_;
  if (first) environment_ = make_environment(parameters());
  observe(now);
  if (first) configure();
  follow_plan(now);
  if (at_end_of_plan(now)) return dmrp::Status::ok;
  try {
    const auto answer = controller_->computeVelocityCommands(stamped(now.pose, environment_->node()->now()),
                                                             twist(now.velocity), &goal_checker_);
    command.v_x = answer.twist.linear.x;
    command.v_y = answer.twist.linear.y;
    command.omega = answer.twist.angular.z;
    return dmrp::Status::ok;
  } catch (const nav2_core::InvalidPath&) {
    plan_key_.revision = 0;  // it has lost its path: the next tick begins with a new plan
  } catch (const nav2_core::ControllerException&) {
    // There is no command, as when a person stands ahead.
  }
  // A robot that stands waits, as if nav2's behaviour tree tried again for ever; one that moves brakes.
  const bool stands = now.velocity.v_x == 0.0 && now.velocity.v_y == 0.0 && now.velocity.omega == 0.0;
  return stands ? dmrp::Status::ok : dmrp::Status::no_solution;
}

// The file's, but the frequency is the one at which this controller is called. Without a file of the user's, MPPI's step
// is that period too: it refuses to be called less often. (The last value of a parameter counts.)
std::vector<rclcpp::Parameter> Controller::parameters() {
  const double period_s = dmrp::seconds(world()->control_period_ns);
  const rclcpp::Parameter frequency("controller_frequency", 1.0 / period_s);
  std::vector<rclcpp::Parameter> out = file_.parameters;
  if (nav2_params->empty()) out.emplace_back(section + ".model_dt", period_s);
  if (annotate_ && annotate_->wanted(annotate_)) out.emplace_back(section + ".publish_optimal_trajectory", true);
  for (const rclcpp::Parameter& parameter : file_.parameters)
    if (parameter.get_name() == frequency.get_name() && !nav2_params->empty() &&
        std::to_string(parameter) != std::to_string(frequency))
      log(dmrp::LogLevel::warning, file_.places.at(parameter.get_name()) + ": expected " + std::to_string(frequency) +
                                       ", as the experiment's control_period_s says");
  out.push_back(frequency);
  return out;
}

void Controller::observe(const dmrp::Observation& now) {
  const dmrp_costmap* map = costmap_->costmap(costmap_, now.robot);
  if (!map) throw std::runtime_error("the host gives no costmap");
  if (!controller_)
    environment_->set_robot({now.footprint.radius_m, hull(now.footprint), map->inflation_radius_m, map->cost_scaling,
                             map->inscribed_radius_m});
  environment_->set_time(now.t_ns);
  environment_->set_robot_pose(now.pose.x, now.pose.y, now.pose.theta);
  environment_->set_costs({map->width, map->height, map->resolution_m, map->origin.x, map->origin.y, map->costs});
}

void Controller::configure() {
  auto controller = environment_->make(class_name_);
  const auto node = environment_->node();
  if (annotate_ && annotate_->wanted(annotate_))
    environment_->watch_trajectories([this](const auto& poses, std::int64_t step_ns) { annotate(poses, step_ns); });
  bool draws_in_thread = false;
  try {
    controller->configure(node, section, environment_->transforms(), environment_->costmap());
    node->get_parameter(section + ".regenerate_noises", draws_in_thread);
    controller->activate();
  } catch (const std::exception& error) {
    // MPPI may have started its thread by now; others cannot clean up what they have not configured.
    node->get_parameter(section + ".regenerate_noises", draws_in_thread);
    if (draws_in_thread) controller->cleanup();
    throw std::runtime_error(with_place(error.what()));
  }
  controller_ = std::move(controller);
  if (draws_in_thread) {
    const std::string reason = section + ".regenerate_noises is true: nav2 draws its noise in a thread beside";
    log(dmrp::LogLevel::warning, reason + ", and this trial does not repeat");
    if (timing_) timing_->not_repeatable(timing_, reason.c_str());
  }
  warn_of_unread_parameters();
}

void Controller::annotate(const std::vector<geometry_msgs::msg::Pose>& poses, std::int64_t step_ns) const {
  std::vector<dmrp::Pose> way;
  for (const auto& pose : poses) way.push_back({pose.position.x, pose.position.y, tf2::getYaw(pose.orientation)});
  const dmrp_trajectory trajectory = {
      sizeof(trajectory), DMRP_ANNOTATE_PREDICTED, robot_, static_cast<std::uint32_t>(way.size()), way.data(), step_ns};
  annotate_->trajectory(annotate_, &trajectory);
}

// A parameter of the wrong type: its place in the file, if the text names one.
std::string Controller::with_place(const std::string& error) const {
  for (const auto& [name, place] : file_.places)
    if (error.find("'" + name + "'") != std::string::npos) return place + ": " + error;
  return path_.empty() ? error : path_ + ": " + error;
}

void Controller::warn_of_unread_parameters() {
  const std::vector<std::string> declared = environment_->declared_parameters();
  for (const auto& [name, place] : file_.places)
    if (name.rfind(section + ".", 0) == 0 && std::find(declared.begin(), declared.end(), name) == declared.end())
      log(dmrp::LogLevel::warning, place + ": " + class_name_ + " does not read '" + name + "'");
}

// nav2's server hands over a plan for each goal, and a new one when the path has changed.
void Controller::follow_plan(const dmrp::Observation& now) {
  const PlanKey key{revision_, now.goal_index};
  if (key == plan_key_) return;
  if (key.goal_index != plan_key_.goal_index) controller_->reset();
  const double heading = course_.leads_to_goal() ? now.goal.pose.theta : std::numeric_limits<double>::quiet_NaN();
  auto plan = course_.plan(now.pose, now.progress_m, heading);
  plan.header.stamp = environment_->node()->now();
  plan_end_ = plan.poses.back().pose;
  goal_checker_.set(now.goal);
  controller_->setPlan(plan);
  plan_key_ = key;
  arrived_ = false;
}

// There the server stops asking the controller. If the robot has rolled out of the host's tolerance, it asks again.
bool Controller::at_end_of_plan(const dmrp::Observation& now) {
  const double distance_m = std::hypot(now.pose.x - plan_end_.position.x, now.pose.y - plan_end_.position.y);
  const auto robot = stamped(now.pose, environment_->node()->now()).pose;
  if (arrived_ && distance_m >= now.goal.tolerance_m) {
    plan_key_.revision = 0;
    follow_plan(now);
  }
  arrived_ = arrived_ || goal_checker_.isGoalReached(robot, plan_end_, twist(now.velocity));
  return arrived_;
}

}  // namespace nav2_adapter
