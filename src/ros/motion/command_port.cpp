#include "ros/motion/command_port.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <utility>

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

constexpr std::uint32_t kCommandsQueued = 1;  // only the newest counts
constexpr size_t kMaxCommandMessage = 16384;

const geometry_msgs::Twist& twistOf(const geometry_msgs::Twist& msg) { return msg; }
const geometry_msgs::Twist& twistOf(const geometry_msgs::TwistStamped& msg) { return msg.twist; }
geometry_msgs::Twist& twistOf(geometry_msgs::Twist& msg) { return msg; }
geometry_msgs::Twist& twistOf(geometry_msgs::TwistStamped& msg) { return msg.twist; }

std_msgs::Header headerOf(const geometry_msgs::Twist& /*msg*/) { return {}; }
template <typename Msg>
const std_msgs::Header& headerOf(const Msg& msg) {
  return msg.header;
}

void stampNow(geometry_msgs::Twist& /*msg*/) {}
template <typename Msg>
void stampNow(Msg& msg) {
  msg.header.stamp = ros::Time::now();
}

template <typename Msg>
boost::shared_ptr<Msg> stampedNow(const Msg& msg) {
  const auto stamped = boost::make_shared<Msg>(msg);
  stampNow(*stamped);
  return stamped;
}

Eigen::Vector3d fromXyz(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

template <typename Msg>
sweep_guard_core::Timestamps timestampsOf(const Msg& msg) {
  const sweep_guard_core::Instant at = now();
  const Time stamp = fromMsg(headerOf(msg).stamp);
  return {stamp == Time() ? at.stamp : stamp, at.steady};
}

template <typename Msg>
ros::Publisher advertise(ros::NodeHandle node) {
  return node.advertise<Msg>("guarded_command", 1);
}

template <typename Msg>
BoundedSubscriber subscribe(const ros::NodeHandle& node, CommandPort::Receive receive, CommandPort::Refuse refuse) {
  return subscribeBounded<Msg>(
      node, {CommandPort::kTopic, kCommandsQueued, kMaxCommandMessage},
      [receive = std::move(receive)](const ros::MessageEvent<const Msg>& event) {
        const auto& msg = event.getConstMessage();
        receive(msg, timestampsOf(*msg));
      },
      std::move(refuse));
}

template <typename Msg>
class TwistPort : public CommandPort {
 public:
  TwistPort(const ros::NodeHandle& node, const MotionParameters& parameters, const Frames& frames, Receive receive,
            Refuse refuse)
      : CommandPort(frames, parameters, advertise<Msg>(node),
                    subscribe<Msg>(node, std::move(receive), std::move(refuse))),
        linear_scale_(parameters.linear_scale),
        angular_scale_(parameters.angular_scale) {}

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

  void sendZero(const MotionInputs& /*known*/, const Cycle& /*cycle*/) override {
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

class PosePort : public CommandPort {
 public:
  PosePort(const ros::NodeHandle& node, const MotionParameters& parameters, const Frames& frames, Receive receive,
           Refuse refuse)
      : CommandPort(frames, parameters, advertise<PoseStamped>(node),
                    subscribe<PoseStamped>(node, std::move(receive), std::move(refuse))),
        repeats_(!parameters.incremental),
        silence_(parameters.options.silence),
        follower_(parameters.leash, parameters.incremental) {}

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

  void sendZero(const MotionInputs& known, const Cycle& cycle) override {
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
    if (!known.planes || !known.tool || !belongsTo(*known.planes, *known.tool)) return false;
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

std::unique_ptr<CommandPort> makeCommandPort(const ros::NodeHandle& node, const MotionParameters& parameters,
                                             const Frames& frames, CommandPort::Receive receive,
                                             CommandPort::Refuse refuse) {
  switch (parameters.command_type) {
    case CommandType::kTwist:
      return std::make_unique<TwistPort<geometry_msgs::Twist>>(node, parameters, frames, std::move(receive),
                                                               std::move(refuse));
    case CommandType::kPoseStamped:
      return std::make_unique<PosePort>(node, parameters, frames, std::move(receive), std::move(refuse));
    case CommandType::kTwistStamped:
      break;
  }
  return std::make_unique<TwistPort<geometry_msgs::TwistStamped>>(node, parameters, frames, std::move(receive),
                                                                  std::move(refuse));
}

}  // namespace sweep_guard_ros
