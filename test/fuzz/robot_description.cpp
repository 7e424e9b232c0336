// The text of a robot description: every collision becomes a piece of the tool, or the description is refused. Without mesh
// files, which are read in a process of their own.
#include <tinyxml2.h>

#include <cmath>
#include <set>

#include "require.h"
#include "ros/tool/robot_description.h"
#include "ros/tool/robot_tree.h"
#include "ros/tool/tool_model.h"
#include "sweep_guard/common/error.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::poseOf;
using sweep_guard_ros::RobotDescription;
using sweep_guard_ros::ToolModel;
using sweep_guard_ros::ToolModelOptions;

// As a reader would that knows the elements alone.
size_t collisionsIn(const std::string& urdf) {
  tinyxml2::XMLDocument document;
  document.Parse(urdf.data(), urdf.size());
  size_t count = 0;
  const tinyxml2::XMLElement* const robot = document.FirstChildElement("robot");
  for (auto* link = robot->FirstChildElement("link"); link != nullptr; link = link->NextSiblingElement("link")) {
    for (auto* part = link->FirstChildElement("collision"); part != nullptr;
         part = part->NextSiblingElement("collision")) {
      ++count;
    }
  }
  return count;
}

void checkPoses(const RobotDescription& robot) {
  for (const urdf::Link* link : RobotDescription::subtree(robot.root())) {
    try {
      const sweep_guard_ros::RobotTree robot_tree = sweep_guard_ros::treeOf(robot, robot.root(), {link});
      std::vector<Eigen::Isometry3d> X_RL;
      robot_tree.tree.poses(sweep_guard_ros::positionsOf(robot, robot_tree.tree, {}), X_RL);
      const Eigen::Isometry3d X = poseOf(robot_tree.links[0], X_RL);
      if (!X.matrix().allFinite()) continue;  // too far away: the tool is refused then
      const Eigen::Matrix3d product = X.linear() * X.linear().transpose();
      require((product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6,
              "a link is placed by a rigid motion");
    } catch (const InvalidInput&) {
    }
  }
}

void checkTool(const ToolModel& model) {
  require(!model.pieces.empty(), "a tool has pieces");
  for (const sweep_guard_core::ConvexPiece& piece : model.pieces) {
    require(piece.shape_T.boundingRadius() <= 100.0, "a tool reaches 100 m at most, and is finite");
  }
}

void checkTools(const std::string& urdf, const RobotDescription& robot) {
  ToolModelOptions options;
  options.frame = robot.root().name;
  try {
    const ToolModel whole = loadToolModel(urdf, options);
    checkTool(whole);
    require(options.frame == "tool" || whole.pieces.size() == collisionsIn(urdf),
            "every collision is a piece of the tool");
  } catch (const InvalidInput&) {
  }
  for (const urdf::Link* link : RobotDescription::subtree(robot.root())) {
    options.links = {link->name};
    options.joints.clear();
    if (link->parent_joint) options.joints[link->parent_joint->name] = 0.5;
    options.padding = 0.001;
    try {
      const ToolModel one = loadToolModel(urdf, options);
      checkTool(one);
      require(one.pieces.size() == link->collision_array.size(), "a link has a piece for each collision");
    } catch (const InvalidInput&) {
    }
  }
}

void check(const std::string& urdf) {
  try {
    const RobotDescription robot(urdf);
    checkPoses(robot);
    if (urdf.find("mesh") == std::string::npos) checkTools(urdf, robot);
  } catch (const InvalidInput& error) {
    require(std::string(error.what()).find('\n') == std::string::npos, "a refusal is one line");
  }
}

const Target kRobotDescription("robot_description", [](Input input) { check(input.rest()); });

}  // namespace
}  // namespace sweep_guard_fuzz
