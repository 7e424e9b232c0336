#pragma once

#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "scenes.h"

namespace sweep_guard_core {

/// An order of the vertices and triangles of a mesh.
struct MeshOrdering {
  std::string name;
  bool vertices_shuffled;
  bool triangles_shuffled;

  /// Returns the mesh in this order.
  TriangleMesh of(const TriangleMesh& mesh) const {
    Random random(/*seed=*/7);
    const std::vector<std::uint32_t> places = indices(mesh.vertexCount(), vertices_shuffled, random);
    const std::vector<std::uint32_t> order = indices(mesh.triangles().size(), triangles_shuffled, random);
    std::vector<Eigen::Vector3d> vertices(places.size());
    for (size_t i = 0; i < places.size(); ++i) vertices[places[i]] = mesh.vertex(i);
    std::vector<Triangle> triangles;
    for (const std::uint32_t i : order) {
      const auto& [a, b, c] = mesh.triangles()[i];
      triangles.push_back({places[a], places[b], places[c]});
    }
    return {vertices, std::move(triangles)};
  }

 private:
  static std::vector<std::uint32_t> indices(size_t count, bool shuffled, Random& random) {
    if (shuffled) return random.permutation(count);
    std::vector<std::uint32_t> in_order(count);
    std::iota(in_order.begin(), in_order.end(), 0U);
    return in_order;
  }
};

inline std::ostream& operator<<(std::ostream& stream, const MeshOrdering& ordering) { return stream << ordering.name; }

inline std::vector<MeshOrdering> meshOrderings() {
  return {{"as_made", false, false},
          {"vertices_shuffled", true, false},
          {"triangles_shuffled", false, true},
          {"all_shuffled", true, true}};
}

}  // namespace sweep_guard_core
