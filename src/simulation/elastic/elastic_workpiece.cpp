#include "simulation/elastic/elastic_workpiece.h"

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using Eigen::Vector3d;
using sweep_guard_core::TriangleMesh;

namespace {

TriangleMesh meshOf(const std::vector<float>& positions, const std::vector<sweep_guard_core::Triangle>& triangles) {
  std::vector<Vector3d> vertices;
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    vertices.emplace_back(Eigen::Map<const Eigen::Vector3f>(&positions[i]).cast<double>());
  }
  return {vertices, triangles};
}

BarStructure heldBars(const TriangleMesh& mesh, const ElasticWorkpiece::Options& options) {
  if (!(options.fixed_height >= 0.0 && options.fixed_height <= 1.0)) {
    throw sweep_guard_core::InvalidInput("fixed_height of the elastic workpiece must be in [0, 1]");
  }
  BarStructure structure = barsOf(mesh, options.material);
  const Eigen::VectorXd heights = structure.rest * options.up_M.normalized();
  const double bottom = heights.minCoeff();
  const double top = bottom + options.fixed_height * (heights.maxCoeff() - bottom);
  for (size_t i = 0; i < structure.fixed.size(); ++i) {
    if (heights[static_cast<Eigen::Index>(i)] <= top) structure.fixed[i] = true;
  }
  return structure;
}

}  // namespace

ElasticWorkpiece::ElasticWorkpiece(const std::vector<float>& positions,
                                   const std::vector<sweep_guard_core::Triangle>& triangles, const Options& options)
    : mesh_(meshOf(positions, triangles)), model_(heldBars(mesh_, options), options.motion) {}

void ElasticWorkpiece::setTool(const sweep_guard_core::Tool& tool, const sweep_guard_core::ForceLaw& law) {
  pieces_.clear();
  for (const sweep_guard_core::ConvexPiece& piece : tool.pieces()) pieces_.emplace_back(piece.shape_T, law);
}

void ElasticWorkpiece::advance(const std::optional<Eigen::Isometry3d>& X_MT) {
  pressures_.clear();
  for (PressingPiece& piece : pieces_) {
    if (X_MT) piece.press(mesh_, *X_MT, pressures_);
  }
  model_.advance(Eigen::MatrixX3d::Zero(model_.positions().rows(), 3), pressures_);
  std::vector<float> moved = positions();
  mesh_.deform(moved);
}

std::vector<float> ElasticWorkpiece::positions() const {
  std::vector<float> positions;
  positions.reserve(3 * mesh_.vertexCount());
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(mesh_.vertexCount()); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(model_.positions()(i, axis)));
  }
  return positions;
}

Vector3d ElasticWorkpiece::force_M() const {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < pressures_.size(); ++i) {
    sum += model_.forces()[static_cast<Eigen::Index>(i)] * pressures_[i].outward;
  }
  return sum;
}

Vector3d ElasticWorkpiece::pressed_M() const {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < pressures_.size(); ++i) {
    sum += model_.forces()[static_cast<Eigen::Index>(i)] * model_.positions().row(pressures_[i].node).transpose();
  }
  const double total = model_.forces().sum();
  return total > 0.0 ? Vector3d(sum / total) : sum;
}

double ElasticWorkpiece::dent() const {
  const auto count = static_cast<Eigen::Index>(mesh_.vertexCount());
  return (model_.positions() - model_.structure().rest).topRows(count).rowwise().norm().maxCoeff();
}

}  // namespace sweep_guard_simulation
