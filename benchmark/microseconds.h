#pragma once

#include <chrono>

namespace sweep_guard_core {

/// Runs `work` once and returns the time that it takes [us].
template <typename Work>
double microseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace sweep_guard_core
