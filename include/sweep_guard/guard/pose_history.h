#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/merged_motion.h"

namespace sweep_guard_core {

/// Where the tool T and a frame M were at a moment in the fixed frame W.
struct PoseSample {
  std::uint64_t number;  ///< counts the poses of the tool
  Time stamp;
  Eigen::Isometry3d X_WT;
  Eigen::Isometry3d X_WM;
};

/// The history of tool and frame, pose by pose, as far back as it may have to be swept. It makes room for itself by moving
/// down in its memory: nothing is allocated once it has been as long as it gets.
class PoseHistory {
 public:
  /// A history that has grown this long goes straight past its second pose from then on: it is that of a detector that
  /// keeps failing. Twice the poses that may wait to be swept.
  static constexpr size_t kMaxSize = 8192;

  /// @param placed  numbers ascend; stamps do not go back
  void add(const PoseSample& placed);
  void forgetFirst() { ++begin_; }  ///< not the last one

  size_t size() const { return all_.size() - begin_; }
  const PoseSample& operator[](size_t i) const { return all_[begin_ + i]; }
  const PoseSample& newest() const { return all_.back(); }

  /// Place of the last pose of that number or a lower one; 0 if there is none.
  size_t lastUpTo(std::uint64_t number) const;
  /// Place of the last pose of that stamp or an earlier one; 0 if there is none.
  size_t lastUpTo(Time stamp) const;

  /// The share of the time from the pose at `from` to the newest that is over at the pose at `i`; 0 before it, 1 where
  /// no time passes.
  double share(size_t from, size_t i) const;

  /// The segment seen from M.
  void path_M(size_t first, size_t last, double tool_radius, Path& path_M) const;

 private:
  std::vector<PoseSample> all_;
  size_t begin_ = 0;
};

}  // namespace sweep_guard_core
