#include "sweep_guard/geometry/decomposition.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/convex_hull.h"
#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {
namespace {

using Set = std::vector<std::uint32_t>;  // of triangles
using Halves = std::pair<Set, Set>;

void check(const DecompositionOptions& options) {
  if (options.max_depth < 0 || options.max_depth > 16) throw InvalidInput("decomposition: max_depth must be 0 to 16");
  if (!(options.step >= 0.0 && options.step <= kMaxCoordinate)) {
    throw InvalidInput("decomposition: step must be finite and >= 0 m");
  }
  if (!(options.least_saving >= 0.0 && options.least_saving <= 1.0)) {
    throw InvalidInput("decomposition: least_saving must be in [0, 1]");
  }
}

std::vector<Eigen::Vector3d> cornersOf(const TriangleMesh& mesh, const Set& set) {
  Set vertices;
  for (const std::uint32_t i : set) {
    const Triangle& triangle = mesh.triangles()[i];
    vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t vertex : vertices) corners.push_back(mesh.vertex(vertex));
  return corners;
}

// Returns the corners of the triangles as columns, each once per triangle.
Eigen::Matrix3Xd usesOf(const TriangleMesh& mesh, const Set& set) {
  Eigen::Matrix3Xd uses(3, 3 * set.size());
  Eigen::Index column = 0;
  for (const std::uint32_t i : set) {
    for (const std::uint32_t vertex : mesh.triangles()[i]) uses.col(column++) = mesh.offset(vertex);
  }
  return uses;
}

// Returns the normal of a triangle with its area as length [m^2].
Eigen::Vector3d areaNormal(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles()[triangle];
  return 0.5 * (mesh.offset(b) - mesh.offset(a)).cross(mesh.offset(c) - mesh.offset(a));
}

Eigen::Vector3d centroid(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles()[triangle];
  return (mesh.offset(a) + mesh.offset(b) + mesh.offset(c)) / 3.0;
}

// Returns the principal axes, sorted by descending extent.
std::array<Eigen::Vector3d, 3> axesOf(const Eigen::Matrix3Xd& about_mean) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(about_mean * about_mean.transpose());
  std::array<Eigen::Vector3d, 3> axes = {moments.eigenvectors().col(2), moments.eigenvectors().col(1),
                                         moments.eigenvectors().col(0)};
  const auto side = [&](const Eigen::Vector3d& axis) {
    const Eigen::RowVectorXd along = axis.transpose() * about_mean;
    return along.maxCoeff() - along.minCoeff();
  };
  std::stable_sort(axes.begin(), axes.end(), [&](const auto& a, const auto& b) { return side(a) > side(b); });
  return axes;
}

std::optional<Halves> cut(const TriangleMesh& mesh, const Set& set) {
  const Eigen::Matrix3Xd uses = usesOf(mesh, set);
  const Eigen::Vector3d mean = uses.rowwise().mean();
  for (const Eigen::Vector3d& axis : axesOf(uses.colwise() - mean)) {
    Halves halves;
    for (const std::uint32_t i : set) {
      (axis.dot(centroid(mesh, i) - mean) < 0.0 ? halves.first : halves.second).push_back(i);
    }
    if (!halves.first.empty() && !halves.second.empty()) return halves;
  }
  return std::nullopt;
}

std::vector<HalfSpace> facesOf(const ConvexHull& hull, const Eigen::Vector3d& origin) {
  std::vector<HalfSpace> faces;
  for (const auto& [a, b, c] : hull.triangles) {
    const Eigen::Vector3d& corner = hull.corners[a];
    const Eigen::Vector3d normal = (hull.corners[b] - corner).cross(hull.corners[c] - corner).normalized();
    if (normal.squaredNorm() > 0.5) faces.emplace_back(normal, normal.dot(corner - origin));
  }
  return faces;
}

// Returns the shorter distance from a point inside of the faces, along a line with a unit direction, to the faces.
double depth(const std::vector<HalfSpace>& faces, const Eigen::Vector3d& p, const Eigen::Vector3d& direction) {
  double ahead = std::numeric_limits<double>::infinity();
  double behind = std::numeric_limits<double>::infinity();
  for (const HalfSpace& face : faces) {
    const double below = std::max(0.0, -face.signedDistance(p));
    const double slope = face.normal().dot(direction);
    if (slope > 0.0) ahead = std::min(ahead, below / slope);
    if (slope < 0.0) behind = std::min(behind, below / -slope);
  }
  return std::min(ahead, behind);
}

