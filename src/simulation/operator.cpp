#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recording/recording.h"
#include "recording/run_node.h"
#include "ros/parameters/parameters.h"
#include "simulation/drilling.h"
#include "simulation/guided_tip.h"
#include "simulation/guides.h"
#include "simulation/joystick.h"
#include "simulation/motion_start.h"
#include "simulation/pose_scheduler.h"
#include "simulation/pose_stream.h"
#include "simulation/tip.h"
#include "sweep_guard/SetIntent.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/ros/conversions.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

namespace {

using sweep_guard_core::StampedPose;

constexpr int kQueue = 10000;
constexpr double kReminderPeriod = 10.0;  // [s]
constexpr double kFinalDelay = 1.0;       // [s] for the last poses to be sent
constexpr double kRisePerWidth = 0.45;    // clearance per radial extent of the tool, as the drill tilts
constexpr double kDepth = 0.010;          // [m] below the surface, in scripted and recorded motion
constexpr double kClearance = 0.1;        // [m] above the surface, at the start of a guided motion
constexpr int kMaxAxis = 63;              // or button of an input device
constexpr double kHoleCircle = 0.06;      // [m] radius
constexpr int kHolesOnCircle = 5;
constexpr double kIntendedRadius = 0.08;  // [m] around a hole: that of some triangles of a coarse workpiece
constexpr double kIntendedDepth = 0.02;   // [m]; more than the depth of a hole, because the workpiece sways

/// Moves the tool: waits for the workpiece and for the guard, then publishes each pose when it is due.
class OperatorNode {
 public:
  explicit OperatorNode(sweep_guard_ros::ParameterReader& parameters)
      : motion_file_(parameters.text("motion_file", "")),
        motion_topic_(parameters.text("motion_topic", "")),
        input_(parameters.choice("input", motion_file_.empty() ? "scripted" : "recording",
                                 {"scripted", "recording", "marker", "joy"})),
        limits_(readLimits(parameters, "hand/", {})),
        joystick_(readJoystick(parameters)),
        acknowledge_button_(parameters.integer("joy/acknowledge_button", 0, -1, kMaxAxis)),
        rate_(parameters.number("rate", 100.0, {1.0, 10000.0})),
        loop_(parameters.flag("loop", true)),
        wait_for_guard_(parameters.flag("wait_for_guard", true)),
        first_hole_(parameters.integer("first_hole", 0, 0, kHolesOnCircle)),
        intend_(parameters.flag("intend", false)),
        guard_(parameters.text("guard", "")),
        start_(parameters) {
    if (input_ == "recording") readMotion();
    publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", kQueue);
  }

  void run() {
    ros::Time::waitForValid();
    if (!start_.awaitWorkpiece()) return;
    if (wait_for_guard_ && !start_.awaitGuard()) return;
    if (!guard_.empty()) setTool(*sweep_guard_ros::loadParameters(ros::NodeHandle(guard_)).tool);
    const PoseStream motion = makePoses();
    if (!start_.awaitSubscribers(publisher_)) return;
    if (intend_) intendHoles();
    start_.stopListening();
    ROS_INFO("the operator starts to move");
    if (perform(motion)) {
      ROS_INFO("the motion is over");
      ros::Duration(kFinalDelay).sleep();
    }
  }

 private:
  static Joystick::Options readJoystick(sweep_guard_ros::ParameterReader& parameters) {
    const auto axes = [&parameters](const std::string& key, const std::array<int, 3>& fallback) {
      const std::vector<int> read = parameters.integers(key, {fallback.begin(), fallback.end()}, -1, kMaxAxis);
      return std::array<int, 3>{read[0], read[1], read[2]};
    };
    Joystick::Options options;
    options.linear_axes = axes("joy/linear_axes", options.linear_axes);
    options.angular_axes = axes("joy/angular_axes", options.angular_axes);
    options.linear = parameters.position("joy/linear", options.linear);
    options.angular = parameters.position("joy/angular", options.angular);
    options.dead_zone = parameters.number("joy/dead_zone", options.dead_zone, {0.0, 0.9});
    options.timeout = sweep_guard_core::fromSeconds(
        parameters.number("joy/timeout", sweep_guard_core::toSeconds(options.timeout), {0.01, 10.0}));
    return options;
  }

  void readMotion() {
    if (motion_file_.empty()) {
      throw sweep_guard_core::InvalidInput(
          "input is 'recording' and motion_file is empty; give a motion file or a rosbag");
    }
    recording_ = sweep_guard_recording::readRecording(motion_file_, motion_topic_).poses;
  }

  void setTool(const sweep_guard_core::Tool& tool) {
    p_TTip_ = tipOf(tool);
    radial_extent_ = radialExtent(tool);
  }

