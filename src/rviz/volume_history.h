#pragma once

#include <sweep_guard/TestedVolume.h>

#include <deque>
#include <vector>

namespace sweep_guard_rviz {

/// Volumes of earlier sweeps, for the eye: close enough to leave no gap, and far enough apart to be told from each
/// other.
class VolumeHistory {
 public:
  using Volumes = std::vector<sweep_guard::TestedVolume>;

  /// Keeps those that lie farther than half their least width from each one kept, and the last `most` of all. A sweep
  /// in parts tells them all again and again: each is kept once.
  void add(const Volumes& volumes, size_t most);
  void clear() { kept_.clear(); }

  /// What is to be drawn beside the newest volumes, the oldest first: those whose place none of these has taken.
  Volumes beside(const Volumes& newest) const;

 private:
  std::deque<sweep_guard::TestedVolume> kept_;
};

}  // namespace sweep_guard_rviz
