#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/interaction/touch_map.h"

namespace sweep_guard_ros {

/// Counts which triangles the tool touches, and publishes that, `~touches`, latched. The thread that sweeps only counts: it
/// waits for another thread no longer than the touched triangles take to be copied.
class TouchesPublisher {
 public:
  explicit TouchesPublisher(ros::NodeHandle private_node);

  /// Counts a sweep. The thread that sweeps.
  void swept(const sweep_guard_core::SweepReport& report, const sweep_guard_core::Workpieces& workpieces);
  void publishIfChanged();  ///< publishes if a count has changed since. Any thread
  void reset();             ///< restarts the counts, and publishes that. Any thread

 private:
  void publishLocked() REQUIRES(publish_mutex_);

  const ros::Publisher publisher_;
  sweep_guard_core::Mutex map_mutex_;
  sweep_guard_core::TouchMap map_ GUARDED_BY(map_mutex_);

  sweep_guard_core::Mutex publish_mutex_;  // locked before the other; for the members below
  std::uint64_t published_ GUARDED_BY(publish_mutex_) = 0;
  std::vector<sweep_guard_core::ObjectTouches> objects_ GUARDED_BY(publish_mutex_);
};

}  // namespace sweep_guard_ros
