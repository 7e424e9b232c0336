#pragma once

#include <map>
#include <set>
#include <string>

#include "common/guarded_by.h"

namespace sweep_guard_ros {

/// Knows on which frame each frame stands, as transforms say, and which of these transforms count. Names are without a slash before
/// them. Any thread.
class FrameTree {
 public:
  /// Takes note of a transform.
  void add(const std::string& parent, const std::string& child);

  /// Sets that transforms between `target` and each of these frames count, in place of those that one user has set before.
  /// @param user  name of the one who uses them
  void use(const std::string& user, const std::string& target, const std::set<std::string>& sources);

  /// Returns whether the transform to a frame from the one it stands on lies between frames that use() names.
  bool isUsed(const std::string& child) const;
  /// Returns the same for the frames of one user.
  bool isUsedBy(const std::string& user, const std::string& child) const;
  /// Returns the frames whose transforms, from what each stands on, lie between two frames.
  std::set<std::string> between(const std::string& target, const std::string& source) const;

 private:
  struct Uses {
    std::string target;
    std::set<std::string> sources;
  };

  void findUsed() const REQUIRES(mutex_);

  mutable sweep_guard_core::Mutex mutex_;
  std::map<std::string, std::string> parents_ GUARDED_BY(mutex_);                 // by child
  std::map<std::string, Uses> uses_ GUARDED_BY(mutex_);                           // by user
  mutable bool outdated_ GUARDED_BY(mutex_) = false;                              // `used_`
  mutable std::map<std::string, std::set<std::string>> used_ GUARDED_BY(mutex_);  // children, by user
};

}  // namespace sweep_guard_ros
