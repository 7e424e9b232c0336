#include "ros/service/trajectory_watch.h"

#include <std_msgs/Bool.h>

#include <algorithm>
#include <utility>

#include "ros/service/check_trajectory.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Error;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::TrajectoryPlan;

constexpr Duration kTestInterval = std::chrono::milliseconds(200);
constexpr int kShare = 10;               // one part of a processor's time out of so many
constexpr double kRestDeviation = 5e-3;  // [m], of a link within a sweep: the rest is not near
constexpr std::uint32_t kMessagesQueued = 10;

TrajectoryPlan trajectoryPlanOf(const trajectory_msgs::JointTrajectory& msg, const Parameters& parameters) {
  TrajectoryPlan plan{namesInModel(msg.joint_names, parameters), {}};
  for (const auto& point : msg.points) {
    plan.points.push_back(
        {Duration(point.time_from_start.toNSec()), point.positions, point.velocities, point.accelerations});
  }
  return plan;
}

Duration timeOfImpact(const sweep_guard::CheckTrajectory::Response& response, const std::vector<Duration>& times) {
  const size_t segment = response.segment;
  if (segment + 1 >= times.size()) return times.back();
  const double share = response.time_of_impact;
  return times[segment] + std::chrono::duration_cast<Duration>(
                              share * std::chrono::duration<double>(times[segment + 1] - times[segment]));
}

}  // namespace

TrajectoryWatch::TrajectoryWatch(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                 ServiceThreads& threads, PathTests& tests, GuardCalls guard)
    : threads_(threads), tests_(tests), guard_(std::move(guard)) {
  const Parameters& parameters = tests.parameters().initial();
  const std::string& action = parameters.trajectory_action;
  if (action.empty()) return;
  ros::NodeHandle own(private_node);
  status_publisher_ = own.advertise<sweep_guard::TrajectoryStatus>("trajectory", 1);
  clear_publisher_ = own.advertise<std_msgs::Bool>("trajectory_clear", 1);
  const auto refuse = [this, action](const std::string& reason) { log_.error(action, action + ": " + reason); };
  const ros::NodeHandle queued = threads.brief.on(node);
  goals_subscriber_ = subscribeBounded<FollowJointTrajectoryActionGoal>(
      queued, {action + "/goal", kMessagesQueued, parameters.max_message_size},
      [this](const auto& event) { onGoal(*event.getConstMessage(), fromMsg(event.getReceiptTime())); }, refuse);
  states_subscriber_ = subscribeBounded<actionlib_msgs::GoalStatusArray>(
      queued, {action + "/status", kMessagesQueued, parameters.max_message_size},
      [this](const auto& event) { onStates(*event.getConstMessage()); }, refuse);
}

void TrajectoryWatch::onGoal(const FollowJointTrajectoryActionGoal& msg, sweep_guard_core::Time received) {
  TrajectoryGoals::Goal goal{msg.goal_id.id, nullptr};
  try {
    const auto parameters = tests_.parameters().get();
    const auto begin = msg.trajectory.header.stamp.isZero() ? received : fromMsg(msg.trajectory.header.stamp);
    goal.trajectory = std::make_shared<const sweep_guard_core::JointTrajectory>(
        parameters->robot->robot.tree, parameters->robot->beside, trajectoryPlanOf(msg.trajectory, *parameters), begin,
        newestPose().state.positions);
  } catch (const std::exception& error) {
    goal.refusal = error.what();
    log_.error("goal", "goal '" + sweep_guard_core::printable(goal.id) + "' refused: " + goal.refusal);
  }
  const sweep_guard_core::Lock lock(mutex_);
  goals_.add(std::move(goal));
}

void TrajectoryWatch::onStates(const actionlib_msgs::GoalStatusArray& msg) {
  {
    const sweep_guard_core::Lock lock(mutex_);
    goals_.setStates(msg, std::chrono::steady_clock::now());
  }
  underWay();
}

