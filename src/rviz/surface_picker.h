#pragma once

#include <OgreRay.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/MeshVertices.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "rviz/ogre_vector.h"

namespace sweep_guard_rviz {

/// Finds the point of a workpiece under the mouse. Searches the workpieces themselves, not the picture, so the
/// tool and the tested volumes in front of them do not matter.
class SurfacePicker {
 public:
  /// Finds the pose of a frame in the fixed frame. @returns whether it is known
  using FindFrame = std::function<bool(const std::string& frame, Ogre::Vector3& position, Ogre::Quaternion& rotation)>;

  /// Adds or replaces a workpiece; a mesh without vertices and triangles removes it. Ignores invalid ones.
  void take(const sweep_guard::DeformableMesh::ConstPtr& mesh);
  void take(const sweep_guard::MeshVertices::ConstPtr& vertices);
  void clear() { surfaces_.clear(); }

  /// Returns the first point that a ray in the fixed frame meets as the center of a region, with its workpiece and frame;
  /// empty if it meets no workpiece whose frame is known.
  std::optional<sweep_guard::Intend> pick(const Ogre::Ray& ray, const FindFrame& find) const;

 private:
  struct PickableSurface {
    sweep_guard::DeformableMesh::ConstPtr mesh;
    sweep_guard::MeshVertices::ConstPtr vertices;  // null: those of the mesh

    Ogre::Vector3 vertex(std::uint32_t index) const;
    std::optional<float> distance(const Ogre::Ray& ray_M) const;
  };

  std::map<std::string, PickableSurface> surfaces_;  // by id
};

}  // namespace sweep_guard_rviz
