#pragma once

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cassert>

#include "detection/placed_core.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

/// A point of the piece, and the corner of the triangle that is next to it.
struct Feature {
  Eigen::Vector3d p_T;
  size_t corner;
};
/// The points of piece and triangle that are next to each other, fixed to both.
using Features = boost::container::static_vector<Feature, 4>;

inline Features featuresOf(const PointPairs& points, const PlacedCore& tool,
                           const std::array<Eigen::Vector3d, 3>& corners) {
  Features features;
  for (const auto& [on_tool, on_obstacle] : points) {
    const auto corner = std::find(corners.begin(), corners.end(), on_obstacle);
    assert(corner != corners.end());
    features.push_back({tool.inTool(on_tool), static_cast<size_t>(corner - corners.begin())});
  }
  return features;
}

inline PointPairs pointsOf(const Features& features, const PlacedCore& tool,
                           const std::array<Eigen::Vector3d, 3>& corners) {
  PointPairs points;
  for (const auto& [p_T, corner] : features) points.push_back({tool.p_MT + tool.R_MT * p_T, corners[corner]});
  return points;
}

/// A direction along which the gap is followed in time: fixed in M, or in T, where the reach of the piece along it is constant.
struct Direction {
  Eigen::Vector3d unit;  // in T if it turns, else in M
  bool turns;
  double reach;  // support of the piece against a direction that turns [m]

  Eigen::Vector3d at(const PlacedCore& tool) const { return turns ? tool.R_MT * unit : unit; }

  bool operator==(const Direction& other) const { return turns == other.turns && unit == other.unit; }
};

Direction fixed(const Eigen::Vector3d& direction_M);
Direction turning(const ConvexShape& shape_T, const Eigen::Vector3d& direction_T);

/// The gap at a fraction of a sub-motion.
struct Gap {
  double fraction;
  double gap;   // [m]
  double rate;  // decrease per fraction, 0 if unknown [m]
};

/// Evaluates tool and triangle at a fraction s of one sub-motion. All positions are relative to a corner of the triangle
/// at the start, so that no digits are lost far from the origin of M.
class ImpactFinder::Trajectory {
 public:
  Trajectory(const ConvexShape& shape_T, const SubMotion& sub_motion, const MovingTriangle& triangle, double start,
             double end)
      : shape_T_(shape_T), motion_(sub_motion), base_M_(triangle.start_M[0]), from_(sub_motion.p_MT_start - base_M_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d displacement = triangle.end_M[i] - triangle.start_M[i];
      corners_[i] = triangle.start_M[i] - base_M_ + start * displacement;
      displacements_[i] = (end - start) * displacement;
    }
  }

  PlacedCore tool(double s) const;

  std::array<Eigen::Vector3d, 3> corners(double s) const {
    return {corners_[0] + s * displacements_[0], corners_[1] + s * displacements_[1],
            corners_[2] + s * displacements_[2]};
  }

  Eigen::Vector3d inMesh(const Direction& direction, double s) const { return direction.at(tool(s)); }

  // Returns G(s) along a direction.
  double gap(const Direction& direction, double s) const;

  // Advances from a fraction up to which a gap larger than `least` is proven along the direction. Searches for the fraction
  // where the gap is `aim`.
  void advance(const Direction& direction, double aim, double least, Gap& at) const;

  const Eigen::Vector3d& base_M() const { return base_M_; }
  double maxDistance() const { return std::max(from_.norm(), (from_ + motion_.travel_M).norm()); }

 private:
  // Returns half the bound of |G''|.
  double curvatureBound(const Direction& direction) const;

  // Relative to the origin of T.
  double farthestCorner() const;

  double fastestCorner() const;

  const ConvexShape& shape_T_;
  const SubMotion& motion_;
  Eigen::Vector3d base_M_;
  Eigen::Vector3d from_;
  std::array<Eigen::Vector3d, 3> corners_;
  std::array<Eigen::Vector3d, 3> displacements_;
};

}  // namespace sweep_guard_core
