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

}  // namespace sweep_guard_core
