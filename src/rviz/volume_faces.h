#pragma once

#include <OgreVector.h>
#include <sweep_guard/TestedVolume.h>

#include <vector>

namespace sweep_guard_rviz {

/// Corners of a convex face in their order, in the frame of the workpiece [m].
using Face = std::vector<Ogre::Vector3>;

/// The faces of a box that is cut by planes. A plane that cuts nothing off has none.
std::vector<Face> facesOf(const sweep_guard::TestedVolume& volume);

}  // namespace sweep_guard_rviz
