#pragma once

#include <Eigen/Core>
#include <boost/circular_buffer.hpp>
#include <cstddef>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Keeps the positions of the tool's tip of the last two seconds for drawing, about 50 per second.
class Trail {
 public:
  using Point = StampedValue<Eigen::Vector3d>;  ///< [m], in W

  /// Adds a position; first forgets all others if its stamp is older than the newest one's.
  void add(Time stamp, const Eigen::Vector3d& p_W) {
    if (!points_.empty() && stamp < points_.back().stamp) points_.clear();
    while (!points_.empty() && points_.front().stamp + kKept < stamp) points_.pop_front();
    const size_t count = points_.size();
    if (count > 1 && stamp - points_[count - 2].stamp < kSpacing) points_.pop_back();
    if (points_.full()) points_.set_capacity(2 * points_.capacity());
    points_.push_back({stamp, p_W});
  }
  void clear() { points_.clear(); }

  const boost::circular_buffer<Point>& points() const { return points_; }  ///< the oldest first

 private:
  static constexpr Duration kKept = std::chrono::seconds(2);
  static constexpr Duration kSpacing = std::chrono::milliseconds(20);
  boost::circular_buffer<Point> points_ = boost::circular_buffer<Point>(128);
};

}  // namespace sweep_guard_core
