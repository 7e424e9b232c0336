#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

/// Receives the number of poses processed since the last call; from any thread.
using Progress = std::function<void(size_t)>;

/// Calls add() for every pose, and reports progress now and then.
template <typename Add>
void addPoses(const std::vector<sweep_guard_core::StampedPose>& poses, const Progress& progress, const Add& add) {
  constexpr size_t kStep = 64;
  for (size_t i = 0; i < poses.size(); ++i) {
    add(poses[i]);
    if ((i + 1) % kStep == 0) progress(kStep);
  }
  progress(poses.size() % kStep);
}

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
