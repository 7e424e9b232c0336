#include "scene/primitives.h"

#include <cmath>
#include <string>

#include "common/number_text.h"
#include "geometry/shape_surface.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr std::uint32_t kSegments = 32;   // of a circle; even
constexpr double kMaxDimension = 1000.0;  // [m]

// Ratio of the radii around and inside a regular polygon.
double circumscription() { return 1.0 / std::cos(kPi / kSegments); }

void checkDimension(const std::string& name, double length) {
  if (length > 0.0 && length <= kMaxDimension) return;
  throw InvalidInput(name + " is " + shortText(length) + " m: must be above 0 and at most 1000 m");
}

struct ProfilePoint {
  double radius, z;
};

// Turns a profile, which begins at `bottom` and ends at `top` on the axis, around the axis.
TriangleSurface revolved(double bottom, const std::vector<ProfilePoint>& profile, double top) {
  TriangleSurface surface{{{0.0, 0.0, bottom}, {0.0, 0.0, top}}, {}};
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const double angle = 2.0 * kPi * i / kSegments;
    const Eigen::Vector2d outward = circumscription() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    for (const auto& [radius, z] : profile)
      surface.vertices.emplace_back(radius * outward.x(), radius * outward.y(), z);
  }
  const auto count = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const std::uint32_t a = 2 + i * count;
    const std::uint32_t b = 2 + (i + 1) % kSegments * count;
    surface.triangles.push_back({0, b, a});
    for (std::uint32_t k = 0; k + 1 < count; ++k) {
      surface.triangles.push_back({a + k, b + k, b + k + 1});
      surface.triangles.push_back({a + k, b + k + 1, a + k + 1});
    }
    surface.triangles.push_back({a + count - 1, b + count - 1, 1});
  }
  return surface;
}

}  // namespace

TriangleSurface boxPrimitive(const Eigen::Vector3d& size) {
  for (const int axis : {0, 1, 2}) checkDimension(std::string("size ") + "xyz"[axis], size[axis]);
  return boxSurface(0.5 * size);
}

TriangleSurface cylinderPrimitive(double radius, double height) {
  checkDimension("radius", radius);
  checkDimension("height", height);
  return revolved(-0.5 * height, {{radius, -0.5 * height}, {radius, 0.5 * height}}, 0.5 * height);
}

TriangleSurface conePrimitive(double radius, double height) {
  checkDimension("radius", radius);
  checkDimension("height", height);
  return revolved(-0.5 * height, {{radius, -0.5 * height}}, 0.5 * height);
}

TriangleSurface spherePrimitive(double radius) {
  checkDimension("radius", radius);
  const double outer = circumscription() * radius;
  std::vector<ProfilePoint> profile;
  for (std::uint32_t i = 1; i < kSegments / 2; ++i) {
    const double polar = 2.0 * kPi * i / kSegments;
    profile.push_back({outer * std::sin(polar), -outer * std::cos(polar)});
  }
  return revolved(-outer, profile, outer);
}

TriangleSurface floorPrimitive() {
  TriangleSurface surface = boxPrimitive({20.0, 20.0, 1.0});
  for (Eigen::Vector3d& vertex : surface.vertices) vertex.z() -= 0.5;
  return surface;
}

}  // namespace sweep_guard_core
