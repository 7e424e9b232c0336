#include "common/heartbeat.h"

namespace sweep_guard_core {
namespace {

thread_local Heartbeat* heartbeat_of_thread = nullptr;

}  // namespace

void Heartbeat::begin() {
  heartbeat_of_thread = this;
  add(1);
}

void Heartbeat::end() {
  add(1);
  heartbeat_of_thread = nullptr;
}

std::optional<std::uint64_t> Heartbeat::steps() const {
  const std::uint64_t count = count_.load(std::memory_order_acquire);
  return count % 2 == 1 ? std::optional(count / 2) : std::nullopt;
}

// No other thread writes.
void Heartbeat::add(std::uint64_t steps) {
  count_.store(count_.load(std::memory_order_relaxed) + steps, std::memory_order_release);
}

void beat() {
  if (heartbeat_of_thread != nullptr) heartbeat_of_thread->add(2);
}

}  // namespace sweep_guard_core
