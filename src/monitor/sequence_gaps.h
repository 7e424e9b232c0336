#pragma once

#include <cstdint>
#include <string>

namespace sweep_guard_core {

/// Finds messages that were sent and did not arrive, by the numbers that their publisher gave them. A publisher that does not count,
/// or begins again, loses nothing.
class SequenceGaps {
 public:
  /// Adds a message that arrived.
  /// @returns so many were lost since the one before
  std::uint32_t add(const std::string& publisher, std::uint32_t sequence) {
    const bool counts = publisher == publisher_ && sequence_ != 0 && sequence > sequence_ + 1;
    const std::uint32_t lost = counts ? sequence - sequence_ - 1 : 0;
    if (publisher != publisher_) publisher_ = publisher;
    sequence_ = sequence;
    return lost;
  }

 private:
  std::string publisher_;  // of the message before, as the number
  std::uint32_t sequence_ = 0;
};

}  // namespace sweep_guard_core
