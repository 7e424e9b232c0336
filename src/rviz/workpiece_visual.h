#pragma once

#include <rviz/ogre_helpers/movable_text.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ObjectTouches.h>
#include <sweep_guard/ObjectView.h>

#include <optional>
#include <string>
#include <vector>

#include "rviz/display_style.h"
#include "rviz/drawing.h"
#include "rviz/ogre_vector.h"
#include "rviz/surface_visual.h"
#include "rviz/volume_history.h"

namespace sweep_guard_rviz {

/// Draws one workpiece with the volumes it is tested with, highlighted triangles and contacts.
class WorkpieceVisual {
 public:
  WorkpieceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& root);
  ~WorkpieceVisual();
  WorkpieceVisual(const WorkpieceVisual&) = delete;
  WorkpieceVisual& operator=(const WorkpieceVisual&) = delete;

  /// Takes a mesh, or vertices of the same revision; ignores invalid ones.
  /// @returns the problem as text; empty if there is none
  std::string setMesh(const sweep_guard::DeformableMesh& mesh);
  std::string setVertices(const sweep_guard::MeshVertices& vertices);

  /// Sets where contact is meant.
  /// @param revision  of the mesh that the triangles are indices into
  void setIntended(std::uint32_t revision, const std::vector<std::uint32_t>& triangles);

  /// Sets which triangles were touched.
  void setTouches(const sweep_guard::ObjectTouches& touches, ColorBy by);
  std::string legend() const;  ///< of the colors of the surface; empty: nothing is colored

  void show(const sweep_guard::ObjectView& view, const DisplayStyle& style);
  void showSurfaceOnly();
  void paint(const DisplayStyle& style);

  bool hasMesh() const { return revision_.has_value(); }
  /// Returns whether the triangle indices of a view refer to the mesh.
  bool fits(const sweep_guard::ObjectView& view) const { return revision_ == view.revision; }
  const std::string& frame() const { return frame_; }  ///< frame of the workpiece; empty: not known
  void place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation);
  void setVisible(bool visible);

  size_t drawnTriangles(SurfaceVisual::Layer layer) const { return surface_.drawnTriangles(layer); }

 private:
  void showVolumes(const sweep_guard::ObjectView& view, const DisplayStyle& style);
  void showContacts(const sweep_guard::ObjectView& view, const DisplayStyle& style);
  void label(const sweep_guard::TriangleContact* deepest, const DisplayStyle& style);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& root_;
  Ogre::SceneNode* node_;
  std::string frame_;
  std::optional<std::uint32_t> revision_;
  SurfaceVisual surface_;
  Drawing measured_;
  Drawing predicted_;
  Drawing points_;
  Drawing normals_;
  Drawing depths_;
  rviz::MovableText label_;  // at the deepest contact
  Ogre::SceneNode* label_node_;
  VolumeHistory history_;
  std::optional<SurfaceVisual::Highlights> highlights_;
  std::uint32_t intended_revision_ = 0;
  std::vector<std::uint32_t> intended_;
  HeatMap heat_;
  ColorBy colored_by_ = ColorBy::kNothing;
};

}  // namespace sweep_guard_rviz
