#pragma once

#include <Eigen/Core>
#include <deque>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Keeps the positions of the tool's tip of the last two seconds for drawing, about 50 per second.
class Trail {
 public:
  struct Point {
    Time stamp;
    Eigen::Vector3d p_W;  ///< [m]
  };

  /// Adds a position; first forgets all others if its stamp is older than the newest one's.
  void add(Time stamp, const Eigen::Vector3d& p_W) {
    if (!points_.empty() && stamp < points_.back().stamp) points_.clear();
    while (!points_.empty() && points_.front().stamp + kKept < stamp) points_.pop_front();
    const size_t count = points_.size();
    if (count > 1 && stamp - points_[count - 2].stamp < kSpacing) points_.pop_back();
    points_.push_back({stamp, p_W});
  }
  void clear() { points_.clear(); }

  const std::deque<Point>& points() const { return points_; }  ///< the oldest first

 private:
  static constexpr Duration kKept = std::chrono::seconds(2);
  static constexpr Duration kSpacing = std::chrono::milliseconds(20);
  std::deque<Point> points_;
};

}  // namespace sweep_guard_core
