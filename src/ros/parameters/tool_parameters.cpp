#include "ros/parameters/tool_parameters.h"

#include <algorithm>
#include <sstream>

#include "ros/input/joint_names.h"
#include "ros/tool/robot_tree.h"
#include "ros/tool/tool_links.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;

// The cylinder's parameters are checked for every tool type.
sweep_guard_core::Tool readCylinder(ParameterReader& read, double padding) {
  const double radius = read.number("tool/radius", 0.01, {1e-6, 100.0, "m"}, "Radius of the cylinder.");
  const double length = read.number("tool/length", 0.15, {1e-6, 100.0, "m"}, "Length of the cylinder.");
  const int sides = read.integer("tool/sides", 32, 3, 1000, "Sides of the polygon that decides how the box is turned.");
  return sweep_guard_core::Tool(sweep_guard_core::ConvexShape::cylinder(radius, length, sides).padded(padding));
}

ToolModelOptions readModelOptions(ParameterReader& read, const std::string& frame, double padding) {
  ToolModelOptions options;
  options.frame = frame;
  options.padding = padding;
  options.links =
      read.texts("tool/links", "urdf only: links that are the tool. []: tool_frame and all that is attached to it.");
  const std::string geometry = read.choice(
      "tool/geometry", "collision", {"collision", "visual", "either"},
      "urdf only: geometry of the links. either: collision or, where there is none, visual; /diagnostics says which.");
  if (geometry == "visual") options.geometry = LinkGeometry::kVisual;
  if (geometry == "either") options.geometry = LinkGeometry::kEither;
  options.mesh_depth = read.integer(
      "tool/mesh_depth", options.mesh_depth, 0, 16,
      "urdf only: how often a mesh may be cut in two; 0: one convex hull. More follows hollows and costs time.");
  options.joints = read.numbers("tool/joints",
                                "urdf only: where joints within the tool stay [rad or m], by name. Others are as close "
                                "to 0 as their limits allow, or where `joint_states` says.");
  options.mesh_roots = read.texts(
      "tool/mesh_roots", "urdf only: absolute folders of file:// meshes, besides packages on ROS_PACKAGE_PATH.");
  return options;
}

std::string describe(const ToolModel& model, const std::string& parameter, const Parameters& parameters) {
  const bool moves = parameters.articulated;
  std::ostringstream text;
  text << model.pieces.size() << " convex pieces from " << parameter << " in the frame of '" << model.frame << "'";
  for (const auto& [joint, position] : model.joints) {
    if (!moves || parameters.fixed_joints.count(joint) != 0) text << ", joint '" << joint << "' at " << position;
  }
  if (moves) text << ", joints where joint_states says";
  return text.str();
}

void checkJointNames(const Parameters& parameters) {
  const sweep_guard_core::KinematicTree& tree = parameters.robot->robot.tree;
  try {
    const JointNames names(tree, fixedPositions(tree, parameters.fixed_joints), parameters.joint_names);
  } catch (const sweep_guard_core::InvalidInput& error) {
    throw sweep_guard_core::InvalidInput(std::string("tool/joint_names: ") + error.what());
  }
}

// Of a tool whose joints move.
void checkJoints(const Parameters& parameters) {
  if (!parameters.robot) throw sweep_guard_core::InvalidInput(parameters.why_no_robot);
  const sweep_guard_core::KinematicTree& tree = parameters.robot->robot.tree;
  for (const auto& [joint, timeout] : parameters.joint_timeouts) variableNamed(tree, joint);
  checkJointNames(parameters);
  const auto is_fixed = [&](const auto& variable) { return parameters.fixed_joints.count(variable.name) != 0; };
  if (std::all_of(tree.variables().begin(), tree.variables().end(), is_fixed)) {
    throw sweep_guard_core::InvalidInput(
        "no joint moves the tool's links, or tool/joints names all that do: leave tool/joint_states out");
  }
}

