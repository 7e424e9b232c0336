#include "ros/motion/joint_port.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/motion/joint_motion_guard.h"

namespace sweep_guard_ros {
namespace {

using std_msgs::Float64MultiArray;
using sweep_guard_core::GuardedMotion;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::MotionInputs;
using sweep_guard_core::printable;
using sweep_guard_core::Timestamps;
using trajectory_msgs::JointTrajectory;

using Names = std::vector<std::string>;

const Names& namesOf(const JointJog& msg, const Names& /*configured*/) { return msg.joint_names; }
const Names& namesOf(const JointTrajectory& msg, const Names& /*configured*/) { return msg.joint_names; }
const Names& namesOf(const Float64MultiArray& /*msg*/, const Names& configured) { return configured; }

std::vector<double>& velocitiesOf(JointJog& msg) { return msg.velocities; }
std::vector<double>& velocitiesOf(JointTrajectory& msg) { return msg.points.front().velocities; }
std::vector<double>& velocitiesOf(Float64MultiArray& msg) { return msg.data; }
template <typename Msg>
const std::vector<double>& velocitiesOf(const Msg& msg) {
  return velocitiesOf(const_cast<Msg&>(msg));  // only read
}

// Each throws unless velocities are all that is commanded.
void requireVelocities(const JointJog& msg) {
  if (!msg.displacements.empty()) throw InvalidInput("displacements are not limited: send velocities alone");
}
void requireVelocities(const JointTrajectory& msg) {
  if (msg.points.size() != 1) {
    throw InvalidInput("a trajectory of " + std::to_string(msg.points.size()) +
                       " points is not limited: send one point with velocities");
  }
  const auto& point = msg.points.front();
  if (point.positions.empty() && point.accelerations.empty() && point.effort.empty()) return;
  throw InvalidInput(
      "positions, accelerations and efforts are not limited: send velocities alone (MoveIt Servo: "
      "publish_joint_velocities true, publish_joint_positions and publish_joint_accelerations false)");
}
void requireVelocities(const Float64MultiArray& /*msg*/) {}

template <typename Msg>
class JointPort : public CommandPort {
 public:
  JointPort(const PortSetup& setup, const JointInput& joints)
      : CommandPort(setup.advertise<Msg>(), setup.subscribe<Msg>()),
        parameters_(setup.parameters),
        joints_(joints),
        guard_(setup.parameters.options, setup.parameters.joint_source.tree) {
    command_.velocities.resize(static_cast<Eigen::Index>(parameters_.joint_source.tree->variables().size()));
  }

  sweep_guard_core::PermissionDecision permission(const MotionInputs& known, const Timestamps& command,
                                                  const sweep_guard_core::Instant& now) override {
    return guard_.permission(known, measured(known), command, now);
  }

  GuardedMotion limit(const MotionInputs& known, const Timestamps& timestamps, const Cycle& cycle) override {
    if (timestamps.stamp > cycle.now.stamp + kFutureTolerance) throw InvalidInput(kFutureStampText);
    read();
    command_.timestamps = timestamps;
    command_.period = cycle.period;
    GuardedMotion motion = guard_.guard(known, measured(known), command_, cycle.now);
    if (accepted_ && leavesJointsOut(*accepted_)) publishScaled(*accepted_, 0.0, /*again=*/true);
    accepted_ = newestPtr<Msg>();
    return motion;
  }

  void send(const GuardedMotion& motion, bool again) override {
    if (motion.scale == 1.0 && !again) return publishNewest<Msg>();
    publishScaled(newest<Msg>(), motion.scale, again);
  }

  // What was refused may be anything: the command before tells what shall stand still.
  void sendZero(const MotionInputs& /*known*/, const Cycle& cycle) override {
    guard_.stop(cycle.now.steady);
    if (accepted_) publishScaled(*accepted_, 0.0, /*again=*/true);
  }

 private:
  void read() {
    const Msg& msg = newest<Msg>();
    requireVelocities(msg);
    const Names& names = namesOf(msg, parameters_.joints);
    const std::vector<double>& velocities = velocitiesOf(msg);
    if (names.empty()) throw InvalidInput("it names no joint");
    if (names.size() != velocities.size()) {
      throw InvalidInput("there are " + std::to_string(velocities.size()) + " velocities for " +
                         std::to_string(names.size()) + " joints");
    }
    command_.velocities.setZero();
    for (size_t i = 0; i < names.size(); ++i) {
      if (std::count(names.begin(), names.end(), names[i]) > 1)
        throw InvalidInput("joint '" + printable(names[i]) + "' is named twice");
      command_.velocities[variableOf(names[i])] = velocities[i];
    }
  }

  // A controller goes on with joints that are named no more.
  bool leavesJointsOut(const Msg& before) const {
    const Names& now = namesOf(newest<Msg>(), parameters_.joints);
    const Names& then = namesOf(before, parameters_.joints);
    return std::any_of(then.begin(), then.end(),
                       [&](const std::string& joint) { return std::find(now.begin(), now.end(), joint) == now.end(); });
  }

  Eigen::Index variableOf(const std::string& name) const {
    if (const auto variable = parameters_.joint_source.names->variable(name))
      return static_cast<Eigen::Index>(*variable);
    throw InvalidInput("joint '" + printable(name) + "' is none of the robot's below '" + parameters_.tool.frame +
                       "', or mimics another one: command those, or set tool/joint_names");
  }

  const sweep_guard_core::MeasuredJoints& measured(const MotionInputs& known) {
    if (!known.planes || !joints_.newest(*known.planes, measured_)) measured_.state.positions.clear();
    return measured_;
  }

  void publishScaled(const Msg& command, double scale, bool again) {
    const auto msg = boost::make_shared<Msg>(command);
    if (scale != 1.0) {
      for (double& velocity : velocitiesOf(*msg)) velocity = scale == 0.0 ? 0.0 : scale * velocity;
    }
    if (again && headerOf(command).stamp != ros::Time()) stampNow(*msg);  // 0 begins at once
    publish(msg);
  }

  const MotionParameters& parameters_;
  const JointInput& joints_;
  sweep_guard_core::JointMotionGuard guard_;
  sweep_guard_core::MeasuredJoints measured_;  // in the newest call of measured()
  sweep_guard_core::JointCommand command_;     // newest one
  boost::shared_ptr<const Msg> accepted_;      // newest one that was limited; null: none was
};

}  // namespace

std::unique_ptr<CommandPort> makeJointPort(const PortSetup& setup, const JointInput& joints) {
  switch (setup.parameters.command_type) {
    case CommandType::kJointTrajectory:
      return std::make_unique<JointPort<JointTrajectory>>(setup, joints);
    case CommandType::kVelocityArray:
      return std::make_unique<JointPort<Float64MultiArray>>(setup, joints);
    default:
      return std::make_unique<JointPort<JointJog>>(setup, joints);
  }
}

}  // namespace sweep_guard_ros
