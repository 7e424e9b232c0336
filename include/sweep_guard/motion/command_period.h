#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Measures the period at which commands arrive.
class CommandPeriod {
 public:
  /// How many intervals count.
  static constexpr size_t kIntervals = 16;

  /// @param longest  bound of the period; longer intervals are pauses, after which the measurement begins again
  /// @throws InvalidInput  unless `longest` is at least 1 ms
  explicit CommandPeriod(Duration longest);

  /// @param received  not before that of the last call
  void add(SteadyTime received);

  /// Returns the longest of the newest intervals, within 1 ms and the bound; the bound before there is one.
  Duration longest() const;
  /// Returns the mean of the newest intervals, within 1 ms and the bound; the bound before there is one.
  Duration mean() const;

 private:
  Duration bounded(Duration period) const;

  const Duration bound_;
  std::optional<SteadyTime> received_;
  std::array<Duration, kIntervals> intervals_{};
  size_t count_ = 0;  // since the last pause
};

/// Returns whether a stream of commands has stopped, or has not begun.
/// @param newest   when its newest command was received; empty: none has come
/// @param timeout  longest time between two commands, > 0
inline bool isSilent(const std::optional<SteadyTime>& newest, Duration timeout, SteadyTime now) {
  return !newest || now - *newest > timeout;
}

}  // namespace sweep_guard_core
