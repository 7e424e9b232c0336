#pragma once

#include <Eigen/Geometry>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "motion/block_boxes.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// The planes before one convex piece of the tool that stand for parts of one mesh, and how near its other parts may be.
/// Positions are relative to the mesh's origin(), along the axes of M.
class PieceCover {
 public:
  /// Begins without planes.
  /// @param X_MT  translation from the mesh's origin() [m]
  void begin(const ConvexShape& shape_T, const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT);

  const ConvexShape& shape_T() const { return *shape_T_; }

  /// Returns a lower bound on the distance of the piece from a box [m]: that of a box around the piece.
  double distance(const CenteredBox& box) const;
  /// Returns the same for a triangle.
  double distance(const Triangle& triangle) const;

  std::array<Eigen::Vector3d, 3> corners_T(const Triangle& triangle) const;
  Eigen::Vector3d normal_M(const Eigen::Vector3d& normal_T) const { return X_MT_.linear() * normal_T; }
  Eigen::Vector3d normal_T(const Eigen::Vector3d& normal_M) const { return X_MT_.linear().transpose() * normal_M; }

  /// Adds a plane: stands for what lies wholly behind normal_T · p_T <= offset_T.
  /// @param number  of the plane among those of all pieces
  void add(const Eigen::Vector3d& normal_T, double offset_T, size_t number);
  /// Moves a plane to the tool until a triangle lies behind it by `slack`, and returns how far [m].
  double raise(size_t number, const Triangle& triangle, double slack);
  size_t planes() const { return planes_.size(); }

  /// Returns the number of a plane that the box or triangle lies wholly behind; empty: none.
  /// @param begin  so many planes are left out
  std::optional<size_t> behind(const CenteredBox& box) const;
  std::optional<size_t> behind(const Triangle& triangle, size_t begin) const;

  using PlaneNumbers = boost::container::static_vector<size_t, simd::kMaxPlanes>;
  /// The triangles of a cluster that lie wholly behind no plane, by the planes tested.
  struct Classified {
    std::uint64_t uncovered;  ///< bit i stands for its triangle i
    PlaneNumbers standing;    ///< of the planes that stand for the others
    size_t tested;            ///< number of planes, from the first, that the triangles are known not to lie behind
  };
  /// @param box  around the cluster
  Classified classify(const Cluster& cluster, const CenteredBox& box) const;

 private:
  struct Plane {
    Eigen::Vector3d normal_M;
    double offset;  // largest normal_M · p of what it stands for [m]
    size_t number;
  };
  std::array<Eigen::Vector3d, 3> corners(const Triangle& triangle) const;
  size_t selectPlanes(const CenteredBox& box, simd::Planes& planes, PlaneNumbers& selected) const;

  const ConvexShape* shape_T_ = nullptr;
  const TriangleMesh* mesh_M_ = nullptr;
  Eigen::Isometry3d X_MT_ = Eigen::Isometry3d::Identity();
  // A frame B in the middle of a box around the piece.
  Eigen::Isometry3d X_BM_ = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d absolute_BM_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half_B_ = Eigen::Vector3d::Zero();
  std::vector<Plane> planes_;
};

}  // namespace sweep_guard_core
