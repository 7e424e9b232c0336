#include <cassert>
#include <cstddef>
#include <cstdint>

#include "peers/polytope.h"

namespace sweep_guard_benchmark {
namespace {

constexpr std::size_t kMaxCorners = 32;  // each plane adds at most one to the triangle's three

struct Corners {
  std::array<Point, kMaxCorners> points;
  std::size_t count = 0;
};

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point between(const Point& p, const Point& q, double t) {
  return {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
}

// The planes that a point lies beyond, one bit for each.
std::uint32_t planesBeyond(const Polytope& polytope_M, const Point& p_M, double grown) {
  std::uint32_t beyond = 0;
  std::uint32_t bit = 1;
  for (const Polytope::Plane& plane : polytope_M.planes_M) {
    if (dot(plane.normal_M, p_M) - plane.offset - grown > 0.0) beyond |= bit;
    bit <<= 1U;
  }
  return beyond;
}

// Returns false if nothing is cut off, and then leaves `inside` as it is.
bool cut(const Corners& polygon, const Polytope::Plane& plane, double grown, Corners& inside) {
  std::array<double, kMaxCorners> distances;
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
  assert(polytope_M.planes_M.size() + 3 <= kMaxCorners);
  std::array<Corners, 2> polygons;
  std::size_t current = 0;
  std::uint32_t beyond_all = ~std::uint32_t{0};
  std::uint32_t beyond_any = 0;
  for (const float* corner : {a_M, b_M, c_M}) {
    const Point& p_M = polygons[0].points[polygons[0].count++] = {corner[0], corner[1], corner[2]};
    const std::uint32_t beyond = planesBeyond(polytope_M, p_M, grown);
    if (beyond == 0) return true;
    beyond_all &= beyond;
    beyond_any |= beyond;
  }
  if (beyond_all != 0) return false;
  for (std::size_t i = 0; i < polytope_M.planes_M.size(); ++i) {
    if ((beyond_any >> i & 1U) == 0) continue;
    const Polytope::Plane& plane = polytope_M.planes_M[i];
    if (cut(polygons[current], plane, grown, polygons[1 - current])) current = 1 - current;
    if (polygons[current].count == 0) return false;
  }
  return true;
}

}  // namespace sweep_guard_benchmark
