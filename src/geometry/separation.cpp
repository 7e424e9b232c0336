#include "sweep_guard/geometry/separation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/floating_point.h"

namespace sweep_guard_core {
namespace {

constexpr int kMaxSteps = 64;
constexpr double kMinSquaredSine = 1e-8;  // squared sine below which the weights of a face lose digits
constexpr double kOverlap = 1e-12;        // of the size; the direction of points that are nearer has no digits
constexpr double kShare = 0.125;          // share of the gap beyond the margin that roughSeparation() may underestimate

// A point of the Minkowski difference, and its two points.
struct Vertex {
  Eigen::Vector3d w;
  Eigen::Vector3d on_tool;
  Eigen::Vector3d on_obstacle;
};

// The point of a simplex closest to the origin, as a convex combination of vertices. That of an empty simplex is
// infinitely far.
struct Closest {
  std::array<int, 4> vertices = {};
  std::array<double, 4> weights = {};
  int size = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double squared_distance = kInfinity;
};

class Simplex {
 public:
  int size() const { return size_; }
  const Vertex& operator[](int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  bool has(const Eigen::Vector3d& w, double tolerance) const {
    return std::any_of(vertices_.begin(), vertices_.begin() + size_,
                       [&](const Vertex& v) { return (v.w - w).squaredNorm() <= tolerance * tolerance; });
  }
  void add(const Vertex& vertex) { vertices_[static_cast<std::size_t>(size_++)] = vertex; }
  void removeLast() { --size_; }

  Closest closest() const;
  void keep(const Closest& closest);

 private:
  const Eigen::Vector3d& w(int i) const { return (*this)[i].w; }
  Closest onVertex(int i) const;
  Closest onEdge(int i, int j) const;
  Closest onFace(int i, int j, int k) const;
  Closest inTetrahedron() const;

  std::array<Vertex, 4> vertices_;
  int size_ = 0;
};

void replaceIfNearer(Closest& best, const Closest& other) {
  if (other.squared_distance < best.squared_distance) best = other;
}

Closest Simplex::onVertex(int i) const { return {{i}, {1.0}, 1, w(i), w(i).squaredNorm()}; }

Closest Simplex::onEdge(int i, int j) const {
  const Eigen::Vector3d edge = w(j) - w(i);
  const double along = -edge.dot(w(i));
  const double length = edge.squaredNorm();
  if (along <= 0.0) return onVertex(i);
  if (along >= length) return onVertex(j);
  const double t = along / length;
  const Eigen::Vector3d point = (1.0 - t) * w(i) + t * w(j);
  return {{i, j}, {1.0 - t, t}, 2, point, point.squaredNorm()};
}

Closest Simplex::onFace(int i, int j, int k) const {
  const Eigen::Vector3d ij = w(j) - w(i);
  const Eigen::Vector3d ik = w(k) - w(i);
  const Eigen::Vector3d normal = ij.cross(ik);
  const double a = normal.dot(w(j).cross(w(k)));
  const double b = normal.dot(w(k).cross(w(i)));
  const double c = normal.dot(w(i).cross(w(j)));
  const bool needle = normal.squaredNorm() < kMinSquaredSine * ij.squaredNorm() * ik.squaredNorm();
  Closest best;
  if (a > 0.0 && b > 0.0 && c > 0.0) {
    const double sum = a + b + c;
    const Eigen::Vector3d point = (a / sum) * w(i) + (b / sum) * w(j) + (c / sum) * w(k);
    best = {{i, j, k}, {a / sum, b / sum, c / sum}, 3, point, point.squaredNorm()};
  }
  if (needle || a <= 0.0) replaceIfNearer(best, onEdge(j, k));
  if (needle || b <= 0.0) replaceIfNearer(best, onEdge(k, i));
  if (needle || c <= 0.0) replaceIfNearer(best, onEdge(i, j));
  return best;
}

// The origin lies beyond a face if the signed volumes of that face and of the whole differ in sign. A volume within its
// rounding error counts as beyond.
Closest Simplex::inTetrahedron() const {
  constexpr std::array<std::array<int, 4>, 4> kFaces = {{{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}}};
  const double whole = (w(1) - w(0)).dot((w(2) - w(0)).cross(w(3) - w(0)));
  std::array<double, 4> volumes;
  Closest best;
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Eigen::Vector3d ij = w(j) - w(i);
    const Eigen::Vector3d ik = w(k) - w(i);
    const double volume = (whole < 0.0 ? -1.0 : 1.0) * w(i).dot(ij.cross(ik));
    const double doubt = 8.0 * kEpsilon * std::sqrt(w(i).squaredNorm() * ij.squaredNorm() * ik.squaredNorm());
    volumes[static_cast<std::size_t>(opposite)] = volume;
    if (volume <= doubt) replaceIfNearer(best, onFace(i, j, k));
  }
  if (best.size > 0) return best;
  const double sum = volumes[0] + volumes[1] + volumes[2] + volumes[3];
  best = {{0, 1, 2, 3}, volumes, 4, Eigen::Vector3d::Zero(), 0.0};
  for (double& weight : best.weights) weight /= sum;
  return best;
}

Closest Simplex::closest() const {
  switch (size_) {
    case 1:
      return onVertex(0);
    case 2:
      return onEdge(0, 1);
    case 3:
      return onFace(0, 1, 2);
    default:
      return inTetrahedron();
  }
}

void Simplex::keep(const Closest& closest) {
  std::array<Vertex, 4> kept;
  size_ = closest.size;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size_); ++i) {
    kept[i] = vertices_[static_cast<std::size_t>(closest.vertices[i])];
  }
  std::copy_n(kept.begin(), size_, vertices_.begin());
}

