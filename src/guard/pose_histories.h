#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "guard/pose_history.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Removes the entries whose key no workpiece has as its id or frame.
template <typename Entries>
void keepOnlyNamed(const Workpieces& workpieces, std::string Workpiece::*name, Entries& entries) {
  for (auto entry = entries.begin(); entry != entries.end();) {
    const bool named = std::any_of(workpieces.begin(), workpieces.end(),
                                   [&](const auto& workpiece) { return (*workpiece).*name == entry->first; });
    entry = named ? std::next(entry) : entries.erase(entry);
  }
}

/// Keeps, for the frame of each workpiece, the poses of one body of the tool that may be swept again, and the newest. All
/// poses are numbered through, also the samples of frames that move on their own.
class PoseHistories {
 public:
  /// @param body    pose of the body at the pose of the tool
  /// @param frames  that move on their own: their samples come with join()
  void add(const PoseWithFrames& pose, const BodyPose& body, const FrameMotions& frames);
  /// Adds the poses in frames that move on their own, as far as these are known.
  void join(const FrameMotions& frames);

  bool isPlaced(const std::string& frame, const PoseWithFrames& pose, const FrameMotions& frames) const;
  const PoseHistory& of(const std::string& frame) const { return histories_.at(frame); }
  const PoseHistory* find(const std::string& frame) const;  ///< null: there was no pose in this frame
  std::uint64_t newest() const { return poses_; }           ///< number of the newest pose
  void findJumps(std::uint64_t after, const SpeedLimits& limits, std::map<std::string, JumpSpeed>& jumps) const;
  std::set<std::string> takePassedOver();  ///< frames whose waiting poses were left out since the last call

  void forgetOtherFrames(const Workpieces& workpieces);
  /// Forgets the poses of each frame that are neither needed nor younger than `kept` before the newest.
  /// @param needed_from  number of the first pose in a frame that has not been swept yet
  template <typename NeededFrom>
  void forgetBefore(Duration kept, const NeededFrom& needed_from) {
    for (auto& [frame, history] : histories_) {
      const std::uint64_t needed = needed_from(frame, history.newest().number);
      const Time oldest = history.newest().stamp - kept;
      while (history.size() > 1 && history[1].number <= needed && history[1].stamp <= oldest) history.forgetFirst();
    }
  }
  void reset();

 private:
  std::map<std::string, PoseHistory> histories_;  // by frame
  std::map<std::string, JoinedMotion> joined_;    // by frame, of those that move on their own
  std::vector<PoseSample> samples_;               // of one of these
  std::uint64_t poses_ = 0;
  std::set<std::string> passed_over_;
};

}  // namespace sweep_guard_core