void readRobot(ParameterReader& read, const std::string& parameter, const ToolModelOptions& options,
               Parameters& parameters) {
  const std::string urdf = read.searchText(parameter);
  if (urdf.empty()) {
    throw sweep_guard_core::InvalidInput("tool/type is urdf, but there is no robot description in the parameter '" +
                                         parameter + "': load one, or name it in tool/robot_description");
  }
  try {
    ToolModel model = loadToolModel(urdf, options);
    parameters.fixed_joints = options.joints;
    parameters.tool_description = describe(model, parameter, parameters);
    parameters.robot = model.robot;
    parameters.why_no_robot = model.why_no_robot;
    parameters.link_shapes = model.shapes;
    if (parameters.articulated) checkJoints(parameters);
    parameters.tool = std::make_shared<const sweep_guard_core::Tool>(parameters.articulated ? piecesByBody(*model.robot)
                                                                                            : std::move(model.pieces));
  } catch (const sweep_guard_core::InvalidInput& error) {
    throw sweep_guard_core::InvalidInput("no tool from the parameter '" + parameter + "': " + error.what());
  }
}

sweep_guard_core::AllowedPairs readAllowed(ParameterReader& read) {
  sweep_guard_core::AllowedPairs pairs;
  for (const auto& texts :
       read.groups("tool/allowed", {"link", "mesh_id"},
                   "Contact of this link with this workpiece is no warning and limits no motion; it is `allowed` in "
                   "~contacts. `*`: each link, or each workpiece. A cylinder's link is `*`.")) {
    if (!sweep_guard_core::isName(texts[1])) {
      throw sweep_guard_core::InvalidInput("parameter tool/allowed: mesh_id '" + sweep_guard_core::printable(texts[1]) +
                                           "' is no name of a workpiece: at most 128 printable characters");
    }
    pairs.push_back({texts[0], texts[1]});
  }
  return pairs;
}

void checkAllowed(const sweep_guard_core::AllowedPairs& pairs, const sweep_guard_core::Tool& tool) {
  for (const sweep_guard_core::AllowedPair& pair : pairs) {
    if (pair.link == sweep_guard_core::AllowedPair::kAny || hasLink(tool, pair.link)) continue;
    throw sweep_guard_core::InvalidInput("parameter tool/allowed: the tool has no link '" +
                                         sweep_guard_core::printable(pair.link) + "': " + linksOf(tool) +
                                         "; '*' means each");
  }
}

using Bodies = std::vector<sweep_guard_core::Tool>;

std::map<std::string, Duration> readJointTimeouts(ParameterReader& read) {
  std::map<std::string, Duration> timeouts;
  for (const auto& [joint, seconds] :
       read.numbers("tool/joint_timeouts",
                    "Age [s] from which a joint makes the warning UNKNOWN, by name, 0.01 to 2; others: "
                    "timing/pose_timeout. The longest also holds for the tool, transforms and other tools, if longer "
                    "than that. A slow joint delays contacts, not predictions.",
                    ParameterReader::Range{0.01, 2.0, "s"})) {
    timeouts[joint] = sweep_guard_core::fromSeconds(seconds);
  }
  return timeouts;
}

}  // namespace