sweep_guard_core::PoseWithFrames TrajectoryWatch::newestPose() const {
  auto pose = guard_.newest_pose();
  if (pose.wait_for(kGuardTimeout) != std::future_status::ready) throw Error("the guard is busy");
  return pose.get();
}

// Tells the guard if it is another one. If that fails, the next call does.
TrajectoryGoals::UnderWay TrajectoryWatch::underWay() {
  const sweep_guard_core::Lock lock(mutex_);
  auto under_way = goals_.underWay(std::chrono::steady_clock::now());
  if (under_way.trajectory == set_) return under_way;
  try {
    guard_.set_trajectory(under_way.trajectory);
    set_ = under_way.trajectory;
  } catch (const Error& error) {
    under_way.problem = error.what();
  }
  return under_way;
}

void TrajectoryWatch::testIfDue() {
  if (!status_publisher_ || std::chrono::steady_clock::now() < due_.load() || testing_.exchange(true)) return;
  threads_.lasting.post([this] { test(); });
}

void TrajectoryWatch::test() {
  const SteadyTime begin = std::chrono::steady_clock::now();
  Summary summary;
  sweep_guard::TrajectoryStatus& status = summary.status;
  status.header.stamp = ros::Time::now();
  status.header.frame_id = tests_.parameters().initial().fixed_frame;
  status.time = ros::Duration(-1.0);
  try {
    const TrajectoryGoals::UnderWay under_way = underWay();
    summary.idle = !under_way.trajectory && under_way.problem.empty();
    status.text = summary.idle ? "no trajectory is under way" : under_way.problem;
    if (under_way.trajectory) testRest(*under_way.trajectory, status);
  } catch (const std::exception& error) {
    summary.idle = false;
    status.text = error.what();
  }
  publish(std::move(summary), begin);
}

void TrajectoryWatch::testRest(const sweep_guard_core::JointTrajectory& trajectory,
                               sweep_guard::TrajectoryStatus& status) {
  const sweep_guard_core::PoseWithFrames pose = newestPose();
  if (!trajectory.isFollowed(pose.stamp, pose.state.positions)) throw Error("the robot does not follow the trajectory");
  const sweep_guard_core::SampledPositions rest = trajectory.rest(pose.stamp, pose.state.positions);
  geometry_msgs::PoseStamped tool_pose;
  tool_pose.header.frame_id = status.header.frame_id;  // without a stamp: in the newest transforms
  tool_pose.pose = toMsg(pose.X_WT);
  sweep_guard::CheckTrajectory::Response response;
  const auto question = tests_.question("", "", /*margin=*/0.0, /*fine=*/true, std::chrono::steady_clock::now());
  checkPositions(tests_, question, {rest.positions, tool_pose, {}, kRestDeviation}, response);
  status.header.stamp = toMsg(pose.stamp);
  status.watching = true;
  status.clear = response.clear && status.text.empty();
  if (!response.message.empty()) status.text += (status.text.empty() ? "" : "; ") + response.message;
  if (!response.collision) return;
  status.time = ros::Duration(sweep_guard_core::toSeconds(timeOfImpact(response, rest.times)));
  status.link = response.tool_link;
  status.mesh_id = response.mesh_id;
}

void TrajectoryWatch::publish(Summary summary, SteadyTime begin) {
  summary.took = std::chrono::steady_clock::now() - begin;
  const Duration interval = std::max(kTestInterval, kShare * summary.took);
  summary.status.valid_until = ros::Time::now() + ros::Duration(2.0 * sweep_guard_core::toSeconds(interval));
  status_publisher_.publish(summary.status);
  std_msgs::Bool clear;
  clear.data = summary.status.clear;
  clear_publisher_.publish(clear);
  {
    const sweep_guard_core::Lock lock(mutex_);
    summary_ = std::move(summary);
  }
  due_ = begin + interval;
  testing_ = false;
}

TrajectoryWatch::Summary TrajectoryWatch::summary() const {
  const sweep_guard_core::Lock lock(mutex_);
  return summary_;
}

}  // namespace sweep_guard_ros
