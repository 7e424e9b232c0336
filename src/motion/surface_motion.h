#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "motion/block_boxes.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Bounds how fast the vertices of one workpiece move in the fixed frame W: from the two latest deformations and the two
/// latest poses of its frame. What a camera sees counts as at rest: nobody knows which point of it came from where.
class SurfaceMotion {
 public:
  /// Takes a newer snapshot and a newer pose of its frame.
  /// @param stamp       of the pose
  /// @param velocity_W  of the frame: of its origin [m/s], and angular [rad/s]; empty: that between the poses
  void update(const std::shared_ptr<const Workpiece>& workpiece, const Eigen::Isometry3d& X_WM, Time stamp,
              const std::optional<Vector6d>& velocity_W = {});

  const std::shared_ptr<const Workpiece>& workpiece() const { return workpiece_; }  ///< newest snapshot
  bool moves() const { return deforms_ || frame_moves_; }
  bool deforms() const { return deforms_; }

  /// Returns an upper bound on the speed along a direction [m/s], in the axes of M, of the vertices of a part of the mesh.
  /// @param part   Cluster, ClusterGroup or MeshOrder
  /// @param box_M  around the part, relative to the mesh's origin() [m]
  template <typename Part>
  double alongNormal(const Eigen::Vector3d& n_M, const Part& part, const CenteredBox& box_M) const {
    return frameSpeed(n_M, box_M) + (deforms_ ? deformingSpeed(n_M, CenteredBox(displacements_.of(part))) : 0.0);
  }
  /// Returns the same of one triangle's corners.
  double alongNormal(const Eigen::Vector3d& n_M, const Triangle& triangle) const;

  /// Returns an upper bound on the speed of any vertex [m/s].
  /// @param box_M  around the mesh, relative to its origin() [m]
  double fastest(const CenteredBox& box_M) const;

 private:
  double frameSpeed(const Eigen::Vector3d& n_M, const CenteredBox& box_M) const;
  double deformingSpeed(const Eigen::Vector3d& n_M, const CenteredBox& displacement_M) const;
  void deform(const Workpiece& before, const Workpiece& now);
  void moveFrame(const Eigen::Isometry3d& X_WM, Time stamp);
  void moveFrame(const Eigen::Isometry3d& X_WM, const Vector6d& velocity_W);

  std::shared_ptr<const Workpiece> workpiece_;
  bool deforms_ = false;
  double interval_ = 1.0;             // between the two latest deformations [s]
  std::vector<float> differences_M_;  // of the vertices, at their places
  VertexBlocks difference_blocks_;
  BlockBoxes displacements_;

  Eigen::Isometry3d X_WM_ = Eigen::Isometry3d::Identity();
  Time stamp_;
  bool frame_moves_ = false;
  // Mean velocity of a point fixed to M, in the axes of M: turning_M p_M + translation_M.
  Eigen::Matrix3d turning_M_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation_M_ = Eigen::Vector3d::Zero();
};

}  // namespace sweep_guard_core
