#pragma once

#include <functional>
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

}  // namespace sweep_guard_evaluation
