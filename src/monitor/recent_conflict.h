#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// How long a conflict of publishers counts after it was found: nodes that publish by turns once a second, with jitter, are in
/// conflict all the time.
constexpr Duration kConflictShown = std::chrono::milliseconds(1500);

/// The newest conflict of publishers, while it counts. One thread.
class RecentConflict {
 public:
  void note(const std::string& text, SteadyTime now) { newest_ = {now, text}; }

  /// Returns the text of the conflict that was found within the last 1.5 s; empty: none was.
  std::string text(SteadyTime now) const {
    return newest_ && now - newest_->stamp <= kConflictShown ? newest_->value : "";
  }

 private:
  std::optional<StampedValue<std::string, SteadyTime>> newest_;
};

}  // namespace sweep_guard_core
