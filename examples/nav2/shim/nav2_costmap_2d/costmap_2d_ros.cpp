// SPDX-License-Identifier: MIT
#include <nav2_costmap_2d/costmap_2d_ros.hpp>
#include <nav2_costmap_2d/inflation_layer.hpp>

namespace nav2_costmap_2d {

// nav2's inflation layer as controllers ask it: for its parameters and the cost at a distance. The costs themselves are
// inflated before they come here.
InflationLayer::InflationLayer()
    : inflation_radius_(0.0),
      inscribed_radius_(0.0),
      cost_scaling_factor_(0.0),
      inflate_unknown_(false),
      inflate_around_unknown_(false),
      cell_inflation_radius_(0),
      cached_cell_inflation_radius_(0),
      resolution_(0.0),
      cache_length_(0),
      last_min_x_(0.0),
      last_min_y_(0.0),
      last_max_x_(0.0),
      last_max_y_(0.0),
      need_reinflation_(false),
      access_(nullptr) {}
InflationLayer::~InflationLayer() = default;
void InflationLayer::onInitialize() {}
void InflationLayer::matchSize() {}
void InflationLayer::onFootprintChanged() {}
void InflationLayer::updateBounds(double, double, double, double*, double*, double*, double*) {}
void InflationLayer::updateCosts(Costmap2D&, int, int, int, int) {}

class Costmap2DROS::Inflated : public InflationLayer {
 public:
  explicit Inflated(LayeredCostmap& layers) {
    layered_costmap_ = &layers;
    name_ = "inflation_layer";
    enabled_ = current_ = true;
  }
  void set(double radius_m, double cost_scaling_per_m, double inscribed_radius_m) {
    inflation_radius_ = radius_m;
    cost_scaling_factor_ = cost_scaling_per_m;
    inscribed_radius_ = inscribed_radius_m;
  }
  void matchSize() override { resolution_ = layered_costmap_->getCostmap()->getResolution(); }
};

namespace {

// nav2's defaults.
constexpr double padding_m = 0.01;
constexpr double default_radius_m = 0.1, default_side_m = 5.0, default_resolution_m = 0.1;
constexpr double default_inflation_radius_m = 0.55, default_cost_scaling_per_m = 10.0;

}  // namespace

Costmap2DROS::Costmap2DROS(const rclcpp::NodeOptions& options)
    : nav2_util::LifecycleNode("costmap", options),
      layered_("odom", true, false),
      inflated_(std::make_shared<Inflated>(layered_)),
      transforms_(std::make_shared<tf2_ros::Buffer>(get_clock())) {
  layered_.addPlugin(inflated_);
}

Costmap2DROS::Costmap2DROS(const std::string&, const std::string&, bool) : Costmap2DROS() {}

nav2_util::CallbackReturn Costmap2DROS::on_configure(const rclcpp_lifecycle::State&) {
  const auto cells = static_cast<unsigned int>(default_side_m / default_resolution_m);
  layered_.resizeMap(cells, cells, default_resolution_m, 0.0, 0.0);
  set_robot_radius(default_radius_m);
  set_inflation(default_inflation_radius_m, default_cost_scaling_per_m, layered_.getInscribedRadius());
  return nav2_util::CallbackReturn::SUCCESS;
}

void Costmap2DROS::set_inflation(double radius_m, double cost_scaling_per_m, double inscribed_radius_m) {
  inflated_->set(radius_m, cost_scaling_per_m, inscribed_radius_m);
}

void Costmap2DROS::set_robot_radius(double radius_m) {
  use_radius_ = true;
  radius_m_ = radius_m;
  setRobotFootprint(makeFootprintFromRadius(radius_m));
}

void Costmap2DROS::set_robot_polygon(const std::vector<geometry_msgs::msg::Point>& points) {
  use_radius_ = false;
  setRobotFootprint(points);
}

void Costmap2DROS::setRobotFootprint(const std::vector<geometry_msgs::msg::Point>& points) {
  unpadded_ = padded_ = points;
  padFootprint(padded_, padding_m);
  layered_.setFootprint(padded_);
}

bool Costmap2DROS::getRobotPose(geometry_msgs::msg::PoseStamped& pose) {
  geometry_msgs::msg::PoseStamped origin;
  origin.header.frame_id = getBaseFrameID();
  origin.header.stamp = now();
  return transformPoseToGlobalFrame(origin, pose);
}

bool Costmap2DROS::transformPoseToGlobalFrame(const geometry_msgs::msg::PoseStamped& in,
                                              geometry_msgs::msg::PoseStamped& out) {
  try {
    transforms_->transform(in, out, getGlobalFrameID());
    return true;
  } catch (const tf2::TransformException&) {
    return false;
  }
}

void Costmap2DROS::getOrientedFootprint(std::vector<geometry_msgs::msg::Point>& oriented) {
  geometry_msgs::msg::PoseStamped pose;
  if (getRobotPose(pose))
    transformFootprint(pose.pose.position.x, pose.pose.position.y, tf2::getYaw(pose.pose.orientation), padded_,
                       oriented);
}

}  // namespace nav2_costmap_2d
