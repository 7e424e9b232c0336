#include "ros/tool/payload.h"

#include <algorithm>

#include "guard/workpiece_store.h"
#include "ros/tool/tool_links.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::ConvexPiece;
using sweep_guard_core::Tool;
using Pieces = std::vector<ConvexPiece>;

Tool with(const Tool& tool, const Payload& payload, const Eigen::Isometry3d& X_BM, double padding) {
  Pieces pieces = tool.pieces();
  for (const auto& shape_M : payload.shapes_M)
    pieces.push_back({payload.id, shape_M.placed(X_BM).padded(padding + sweep_guard_core::WorkpieceStore::kRigid)});
  return Tool(std::move(pieces));
}

Tool without(const Tool& tool, const std::string& id) {
  Pieces pieces = tool.pieces();
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(), [&](const ConvexPiece& piece) { return piece.link == id; }),
               pieces.end());
  return Tool(std::move(pieces));
}

std::shared_ptr<const RobotModel> changed(const RobotModel& model, size_t body, Tool tool) {
  const auto next = std::make_shared<RobotModel>(model);
  next->robot.bodies[body].radius = tool.boundingRadius();
  next->robot.tools[body] = std::move(tool);
  return next;
}

void setRigidTool(Tool tool, Parameters& parameters) {
  parameters.tool = std::make_shared<const Tool>(std::move(tool));
  parameters.bodies = std::make_shared<const std::vector<Tool>>(std::vector<Tool>{*parameters.tool});
}

void setTool(const std::shared_ptr<const RobotModel>& robot, Parameters& parameters) {
  parameters.robot = robot;
  parameters.bodies = std::shared_ptr<const std::vector<Tool>>(robot, &robot->robot.tools);
  parameters.tool = std::make_shared<const Tool>(piecesByBody(*robot));
}

size_t bodyOf(const RobotModel& model, const std::string& link) {
  const auto& tools = model.robot.tools;
  const auto holds = [&](const Tool& tool) { return hasLink(tool, link); };
  return static_cast<size_t>(std::find_if(tools.begin(), tools.end(), holds) - tools.begin());
}

Eigen::Isometry3d configuredPose(const RobotModel& model, size_t body) {
  std::vector<Eigen::Isometry3d> X_TB;
  bodyPoses(model.robot.tree, model.robot.bodies, {model.X_TR, model.positions}, X_TB);
  return X_TB[body];
}

}  // namespace

size_t bodyWithLink(const Parameters& parameters, const std::string& link) {
  if (!hasLink(*parameters.tool, link)) {
    throw sweep_guard_core::InvalidInput("the tool has no link '" + sweep_guard_core::printable(link) +
                                         "': " + linksOf(*parameters.tool));
  }
  return parameters.articulated ? bodyOf(*parameters.robot, link) : 0;
}

Parameters withPayload(const Parameters& before, const Payload& payload, const sweep_guard_core::PoseWithFrames& pose) {
  if (hasLink(*before.tool, payload.id)) {
    throw sweep_guard_core::InvalidInput("the tool has a link '" + payload.id +
                                         "' already: contacts could not tell them apart");
  }
  const Eigen::Isometry3d X_BM = pose.bodies[bodyWithLink(before, payload.link)].X_WB.inverse() * payload.X_WM;
  Parameters next = before;
  next.attached.insert(payload.id);
  if (!before.articulated) setRigidTool(with(*before.tool, payload, X_BM, before.tool_padding), next);
  if (!before.robot) return next;
  const size_t body = bodyOf(*before.robot, payload.link);
  const Eigen::Isometry3d X_TB =
      before.articulated ? Eigen::Isometry3d::Identity() : configuredPose(*before.robot, body);
  const Tool tool = with(before.robot->robot.tools[body], payload, X_TB.inverse() * X_BM, before.tool_padding);
  next.robot = changed(*before.robot, body, tool);
  if (before.articulated) setTool(next.robot, next);
  return next;
}

Parameters withoutPayload(const Parameters& before, const std::string& id) {
  Parameters next = before;
  next.attached.erase(id);
  if (!before.articulated) setRigidTool(without(*before.tool, id), next);
  if (!before.robot) return next;
  const size_t body = bodyOf(*before.robot, id);
  next.robot = changed(*before.robot, body, without(before.robot->robot.tools[body], id));
  if (before.articulated) setTool(next.robot, next);
  return next;
}

}  // namespace sweep_guard_ros
