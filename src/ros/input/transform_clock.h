#pragma once

#include <optional>
#include <string>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Knows which stamps of moving transforms count, while the clock of the stamps may go back.
class TransformClock {
 public:
  /// Returns whether time has gone back since the last call: the stamps of what was received before mean another time now.
  bool hasGoneBack(const sweep_guard_core::Instant& now);

  /// Returns why a stamp does not count now; empty: it counts. It may lie 10 s ahead: tf2 ignores every transform that is
  /// older by that than the newest of its frame. For 1 s of the steady clock after time went back, it may lie 0.2 s ahead: a
  /// message of the time before may be on its way, and poses would be placed between both times.
  std::string refusal(sweep_guard_core::Time stamp, const sweep_guard_core::Instant& now) const;

 private:
  sweep_guard_core::Time newest_;
  std::optional<sweep_guard_core::SteadyTime> went_back_;
};

}  // namespace sweep_guard_ros