  PoseStream makePoses() {
    if (input_ == "recording") return playRecording();
    if (input_ == "scripted") return drill();
    const GuidedTip tip(aboveTheWorkpiece(), limits_);
    if (input_ == "joy") {
      joy_guide_.emplace(node_, joystick_, acknowledge_button_);
      return guidedBy(tip, [this](GuidedTip& moving, double dt) { joy_guide_->move(moving, dt); });
    }
    marker_guide_ =
        std::make_unique<MarkerGuide>(ros::names::resolve("~marker"), start_.frame(), tip.pose(), start_.transforms());
    return guidedBy(tip, [this](GuidedTip& moving, double dt) { marker_guide_->move(moving, dt); });
  }

  PoseStream guidedBy(const GuidedTip& tip, const Guide& guide) {
    return guided(tip, rate_, [this, guide](GuidedTip& moving, double dt) {
      if (std::exchange(stalled_, false)) moving.stop();
      guide(moving, dt);
    });
  }

  PoseStream drill() const {
    Drilling::Options options;
    options.depth = kDepth;
    options.clearance += kRisePerWidth * radial_extent_;
    return sampled(Drilling(holes_W(), options), rate_, loop_);
  }

  std::vector<Eigen::Vector3d> holes_W() const {
    std::vector<Eigen::Vector3d> holes_W = holesAround(start_.mesh_W(), kHoleCircle, kHolesOnCircle);
    const auto first = static_cast<size_t>(first_hole_) % holes_W.size();
    std::rotate(holes_W.begin(), holes_W.begin() + static_cast<std::ptrdiff_t>(first), holes_W.end());
    return holes_W;
  }

  // Says where the drill is meant to touch the workpiece.
  void intendHoles() {
    sweep_guard::SetIntent service;
    for (const Eigen::Vector3d& hole_W : holes_W()) {
      sweep_guard::Intend intend;
      intend.mesh_id = start_.meshId();
      intend.frame_id = start_.frame();
      intend.center = tf2::toMsg(hole_W);
      intend.radius = kIntendedRadius;
      intend.depth = kIntendedDepth;
      service.request.intends.push_back(intend);
    }
    auto client = node_.serviceClient<sweep_guard::SetIntent>("intend");
    if (!waitUntil([&] { return client.exists(); }, "the guard's service ~intend")) return;
    if (!client.call(service)) service.response.message = "no answer";
    ROS_INFO("~intend: %s", service.response.message.c_str());
  }

  PoseStream playRecording() const {
    return replayed(recording_, loop_, highestPoint(start_.mesh_W()) - kDepth * Eigen::Vector3d::UnitZ());
  }

  Eigen::Isometry3d aboveTheWorkpiece() const {
    const double clearance = kClearance + kRisePerWidth * radial_extent_;
    return pointingDown(highestPoint(start_.mesh_W()) + clearance * Eigen::Vector3d::UnitZ());
  }

  bool perform(const PoseStream& motion) {
    PoseScheduler scheduler(rosNow(), joy_guide_ || marker_guide_);
    for (std::optional<StampedPose> pose = motion(); pose; pose = motion()) {
      if (!awaitDue(scheduler, pose->stamp)) return false;
      if (scheduler.resume(pose->stamp, rosNow())) resumeAfterStall();
      publish(pose->X_WT * Eigen::Translation3d(-p_TTip_), sweep_guard_ros::toMsg(scheduler.due(pose->stamp)));
      ros::spinOnce();
    }
    return true;
  }

  void resumeAfterStall() {
    ROS_WARN_THROTTLE(kReminderPeriod, "the operator stalled: the tool continues from rest");
    stalled_ = true;
    if (joy_guide_) joy_guide_->release();
  }

  void publish(const Eigen::Isometry3d& X_WT, const ros::Time& stamp) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = start_.frame();
    message.pose = tf2::toMsg(X_WT);
    publisher_.publish(message);
  }

  std::string motion_file_;
  std::string motion_topic_;
  std::string input_;
  GuidedTip::Limits limits_;
  Joystick::Options joystick_;
  int acknowledge_button_;
  double rate_;
  bool loop_;
  bool wait_for_guard_;
  int first_hole_;  // of the script
  bool intend_;
  std::string guard_;  // the operator moves its tool; empty: a tool with the tip at the origin
  std::vector<StampedPose> recording_;
  Eigen::Vector3d p_TTip_ = Eigen::Vector3d::Zero();  // [m]; the motion is that of the tip
  double radial_extent_ = 0.0;                        // [m]
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  MotionStart start_;
  bool stalled_ = false;  // since the last motion of the tip
  std::optional<JoyGuide> joy_guide_;
  std::unique_ptr<MarkerGuide> marker_guide_;
};

}  // namespace

}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::OperatorNode>(argc, argv, "operator");
}
