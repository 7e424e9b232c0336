#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recording/run_node.h"
#include "ros/input/joint_names.h"
#include "ros/parameters/parameters.h"
#include "simulation/joint_motion.h"
#include "simulation/motion_start.h"
#include "simulation/playback.h"
#include "simulation/pose_scheduler.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {
namespace {

using sweep_guard_core::InvalidInput;

constexpr std::uint32_t kQueue = 10000;
constexpr double kDepth = 0.010;     // [m] of the middle of the path below the surface
constexpr double kFinalDelay = 1.0;  // [s] for the last states to be sent

/// Moves the guard's articulated tool by the joints of a rosbag. Puts its base where the tool meets the workpiece, waits
/// for workpiece and guard, then publishes each state when it is due.
class JointPlayer {
 public:
  explicit JointPlayer(sweep_guard_ros::ParameterReader& parameters)
      : bag_(parameters.name("bag", "")),
        topic_(parameters.text("topic", "")),
        place_T_(readPlace(parameters)),
        loop_(parameters.flag("loop", true)),
        guard_(sweep_guard_ros::loadParameters(ros::NodeHandle(parameters.name("guard", "sweep_guard")))),
        start_(parameters) {
    if (guard_.tool_source != sweep_guard_ros::ToolSource::kJointStates) {
      throw InvalidInput("no joints move the tool of the guard; set its tool_source to joint_states");
    }
    if (guard_.tool_frame == start_.frame()) {
      throw InvalidInput("tool_frame is '" + start_.frame() +
                         "', and this frame cannot be moved to the workpiece; leave --tool-frame out");
    }
    const sweep_guard_core::KinematicTree& tree = guard_.robot->robot.tree;
    const sweep_guard_ros::JointNames names(tree, sweep_guard_ros::fixedPositions(tree, guard_.fixed_joints),
                                            guard_.joint_names);
    for (size_t i = 0; i < tree.variables().size(); ++i) joints_.push_back(names.inMessages(i));
    motion_ = readJointMotion(bag_, topic_, tree, guard_.fixed_joints, guard_.joint_names);
    publisher_ = node_.advertise<sensor_msgs::JointState>("joint_states", kQueue);
  }

  void run() {
    ros::Time::waitForValid();
    if (!start_.awaitWorkpiece()) return;
    const Meeting meeting = halfway(*guard_.robot, motion_);
    placeBase(place_T_ ? start_.center_W() - *place_T_ : placeToMeet(meeting, start_.mesh_W(), kDepth));
    if (!start_.awaitGuard() || !start_.awaitSubscribers(publisher_)) return;
    start_.stopListening();
    ROS_INFO("the joints start to move");
    if (perform(Playback<StampedPositions>(std::move(motion_), loop_))) {
      ROS_INFO("the motion is over");
      ros::Duration(kFinalDelay).sleep();
    }
  }

 private:
  static std::optional<Eigen::Vector3d> readPlace(sweep_guard_ros::ParameterReader& parameters) {
    const Eigen::Vector3d place_T = parameters.position("place", Eigen::Vector3d::Zero());
    return ros::NodeHandle("~").hasParam("place") ? std::optional(place_T) : std::nullopt;
  }

  // The frame is not turned.
  void placeBase(const Eigen::Vector3d& p_W) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(Eigen::Isometry3d(Eigen::Translation3d(p_W)));
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = start_.frame();
    transform.child_frame_id = guard_.tool_frame;
    broadcaster_.sendTransform(transform);
    const Eigen::Vector3d center_T = start_.center_W() - p_W;
    ROS_INFO("the workpiece is at place:=[%.3f,%.3f,%.3f] in '%s'", center_T.x(), center_T.y(), center_T.z(),
             guard_.tool_frame.c_str());
  }

  bool perform(Playback<StampedPositions> playback) {
    const PoseScheduler scheduler(rosNow(), /*live=*/false);
    for (auto state = playback.next(); state; state = playback.next()) {
      if (!awaitDue(scheduler, state->stamp)) return false;
      publish(sweep_guard_ros::toMsg(scheduler.due(state->stamp)), state->positions);
      ros::spinOnce();
    }
    return true;
  }

  void publish(const ros::Time& stamp, const std::vector<double>& positions) {
    sensor_msgs::JointState message;
    message.header.stamp = stamp;
    message.name = joints_;
    message.position = positions;
    publisher_.publish(message);
  }

  std::string bag_;
  std::string topic_;
  std::optional<Eigen::Vector3d> place_T_;  // [m] of the center of the workpiece; empty: where the tool meets it
  bool loop_;
  sweep_guard_ros::Parameters guard_;
  std::vector<std::string> joints_;  // by variable
  std::vector<StampedPositions> motion_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  MotionStart start_;
};

}  // namespace
}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::JointPlayer>(argc, argv, "joint_player");
}
