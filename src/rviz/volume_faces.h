#pragma once

#include <OgreVector.h>
#include <sweep_guard/TestedVolume.h>

#include <vector>

namespace sweep_guard_rviz {

/// The corners of a convex face in order, in the frame of the workpiece [m].
using Face = std::vector<Ogre::Vector3>;

/// Returns the faces of a box that is clipped by planes. A plane that clips nothing has no face.
std::vector<Face> facesOf(const sweep_guard::TestedVolume& volume);

}  // namespace sweep_guard_rviz
