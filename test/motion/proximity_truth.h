#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/floating_point.h"
#include "scenes.h"
#include "sweep_guard/geometry/separation.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {

using Corners = std::array<Eigen::Vector3d, 3>;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using namespace std::chrono_literals;

inline const std::string kFrame = "mesh";

inline std::shared_ptr<const Workpiece> workpieceOf(const TriangleMesh& mesh_M, const std::string& id = "liver") {
  return std::make_shared<const Workpiece>(Workpiece{id, 1, Time(100s), SteadyTime(100s), kFrame, mesh_M});
}

inline std::shared_ptr<const Workpiece> updated(const Workpiece& before, std::vector<float> positions_M,
                                                Duration later) {
  Workpiece next = before;
  next.mesh_M.deform(positions_M);
  next.stamp += later;
  next.received += later;
  countUpdate(before, next);
  return std::make_shared<const Workpiece>(std::move(next));
}

inline PoseWithFrames poseAt(const Isometry3d& X_WT, Time stamp = Time(100s),
                             const Isometry3d& X_WM = Isometry3d::Identity()) {
  return {stamp, SteadyTime(100s), X_WT, {{kFrame, X_WM}}};
}

inline Tool toolOfAllShapes(Random& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 12; ++i) points.emplace_back(0.02 * random.direction());
  const auto placed = [&](const ConvexShape& shape) {
    return ConvexPiece{"link", shape.placed(random.pose(random.inBox({0.04, 0.04, 0.04})))};
  };
  return Tool(std::vector<ConvexPiece>{placed(ConvexShape::cylinder(0.005, 0.05)), placed(ConvexShape::sphere(0.01)),
                                       placed(ConvexShape::box({0.004, 0.01, 0.02})),
                                       placed(ConvexShape::hull(points).padded(0.002))});
}

/// Sheets, chains and single triangles in the neighborhood.
inline TriangleMesh randomMesh(Random& random) {
  std::vector<Vector3d> vertices;
  std::vector<Triangle> triangles;
  const int count = 1 + random.below(400);
  const double size = random.logUniform(0.001, 0.05);
  for (int i = 0; i < count; ++i) {
    const Vector3d place = random.uniform(0.0, 0.2) * random.direction();
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int corner = 0; corner < 3; ++corner) vertices.emplace_back(place + size * random.direction());
    triangles.push_back({first, first + 1, first + 2});
  }
  return TriangleMesh(vertices, triangles);
}

/// What find() has to bound, triangle by triangle. The pieces of all bodies are counted through.
class BruteForce {
 public:
  BruteForce(const BodyTools& bodies, const PoseWithFrames& pose, const Workpiece& workpiece,
             const Workpiece* before = nullptr, const Isometry3d& X_WM_before = Isometry3d::Identity(),
             double frame_interval = 1.0)
      : workpiece_(workpiece) {
    for (size_t body = 0; body < bodies.size(); ++body) {
      for (const ConvexPiece& piece : bodies[body]->pieces())
        pieces_.push_back({&piece.shape_T, pose.bodies[body].X_WB, body});
    }
    const Isometry3d& X_WM = pose.X_WM.at(kFrame);
    for (size_t i = 0; i < workpiece.mesh_M.vertexCount(); ++i) {
      const Vector3d p_M = workpiece.mesh_M.vertex(i);
      positions_W_.emplace_back(X_WM * p_M);
      velocities_W_.emplace_back((X_WM * p_M - X_WM_before * p_M) / frame_interval);
      if (before == nullptr) continue;
      velocities_W_.back() +=
          X_WM.linear() * (p_M - before->mesh_M.vertex(i)) / toSeconds(workpiece.stamp - before->stamp);
    }
  }

  size_t pieces() const { return pieces_.size(); }
  size_t bodyOf(size_t piece) const { return pieces_[piece].body; }
  size_t triangles() const { return workpiece_.mesh_M.triangles().size(); }

  Corners cornersOf(size_t triangle) const {
    const Triangle& vertices = workpiece_.mesh_M.triangles()[triangle];
    return {positions_W_[vertices[0]], positions_W_[vertices[1]], positions_W_[vertices[2]]};
  }

