#pragma once

#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ros/parameters/camera_parameters.h"
#include "ros/tool/tool_model.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/interaction/interaction_finder.h"
#include "sweep_guard/monitor/warning.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

enum class ToolSource { kTopic, kTf, kJointStates };

/// Type of what goes to the robot.
enum class CommandSource { kNone, kPoseStamped, kTwistStamped, kTwist, kJointJog };

/// What happens if the detector fails its test at the start.
enum class SelfTest { kNone, kUnknown, kExit };

/// Holds all parameters of the node, checked. loadParameters() defines key, unit, range, default and effect of each;
/// doc/interface.md and config/sweep_guard.yaml are generated from them.
struct Parameters {
  std::string fixed_frame;
  ToolSource tool_source;
  std::string tool_frame;
  std::shared_ptr<const sweep_guard_core::Tool>
      tool;  ///< of an articulated one: all pieces of `bodies` in their order,
             ///< joints as configured
  /// What the guard sweeps: the rigid bodies of an articulated tool, each in its own frame, or else `tool`.
  std::shared_ptr<const std::vector<sweep_guard_core::Tool>> bodies;
  bool articulated;                            ///< joints of the tool move, as `joint_states` says: `robot` is there
  std::map<std::string, double> fixed_joints;  ///< positions [rad or m] of joints that `joint_states` need not have
  std::map<std::string, std::string>
      joint_names;  ///< names of joints in the URDF, by those in `joint_states` that differ
  std::map<std::string, sweep_guard_core::Duration> joint_timeouts;  ///< where a joint has its own
  sweep_guard_core::Duration joint_timeout;                          ///< of the others, and of the tool pose
  std::shared_ptr<const RobotModel> robot;  ///< whose links are the tool; null: nothing that joints move
  std::string why_no_robot;                 ///< why it is null
  std::string trajectory_action;            ///< of the controller that moves the joints; empty: none is watched
  std::string robot_description;            ///< name of the parameter that holds the URDF
  int mesh_depth;                           ///< see ToolModelOptions
  std::vector<std::string> mesh_roots;      ///< see locateMesh()
  /// Pieces of the links of the robot description that joints move, by the link that is their frame: cameras may see them. Null: none.
  std::shared_ptr<const std::map<std::string, std::vector<sweep_guard_core::ConvexPiece>>> robot_links;
  std::string why_no_links;            ///< why it is null
  double tool_padding;                 ///< [m]
  std::set<std::string> attached;      ///< workpieces that are part of the tool, as links of these names (~attach)
  std::string tool_description;        ///< shape and source of the tool, for people
  std::vector<LinkShape> link_shapes;  ///< what each link is made of, without what is attached; none of a cylinder
  sweep_guard_core::DetectorChoice detector;  ///< as configured, until it is replaced by one that is available
  SelfTest self_test;
  int cross_check;             ///< one query of the detector out of this many is asked twice; 0: none
  CommandSource command_type;  ///< of what goes to the robot
  std::string command_topic;
  sweep_guard_core::GuardOptions guard;
  sweep_guard_core::WarningLimits limits;
  double acknowledge_distance;  ///< [m]
  double proximity_reach;       ///< [m]; 0: no planes
  sweep_guard_core::InteractionOptions interaction;
  double marker_rate;                       ///< [Hz]
  std::set<std::string> marker_namespaces;  ///< published ones
  sweep_guard_core::Duration check_sweep_deadline;
  int realtime_priority;                     ///< of the guard's thread; 0: none
  sweep_guard_core::Rules<bool> sheets;      ///< workpieces whose surfaces have no inside
  sweep_guard_core::Rules<double> paddings;  ///< of workpieces [m]
  std::set<std::string> ruled_ids;           ///< ids for which there is a rule of their own
  std::set<std::string> mesh_ids;            ///< workpieces that must be there; empty: all that come
  std::vector<std::string> other_tools;      ///< nodes of their guards
  std::vector<CameraParameters> cameras;
  bool allow_several_publishers;  ///< of tool poses
  size_t max_triangles;
  size_t max_message_size;               ///< [bytes]
  size_t max_memory;                     ///< of the node's process [MiB]; 0: no limit
  ParameterReader::Settings settings;    ///< as read
  std::vector<ParameterInfo> described;  ///< always the same keys in the same order
};

/// Returns the ids of the cameras.
std::set<std::string> cameraIds(const Parameters& parameters);

/// Returns the workpieces that must be there: `mesh_ids` and the cameras.
std::set<std::string> requiredIds(const Parameters& parameters);

/// Returns the robot whose joints move the tool; null: none do.
std::shared_ptr<const sweep_guard_core::Robot> articulatedRobot(const Parameters& parameters);

/// Reads the private parameters, and makes the tool from them or from a robot description. A missing parameter takes
/// its default. Warns of each parameter that is not read.
/// @throws sweep_guard_core::InvalidInput naming key, value and range if one has the wrong type, is NaN or is out of
///     range; naming the three keys that replaced `warning/min_probability` if that is set; naming link and file if
///     the robot description makes no tool
Parameters loadParameters(const ros::NodeHandle& private_node);

/// Refuses to start with the defaults alone in place of a configuration: a master that was restarted has lost it.
/// @param arguments  of the command line. The launch files give `--configured`; without it, nothing is checked
/// @throws sweep_guard_core::InvalidInput if there is no private parameter
void checkConfigured(const ros::NodeHandle& private_node, const std::vector<std::string>& arguments);

/// Returns the parameters with these changes, checked as at the start. All others stay, whatever the parameter server
/// holds now.
/// @throws sweep_guard_core::InvalidInput as loadParameters(), or if a parameter does not exist or may not change while
///     the node runs
Parameters changeParameters(const ros::NodeHandle& private_node, const Parameters& before,
                            const std::map<std::string, ParameterValue>& changes);

}  // namespace sweep_guard_ros
