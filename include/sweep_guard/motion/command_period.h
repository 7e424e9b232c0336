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

/// Notices that a stream of commands has stopped. It is silent until the first command.
class CommandSilence {
 public:
  /// @param timeout  longest time between two commands of a stream, > 0
  explicit CommandSilence(Duration timeout) : timeout_(timeout) {}

  void received(SteadyTime now) { newest_ = now; }

  Duration timeout() const { return timeout_; }
  bool silent(SteadyTime now) const { return !newest_ || now - *newest_ > timeout_; }

 private:
  const Duration timeout_;
  std::optional<SteadyTime> newest_;
};

}  // namespace sweep_guard_core
