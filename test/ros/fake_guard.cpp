#include "fake_guard.h"

#include <limits>
#include <utility>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr const char* kFrame = "world";
constexpr std::uint32_t kRevision = 1;
constexpr auto kPeriod = std::chrono::milliseconds(10);
const ros::Duration kValid(0.2);

sweep_guard::ToolBalls oneBall(const FakeLink& link) {
  sweep_guard::ToolBalls balls;
  balls.header.frame_id = link.tool;
  balls.header.stamp = ros::Time::now();
  balls.tool = link.tool;
  balls.revision = kRevision;
  balls.pieces.resize(1);
  balls.pieces[0].balls.resize(1);
  balls.pieces[0].link = balls.pieces[0].frame = link.link;
  balls.pieces[0].balls[0].center = vectorMsg<geometry_msgs::Point>(link.center);
  balls.pieces[0].balls[0].radius = FakeGuard::kRadius;
  return balls;
}

}  // namespace

FakeGuard::FakeGuard(const std::string& name, FakeLink link) : node_(name), link_(std::move(link)) {
  warnings_ = node_.advertise<sweep_guard::Warning>("warning", 10);
  proximities_ = node_.advertise<sweep_guard::Proximity>("proximity", 10);
  balls_ = node_.advertise<sweep_guard::ToolBalls>("tool_balls", 1, /*latch=*/true);
  balls_.publish(oneBall(link_));
  repeater_.emplace(kPeriod, [this] { publish(); });
}

void FakeGuard::setGap(double gap) {
  const std::lock_guard lock(mutex_);
  gap_ = gap;
}

void FakeGuard::setJoints(const std::vector<std::string>& joints) {
  const std::lock_guard lock(mutex_);
  link_.joints = joints;
  link_.positions.assign(joints.size(), 0.0);
}

void FakeGuard::setLevel(std::uint8_t level) {
  const std::lock_guard lock(mutex_);
  level_ = level;
}

void FakeGuard::setSilent(bool silent) {
  const std::lock_guard lock(mutex_);
  silent_ = silent;
}

void FakeGuard::publish() {
  const std::lock_guard lock(mutex_);
  if (silent_) return;
  const ros::Time now = ros::Time::now();
  sweep_guard::Warning warning;
  warning.header.frame_id = kFrame;
  warning.header.stamp = now;
  warning.tool = link_.tool;
  warning.level = level_;
  warning.clear = level_ == sweep_guard::Warning::CLEAR;
  warning.reasons = level_ == sweep_guard::Warning::UNKNOWN ? sweep_guard::Warning::MESH_STALE : 0;
  warning.valid_until = now + kValid;
  warnings_.publish(warning);
  proximities_.publish(proximity(now));
}

sweep_guard::Proximity FakeGuard::proximity(ros::Time now) const {
  sweep_guard::Proximity proximity;
  proximity.header.frame_id = kFrame;
  proximity.header.stamp = now;
  proximity.tool = link_.tool;
  proximity.tool_pose.orientation.w = 1.0;
  proximity.joints = link_.joints;
  proximity.positions = link_.positions;
  proximity.tool_revision = kRevision;
  proximity.valid_until = now + kValid;
  proximity.valid = true;
  proximity.uncovered_distance = std::numeric_limits<double>::infinity();
  sweep_guard::SeparatingPlane& plane = proximity.planes.emplace_back();
  plane.tool_link = link_.link;
  plane.mesh_id = "table";
  plane.point.z = link_.center_T.z() - gap_ - kRadius;
  plane.normal.z = 1.0;
  plane.gap = gap_;
  return proximity;
}

}  // namespace sweep_guard_ros
