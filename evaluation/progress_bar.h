#pragma once

#include <cstddef>
#include <mutex>
#include <string>

namespace sweep_guard_evaluation {

/// Shows the progress of a long computation in one line on stderr, if that is a terminal. Any thread may advance it.
class ProgressBar {
 public:
  ProgressBar(const std::string& title, size_t total);
  ~ProgressBar();  ///< erases the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void advance(size_t steps);

 private:
  const std::string title_;
  const size_t total_;
  const bool visible_;
  std::mutex mutex_;
  size_t done_ = 0;
  size_t percent_ = 0;
};

}  // namespace sweep_guard_evaluation
