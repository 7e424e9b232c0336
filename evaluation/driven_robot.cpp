#include "evaluation/driven_robot.h"

#include <algorithm>

namespace sweep_guard_evaluation {

using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_core::Twist;

namespace {

Twist velocityAt(const RecordedMotion& motion, Time time) {
  const Eigen::Isometry3d from_WT = motion.at(time);
  const Eigen::Isometry3d to_WT = motion.at(time + kCommandPeriod);
  const Eigen::AngleAxisd turn_W(to_WT.linear() * from_WT.linear().transpose());
  const double seconds = toSeconds(kCommandPeriod);
  return {(to_WT.translation() - from_WT.translation()) / seconds, turn_W.angle() / seconds * turn_W.axis()};
}

}  // namespace

size_t DrivenRobot::cycleAt(Time time) const {
  const auto found = std::lower_bound(cycles.begin(), cycles.end(), time,
                                      [](const Cycle& cycle, Time wanted) { return cycle.time < wanted; });
  return static_cast<size_t>(found - cycles.begin());
}

DrivenRobot drive(const RecordedMotion& motion, const RobotOptions& options) {
  DrivenRobot driven;
  for (const auto& segment : motion.segments()) {
    SimulatedRobot robot(motion.at(segment.begin), options);
    driven.path.push_back({segment.begin, robot.pose()});
    Twist command_W;
    for (Time time = segment.begin; time + kCommandPeriod <= segment.end; time += kCommandPeriod) {
      command_W = clipped(velocityAt(motion, time), command_W, options, toSeconds(kCommandPeriod));
      driven.cycles.push_back({time, command_W, robot});
      robot.send(command_W);
      for (Time end = time + SimulatedRobot::kStep; end <= time + kCommandPeriod; end += SimulatedRobot::kStep) {
        robot.step();
        driven.path.push_back({end, robot.pose()});
      }
    }
  }
  return driven;
}

sweep_guard_recording::Recording followed(const sweep_guard_recording::Recording& recording, RobotOptions options) {
  constexpr double kUnlimited = 1e9;
  options.max_speed = options.max_turn_rate = options.max_acceleration = options.max_turn_acceleration = kUnlimited;
  const RecordedMotion path(drive(RecordedMotion(recording.poses), options).path);
  sweep_guard_recording::Recording robot{recording.name, {}, recording.poses};
  for (const auto& pose : recording.poses) {
    if (path.isContinuous(pose.stamp, pose.stamp)) robot.poses.push_back({pose.stamp, path.at(pose.stamp)});
  }
  return robot;
}

}  // namespace sweep_guard_evaluation
