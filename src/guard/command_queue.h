#pragma once

#include <boost/circular_buffer.hpp>
#include <utility>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/prediction/sent_command.h"

namespace sweep_guard_core {

/// Holds the commands that the guard's thread has not taken: the newest 256, as while no pose comes. Any thread.
class CommandQueue {
 public:
  void push(SentCommand command) {
    const Lock lock(mutex_);
    commands_.push_back(std::move(command));
  }

  /// Takes all commands, the oldest first.
  /// @param[out] taken  overwritten; its buffer is used again
  void take(std::vector<SentCommand>& taken) {
    const Lock lock(mutex_);
    taken.assign(commands_.begin(), commands_.end());
    commands_.clear();
  }

 private:
  Mutex mutex_;
  boost::circular_buffer<SentCommand> commands_ GUARDED_BY(mutex_) = boost::circular_buffer<SentCommand>(256);
};

}  // namespace sweep_guard_core