// Estimates the space between the triangles and the surface of their hull [m^3].
double spaceBetween(const TriangleMesh& mesh, const Set& set, const ConvexHull& hull) {
  if (!hull.solid) return 0.0;
  const std::vector<HalfSpace> faces = facesOf(hull, mesh.origin());
  double space = 0.0;
  for (const std::uint32_t i : set) {
    const Eigen::Vector3d normal = areaNormal(mesh, i);
    const double area = normal.norm();
    if (area > 0.0) space += area * depth(faces, centroid(mesh, i), normal / area);
  }
  return space;
}

bool lexicographicallyLess(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Returns for each vertex the first one at the same place: files often have one vertex per triangle and corner.
Set placesOf(const TriangleMesh& mesh) {
  Set order(mesh.vertexCount());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return lexicographicallyLess(mesh.offset(a), mesh.offset(b)); });
  Set places(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && mesh.offset(order[i]) == mesh.offset(order[i - 1]);
    places[order[i]] = same ? places[order[i - 1]] : order[i];
  }
  return places;
}

// Returns the components that are connected by vertices, ordered by their first triangle.
std::vector<Set> componentsOf(const TriangleMesh& mesh) {
  Set root = placesOf(mesh);
  const auto rootOf = [&root](std::uint32_t vertex) {
    while (root[vertex] != vertex) vertex = root[vertex] = root[root[vertex]];
    return vertex;
  };
  for (const auto& [a, b, c] : mesh.triangles()) {
    root[rootOf(b)] = rootOf(a);
    root[rootOf(c)] = rootOf(a);
  }
  std::map<std::uint32_t, Set> by_root;
  for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) by_root[rootOf(mesh.triangles()[i][0])].push_back(i);
  std::vector<Set> components;
  components.reserve(by_root.size());
  for (auto& [vertex, component] : by_root) components.push_back(std::move(component));
  return components;
}

struct Cover {
  std::vector<Set> sets;
  double swept = 0.0;   // volume that the hulls cover in a step [m^3]
  double wasted = 0.0;  // part of it that the mesh does not need [m^3]
};

int levelsFor(size_t count) {
  int levels = 0;
  while (count > size_t{1} << static_cast<unsigned>(levels)) ++levels;
  return levels;
}

Cover joined(Cover a, Cover b) {
  std::move(b.sets.begin(), b.sets.end(), std::back_inserter(a.sets));
  return {std::move(a.sets), a.swept + b.swept, a.wasted + b.wasted};
}

class Decomposition {
 public:
  Decomposition(const TriangleMesh& mesh, const DecompositionOptions& options) : mesh_(mesh), step_(options.step) {
    Set all(mesh.triangles().size());
    std::iota(all.begin(), all.end(), 0U);
    price_per_piece_ = options.least_saving * whole(all).swept;
    cover_ = bestCover(all, options.max_depth);
    const std::vector<Set> components = componentsOf(mesh);
    const int depth = options.max_depth - levelsFor(components.size());
    if (depth < 0 || components.size() == 1) return;
    Cover separate;
    for (const Set& component : components) separate = joined(std::move(separate), bestCover(component, depth));
    if (pays(separate, cover_)) cover_ = std::move(separate);
  }

  std::vector<Set> sets() && { return std::move(cover_.sets); }

 private:
  Cover whole(const Set& set) const {
    const ConvexHull hull = convexHull(cornersOf(mesh_, set));
    const double shadow = 0.25 * surface(hull);
    return {{set}, volume(hull) + shadow * step_, spaceBetween(mesh_, set, hull) + shadow * step_};
  }

  Cover bestCover(const Set& set, int depth) const {
    Cover undivided = whole(set);
    if (depth == 0 || undivided.wasted <= price_per_piece_) return undivided;
    std::optional<Halves> halves = cut(mesh_, set);
    if (!halves) return undivided;
    Cover divided = joined(bestCover(halves->first, depth - 1), bestCover(halves->second, depth - 1));
    return pays(divided, undivided) ? divided : undivided;
  }

  bool pays(const Cover& divided, const Cover& undivided) const {
    const double more = static_cast<double>(divided.sets.size()) - static_cast<double>(undivided.sets.size());
    const double price = price_per_piece_ * more;
    return divided.swept + price < undivided.swept && divided.wasted + price < undivided.wasted;
  }

  const TriangleMesh& mesh_;
  double step_;
  double price_per_piece_ = 0.0;
  Cover cover_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> decompose(const TriangleMesh& mesh, const DecompositionOptions& options) {
  check(options);
  return Decomposition(mesh, options).sets();
}

std::vector<ConvexShape> convexPieces(const TriangleMesh& mesh_T, const DecompositionOptions& options) {
  std::vector<ConvexShape> pieces;
  for (const Set& set : decompose(mesh_T, options)) {
    pieces.push_back(ConvexShape::hull(cornersOf(mesh_T, set)).padded(mesh_T.rounding()));
  }
  return pieces;
}

}  // namespace sweep_guard_core
