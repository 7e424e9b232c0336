#pragma once

#include <OgreColourValue.h>

#include <optional>

#include "rviz/heat_map.h"

namespace sweep_guard_rviz {

/// Describes how one element of the display is drawn.
struct ElementStyle {
  bool shown = true;
  Ogre::ColourValue color;
};

/// Describes how all elements of the display are drawn.
struct DisplayStyle {
  ElementStyle surface;
  size_t max_edged = 0;  ///< edges are drawn of surfaces with at most this many triangles
  ElementStyle touched;
  ElementStyle reflex;
  ElementStyle considered;
  ElementStyle intended;   ///< where contact is meant
  ElementStyle allowed;    ///< triangles that links are allowed to touch
  ElementStyle measured;   ///< volumes of the newest sweep
  size_t history = 0;      ///< number of earlier volumes that are kept
  ElementStyle predicted;  ///< volumes along the predicted path
  ElementStyle tool;
  ElementStyle ghosts;
  size_t max_ghosts = 0;
  ElementStyle path;  ///< path of the tip, measured and predicted
  ElementStyle contacts;
  float point_size = 0.0F;  ///< of a contact point [m]
  ElementStyle normals;
  float normal_length = 0.0F;    ///< [m]
  ElementStyle depths;           ///< of contacts: a spike into the workpiece, and a label with the largest depth
  ElementStyle force;            ///< of a workpiece on the tool, with a label
  float force_length = 0.0F;     ///< of its arrow, per force [m/N]
  ElementStyle way_back;         ///< of a robot that a motion guard holds back: an arrow
  float way_back_length = 0.0F;  ///< [m]
  ColorBy color_by = ColorBy::kNothing;
  std::optional<double>
      since_contact;  ///< [s] since the tool touched: the label says so, without spikes. Empty: it touches

  /// Returns this style with a pale contact, for one that ended this long ago [s].
  DisplayStyle held(double seconds) const;
  /// Returns this style with pale triangles that will be touched later: the operator knows of them.
  DisplayStyle acknowledged() const;
  /// Returns this style with everything gray except the surface: for level UNKNOWN.
  DisplayStyle grayed() const;
  /// Returns this style with everything hidden except the surface.
  DisplayStyle surfaceOnly() const;
};

}  // namespace sweep_guard_rviz
