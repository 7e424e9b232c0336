#pragma once

#include <set>
#include <string>
#include <vector>

#include "ros/input/joint_names.h"

namespace sweep_guard_ros {

/// Remembers which names of joints that are not the tool's came in messages, to be shown where the tool's are missing.
class ForeignJoints {
 public:
  /// Remembers at most 64 names.
  void note(const JointNames& own, const std::vector<std::string>& names);

  /// Lists at most 8 of the names, those first in which a missing name is contained; empty: there are none.
  std::string text(const std::vector<std::string>& missing) const;

  void clear() { names_.clear(); }

 private:
  std::set<std::string> names_;
};

}  // namespace sweep_guard_ros
