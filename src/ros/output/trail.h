#pragma once

#include <Eigen/Core>
#include <deque>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Where the tool's tip has been of late, for the eye: thinned out to fifty points a second.
class Trail {
 public:
  struct Point {
    sweep_guard_core::Time stamp;
    Eigen::Vector3d p_W;  ///< [m]
  };

  /// A point earlier than the one before begins anew.
  void add(sweep_guard_core::Time stamp, const Eigen::Vector3d& p_W) {
    if (!points_.empty() && stamp < points_.back().stamp) points_.clear();
    while (!points_.empty() && points_.front().stamp + kKept < stamp) points_.pop_front();
    const size_t count = points_.size();
    if (count > 1 && stamp - points_[count - 2].stamp < kSpacing) points_.pop_back();
    points_.push_back({stamp, p_W});
  }

  const std::deque<Point>& points() const { return points_; }

 private:
  static constexpr sweep_guard_core::Duration kKept = std::chrono::seconds(2);
  static constexpr sweep_guard_core::Duration kSpacing = std::chrono::milliseconds(20);
  std::deque<Point> points_;
};

}  // namespace sweep_guard_ros
