#pragma once

namespace sweep_guard_ros {

/// Says which geometry of its links a tool is made of; kEither: a link's collisions or, if it has none, its visuals.
enum class LinkGeometry { kCollision, kVisual, kEither };

/// Says what a robot description has of the geometry of a link, and which part of it is read.
struct LinkElements {
  bool visual_is_read = false;  ///< in place of the collisions
  bool has_shape = false;       ///< in an element that is read or not
  bool has_several = false;     ///< geometries in one element that is read
};

}  // namespace sweep_guard_ros
