#pragma once

#include <boost/circular_buffer.hpp>
#include <condition_variable>
#include <optional>
#include <utility>

#include "common/guarded_by.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_core {

/// Where the bodies of the tool were in the last second, at the newest 4096 poses, in the fixed frame. Any thread.
class RecentPoses {
 public:
  /// Adds a pose. One whose stamp is older than the newest begins anew: time has gone back.
  void add(Time stamp, const BodyPoses& bodies);

  /// Returns the bodies at the last pose not after a time, and at the first not before it. Waits for the latter; empty if it does not
  /// come, or all poses are later.
  /// @param wait  for no longer, on the steady clock
  std::optional<std::pair<BodyPoses, BodyPoses>> around(Time stamp, Duration wait) const;

 private:
  mutable Mutex mutex_;
  mutable std::condition_variable_any added_;
  // The oldest first.
  boost::circular_buffer<std::pair<Time, BodyPoses>> poses_ GUARDED_BY(mutex_) =
      boost::circular_buffer<std::pair<Time, BodyPoses>>(128);
};

}  // namespace sweep_guard_core
