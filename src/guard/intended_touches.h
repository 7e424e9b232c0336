#pragma once

#include <string>
#include <vector>

#include "guard/intended_contact.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/sweep_report.h"

namespace sweep_guard_core {

/// Keeps which links of the tool have touched a workpiece as intended: each until it is 10 mm away from the box around
/// the regions, in M, or until nothing is intended there any more.
class IntendedTouches {
 public:
  /// Takes over what a sweep found.
  /// @param report      of one body
  /// @param pose, X_WB  where its sweep ended
  void update(const SweepReport& report, const PoseWithFrames& pose, const Eigen::Isometry3d& X_WB, const Tool& body,
              const Intentions& intentions);
  void clear() { touches_.clear(); }

  bool contains(const std::string& mesh_id, const std::string& link) const;

 private:
  struct Touch {
    std::string mesh_id;
    std::string link;
    bool operator==(const Touch& other) const { return mesh_id == other.mesh_id && link == other.link; }
  };

  std::vector<Touch> touches_;
};

inline const IntendedTouches kNoTouches;

}  // namespace sweep_guard_core