void readTool(ParameterReader& read, const Parameters* before, Parameters& parameters) {
  const std::string type = read.choice("tool/type", "cylinder", {"cylinder", "urdf"},
                                       "cylinder: fills z in [-tool/length, 0] of the tool frame; z points out of the "
                                       "tip. urdf: the geometry of links of a robot description.");
  const double padding = read.live().number("tool/padding", 0.0, {0.0, 1.0, "m"}, "Grows the tool on all sides.");
  const sweep_guard_core::Tool cylinder = readCylinder(read, padding);
  const std::string description =
      read.name("tool/robot_description", "robot_description",
                "urdf only: parameter with the URDF, searched from the node's namespace upwards.");
  read.ignore(description);
  ToolModelOptions options = readModelOptions(read, parameters.tool_frame, padding);
  options.of_root = parameters.tool_source == ToolSource::kJointStates;
  parameters.robot_description = description;
  parameters.mesh_depth = options.mesh_depth;
  parameters.mesh_roots = options.mesh_roots;
  const bool joint_states = read.flag("tool/joint_states", false,
                                      "urdf only: `joint_states` moves joints of the tool, none of them tool_frame. "
                                      "Implied by tool_source joint_states.");
  parameters.joint_names =
      read.textsByName("tool/joint_names",
                       "urdf only: names in the URDF by names in `joint_states`, where they differ: {outer_yaw: yaw}.");
  parameters.joint_timeouts = readJointTimeouts(read);
  parameters.guard.allowed = readAllowed(read);
  parameters.articulated = joint_states || parameters.tool_source == ToolSource::kJointStates;
  parameters.trajectory_action = read.optionalName(
      "trajectory/action",
      "control_msgs/FollowJointTrajectory action that moves the joints, as /arm_controller/follow_joint_trajectory: "
      "its trajectory is predicted, and its rest tested (~trajectory).");
  if (!parameters.trajectory_action.empty() && !parameters.articulated) {
    throw sweep_guard_core::InvalidInput(
        "trajectory/action: no joints of the tool move: set tool/joint_states, or tool_source joint_states");
  }
  parameters.tool_padding = padding;
  if (before != nullptr) parameters.attached = before->attached;
  if (!parameters.attached.empty() && before->tool_padding != padding) {
    throw sweep_guard_core::InvalidInput("tool/padding does not change while '" + *parameters.attached.begin() +
                                         "' is attached: detach it first");
  }
  if (before != nullptr && before->tool_padding == padding) {
    parameters.tool = before->tool;
    parameters.bodies = before->bodies;
    parameters.fixed_joints = before->fixed_joints;
    parameters.tool_description = before->tool_description;
    parameters.robot = before->robot;
    parameters.link_shapes = before->link_shapes;
    parameters.why_no_robot = before->why_no_robot;
  } else if (type == "urdf") {
    readRobot(read, description, options, parameters);
  } else {
    parameters.tool = std::make_shared<const sweep_guard_core::Tool>(cylinder);
    parameters.tool_description = "a cylinder";
    parameters.why_no_robot = "tool/type is cylinder: set it to urdf";
    if (parameters.articulated) {
      throw sweep_guard_core::InvalidInput("tool/joint_states, or tool_source joint_states: " +
                                           parameters.why_no_robot);
    }
  }
  checkAllowed(parameters.guard.allowed, *parameters.tool);
  parameters.bodies = parameters.articulated
                          ? std::shared_ptr<const Bodies>(parameters.robot, &parameters.robot->robot.tools)
                          : std::make_shared<const Bodies>(Bodies{*parameters.tool});
}

void readRobotLinks(ParameterReader& read, const Parameters* before, Parameters& parameters) {
  if (before != nullptr) {
    parameters.robot_links = before->robot_links;
    parameters.why_no_links = before->why_no_links;
    return;
  }
  ToolModelOptions options;
  options.geometry = LinkGeometry::kEither;
  options.mesh_depth = parameters.mesh_depth;
  options.mesh_roots = parameters.mesh_roots;
  const std::string urdf = read.searchText(parameters.robot_description);
  parameters.why_no_links = "there is no parameter '" + parameters.robot_description + "'";
  if (urdf.empty()) return;
  try {
    parameters.robot_links = std::make_shared<const decltype(loadLinks(urdf, options))>(loadLinks(urdf, options));
  } catch (const sweep_guard_core::InvalidInput& error) {
    parameters.why_no_links = error.what();
  }
}

void readCommandSource(ParameterReader& read, Parameters& parameters) {
  const std::map<std::string, CommandSource> types = {{"none", CommandSource::kNone},
                                                      {"pose_stamped", CommandSource::kPoseStamped},
                                                      {"twist_stamped", CommandSource::kTwistStamped},
                                                      {"twist", CommandSource::kTwist},
                                                      {"joint_jog", CommandSource::kJointJog}};
  const CommandSource type = types.at(
      read.choice("prediction/command_type", "none", {"none", "pose_stamped", "twist_stamped", "twist", "joint_jog"},
                  "Commands to the robot, from which `direct` predicts, too: geometry_msgs types, of tool_frame [m, "
                  "m/s, rad/s] (twist: along the axes of fixed_frame), or control_msgs/JointJog. none: none."));
  parameters.command_type = type;
  parameters.command_topic = read.name("prediction/command_topic", "command",
                                       "Topic of these commands: with motion_guard its guarded_command.");
  const bool of_joints = type == CommandSource::kJointJog;
  if (of_joints && !parameters.articulated)
    throw sweep_guard_core::InvalidInput("prediction/command_type: no joint moves the tool: use another one");
  if (!of_joints && type != CommandSource::kNone && parameters.tool_source == ToolSource::kJointStates)
    throw sweep_guard_core::InvalidInput("prediction/command_type: joints move the tool: use joint_jog or none");
}

}  // namespace sweep_guard_ros