  double distance(size_t piece, size_t triangle) const {
    Corners corners_T = cornersOf(triangle);
    for (Vector3d& p : corners_T) p = pieces_[piece].X_WT.inverse() * p;
    const Separation apart = separation(*pieces_[piece].shape_T, PointHull(corners_T));
    return (apart.on_tool - apart.on_obstacle).norm();
  }

  bool standsFor(const ProximityPlane& each, size_t piece, size_t triangle) const {
    const SeparatingPlane& plane = each.plane;
    if (plane.piece != piece || each.workpiece.get() != &workpiece_) return false;
    const Triangle& vertices = workpiece_.mesh_M.triangles()[triangle];
    return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t i) {
      return plane.normal_W.dot(positions_W_[i] - plane.point_W) <= 1e-9 &&
             plane.normal_W.dot(velocities_W_[i]) <= plane.surface_speed + 1e-9;
    });
  }

  double speed(size_t triangle) const {
    double most = 0.0;
    for (const std::uint32_t i : workpiece_.mesh_M.triangles()[triangle])
      most = std::max(most, velocities_W_[i].norm());
    return most;
  }

  // Of the piece before the plane.
  double gap(const SeparatingPlane& plane) const {
    const auto& [shape_T, X_WT, body] = pieces_[plane.piece];
    const double least_T = -shape_T->support(-(X_WT.linear().transpose() * plane.normal_W));
    return least_T + plane.normal_W.dot(X_WT.translation() - plane.point_W);
  }

 private:
  struct Piece {
    const ConvexShape* shape_T;
    Isometry3d X_WT;
    size_t body;
  };

  const Workpiece& workpiece_;
  std::vector<Piece> pieces_;
  std::vector<Vector3d> positions_W_;
  std::vector<Vector3d> velocities_W_;
};

/// How often each case was met: a test that never meets one proves nothing about it.
struct Met {
  size_t behind = 0;
  size_t left_over = 0;
  size_t contacts = 0;
  size_t full = 0;
};

inline void expectAllBounded(const BruteForce& truth, double reach, const Proximity& found, Met& met) {
  ASSERT_LE(found.planes.size(), ProximityFinder::kMaxPlanes);
  if (found.planes.size() == ProximityFinder::kMaxPlanes) ++met.full;
  for (size_t piece = 0; piece < truth.pieces(); ++piece) {
    for (size_t triangle = 0; triangle < truth.triangles(); ++triangle) {
      const auto stands = [&](const ProximityPlane& plane) { return truth.standsFor(plane, piece, triangle); };
      if (std::any_of(found.planes.begin(), found.planes.end(), stands)) {
        ++met.behind;
        continue;
      }
      ++met.left_over;
      const double distance = truth.distance(piece, triangle);
      ASSERT_LE(found.uncovered.distance, distance + 1e-9) << "piece " << piece << ", triangle " << triangle;
      ASSERT_GE(found.uncovered.speed, truth.speed(triangle) - 1e-9);
      if (found.planes.size() < ProximityFinder::kMaxPlanes) {
        ASSERT_GE(distance, reach - 1e-9);
      }
    }
  }
}

inline void expectPlanesInFront(const BruteForce& truth, const Proximity& found, Met& met) {
  double before = -kInfinity;
  for (const ProximityPlane& each : found.planes) {
    const SeparatingPlane& plane = each.plane;
    ASSERT_NEAR(plane.normal_W.norm(), 1.0, 1e-12);
    ASSERT_NEAR(truth.gap(plane), plane.gap, 1e-9);
    ASSERT_TRUE(truth.standsFor(each, plane.piece, each.triangle));
    const double distance = truth.distance(plane.piece, each.triangle);
    ASSERT_LE(plane.gap, distance);
    if (distance > 1e-4) {
      ASSERT_GE(plane.gap, 0.949 * distance - 1e-5);
    }
    ASSERT_GE(plane.gap, before);
    before = plane.gap;
    if (each.contact) ++met.contacts;
  }
}

}  // namespace sweep_guard_core
