#pragma once

#include <OgreSceneNode.h>

namespace sweep_guard_rviz {

/// Shows a node below its parent, or takes it out. Its visibility would be that of everything below it, too.
inline void attach(Ogre::SceneNode& parent, Ogre::SceneNode& node, bool shown) {
  if (shown == (node.getParent() != nullptr)) return;
  if (shown) {
    parent.addChild(&node);
  } else {
    parent.removeChild(&node);
  }
}

}  // namespace sweep_guard_rviz
