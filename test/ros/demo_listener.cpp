#include "demo_listener.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kQueue = 100000;
const ros::Duration kStall(0.1);  // that the operator makes up for
constexpr auto kTimeout = std::chrono::seconds(20);

bool samePose(const geometry_msgs::PoseStamped& a, const geometry_msgs::PoseStamped& b) {
  return (positionOf(a) - positionOf(b)).norm() < 1e-7;
}

size_t restingAtEnd(const DemoListener::Poses& poses) {
  const auto moved =
      std::find_if(poses.rbegin(), poses.rend(), [&poses](const auto& pose) { return !samePose(pose, poses.back()); });
  return static_cast<size_t>(moved - poses.rbegin());
}

}  // namespace

DemoListener::DemoListener() {
  const boost::function<void(const geometry_msgs::PoseStamped&)> take_pose = [this](const auto& pose) {
    const std::lock_guard lock(mutex_);
    poses_.push_back(pose);
    changed_.notify_all();
  };
  const boost::function<void(const sweep_guard::Warning&)> take_warning = [this](const auto& warning) {
    const std::lock_guard lock(mutex_);
    in_contact_ = in_contact_ || warning.contact;
    acknowledged_ = acknowledged_ || warning.acknowledged;
    changed_.notify_all();
  };
  pose_subscriber_ = node_.subscribe<geometry_msgs::PoseStamped>("tool_pose", kQueue, take_pose);
  warning_subscriber_ = node_.subscribe<sweep_guard::Warning>("sweep_guard/warning", kQueue, take_warning);
  spinner_.start();
}

DemoListener::Poses DemoListener::awaitPoses(const std::function<bool(const Poses&)>& fit) const {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, kTimeout, [&] { return fit(poses_); })) {
    throw std::runtime_error("no such motion, after " + std::to_string(poses_.size()) + " poses");
  }
  return poses_;
}

DemoListener::Poses DemoListener::awaitPoses(size_t count) const {
  return awaitPoses([count](const Poses& poses) { return poses.size() >= count; });
}

DemoListener::Poses DemoListener::awaitRest(size_t count) const {
  const Poses poses = awaitPoses([count](const Poses& all) { return restingAtEnd(all) > count; });
  return {poses.end() - static_cast<std::ptrdiff_t>(restingAtEnd(poses)), poses.end()};
}

bool DemoListener::acknowledged() const {
  const std::lock_guard lock(mutex_);
  return acknowledged_;
}

bool DemoListener::inContact() const {
  const std::lock_guard lock(mutex_);
  return in_contact_;
}

void DemoListener::awaitContact() const {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, kTimeout, [this] { return in_contact_; })) throw std::runtime_error("no contact");
}

Eigen::Vector3d positionOf(const geometry_msgs::PoseStamped& pose) {
  const auto& p = pose.pose.position;
  return {p.x, p.y, p.z};
}

double longestStep(const DemoListener::Poses& poses) {
  double longest = 0.0;
  for (size_t i = 1; i < poses.size(); ++i) {
    longest = std::max(longest, (positionOf(poses[i]) - positionOf(poses[i - 1])).norm());
  }
  return longest;
}

bool isEven(const DemoListener::Poses& poses, const ros::Duration& period) {
  return std::adjacent_find(poses.begin(), poses.end(), [&period](const auto& a, const auto& b) {
           const ros::Duration gap = b.header.stamp - a.header.stamp;
           return gap != period && gap <= period + kStall;
         }) == poses.end();
}

}  // namespace sweep_guard_ros
