#pragma once

#include <vector>

#include "sweep_guard/prediction/sent_command.h"

namespace sweep_guard_evaluation {

/// Passes on recorded commands when their time has come.
class CommandFeed {
 public:
  /// @param commands  stamps do not decrease; null: none. They must outlive the feed
  explicit CommandFeed(const std::vector<sweep_guard_core::StampedPose>* commands) : commands_(commands) {}

  /// Passes on the commands up to a time.
  /// @param receiver  a predictor or a guard
  template <typename Receiver>
  void sendUntil(sweep_guard_core::Time time, Receiver& receiver) {
    if (commands_ == nullptr) return;
    for (; next_ < commands_->size() && (*commands_)[next_].stamp <= time; ++next_)
      receiver.command({(*commands_)[next_].stamp, (*commands_)[next_].X_WT});
  }

 private:
  const std::vector<sweep_guard_core::StampedPose>* commands_;
  size_t next_ = 0;
};

}  // namespace sweep_guard_evaluation
