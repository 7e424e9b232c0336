#pragma once

#include <OgreColourValue.h>

namespace sweep_guard_rviz {

/// How one part of the picture is drawn.
struct Part {
  bool shown = true;
  Ogre::ColourValue color;
};

/// What is drawn, and how.
struct Look {
  Part surface;
  size_t most_edged = 0;  ///< edges are drawn of surfaces of so many triangles at most
  Part touched;
  Part reflex;
  Part considered;
  Part measured;       ///< volumes of the newest sweep
  size_t history = 0;  ///< number of earlier volumes that stay
  Part predicted;      ///< volumes along the predicted path
  Part tool;
  Part ghosts;
  size_t most_ghosts = 0;
  Part path;  ///< of the tip, measured and predicted
  Part contacts;
  float point_size = 0.0F;  ///< of a contact [m]
  Part normals;
  float normal_length = 0.0F;  ///< [m]
  Part depths;                 ///< of contacts: a spike into the workpiece, and the largest in words

  /// In grey, as while nothing is promised; the surface stays as it is.
  Look greyed() const;
  /// The surface alone.
  Look surfaceOnly() const;
};

}  // namespace sweep_guard_rviz
