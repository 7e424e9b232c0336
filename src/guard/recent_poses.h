#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "common/guarded_by.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_core {

/// Where the bodies of the tool were in the last second, in the fixed frame. Any thread.
class RecentPoses {
 public:
  /// Adds a pose. One whose stamp is older than the newest begins anew: time has gone back.
  void add(Time stamp, const BodyPoses& bodies);

  /// Returns the bodies at the last pose not after a time, and at the first not before it. After the newest pose, that twice; empty
  /// if there is none, or all are later.
  std::optional<std::pair<BodyPoses, BodyPoses>> around(Time stamp) const;

 private:
  mutable Mutex mutex_;
  std::deque<std::pair<Time, BodyPoses>> poses_ GUARDED_BY(mutex_);  // the oldest first
};

}  // namespace sweep_guard_core
