#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Tells in words why the newest command of a stream is no longer in force: commands come too rarely, have stopped, or
/// bear old stamps.
class CommandGaps {
 public:
  /// How many intervals count.
  static constexpr size_t kIntervals = 8;
  /// A longer interval is a pause of the operator, after which the measurement begins again.
  static constexpr Duration kPause = std::chrono::seconds(2);

  /// @param timeout    how long a command is in force, > 0
  /// @param parameter  that sets it
  CommandGaps(Duration timeout, std::string parameter);

  /// @param command  not received before that of the last call
  void received(const Timestamps& command);

  /// Returns that commands come, but more rarely than `timeout`, with both times. Empty unless at least two of the newest
  /// intervals exceed it; empty if commands have stopped (kPause).
  std::string rarity(SteadyTime now) const;

  /// Returns why the newest command is too old; only after received().
  std::string tooOld(const Instant& now) const;

 private:
  const Duration timeout_;
  const std::string parameter_;
  std::optional<Timestamps> newest_;
  std::array<Duration, kIntervals> intervals_{};
  size_t count_ = 0;  // since the last pause
};

}  // namespace sweep_guard_core
