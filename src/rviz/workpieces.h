#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ObjectView.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rviz/look.h"
#include "rviz/workpiece_visual.h"

namespace sweep_guard_rviz {

/// The workpieces of one display, by their ids.
class Workpieces {
 public:
  /// Pose of a frame in the fixed frame. @return false: it is not known
  using FindFrame = std::function<bool(const std::string& frame, Ogre::Vector3& position, Ogre::Quaternion& rotation)>;

  Workpieces(Ogre::SceneManager& scene, Ogre::SceneNode& node) : scene_(scene), node_(node) {}

  void clear();

  void take(
      const sweep_guard::DeformableMesh& mesh);  ///< a mesh without vertices and triangles takes its workpiece out
  void take(const sweep_guard::MeshVertices::ConstPtr& vertices);
  void deform();  ///< to the newest vertices

  /// Of what is not among `objects` only the surface is drawn; what has none is gone.
  void draw(const std::vector<sweep_guard::ObjectView>& objects, const Look& look);
  void place(const FindFrame& find);  ///< what has no known frame is hidden

  size_t drawnTriangles(SurfaceVisual::Layer layer) const;
  /// What is missing or wrong, in words; empty: nothing.
  /// @param topic  where meshes come from
  std::string complaint(const std::string& topic) const;

 private:
  WorkpieceVisual& visual(const std::string& id);
  void note(const std::string& id, const std::string& wrong);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& node_;
  std::map<std::string, std::unique_ptr<WorkpieceVisual>> visuals_;
  std::map<std::string, std::string> wrong_;                             // with a workpiece, in words
  std::map<std::string, sweep_guard::MeshVertices::ConstPtr> vertices_;  // that are not drawn yet
};

}  // namespace sweep_guard_rviz
