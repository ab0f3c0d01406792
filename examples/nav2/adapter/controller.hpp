// SPDX-License-Identifier: MIT
// A controller of nav2 as a plugin of dmrp: what nav2's controller server does for it, without a server.
#pragma once

#include <adapter/environment.hpp>
#include <adapter/goal_checker.hpp>
#include <adapter/parameter_file.hpp>
#include <adapter/plan.hpp>
#include <dmrp/plugin.hpp>
#include <memory>
#include <set>
#include <string>

namespace nav2_adapter {

dmrp::Descriptor describe(const char* id, const char* class_name);

class Controller : public dmrp::LocalController {
 public:
  Controller(const char* id, const char* class_name) : id_(id), class_name_(class_name) {}
  ~Controller() override { end(); }

  dmrp::Param<std::string> nav2_params =
      param("nav2_params", "").path().doc("nav2's parameter file, its section FollowPath; none: the published values");

  dmrp::Status start(const dmrp::Start& start) override;
  void set_path(dmrp::Path path, std::uint64_t revision) override;
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override;
  void trial_end(const dmrp::TrialEnd&) override { end(); }

 private:
  // What the plan in force was made for: another one is made when any of them changes.
  struct PlanKey {
    std::uint64_t revision = 0;
    std::uint32_t goal_index = 0;
    bool operator==(const PlanKey& b) const { return revision == b.revision && goal_index == b.goal_index; }
  };

  std::string published_file() const;
  std::vector<rclcpp::Parameter> parameters();
  void observe(const dmrp::Observation& now);
  void configure();
  void end();
  void follow_plan(const dmrp::Observation& now);
  bool at_end_of_plan(const dmrp::Observation& now);
  void annotate(const std::vector<geometry_msgs::msg::Pose>& poses, std::int64_t step_ns) const;
  void warn_of_unread_parameters();
  std::string with_place(const std::string& error) const;

  const char* id_;
  const char* class_name_;
  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_annotate* annotate_ = nullptr;
  const dmrp_timing* timing_ = nullptr;
  std::uint32_t robot_ = 0;
  std::string path_;
  ParameterFile file_;
  std::unique_ptr<Environment> environment_;
  std::shared_ptr<nav2_core::Controller> controller_;
  GoalChecker goal_checker_;
  Course course_;
  std::uint64_t revision_ = 0;
  PlanKey plan_key_;
  geometry_msgs::msg::Pose plan_end_;
  bool arrived_ = false;
  LogSink log_sink_;
  std::set<std::string> logged_places_;
};

}  // namespace nav2_adapter
