#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "motion/block_boxes.h"
#include "motion/piece_cover.h"
#include "motion/surface_motion.h"
#include "sweep_guard/guard/contact_policy.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {

/// A mesh at one pose of the tool.
struct PlacedSurface {
  std::shared_ptr<const Workpiece> workpiece;
  const SurfaceMotion* motion;
  const std::vector<TriangleContact>* contacts;  ///< what the sweep to the pose met; null: not known
  BlockBoxes boxes;
  double age;    ///< of its deformation at the pose, in which it has moved on [s]; 0 if it does not deform
  double drift;  ///< bound on how far its frame may have moved since that was measured [m]
};

/// A body of the tool, in its frame T, and a mesh.
struct FacingBody {
  const PlacedSurface* surface;
  const Tool* tool;
  size_t first_piece;  ///< number of pieces of the bodies before
  ContactPolicy contact;
  Eigen::Isometry3d X_WT;
  Eigen::Isometry3d X_MT;  ///< translation from the mesh's origin() [m]

  /// Returns whether a piece of the tool, counted through all bodies, is one of this body.
  bool has(size_t piece) const { return piece >= first_piece && piece - first_piece < tool->pieces().size(); }
  /// Returns a lower bound on the distance of the body from the mesh [m].
  double distance() const;
};

/// A triangle of the mesh apart from a piece of the tool, or in contact with it.
struct SeparatedTriangle {
  std::uint32_t triangle;
  Eigen::Vector3d normal_T;  ///< unit, to the piece
  double gap;                ///< along the normal [m]; negative in contact
  Eigen::Vector3d top_T;     ///< corner farthest along the normal [m]
};

/// A piece of a body and a mesh.
struct Facing {
  const FacingBody* body;
  const PlacedSurface* surface;
  size_t piece;  ///< of the body
  PieceCover cover;
  Eigen::Vector3d guess_T;  ///< normal of the last separation
  double nearest;           ///< bound of the nearest triangle known that waits for its plane [m]

  const TriangleMesh& mesh() const { return surface->workpiece->mesh_M; }
  size_t pieceOfTool() const { return body->first_piece + piece; }  ///< counted through all bodies
  /// Returns how deep the piece may reach into a triangle [m]; 0: contact is not meant there.
  double intendedDepth(std::uint32_t triangle) const { return body->contact.intendedDepth(piece, triangle); }
  /// Returns the corners. A triangle that the piece is meant to touch counts from the intended depth on.
  PieceCover::Corners corners(std::uint32_t triangle) const;
  /// Returns the triangle of a cluster that the lowest bit stands for.
  std::uint32_t triangleAt(const Cluster& cluster, std::uint64_t bits) const;

  /// In contact the normal is that of the contact, or of the triangle, to the side that frees the piece sooner.
  SeparatedTriangle separate(std::uint32_t triangle);
  void forgetNearest();

 private:
  Eigen::Vector3d contactNormal_T(std::uint32_t triangle, const PieceCover::Corners& corners_T) const;
};

/// Each body of a tool with each mesh around it, at one pose, and the pieces of those that are faced. Remembers how the
/// surfaces move.
class Facings {
 public:
  /// Places the meshes of a request in place of those of the last one.
  /// @param[out] unplaced  meshes without a frame at the pose are added
  void begin(const ProximityRequest& request, Workpieces& unplaced);
  void end();                         ///< keeps no mesh alive
  void reset() { motions_.clear(); }  ///< forgets how surfaces moved

  size_t bodies() const { return body_count_; }
  const FacingBody& body(size_t index) const { return bodies_[index]; }
  void face(size_t body);  ///< adds the pieces of a body

  size_t size() const { return count_; }
  Facing& operator[](size_t index) { return facings_[index]; }

  double margin() const { return margin_; }    ///< the largest of the meshes [m]
  double padding() const { return padding_; }  ///< the largest of the meshes [m]
  double fastest() const;                      ///< bound on the speed of any vertex [m/s]
  double maxDisplacement() const;              ///< bound on the displacement of any vertex since its deformation [m]

 private:
  static double fastest(const PlacedSurface& surface);
  void place(const ProximityRequest& request, const std::shared_ptr<const Workpiece>& workpiece,
             const Eigen::Isometry3d& X_WM);
  bool placeBodies(const ProximityRequest& request, const Workpiece& workpiece, const Eigen::Isometry3d& X_WM);

  std::map<std::string, SurfaceMotion> motions_;  // by id
  std::vector<PlacedSurface> surfaces_;           // the first surface_count_
  size_t surface_count_ = 0;
  std::vector<FacingBody> bodies_;  // the first body_count_
  size_t body_count_ = 0;
  std::vector<Facing> facings_;  // the first count_
  size_t count_ = 0;
  double margin_ = 0.0;
  double padding_ = 0.0;
};

}  // namespace sweep_guard_core
