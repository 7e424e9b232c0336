#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

namespace sweep_guard_core {

/// Counts the steps of a thread's work, so that another thread can tell work from a hang. One thread works, any thread
/// reads.
class Heartbeat {
 public:
  /// Begins a piece of work of the calling thread: beat() counts here until end().
  void begin();
  void end();

  /// Returns the number of steps since the construction; empty while there is no work.
  std::optional<std::uint64_t> steps() const;

 private:
  friend void beat();
  void add(std::uint64_t steps);

  std::atomic<std::uint64_t> count_ = 0;  // twice the steps; odd while it works
};

/// Reports that the calling thread has come a step further: belongs into loops that end and may take long. Takes
/// nanoseconds. Does nothing in a thread that has no heartbeat.
void beat();

}  // namespace sweep_guard_core
