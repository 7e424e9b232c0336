#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sweep_guard_benchmark {

using Nanoseconds = std::int64_t;  ///< since the epoch of the ROS clock

/// A message of the guard about the poses after `begin` up to `stamp`, and when it was received.
struct ReceivedMessage {
  Nanoseconds begin;
  Nanoseconds stamp;
  Nanoseconds received;
};

/// Returns the time from each pose until the first message that covers it was received [ms]. Poses that no message
/// covers are left out.
/// @param poses     stamps, ascending
/// @param messages  ascending in their stamps
std::vector<double> latencies(const std::vector<Nanoseconds>& poses, const std::vector<ReceivedMessage>& messages);

/// Returns the time from the newest pose of each message until the message was received [ms]. Of messages with the same
/// stamp only the first counts; the others repeat it.
std::vector<double> ages(const std::vector<ReceivedMessage>& messages);

/// A class of a distribution.
struct HistogramClass {
  double middle_ms;
  double share;  ///< of all measurements
};

/// Returns the distribution in twenty classes per decade, for a log scale. No class between the ends is left out.
std::vector<HistogramClass> histogram(const std::vector<double>& milliseconds);

/// Returns how often a message begins after the end of the previous one: motion that was not swept.
std::size_t holes(const std::vector<ReceivedMessage>& messages);

/// Returns the messages whose stamp lies in [begin, end).
std::vector<ReceivedMessage> within(const std::vector<ReceivedMessage>& messages, Nanoseconds begin, Nanoseconds end);

}  // namespace sweep_guard_benchmark
