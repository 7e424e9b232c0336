#include <cassert>
#include <cstddef>

#include "peers/polytope.h"

namespace sweep_guard_benchmark {
namespace {

constexpr std::size_t kMostCorners = 32;  // each plane adds at most one to the triangle's three

struct Corners {
  std::array<Point, kMostCorners> points;
  std::size_t count = 0;
};

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point between(const Point& p, const Point& q, double t) {
  return {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
}

// False if nothing is cut off: `inside` is not touched then.
bool cut(const Corners& polygon, const Polytope::Plane& plane, double grown, Corners& inside) {
  std::array<double, kMostCorners> distances;
  bool beyond = false;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    distances[i] = dot(plane.normal_M, polygon.points[i]) - plane.offset - grown;
    beyond |= distances[i] > 0.0;
  }
  if (!beyond) return false;
  inside.count = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const std::size_t next = i + 1 == polygon.count ? 0 : i + 1;
    if (distances[i] <= 0.0) inside.points[inside.count++] = polygon.points[i];
    if ((distances[i] < 0.0 && distances[next] > 0.0) || (distances[i] > 0.0 && distances[next] < 0.0)) {
      const double t = distances[i] / (distances[i] - distances[next]);
      inside.points[inside.count++] = between(polygon.points[i], polygon.points[next], t);
    }
  }
  return true;
}

}  // namespace

bool meets(const Polytope& polytope_M, const float* a_M, const float* b_M, const float* c_M, double grown) {
  assert(polytope_M.planes_M.size() + 3 <= kMostCorners);
  std::array<Corners, 2> polygons;
  std::size_t current = 0;
  for (const float* corner : {a_M, b_M, c_M}) {
    polygons[0].points[polygons[0].count++] = {corner[0], corner[1], corner[2]};
  }
  for (const Polytope::Plane& plane : polytope_M.planes_M) {
    if (cut(polygons[current], plane, grown, polygons[1 - current])) current = 1 - current;
    if (polygons[current].count == 0) return false;
  }
  return true;
}

}  // namespace sweep_guard_benchmark
