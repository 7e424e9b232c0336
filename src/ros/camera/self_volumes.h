#pragma once

#include <set>
#include <string>
#include <vector>

#include "guard/recent_poses.h"
#include "ros/input/frames.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_ros {

/// The volumes around the robot while an image was taken: around the bodies of the tool, and around the links of the robot
/// description. One thread.
class SelfVolumes {
 public:
  /// All must outlive this.
  SelfVolumes(const LiveParameters& parameters, const Frames& frames, const sweep_guard_core::RecentPoses& poses)
      : parameters_(parameters), frames_(frames), poses_(poses) {}

  /// Returns a volume for each convex piece, in the fixed frame: of the tool between its poses around the stamp, and of each link
  /// that tf has known since the start, at the stamp. Waits for them, `timing/pose_timeout` in all. Valid until the next call.
  /// @param padding  the pieces are grown by this [m], >= 0
  /// @throws sweep_guard_core::Error if the tool or such a link is not known at the stamp: the picture would show it as surroundings
  const std::vector<sweep_guard_core::SweptVolume>& at(sweep_guard_core::Time stamp, double padding);

  /// Returns points within the tool at the pose after the stamp, in the fixed frame [m], as at().
  const std::vector<Eigen::Vector3d>& toolPoints() const { return points_W_; }
  /// Returns the links that the last call of at() has left out, because tf has never known them.
  const std::vector<std::string>& unplaced() const { return unplaced_; }

 private:
  void addTool(const Parameters& parameters, sweep_guard_core::Time stamp, double padding);
  void addLinks(const Parameters& parameters, sweep_guard_core::Time stamp, double padding,
                sweep_guard_core::SteadyTime end);
  void add(const std::vector<sweep_guard_core::ConvexPiece>& pieces, const sweep_guard_core::Motion& motion_W,
           const Parameters& parameters, double padding);

  const LiveParameters& parameters_;
  const Frames& frames_;
  const sweep_guard_core::RecentPoses& poses_;
  std::vector<sweep_guard_core::Motion> parts_W_;  // of a motion
  std::vector<sweep_guard_core::SweptVolume> volumes_W_;
  std::vector<Eigen::Vector3d> points_W_;
  std::set<std::string> known_;  // links
  std::vector<std::string> unplaced_;
};

}  // namespace sweep_guard_ros
