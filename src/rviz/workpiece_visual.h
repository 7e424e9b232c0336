#pragma once

#include <OgreVector.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ObjectView.h>

#include <memory>
#include <optional>
#include <string>

#include "rviz/drawing.h"
#include "rviz/look.h"
#include "rviz/surface_visual.h"
#include "rviz/volume_history.h"

namespace sweep_guard_rviz {

/// One workpiece, what it is tested with and what is met of it.
class WorkpieceVisual {
 public:
  WorkpieceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& root);
  ~WorkpieceVisual();
  WorkpieceVisual(const WorkpieceVisual&) = delete;
  WorkpieceVisual& operator=(const WorkpieceVisual&) = delete;

  /// What does not fit is left out. @return what is wrong with it, in words; empty: nothing
  std::string setMesh(const sweep_guard::DeformableMesh& mesh);
  std::string setVertices(const sweep_guard::MeshVertices& vertices);

  void show(const sweep_guard::ObjectView& view, const Look& look);
  void showSurfaceOnly();
  void paint(const Look& look);

  bool hasMesh() const { return revision_.has_value(); }
  /// Triangles are highlighted only in the revision that they were counted in.
  bool fits(const sweep_guard::ObjectView& view) const { return revision_ == view.revision; }
  const std::string& frame() const { return frame_; }  ///< that it is to be placed in; empty: not known
  void place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation);
  void setVisible(bool visible);

  size_t drawnTriangles(SurfaceVisual::Layer layer) const { return surface_.drawnTriangles(layer); }

 private:
  void showVolumes(const sweep_guard::ObjectView& view, const Look& look);
  void showContacts(const sweep_guard::ObjectView& view, const Look& look);
  void label(const sweep_guard::TriangleContact* deepest, const Look& look);

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
  rviz::MovableText label_;  // of the deepest contact
  Ogre::SceneNode* label_node_;
  VolumeHistory history_;
  std::optional<Highlights> highlights_;
};

}  // namespace sweep_guard_rviz
