#pragma once

#include <OgreColourValue.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>
#include <OgrePrerequisites.h>
#include <OgreVector.h>
#include <shape_msgs/MeshTriangle.h>
#include <sweep_guard/ObjectView.h>

#include <cstdint>
#include <vector>

#include "rviz/heat_map.h"

namespace sweep_guard_rviz {

/// Lists the triangles of a workpiece that are shown in a color of their own: ascending, each triangle in one list.
struct Highlights {
  std::vector<std::uint32_t> touched;
  std::vector<std::uint32_t> reflex;      ///< without those in touched
  std::vector<std::uint32_t> considered;  ///< without those in touched and reflex
  std::vector<std::uint32_t> allowed;     ///< touched by links that may, without those above
  std::vector<std::uint32_t> intended;    ///< without those above

  bool operator==(const Highlights& other) const {
    return touched == other.touched && reflex == other.reflex && considered == other.considered &&
           allowed == other.allowed && intended == other.intended;
  }
};

/// Assigns each triangle to its most urgent list. Drops indices that the workpiece does not have.
/// @param intended   where contact is meant
/// @param triangles  number of triangles of the workpiece
Highlights highlightsOf(const sweep_guard::ObjectView& view, const std::vector<std::uint32_t>& intended,
                        size_t triangles);

/// Draws a deforming surface with highlighted triangles. All layers share one vertex buffer, which a deformation
/// overwrites; each layer has an index buffer.
class SurfaceVisual {
 public:
  /// The layers in drawing order, the last on top.
  enum Layer {
    kSurface,
    kHeat,  ///< the first of kHeatColors
    kIntended = kHeat + kHeatColors,
    kAllowed,
    kConsidered,
    kReflex,
    kTouched,
    kLayers
  };

  SurfaceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node);
  ~SurfaceVisual();
  SurfaceVisual(const SurfaceVisual&) = delete;
  SurfaceVisual& operator=(const SurfaceVisual&) = delete;

  /// Replaces the surface.
  /// @param triangles  with vertex indices below `vertices`
  void setTriangles(std::vector<shape_msgs::MeshTriangle> triangles, size_t vertices);
  size_t triangleCount() const { return triangles_.size(); }
  size_t vertexCount() const { return vertices_; }

  /// Deforms the surface.
  /// @param positions  x0 y0 z0 x1 ... of all vertices, in the frame of the node [m]
  void setVertices(const float* positions);
  void highlight(const Highlights& highlights);  ///< indices below triangleCount()
  void color(const HeatMap& map);                ///< the same

  /// @param edges  draws the edges of the triangles, too
  void paintLayer(Layer layer, const Ogre::ColourValue& color, bool shown, bool edges);

  size_t drawnTriangles(Layer layer) const;  ///< number of triangles that a layer shows

 private:
  void build();
  void clear();
  void setIndices(Layer layer, const std::vector<std::uint32_t>& triangles);
  std::vector<Ogre::Vector3> normals() const;
  void writeVertices();
  void updateVisibility();

  Ogre::SceneManager& scene_;
  Ogre::SceneNode& node_;
  std::vector<shape_msgs::MeshTriangle> triangles_;
  size_t vertices_ = 0;
  Ogre::MeshPtr mesh_;
  Ogre::Entity* entity_ = nullptr;
  Ogre::HardwareVertexBufferSharedPtr buffer_;
  std::vector<Ogre::MaterialPtr> materials_;
  bool wanted_[kLayers] = {};
  size_t counts_[kLayers] = {};
  std::vector<float> positions_;  // empty: none received
  Ogre::ColourValue color_;
};

}  // namespace sweep_guard_rviz
