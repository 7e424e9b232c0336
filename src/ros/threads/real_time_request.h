#pragma once

#include <string>
#include <utility>

#include "common/guarded_by.h"

namespace sweep_guard_ros {

/// Asks for the real-time priority of a thread that has to run on time, and knows what became of it. The thread goes on
/// without it where it is refused: as prompt as it can be without a privilege (setPrompt()).
class RealTimeRequest {
 public:
  /// @param priority   1 to 99; 0: none is wanted
  /// @param parameter  that it was set by
  RealTimeRequest(int priority, std::string parameter) : priority_(priority), parameter_(std::move(parameter)) {}

  void make();  ///< by the thread, once. Logs a refusal

  std::string refusal() const;  ///< with what to do; empty: granted, or not asked for yet. Any thread

 private:
  const int priority_;
  const std::string parameter_;
  mutable sweep_guard_core::Mutex mutex_;
  std::string refusal_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_ros
