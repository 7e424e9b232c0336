#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "guard/intended_contact.h"
#include "motion/block_boxes.h"
#include "motion/piece_cover.h"
#include "motion/surface_motion.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// A mesh at one pose of the tool.
struct PlacedSurface {
  std::shared_ptr<const Workpiece> workpiece;
  const SurfaceMotion* motion;
  const std::vector<TriangleContact>* contacts;  ///< what the sweep to the pose met; null: not known
  IntendedContact intended;
  BlockBoxes boxes;
  double age;  ///< of its deformation at the pose, in which it has moved on [s]; 0 if it does not deform
};

/// A triangle of the mesh apart from a piece of the tool, or in contact with it.
struct SeparatedTriangle {
  std::uint32_t triangle;
  Eigen::Vector3d normal_T;  ///< unit, to the piece
  double gap;                ///< along the normal [m]; negative in contact
  Eigen::Vector3d top_T;     ///< corner farthest along the normal [m]
};

/// A piece of the tool and a mesh.
struct Facing {
  size_t piece;
  const PlacedSurface* surface;
  PieceCover cover;
  Eigen::Vector3d guess_T;  ///< normal of the last separation
  double nearest;           ///< bound of the nearest triangle known that waits for its plane [m]

  const TriangleMesh& mesh() const { return surface->workpiece->mesh_M; }
  /// Returns how deep the piece may reach into a triangle [m]; 0: contact is not meant there.
  double allowedDepth(std::uint32_t triangle) const { return surface->intended.allowedDepth(piece, triangle); }
  /// Returns the corners. A triangle that the piece is meant to touch counts from the depth on that is allowed.
  PieceCover::Corners corners(std::uint32_t triangle) const;
  /// Returns the triangle of a cluster that the lowest bit stands for.
  std::uint32_t triangleAt(const Cluster& cluster, std::uint64_t bits) const;

  /// In contact the normal is that of the contact, or of the triangle, to the side that frees the piece sooner.
  SeparatedTriangle separate(std::uint32_t triangle);
  void forgetNearest();

 private:
  Eigen::Vector3d contactNormal_T(std::uint32_t triangle, const PieceCover::Corners& corners_T) const;
};

}  // namespace sweep_guard_core
