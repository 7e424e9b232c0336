#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sweep_guard_benchmark {

using Nanoseconds = std::int64_t;  ///< since the epoch of the ROS clock

/// What the guard said of the poses after `begin` up to `stamp`, and when it was heard.
struct Heard {
  Nanoseconds begin;
  Nanoseconds stamp;
  Nanoseconds received;
};

/// From each pose until a message was heard that covers it [ms]; poses that none covers are left out.
/// @param poses  stamps, ascending
/// @param heard  stamps ascending
std::vector<double> latencies(const std::vector<Nanoseconds>& poses, const std::vector<Heard>& heard);

/// From the pose that each message rests on until it was heard [ms]. Of messages with the same stamp the first counts:
/// the others repeat it.
std::vector<double> ages(const std::vector<Heard>& heard);

/// How often a message begins later than the one before ended: motion that no one looked at.
std::size_t holes(const std::vector<Heard>& heard);

/// What lies in [begin, end), by its stamp.
std::vector<Heard> within(const std::vector<Heard>& heard, Nanoseconds begin, Nanoseconds end);

}  // namespace sweep_guard_benchmark
