#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "ros/threads/gate.h"

namespace sweep_guard_ros {

/// Reports the refused messages of one topic to all of its bounded subscriptions in this process. roscpp has one of them read
/// each message for all, and none of them receives what that one refuses. Any thread.
class TopicRefusals {
 public:
  using Report = Gate<const std::string&>;

  /// Returns those that all subscriptions of this process to a topic share.
  /// @param topic  resolved name
  static std::shared_ptr<TopicRefusals> of(const std::string& topic);

  /// @param report  called with the reason of each refusal, for as long as the returned object exists and is not closed
  std::shared_ptr<Report> add(std::function<void(const std::string&)> report);
  void pass(const std::string& reason);

 private:
  std::vector<std::weak_ptr<Report>> reports() const;

  mutable sweep_guard_core::Mutex mutex_;
  std::vector<std::weak_ptr<Report>> reports_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_ros
