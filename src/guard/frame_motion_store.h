#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "sweep_guard/common/priority_mutex.h"
#include "sweep_guard/guard/frame_motion.h"

namespace sweep_guard_core {

/// Keeps the newest motions of frames that move on their own. Any thread.
class FrameMotionStore {
 public:
  FrameMotionStore();

  /// Sets which frames there are whose names begin with `beginning`, and forgets the motions of others that do.
  void expect(const std::string& beginning, const std::set<std::string>& frames);
  /// Replaces motions. Those of frames that are not expected are left out.
  void set(const FrameMotions& motions);

  std::shared_ptr<const FrameMotions> get() const;
  bool expects(const std::string& frame) const;
  /// Returns the pose of a frame at a time; empty: not known.
  std::optional<Eigen::Isometry3d> at(const std::string& frame, Time time) const;
  /// Returns the newest measured pose of a frame; empty: there is none.
  std::optional<Eigen::Isometry3d> newest(const std::string& frame) const;

 private:
  std::shared_ptr<const FrameMotion> find(const std::string& frame) const;

  mutable PriorityMutex mutex_;
  std::set<std::string> frames_;
  std::shared_ptr<const FrameMotions> motions_;
};

}  // namespace sweep_guard_core
