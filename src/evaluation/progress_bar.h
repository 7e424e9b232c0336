#pragma once

#include <cstddef>
#include <mutex>
#include <string>

namespace sweep_guard_evaluation {

/// How far a long computation is, in one line on stderr where that is a terminal, and nowhere else. Any thread.
class ProgressBar {
 public:
  ProgressBar(const std::string& title, size_t total);
  ~ProgressBar();  ///< takes the line away
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void advance(size_t steps);

 private:
  const std::string title_;
  const size_t total_;
  const bool shown_;
  std::mutex mutex_;
  size_t done_ = 0;
  size_t percent_ = 0;
};

}  // namespace sweep_guard_evaluation
