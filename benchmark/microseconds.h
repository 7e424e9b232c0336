#pragma once

#include <chrono>
#include <ctime>

namespace sweep_guard_core {

/// Runs `work` once and returns the time that it takes [us].
template <typename Work>
double microseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

/// Returns the time that a processor has spent on this thread [us].
inline double processorMicroseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// Runs `work` once and returns the time that a processor spends on it [us]: other processes hardly change it.
template <typename Work>
double processorTime(const Work& work) {
  const double begin = processorMicroseconds();
  work();
  return processorMicroseconds() - begin;
}

}  // namespace sweep_guard_core
