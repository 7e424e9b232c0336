#pragma once

#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "scenes.h"

namespace sweep_guard_core {

/// One of the orders in which the same mesh may come.
struct MeshOrdering {
  std::string name;
  bool vertices_shuffled;
  bool triangles_shuffled;

  TriangleMesh of(const TriangleMesh& mesh) const {
    Random random(/*seed=*/7);
    const std::vector<std::uint32_t> places = permutation(mesh.vertexCount(), vertices_shuffled, random);
    const std::vector<std::uint32_t> order = permutation(mesh.triangles().size(), triangles_shuffled, random);
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
  static std::vector<std::uint32_t> permutation(size_t count, bool shuffled, Random& random) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (size_t i = count; shuffled && i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<size_t>(random.below(static_cast<int>(i)))]);
    }
    return order;
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
