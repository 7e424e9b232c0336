#include "ros/motion/command_port.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <utility>

#include "ros/motion/command_frames.h"
#include "ros/motion/joint_port.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/motion/pose_follower.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::PoseStamped;
using sweep_guard_core::Duration;
using sweep_guard_core::GuardedMotion;
using sweep_guard_core::MotionCommand;
using sweep_guard_core::MotionInputs;
using sweep_guard_core::Moved;
using sweep_guard_core::Time;
using sweep_guard_core::Twist;

const geometry_msgs::Twist& twistOf(const geometry_msgs::Twist& msg) { return msg; }
const geometry_msgs::Twist& twistOf(const geometry_msgs::TwistStamped& msg) { return msg.twist; }
geometry_msgs::Twist& twistOf(geometry_msgs::Twist& msg) { return msg; }
geometry_msgs::Twist& twistOf(geometry_msgs::TwistStamped& msg) { return msg.twist; }

template <typename Msg>
boost::shared_ptr<Msg> stampedNow(const Msg& msg) {
  auto stamped = boost::make_shared<Msg>(msg);
  stampNow(*stamped);
  return stamped;
}

Eigen::Vector3d fromXyz(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

// A command of the tool: limited by where the tool is.
class ToolPort : public CommandPort {
 public:
  sweep_guard_core::PermissionDecision permission(const MotionInputs& known,
                                                  const sweep_guard_core::Timestamps& command,
                                                  const sweep_guard_core::Instant& now) override {
    return guard_.permission(known, command, now);
  }

  GuardedMotion limit(const MotionInputs& known, const sweep_guard_core::Timestamps& timestamps,
                      const Cycle& cycle) override {
    MotionCommand command = read(known, cycle);
    command.timestamps = timestamps;
    command.period = cycle.period;
    return guard_.guard(known, command, cycle.now);
  }

  void sendZero(const MotionInputs& known, const Cycle& cycle) override {
    guard_.stop(cycle.now.steady);
    sendStandstill(known, cycle);
  }

 protected:
  ToolPort(const PortSetup& setup, const Frames& frames, const ros::Publisher& publisher, BoundedSubscriber subscriber)
      : CommandPort(publisher, std::move(subscriber)),
        frames_(frames),
        parameters_(setup.parameters),
        guard_(setup.parameters.options) {}

  // Reads the newest command. All but its timestamps and `period` is filled in.
  virtual MotionCommand read(const MotionInputs& known, const Cycle& cycle) = 0;
  virtual void sendStandstill(const MotionInputs& known, const Cycle& cycle) = 0;

  Eigen::Isometry3d poseOf(const std::string& frame, const std::optional<ToolPose>& tool) const {
    return commandFramePose(frames_, parameters_, frame, tool);
  }
  Eigen::Isometry3d point() const { return newestPose(frames_, parameters_.tool.frame, parameters_.command_point); }

 private:
  const Frames& frames_;
  const MotionParameters& parameters_;
  sweep_guard_core::MotionGuard guard_;
};

template <typename Msg>
class TwistPort : public ToolPort {
 public:
  TwistPort(const PortSetup& setup, const Frames& frames)
      : ToolPort(setup, frames, setup.advertise<Msg>(), setup.subscribe<Msg>()),
        linear_scale_(setup.parameters.linear_scale),
        angular_scale_(setup.parameters.angular_scale) {}

  MotionCommand read(const MotionInputs& known, const Cycle& /*cycle*/) override {
    const geometry_msgs::Twist& msg = twistOf(newest<Msg>());
    R_WC_ = poseOf(headerOf(newest<Msg>()).frame_id, known.pose).linear();
    MotionCommand command;
    command.point_T = point().translation();
    command.twist_W = {R_WC_ * (linear_scale_ * fromXyz(msg.linear)), R_WC_ * (angular_scale_ * fromXyz(msg.angular))};
    commanded_W_ = command.twist_W;
    return command;
  }

  void send(const GuardedMotion& motion, bool again) override {
    const Twist& let_through_W = motion.twist_W;
    if (let_through_W == commanded_W_) return again ? publish(stampedNow(newest<Msg>())) : publishNewest<Msg>();
    const auto msg = boost::make_shared<Msg>(newest<Msg>());
    geometry_msgs::Twist& twist = twistOf(*msg);
    twist.linear = vectorMsg<geometry_msgs::Vector3>(R_WC_.transpose() * let_through_W.v_W / linear_scale_);
    twist.angular = vectorMsg<geometry_msgs::Vector3>(R_WC_.transpose() * let_through_W.w_W / angular_scale_);
    if (again) stampNow(*msg);
    publish(msg);
  }

  void sendStandstill(const MotionInputs& /*known*/, const Cycle& /*cycle*/) override {
    const auto msg = boost::make_shared<Msg>(newest<Msg>());
    twistOf(*msg) = {};
    stampNow(*msg);
    publish(msg);
  }

 private:
  const double linear_scale_;
  const double angular_scale_;
  Eigen::Matrix3d R_WC_ = Eigen::Matrix3d::Identity();  // of the newest command, as the following
  Twist commanded_W_;
};

class PosePort : public ToolPort {
 public:
  PosePort(const PortSetup& setup, const Frames& frames)
      : ToolPort(setup, frames, setup.advertise<PoseStamped>(), setup.subscribe<PoseStamped>()),
        repeats_(!setup.parameters.incremental),
        silence_(setup.parameters.options.silence),
        follower_(setup.parameters.leash, setup.parameters.incremental) {}

  bool isPose() const override { return true; }
  bool repeats() const override { return repeats_; }

  MotionCommand read(const MotionInputs& known, const Cycle& cycle) override {
    if (!known.pose) throw FrameError("no tool pose yet");
    X_TP_ = point();
    const Eigen::Isometry3d command_CP = fromMsg(newest<PoseStamped>().pose);
    X_WC_ = poseOf(newest<PoseStamped>().header.frame_id, known.pose);
    frame_ = newest<PoseStamped>().header.frame_id;
    if (!follower_.begun()) follower_.begin(known.pose->X_WT * X_TP_);
    follow(known, cycle);
    MotionCommand command;
    command.point_T = X_TP_.translation();
    command.twist_W = follower_.towards(X_WC_ * command_CP, cycle.since_sent);
    command.rest_WT = follower_.sent() * X_TP_.inverse();
    return command;
  }

  void send(const GuardedMotion& motion, bool again) override {
    if (motion.decision.permission == sweep_guard_core::Permission::kStop) {
      follower_.hold(tool_is_fresh_);
    } else {
      follower_.moveOn(motion.twist_W);
    }
    if (follower_.reached()) return again ? publish(stampedNow(newest<PoseStamped>())) : publishNewest<PoseStamped>();
    publishSent(again ? ros::Time::now() : newest<PoseStamped>().header.stamp);
  }

  void sendStandstill(const MotionInputs& known, const Cycle& cycle) override {
    if (!follower_.begun()) return;
    follow(known, cycle);
    follower_.hold(tool_is_fresh_);
    followFrame();
    publishSent(ros::Time::now());
  }

  void pause() override { follower_.end(); }
  void rebase() override { follower_.rebase(); }

  std::optional<Moved> standingLead() const override {
    if (!follower_.waits()) return {};
    const Eigen::Isometry3d X_TS = follower_.tool()->inverse() * follower_.sent();
    return Moved{X_TS.translation().norm(), Eigen::AngleAxisd(X_TS.linear()).angle()};
  }

 private:
  void follow(const MotionInputs& known, const Cycle& cycle) {
    const std::optional<ToolPose>& tool = known.pose;
    tool_is_fresh_ = tool && age(tool->timestamps, cycle.now) <= silence_;
    if (!tool) return;
    const Duration tool_age = std::max(Duration::zero(), age(tool->timestamps, cycle.now));
    follower_.observe({tool->X_WT * X_TP_, tool_age, cycle.period, cycle.now.steady});
    if (tool_is_fresh_ && passesASurface(known)) follower_.takeBack();
  }

  bool passesASurface(const MotionInputs& known) const {
    if (known.jointsMoveTool() || !known.planes || !known.tool || !belongsTo(*known.planes, *known.tool)) return false;
    const Eigen::Isometry3d sent_WT = follower_.sent() * X_TP_.inverse();
    return sweep_guard_core::passesASurface(*known.planes, *known.tool, known.pose->X_WT, sent_WT);
  }

  // The frame may move while the tool stands still.
  void followFrame() {
    try {
      X_WC_ = poseOf(frame_, {});
    } catch (const FrameError&) {  // the newest one known, as for the frame of the tool
    }
  }

  void publishSent(const ros::Time& stamp) {
    const auto msg = boost::make_shared<PoseStamped>();
    msg->header.frame_id = frame_;
    msg->header.stamp = stamp;
    msg->pose = toMsg(X_WC_.inverse() * follower_.sent());
    publish(msg);
  }

  const bool repeats_;
  const Duration silence_;  // of the tool: an older pose does not show where it is
  sweep_guard_core::PoseFollower follower_;
  bool tool_is_fresh_ = false;
  Eigen::Isometry3d X_TP_ = Eigen::Isometry3d::Identity();  // newest one known
  std::string frame_;                                       // of the newest command that was read, as X_WC_
  Eigen::Isometry3d X_WC_ = Eigen::Isometry3d::Identity();
};

}  // namespace

sweep_guard_core::Timestamps PortSetup::timestampsOf(const std_msgs::Header& header) {
  const sweep_guard_core::Instant at = now();
  const Time stamp = fromMsg(header.stamp);
  return {stamp == Time() ? at.stamp : stamp, at.steady};
}

std::unique_ptr<CommandPort> makeCommandPort(const PortSetup& setup, const Frames& frames, const JointInput* joints) {
  if (joints != nullptr) return makeJointPort(setup, *joints);
  switch (setup.parameters.command_type) {
    case CommandType::kTwist:
      return std::make_unique<TwistPort<geometry_msgs::Twist>>(setup, frames);
    case CommandType::kPoseStamped:
      return std::make_unique<PosePort>(setup, frames);
    default:
      return std::make_unique<TwistPort<geometry_msgs::TwistStamped>>(setup, frames);
  }
}

}  // namespace sweep_guard_ros
