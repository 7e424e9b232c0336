#pragma once

#include <sweep_guard/TestedVolume.h>

#include <deque>
#include <vector>

#include "rviz/ogre_vector.h"

namespace sweep_guard_rviz {

/// The corners of a convex face in order, in the frame of the workpiece [m].
using Face = std::vector<Ogre::Vector3>;

/// Returns the faces of a box that is clipped by planes. A plane that clips nothing has no face.
std::vector<Face> facesOf(const sweep_guard::TestedVolume& volume);

/// Keeps volumes of earlier sweeps for drawing: close enough to leave no gap, far enough apart to be distinguished.
class VolumeHistory {
 public:
  using Volumes = std::vector<sweep_guard::TestedVolume>;

  /// Adds the volumes that lie farther than half their least width from each one kept, so that repeated volumes are
  /// kept once. Then drops the oldest ones above `max_count`.
  void add(const Volumes& volumes, size_t max_count);
  void clear() { kept_.clear(); }

  /// Returns the volumes kept that are not near one of the newest volumes, the oldest first.
  Volumes beside(const Volumes& newest) const;

 private:
  std::deque<sweep_guard::TestedVolume> kept_;
};

}  // namespace sweep_guard_rviz
