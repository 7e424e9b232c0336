#include "evaluation/loop_scene.h"

#include <algorithm>

#include "detection/placed_core.h"
#include "evaluation/simulated_node.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Separation;

LoopScene::LoopScene(const sweep_guard_core::Tool& tool, const SquareObstacle& square)
    : tool_(tool), detector_(sweep_guard_core::makeDetector("reference")) {
  workpieces_.push_back(std::make_shared<const sweep_guard_core::Workpiece>(
      sweep_guard_core::Workpiece{"square", 1, {}, {}, kFrame, meshOf(square)}));
  for (size_t i = 0; i < corners_M_.size(); ++i) corners_M_[i] = workpieces_[0]->mesh_M.vertex(i);
}

Eigen::Vector3d LoopScene::normal_M() const {
  return (corners_M_[1] - corners_M_[0]).cross(corners_M_[3] - corners_M_[0]).normalized();
}

Separation LoopScene::separationAt(const Eigen::Isometry3d& X_MT, size_t piece) const {
  const sweep_guard_core::ConvexShape& shape_T = tool_.pieces()[piece].shape_T;
  const sweep_guard_core::PlacedCore core{shape_T, X_MT.linear(), X_MT.translation()};
  Separation apart = separation(core, sweep_guard_core::PointHull(corners_M_));
  apart.gap -= shape_T.padding();
  return apart;
}

Separation LoopScene::separationAt(const Eigen::Isometry3d& X_MT) const {
  Separation nearest = separationAt(X_MT, 0);
  for (size_t piece = 1; piece < tool_.pieces().size(); ++piece) {
    const Separation apart = separationAt(X_MT, piece);
    if (apart.gap < nearest.gap) nearest = apart;
  }
  return nearest;
}

std::optional<size_t> LoopScene::firstContact(const std::vector<Eigen::Isometry3d>& path_MT,
                                              const std::vector<double>& gaps) {
  if (*std::min_element(gaps.begin(), gaps.end()) > kSwept) return std::nullopt;
  return checkPath(*detector_, {tool_, path_MT, workpieces_[0]->mesh_M}).first_contact;
}

const sweep_guard_core::Proximity& LoopScene::proximityAt(const Eigen::Isometry3d& X_WT, const Eigen::Isometry3d& X_WM,
                                                          sweep_guard_core::Time stamp, double reach) {
  finder_.find({{&tool_}, {stamp, instantOf(stamp).steady, X_WT, {{kFrame, X_WM}}}, workpieces_, reach}, proximity_);
  return proximity_;
}

}  // namespace sweep_guard_evaluation
