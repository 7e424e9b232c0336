#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intended.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ObjectView.h>
#include <sweep_guard/Touches.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rviz/display_style.h"
#include "rviz/workpiece_visual.h"

namespace sweep_guard_rviz {

constexpr std::uint32_t kMeshesQueued = 10;  ///< of topics, for several workpieces

/// Holds the workpieces of one display by id.
class Workpieces {
 public:
  /// Finds the pose of a frame in the fixed frame. @returns whether it is known
  using FindFrame = std::function<bool(const std::string& frame, Ogre::Vector3& position, Ogre::Quaternion& rotation)>;

  Workpieces(Ogre::SceneManager& scene, Ogre::SceneNode& node) : scene_(scene), node_(node) {}

  void clear();

  /// Adds or replaces a workpiece; a mesh without vertices and triangles removes it.
  void take(const sweep_guard::DeformableMesh& mesh);
  void take(const sweep_guard::MeshVertices::ConstPtr& vertices);
  void take(const sweep_guard::Intended::ConstPtr& intended) { intended_ = intended; }
  void take(const sweep_guard::Touches::ConstPtr& touches) { touches_ = touches; }
  void deform();  ///< applies the newest vertices

  /// Draws all workpieces. One that is not among `objects` is drawn without volumes and contacts, or removed if it has
  /// no mesh.
  void draw(const std::vector<sweep_guard::ObjectView>& objects, const DisplayStyle& style);
  void place(const FindFrame& find);  ///< hides workpieces whose frame is not known

  std::string legend() const;  ///< of the colors of each workpiece that was touched; empty: none is colored
  size_t drawnTriangles(SurfaceVisual::Layer layer) const;
  /// Returns a missing or invalid input as text; empty if there is none.
  /// @param topic  topic of the meshes
  std::string problem(const std::string& topic) const;

 private:
  WorkpieceVisual& visual(const std::string& id);
  void showIntended(const std::string& id, WorkpieceVisual& visual) const;
  void showTouches(const std::string& id, WorkpieceVisual& visual, ColorBy by) const;
  void setProblem(const std::string& id, const std::string& problem);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& node_;
  std::map<std::string, std::unique_ptr<WorkpieceVisual>> visuals_;
  std::set<std::string> cameras_;                                        // workpieces that need no mesh
  std::map<std::string, std::string> problems_;                          // by workpiece
  std::map<std::string, sweep_guard::MeshVertices::ConstPtr> vertices_;  // not drawn yet
  sweep_guard::Intended::ConstPtr intended_;
  sweep_guard::Touches::ConstPtr touches_;
};

}  // namespace sweep_guard_rviz
