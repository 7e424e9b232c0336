#pragma once

#include <OgreSceneNode.h>

namespace sweep_guard_rviz {

/// Shows a node below its parent or detaches it. Setting its visibility instead would overwrite that of its children.
inline void attach(Ogre::SceneNode& parent, Ogre::SceneNode& node, bool shown) {
  if (shown == (node.getParent() != nullptr)) return;
  if (shown) {
    parent.addChild(&node);
  } else {
    parent.removeChild(&node);
  }
}

}  // namespace sweep_guard_rviz
