#pragma once

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cassert>

#include "detection/placed_core.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {

/// The points of piece and triangle that are next to each other, fixed to both.
class Features {
 public:
  Features() = default;
  Features(const PointPairs& points, const PlacedCore& tool, const std::array<Eigen::Vector3d, 3>& corners) {
    for (const auto& [on_tool, on_obstacle] : points) {
      const auto corner = std::find(corners.begin(), corners.end(), on_obstacle);
      assert(corner != corners.end());
      features_.push_back({tool.inTool(on_tool), static_cast<size_t>(corner - corners.begin())});
    }
  }

  PointPairs at(const PlacedCore& tool, const std::array<Eigen::Vector3d, 3>& corners) const {
    PointPairs points;
    for (const auto& [p_T, corner] : features_) points.push_back({tool.p_MT + tool.R_MT * p_T, corners[corner]});
    return points;
  }

  bool ofOneCorner() const {
    return std::all_of(features_.begin(), features_.end(),
                       [&](const Feature& feature) { return feature.corner == features_.front().corner; });
  }

 private:
  struct Feature {
    Eigen::Vector3d p_T;
    size_t corner;
  };
  boost::container::static_vector<Feature, 4> features_;
};

}  // namespace sweep_guard_core
