#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "simulation/elastic/bar_model.h"
#include "simulation/elastic/mesh_bars.h"
#include "simulation/elastic/pressing_piece.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/interaction/interaction_finder.h"

namespace sweep_guard_simulation {

/// A workpiece that yields to a tool, in its frame M: a BarModel of a mesh, pressed by the interaction force of each
/// convex piece of the tool (interaction/interaction_force.h).
class ElasticWorkpiece {
 public:
  struct Options {
    ElasticMaterial material;
    double fixed_height = 0.4;  ///< share of the height, from the bottom, that does not move, in [0, 1]
    Eigen::Vector3d up_M = Eigen::Vector3d::UnitZ();  ///< along which the height is measured
    BarModel::Options motion;
  };

  /// Takes about a second for 4 000 triangles.
  /// @param positions  of the vertices at rest: x0 y0 z0 x1 ... [m]
  /// @throws sweep_guard_core::InvalidInput if mesh or options are refused, or as BarModel
  ElasticWorkpiece(const std::vector<float>& positions, const std::vector<sweep_guard_core::Triangle>& triangles,
                   const Options& options);

  /// Exchanges the tool.
  /// @param law  its damping is left out
  void setTool(const sweep_guard_core::Tool& tool, const sweep_guard_core::ForceLaw& law);

  /// Moves on by a step.
  /// @param X_MT  pose of the tool; empty: it is not there
  void advance(const std::optional<Eigen::Isometry3d>& X_MT);

  std::vector<float> positions() const;  ///< of the vertices: x0 y0 z0 x1 ... [m]
  Eigen::Vector3d force_M() const;       ///< of the workpiece on the tool, at the end of the last step [N]
  Eigen::Vector3d pressed_M() const;     ///< where it acts: the middle of the pressed vertices; 0 without a force [m]
  double dent() const;                   ///< largest distance of a vertex from its place at rest [m]
  const BarModel& model() const { return model_; }

 private:
  sweep_guard_core::TriangleMesh mesh_;
  BarModel model_;
  std::vector<PressingPiece> pieces_;  // of the tool
  std::vector<Pressure> pressures_;    // in the last step
};

}  // namespace sweep_guard_simulation
