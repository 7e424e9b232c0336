#pragma once

#include <memory>
#include <utility>

#include "common/guarded_by.h"
#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Holds the current parameters. A returned snapshot does not change. Any thread.
class LiveParameters {
 public:
  explicit LiveParameters(Parameters initial) : initial_(std::make_shared<const Parameters>(std::move(initial))) {}

  std::shared_ptr<const Parameters> get() const {
    const sweep_guard_core::Lock lock(mutex_);
    return current_;
  }
  void set(std::shared_ptr<const Parameters> parameters) {
    const sweep_guard_core::Lock lock(mutex_);
    std::swap(current_, parameters);
  }
  const Parameters& initial() const { return *initial_; }  ///< parameters at the start

 private:
  const std::shared_ptr<const Parameters> initial_;
  mutable sweep_guard_core::Mutex mutex_;
  std::shared_ptr<const Parameters> current_ GUARDED_BY(mutex_) = initial_;
};

}  // namespace sweep_guard_ros
