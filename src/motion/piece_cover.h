#pragma once

#include <Eigen/Geometry>
#include <algorithm>
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
  using Corners = std::array<Eigen::Vector3d, 3>;  ///< of a triangle [m]

  /// Begins without planes.
  /// @param X_MT  translation from the mesh's origin() [m]
  void begin(const ConvexShape& shape_T, const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT);

  const ConvexShape& shape_T() const { return *shape_T_; }

  /// Returns a lower bound on the distance of the piece from a box [m]: that of a box around the piece.
  double distance(const CenteredBox& box) const;
  /// Returns the same for a triangle.
  double distance(const Corners& corners) const;

  Corners corners(const Triangle& triangle) const;
  Corners corners_T(const Corners& corners) const;
  Eigen::Vector3d normal_M(const Eigen::Vector3d& normal_T) const { return X_MT_.linear() * normal_T; }
  Eigen::Vector3d normal_T(const Eigen::Vector3d& normal_M) const { return X_MT_.linear().transpose() * normal_M; }

  /// Adds a plane: stands for what lies wholly behind normal_T · p_T <= offset_T.
  /// @param number  of the plane among those of all pieces
  void add(const Eigen::Vector3d& normal_T, double offset_T, size_t number);
  size_t planes() const { return planes_.size(); }

  /// Returns the number of a plane that the box or triangle lies wholly behind; empty: none.
  /// @param begin  number of planes, from the first, that are left out
  std::optional<size_t> behind(const CenteredBox& box) const;
  std::optional<size_t> behind(const Corners& corners, size_t begin) const;

  /// Sets the plane of the nearest triangle known so far, which may not remain the nearest: what lies behind it is not
  /// nearer. Empty: none is known.
  void setNearest(const std::optional<Eigen::Vector3d>& normal_T, double offset_T = 0.0);
  bool hasNearest() const { return nearest_.has_value(); }
  bool behindNearest(const CenteredBox& box) const { return nearest_ && nearest_->stands(box); }
  bool behindNearest(const Corners& corners) const { return nearest_ && nearest_->stands(corners); }

  using PlaneNumbers = boost::container::static_vector<size_t, simd::kMaxPlanes>;
  /// The triangles of a cluster that are not known to lie wholly behind a plane. Bit i stands for its triangle i.
  struct Classified {
    std::uint64_t nearer;      ///< also not behind the plane of the nearest triangle
    std::uint64_t not_nearer;  ///< behind that plane
    PlaneNumbers standing;     ///< planes that stand for the others
    size_t tested;             ///< number of planes, from the first, that `nearer` are known not to lie behind
  };
  /// @param box  around the cluster
  Classified classify(const Cluster& cluster, const CenteredBox& box) const;

 private:
  struct Plane {
    Eigen::Vector3d normal_M;
    double offset;  // largest normal_M · p of what it stands for [m]
    size_t number;

    bool stands(const CenteredBox& box) const {
      return normal_M.dot(box.center) + normal_M.cwiseAbs().dot(box.half) <= offset;
    }
    bool stands(const Corners& corners) const {
      return std::all_of(corners.begin(), corners.end(), [&](const auto& p) { return normal_M.dot(p) <= offset; });
    }
    bool mayStand(const CenteredBox& box) const {
      return normal_M.dot(box.center) - normal_M.cwiseAbs().dot(box.half) <= offset;
    }
  };
  size_t selectPlanes(const CenteredBox& box, simd::Planes& planes, PlaneNumbers& selected) const;

  const ConvexShape* shape_T_ = nullptr;
  const TriangleMesh* mesh_M_ = nullptr;
  Eigen::Isometry3d X_MT_ = Eigen::Isometry3d::Identity();
  // A frame B in the middle of a box around the piece.
  Eigen::Isometry3d X_BM_ = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d absolute_BM_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half_B_ = Eigen::Vector3d::Zero();
  std::vector<Plane> planes_;
  std::optional<Plane> nearest_;
};

}  // namespace sweep_guard_core
