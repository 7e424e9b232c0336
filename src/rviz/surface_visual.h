#pragma once

#include <OgreColourValue.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>
#include <OgrePrerequisites.h>
#include <shape_msgs/MeshTriangle.h>
#include <sweep_guard/ObjectView.h>

#include <array>
#include <cstdint>
#include <vector>

#include "rviz/heat_map.h"
#include "rviz/ogre_vector.h"

namespace sweep_guard_rviz {

/// Draws a deforming surface with highlighted triangles. All layers share one vertex buffer, which a deformation
/// overwrites; each layer has an index buffer.
class SurfaceVisual {
 public:
  /// The layers in drawing order, the last on top.
  enum Layer {
    kSurface,
    kHeat,  ///< the first of kHeatColors
    kIntended = kHeat + kHeatColors,
    kAllowed,  ///< touched by links that may
    kConsidered,
    kReflex,
    kTouched,
    kLayers
  };
  /// The triangles that are shown in a color of their own, by layer, from kIntended on: ascending, each in one layer.
  using Highlights = std::array<std::vector<std::uint32_t>, kLayers>;

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

/// Assigns each triangle to its most urgent layer. Drops indices that the workpiece does not have.
/// @param intended   where contact is meant
/// @param triangles  number of triangles of the workpiece
SurfaceVisual::Highlights highlightsOf(const sweep_guard::ObjectView& view, const std::vector<std::uint32_t>& intended,
                                       size_t triangles);

}  // namespace sweep_guard_rviz