// Returns the direction from the origin to the closest point. It is orthogonal to the simplex except for rounding,
// which is removed.
Eigen::Vector3d outwards(const Simplex& simplex, const Eigen::Vector3d& point) {
  Eigen::Vector3d normal = point.normalized();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (int i = 1; i < std::min(simplex.size(), 3); ++i) {
    Eigen::Vector3d edge = simplex[i].w - simplex[0].w;
    if (i == 2) edge -= first * first.dot(edge);
    const double length = edge.norm();
    if (length == 0.0) continue;
    edge /= length;
    normal -= edge * edge.dot(normal);
    first = edge;
  }
  return normal.normalized();
}

class Search {
 public:
  Search(const SupportMapping& tool, const SupportMapping& obstacle) : tool_(tool), obstacle_(obstacle) {}

  // The conditions for the end of the search:
  double accuracy = 0.0;         // the gap differs from the distance by no more [m]
  double margin = kInfinity;     // or by no more than kShare of what the gap exceeds this by [m]
  double gap_above = kInfinity;  // the gap is larger [m]
  double distance_within = 0.0;  // the distance is not larger [m]

  Separation run(const Eigen::Vector3d& guess, const PointPairs& start = {}) {
    const double length = guess.norm();
    Eigen::Vector3d direction = length > 0.0 ? Eigen::Vector3d(guess / length) : Eigen::Vector3d::UnitZ();
    if (beginFrom(start)) direction = outwards(simplex_, closest_.point);
    for (int step = 0; step < kMaxSteps && advance(direction); ++step) direction = outwards(simplex_, closest_.point);
    for (int i = 0; i < simplex_.size(); ++i) {
      const double weight = closest_.weights[static_cast<std::size_t>(i)];
      best_.on_tool += weight * simplex_[i].on_tool;
      best_.on_obstacle += weight * simplex_[i].on_obstacle;
      best_.simplex.push_back({simplex_[i].on_tool, simplex_[i].on_obstacle});
    }
    return best_;
  }

 private:
  // Returns false if the points are of no use: there are none, or they overlap.
  bool beginFrom(const PointPairs& start) {
    for (const auto& [on_tool, on_obstacle] : start) {
      simplex_.add({on_tool - on_obstacle, on_tool, on_obstacle});
      size_ = std::max(size_, simplex_[simplex_.size() - 1].w.norm());
    }
    if (start.empty()) return false;
    closest_ = simplex_.closest();
    simplex_.keep(closest_);
    if (std::sqrt(closest_.squared_distance) > kOverlap * size_) return true;
    simplex_ = {};
    closest_ = {};
    return false;
  }

  // Returns false at the end of the search.
  bool advance(const Eigen::Vector3d& direction) {
    Vertex vertex{{}, tool_.supportPoint(-direction), obstacle_.supportPoint(direction)};
    vertex.w = vertex.on_tool - vertex.on_obstacle;
    size_ = std::max(size_, vertex.w.norm());
    const double gap = direction.dot(vertex.w);
    if (gap > best_.gap) {
      best_.gap = gap;
      best_.normal = direction;
    }
    if (simplex_.size() == 0) return approach(vertex) && best_.gap <= gap_above;
    const double distance = std::sqrt(closest_.squared_distance);
    const double left = distance - best_.gap;
    if (best_.gap > gap_above || left <= std::max(kEpsilon * size_, accuracy)) return false;
    if (left <= kShare * (best_.gap - margin)) return false;
    return !simplex_.has(vertex.w, 2.0 * kEpsilon * size_) && approach(vertex);
  }

  // Returns false if the vertex brings the simplex no closer to the origin, or close enough.
  bool approach(const Vertex& vertex) {
    simplex_.add(vertex);
    const Closest closest = simplex_.closest();
    if (!(closest.squared_distance < closest_.squared_distance)) {
      simplex_.removeLast();
      return false;
    }
    simplex_.keep(closest);
    closest_ = closest;
    return std::sqrt(closest_.squared_distance) > std::max(4.0 * kEpsilon * size_, distance_within);
  }

  const SupportMapping& tool_;
  const SupportMapping& obstacle_;
  double size_ = 0.0;  // known size of the Minkowski difference [m]
  Simplex simplex_;
  Closest closest_;
  Separation best_ = {Eigen::Vector3d::UnitZ(), -kInfinity, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), {}};
};

}  // namespace

Eigen::Vector3d PointHull::supportPoint(const Eigen::Vector3d& direction) const {
  assert(count_ > 0);
  std::size_t farthest = 0;
  double reach = direction.dot(points_[0]);
  for (std::size_t i = 1; i < count_; ++i) {
    const double along = direction.dot(points_[i]);
    if (along > reach) {
      reach = along;
      farthest = i;
    }
  }
  return points_[farthest];
}

Separation separation(const SupportMapping& tool, const SupportMapping& obstacle, double accuracy,
                      const Eigen::Vector3d& guess, const PointPairs& start) {
  Search search(tool, obstacle);
  search.accuracy = accuracy;
  return search.run(guess, start);
}

Separation roughSeparation(const SupportMapping& tool, const SupportMapping& obstacle, double margin, double accuracy,
                           const Eigen::Vector3d& guess, const PointPairs& start) {
  Search search(tool, obstacle);
  search.accuracy = accuracy;
  search.margin = margin;
  return search.run(guess, start);
}

bool distanceExceeds(const SupportMapping& tool, const SupportMapping& obstacle, double distance,
                     const Eigen::Vector3d& guess) {
  Search search(tool, obstacle);
  search.gap_above = distance;
  search.distance_within = distance;
  return search.run(guess).gap > distance;
}

}  // namespace sweep_guard_core
