#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/common/sample_buffer.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Finds frames that several nodes publish in turn at different places: a lookup mixes both, and gives places where
/// nothing is. Only transforms that change count; static ones are left out.
///
/// Nodes that place a frame alike may share it, and one may take it over from another. It is a conflict if node A publishes, then
/// node B, then A again within about 1 s, and both place it on different frames, or more than 1 mm or 1 mrad apart at one stamp.
class FramePublishers {
 public:
  struct Transform {
    sweep_guard_core::Time stamp;
    std::string parent;
    Eigen::Isometry3d X_PF = Eigen::Isometry3d::Identity();  ///< finite, rotation orthonormal; not checked
  };
  /// Two nodes that do not agree where a frame is.
  struct Conflict {
    std::string frame;
    std::string text;                    ///< frame, nodes and by how much they differ, in words
    sweep_guard_core::SteadyTime found;  ///< last
  };

  /// Adds a transform that was received. The thread of the listener.
  void add(const std::string& frame, const std::string& node, const Transform& transform,
           sweep_guard_core::SteadyTime received);

  bool hasConflicts() const { return any_; }  ///< that conflicts() may return; any thread, without a lock
  /// Returns the conflicts that were found within the last 1.5 s. Any thread.
  std::vector<Conflict> conflicts(sweep_guard_core::SteadyTime now) const;

 private:
  using Samples = sweep_guard_core::SampleBuffer<Transform>;
  struct Node {
    std::string name;
    Samples samples = {};
    std::uint64_t number = 0;               // of its newest transform, among all
    sweep_guard_core::SteadyTime received;  // its newest transform
    sweep_guard_core::SteadyTime by_turns;  // when it published after another node that had published after it
  };
  static Node& nodeOf(const std::string& name, sweep_guard_core::SteadyTime received, std::vector<Node>& nodes);
  void compare(const std::string& frame, const Node& one, const Node& other, sweep_guard_core::SteadyTime received);
  void found(Conflict conflict);

  std::unordered_map<std::string, std::vector<Node>> nodes_;  // by frame; used by the listener only
  std::uint64_t count_ = 0;                                   // of transforms; the same
  mutable sweep_guard_core::Mutex mutex_;                     // of the next one
  mutable std::map<std::string, Conflict> conflicts_ GUARDED_BY(mutex_);
  mutable std::atomic<bool> any_ = false;
};

}  // namespace sweep_guard_ros
