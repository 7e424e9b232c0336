#include "rviz/surface_visual.h"

#include <OgreEntity.h>
#include <OgreHardwareBufferManager.h>
#include <OgreMeshManager.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSubEntity.h>
#include <OgreSubMesh.h>
#include <OgreTechnique.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>

#include "rviz/drawing.h"

namespace sweep_guard_rviz {
namespace {

using Triangles = std::vector<std::uint32_t>;

Triangles without(const Triangles& all, const Triangles& others) {
  Triangles left;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

Triangles below(Triangles all, size_t count) {
  std::sort(all.begin(), all.end());
  const auto end = std::find_if(all.begin(), all.end(), [&](std::uint32_t triangle) { return triangle >= count; });
  all.erase(end, all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

using Ogre::Vector3;

const Vector3 kLight(0.48F, 0.14F, 0.866F);  // direction towards the light

// Memory layout of the vertex buffer.
struct Vertex {
  float position[3];
  std::uint8_t color[4];  // red first
};

void writeTo(Ogre::HardwareBuffer& buffer, const void* data, size_t bytes) {
  void* const to = buffer.lock(0, bytes, Ogre::HardwareBuffer::HBL_DISCARD);
  std::memcpy(to, data, bytes);
  buffer.unlock();
}

void addEdges(Ogre::Technique& technique, int layer) {
  Ogre::Pass& edges = *technique.createPass();
  const float lifted = static_cast<float>(layer) + 0.5F;
  edges.setCullingMode(Ogre::CULL_NONE);
  edges.setPolygonMode(Ogre::PM_WIREFRAME);
  edges.setDepthBias(lifted, lifted);
}

Vector3 at(const std::vector<float>& positions, std::uint32_t vertex) {
  return Vector3(&positions[3 * size_t{vertex}]);
}

}  // namespace

SurfaceVisual::Highlights highlightsOf(const sweep_guard::ObjectView& view, const Triangles& intended,
                                       size_t triangles) {
  SurfaceVisual::Highlights shown;
  shown[SurfaceVisual::kTouched] = below(view.touched, triangles);
  shown[SurfaceVisual::kReflex] = below(view.reflex, triangles);
  shown[SurfaceVisual::kConsidered] = below(view.considered, triangles);
  shown[SurfaceVisual::kAllowed] = below(view.allowed, triangles);
  shown[SurfaceVisual::kIntended] = below(intended, triangles);
  for (size_t layer = SurfaceVisual::kIntended; layer < shown.size(); ++layer) {
    for (size_t above = layer + 1; above < shown.size(); ++above) shown[layer] = without(shown[layer], shown[above]);
  }
  return shown;
}

SurfaceVisual::SurfaceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node) : scene_(scene), node_(node) {
  for (int layer = 0; layer < kLayers; ++layer) materials_.push_back(makeMaterial(layer));
}

SurfaceVisual::~SurfaceVisual() {
  clear();
  for (const Ogre::MaterialPtr& material : materials_) drop(material);
}

void SurfaceVisual::clear() {
  if (entity_ == nullptr) return;
  scene_.destroyEntity(entity_);
  Ogre::MeshManager::getSingleton().remove(mesh_->getHandle());
  entity_ = nullptr;
  mesh_ = {};
  buffer_ = {};
}

void SurfaceVisual::setTriangles(std::vector<shape_msgs::MeshTriangle> triangles, size_t vertices) {
  clear();
  triangles_ = std::move(triangles);
  vertices_ = vertices;
  positions_.clear();
  std::fill(std::begin(counts_), std::end(counts_), 0);
  if (!triangles_.empty() && vertices_ > 0) build();
}

void SurfaceVisual::build() {
  static int made = 0;
  mesh_ = Ogre::MeshManager::getSingleton().createManual("sweep_guard_surface_" + std::to_string(made++), kResources);
  auto* const data = new Ogre::VertexData();  // owned by the mesh
  mesh_->sharedVertexData = data;
  data->vertexCount = vertices_;
  data->vertexDeclaration->addElement(0, offsetof(Vertex, position), Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  data->vertexDeclaration->addElement(0, offsetof(Vertex, color), Ogre::VET_COLOUR_ABGR, Ogre::VES_DIFFUSE);
  buffer_ = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      sizeof(Vertex), vertices_, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  data->vertexBufferBinding->setBinding(0, buffer_);
  for (int layer = 0; layer < kLayers; ++layer) {
    Ogre::SubMesh& submesh = *mesh_->createSubMesh();
    submesh.useSharedVertices = true;
    submesh.setMaterialName(materials_[static_cast<size_t>(layer)]->getName(), kResources);
  }
  std::vector<std::uint32_t> all(triangles_.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  for (int layer = 0; layer < kLayers; ++layer) {
    setIndices(static_cast<Layer>(layer), layer == kSurface ? all : std::vector<std::uint32_t>());
  }
  mesh_->_setBounds(Ogre::AxisAlignedBox(Vector3::ZERO, Vector3::ZERO));
  mesh_->load();
  entity_ = scene_.createEntity(mesh_);
  node_.attachObject(entity_);
  updateVisibility();
}

void SurfaceVisual::setIndices(Layer layer, const std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const std::uint32_t triangle : triangles) {
    const auto& indices = triangles_[triangle].vertex_indices;
    corners.insert(corners.end(), indices.begin(), indices.end());
  }
  counts_[layer] = triangles.size();
  Ogre::IndexData& data = *mesh_->getSubMesh(static_cast<std::uint16_t>(layer))->indexData;
  data.indexCount = corners.size();
  if (data.indexBuffer.get() == nullptr || data.indexBuffer->getNumIndexes() < corners.size()) {
    data.indexBuffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
        Ogre::HardwareIndexBuffer::IT_32BIT, std::max<size_t>(3, corners.size()),
        Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  }
  if (!corners.empty()) writeTo(*data.indexBuffer, corners.data(), corners.size() * sizeof(std::uint32_t));
}

// The normals point outwards where the surface is closed, whatever its winding.
std::vector<Vector3> SurfaceVisual::normals() const {
  std::vector<Vector3> normals(vertices_, Vector3::ZERO);
  const Vector3 inside = at(positions_, 0);
  float volume = 0.0F;
  for (const shape_msgs::MeshTriangle& triangle : triangles_) {
    const auto& corners = triangle.vertex_indices;
    const Vector3 p = at(positions_, corners[0]);
    const Vector3 normal = (at(positions_, corners[1]) - p).crossProduct(at(positions_, corners[2]) - p);
    volume += normal.dotProduct(p - inside);
    for (const std::uint32_t corner : corners) normals[corner] += normal;
  }
  for (Vector3& normal : normals) normal = (volume < 0.0F ? -1.0F : 1.0F) * normal.normalisedCopy();
  return normals;
}

void SurfaceVisual::setVertices(const float* positions) {
  if (entity_ == nullptr) return;
  positions_.assign(positions, positions + 3 * vertices_);
  Ogre::AxisAlignedBox bounds;
  for (std::uint32_t i = 0; i < vertices_; ++i) bounds.merge(at(positions_, i));
  mesh_->_setBounds(bounds, false);
  node_.needUpdate();
  writeVertices();
  updateVisibility();
}

// Shades each vertex: with rviz's own light, one side of the workpiece would be dark.
void SurfaceVisual::writeVertices() {
  if (entity_ == nullptr || positions_.empty()) return;
  const std::vector<Vector3> normals = this->normals();
  std::vector<Vertex> vertices(vertices_);
  for (size_t i = 0; i < vertices_; ++i) {
    const float shade = 255.0F * (0.56F + 0.44F * normals[i].dotProduct(kLight));
    std::copy_n(&positions_[3 * i], 3, vertices[i].position);
    for (size_t c = 0; c < 3; ++c) vertices[i].color[c] = static_cast<std::uint8_t>(shade * color_[c]);
    vertices[i].color[3] = static_cast<std::uint8_t>(255.0F * color_.a);
  }
  writeTo(*buffer_, vertices.data(), vertices.size() * sizeof(Vertex));
}

void SurfaceVisual::highlight(const Highlights& highlights) {
  if (entity_ == nullptr) return;
  for (size_t layer = kIntended; layer < kLayers; ++layer) setIndices(static_cast<Layer>(layer), highlights[layer]);
  updateVisibility();
}

void SurfaceVisual::color(const HeatMap& map) {
  if (entity_ == nullptr) return;
  for (size_t i = 0; i < kHeatColors; ++i) setIndices(static_cast<Layer>(kHeat + i), map.triangles[i]);
  updateVisibility();
}

void SurfaceVisual::paintLayer(Layer layer, const Ogre::ColourValue& color, bool shown, bool edges) {
  Ogre::Technique& technique = *materials_[layer]->getTechnique(0);
  if (edges != (technique.getNumPasses() == 2)) edges ? addEdges(technique, layer) : technique.removePass(1);
  const bool dark = layer == kSurface || layer == kIntended || layer == kAllowed;
  Ogre::ColourValue line = dark ? 0.4F * color : 0.5F * (color + Ogre::ColourValue::White);
  line.a = (layer == kSurface ? 0.25F : 1.0F) * color.a;
  if (edges) paint(*technique.getPass(1), line);
  if (layer == kSurface) {
    paintByVertices(*technique.getPass(0), color.a);
    if (std::exchange(color_, color) != color) writeVertices();
  } else {
    paint(*technique.getPass(0), color);
  }
  wanted_[layer] = shown;
  updateVisibility();
}

size_t SurfaceVisual::drawnTriangles(Layer layer) const {
  return entity_ != nullptr && !positions_.empty() && wanted_[layer] ? counts_[layer] : 0;
}

void SurfaceVisual::updateVisibility() {
  if (entity_ == nullptr) return;
  for (int layer = 0; layer < kLayers; ++layer) {
    entity_->getSubEntity(static_cast<unsigned>(layer))->setVisible(drawnTriangles(static_cast<Layer>(layer)) > 0);
  }
}

}  // namespace sweep_guard_rviz
