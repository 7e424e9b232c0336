#pragma once

#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Notices that a stream of commands has stopped. It is silent until the first command.
class CommandSilence {
 public:
  /// @param timeout  longest time between two commands of a stream, > 0
  explicit CommandSilence(Duration timeout) : timeout_(timeout) {}

  void received(SteadyTime now) { newest_ = now; }

  bool silent(SteadyTime now) const { return !newest_ || now - *newest_ > timeout_; }

 private:
  const Duration timeout_;
  std::optional<SteadyTime> newest_;
};

}  // namespace sweep_guard_core
