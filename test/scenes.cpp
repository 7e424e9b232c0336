#include "scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {
namespace {

constexpr double kTiny = 1e-6;  // of the volume's size: too small to have a useful direction

using Corners = std::array<Eigen::Vector3d, 3>;

TriangleMesh separateTriangles(const std::vector<Corners>& triangles_M) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (const Corners& corners : triangles_M) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    triangles.push_back({first, first + 1, first + 2});
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  return TriangleMesh(vertices, std::move(triangles));
}

TriangleMesh asStreamed(const TriangleMesh& mesh) { return deformed(mesh, streamedPositions(mesh)); }

Eigen::Vector3d randomPlace(Random& random) {
  const double distance = random.chance(0.3) ? 0.0 : random.logUniform(1e-3, 1e6);
  return distance * random.direction();
}

// Largest triangle, in sizes of the volume, that stays within the bounds of a mesh.
double largestIn(double size) { return std::min(1e4, 1e6 / size); }

VolumeKind randomKind(Random& random) { return random.chance(0.3) ? VolumeKind::kObb : VolumeKind::kObbPlanes; }

Corners randomTriangle_B(Random& random, const Eigen::Vector3d& half, double spread) {
  const double size = half.norm();
  const Eigen::Vector3d near = random.inBox(spread * half);
  const double side = size * random.logUniform(1e-3, 3.0);
  Corners corners = {near, near + side * random.direction(), near + side * random.direction()};
  switch (random.below(8)) {
    case 0:  // sliver
      corners[2] = 0.5 * (corners[0] + corners[1]) + 1e-9 * side * random.direction();
      break;
    case 1:  // needle
      corners[2] = corners[1];
      break;
    case 2:  // point
      corners[1] = corners[2] = corners[0];
      break;
    case 3:  // huge
      for (Eigen::Vector3d& p : corners)
        p = near + size * random.logUniform(10.0, largestIn(size)) * random.direction();
      break;
    case 4: {  // in the plane of a face
      const int axis = random.below(3);
      for (Eigen::Vector3d& p : corners) p[axis] = half[axis];
      break;
    }
    default:
      break;
  }
  return corners;
}

std::vector<Eigen::Vector3d> cornersOf(const std::vector<Polygon>& faces) {
  std::vector<Eigen::Vector3d> corners;
  for (const Polygon& face : faces) corners.insert(corners.end(), face.begin(), face.end());
  return corners;
}

Eigen::Vector3d farthest(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& direction) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const auto& a, const auto& b) { return direction.dot(a) < direction.dot(b); });
}

Eigen::Vector3d twiceArea(const Polygon& face) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (size_t i = 2; i < face.size(); ++i) area += (face[i - 1] - face[0]).cross(face[i] - face[0]);
  return area;
}

Eigen::Vector3d faceNormal(const Polygon& face) { return twiceArea(face).normalized(); }

std::vector<Polygon> largeFaces(const SweptVolume& volume) {
  const double size = volume.box.half_extents.norm();
  std::vector<Polygon> faces = polytopeFaces(volume.halfSpaces_B(), size);
  const auto tiny = [&](const Polygon& face) { return twiceArea(face).norm() < kTiny * size * size; };
  faces.erase(std::remove_if(faces.begin(), faces.end(), tiny), faces.end());
  return faces;
}

// A random point between two points.
Eigen::Vector3d between(Random& random, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a + random.uniform(0.0, 1.0) * (b - a);
}

// A triangle that touches a convex volume, on the other side of a plane that touches the volume too. In B.
struct Touch {
  enum class Kind { kCornerOnFace, kEdgeOnEdge, kFaceOnCorner };
  Kind kind;
  Corners corners;
  Eigen::Vector3d normal;  // of the plane, outward
  Eigen::Vector3d edge;    // of the volume, for kEdgeOnEdge
};

Eigen::Vector3d across(Random& random, const Eigen::Vector3d& normal) {
  return normal.cross(random.direction()).normalized();
}

// A direction out of the plane, or in the plane: then an edge or the whole triangle lies in it.
Eigen::Vector3d outOf(Random& random, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along = across(random, normal);
  return random.chance(0.3) ? along : (along + random.logUniform(1e-6, 10.0) * normal).normalized();
}

Touch cornerOnFace(Random& random, const std::vector<Polygon>& faces, double side) {
  const Polygon& face = faces[static_cast<size_t>(random.below(static_cast<int>(faces.size())))];
  const Eigen::Vector3d normal = faceNormal(face);
  const Eigen::Vector3d p = between(random, face[0], between(random, face[1], face[2]));
  return {
      Touch::Kind::kCornerOnFace, {p, p + side * outOf(random, normal), p + side * outOf(random, normal)}, normal, {}};
}

Touch edgeOnEdge(Random& random, const std::vector<Polygon>& faces, double side, double size) {
  const Polygon& face = faces[static_cast<size_t>(random.below(static_cast<int>(faces.size())))];
  size_t first = 0;
  size_t second = 0;
  do {
    first = static_cast<size_t>(random.below(static_cast<int>(face.size())));
    second = (first + 1) % face.size();
  } while ((face[second] - face[first]).norm() < kTiny * size);
  const Eigen::Vector3d& a = face[first];
  const Eigen::Vector3d edge = (face[second] - a).normalized();
  const Eigen::Vector3d face_normal = faceNormal(face);
  const Eigen::Vector3d into_face = face_normal.cross(edge);
  // A plane that leans less than the neighboring face touches only the edge.
  double lean = M_PI;
  for (const Eigen::Vector3d& p : cornersOf(faces)) {
    const double depth = -face_normal.dot(p - a);
    if (depth > kTiny * size) lean = std::min(lean, std::atan2(depth, -into_face.dot(p - a)));
  }
  const double angle = random.uniform(0.1, 0.9) * lean;
  const Eigen::Vector3d normal = std::cos(angle) * face_normal - std::sin(angle) * into_face;
  const Eigen::Vector3d along = across(random, normal);
  const Eigen::Vector3d from = between(random, a, face[second]) - random.uniform(0.1, 0.9) * side * along;
  return {Touch::Kind::kEdgeOnEdge, {from, from + side * along, from + side * outOf(random, normal)}, normal, edge};
}

Touch faceOnCorner(Random& random, const std::vector<Polygon>& faces, double side) {
  const Eigen::Vector3d normal = random.direction();
  const Eigen::Vector3d corner = farthest(cornersOf(faces), normal);
  const Eigen::Vector3d u = side * across(random, normal);
  const Eigen::Vector3d v = normal.cross(u);
  return {
      Touch::Kind::kFaceOnCorner,
      {corner + u, corner - 0.5 * u + random.uniform(0.4, 2.0) * v, corner - 0.5 * u - random.uniform(0.4, 2.0) * v},
      normal,
      {}};
}

Touch randomTouch(Random& random, const std::vector<Polygon>& faces, double size) {
  const double side = size * random.logUniform(1e-3, random.chance(0.1) ? largestIn(size) : 10.0);
  switch (random.below(3)) {
    case 0:
      return cornerOnFace(random, faces, side);
    case 1:
      return edgeOnEdge(random, faces, side, size);
    default:
      return faceOnCorner(random, faces, side);
  }
}

// Distance of triangle and volume in sizes of the volume; negative: depth.
double randomGap(Random& random) {
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  constexpr std::array<double, 4> kRoundings = {0.0, 1.0, 2.0, 8.0};
  if (random.chance(0.4)) return sign * kRoundings[static_cast<size_t>(random.below(4))] * 0x1p-53;
  return sign * random.logUniform(1e-10, 1e-2);
}

// The normal of the plane between volume and triangle after the corners were rounded to float32.
Eigen::Vector3d separatingNormal(const Touch& touch, const Corners& corners) {
  Eigen::Vector3d normal = touch.normal;
  if (touch.kind == Touch::Kind::kFaceOnCorner) normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (touch.kind == Touch::Kind::kEdgeOnEdge) normal = touch.edge.cross(corners[1] - corners[0]);
  if (normal.norm() == 0.0) return touch.normal;
  return (normal.dot(touch.normal) < 0.0 ? -normal : normal).normalized();
}

// An axis-aligned box of dyadic numbers: positions on its faces are equal in float32 and in double.
SweptVolume alignedVolume(Random& random) {
  SweptVolume volume;
  for (int i = 0; i < 3; ++i) volume.box.X_MB.translation()[i] = random.below(2049) - 1024;
  for (int i = 0; i < 3; ++i) volume.box.half_extents[i] = (1 + random.below(64)) / 64.0;
  std::sort(volume.box.half_extents.data(), volume.box.half_extents.data() + 3);
  return volume;
}

Scene alignedGrazingScene(Random& random) {
  SweptVolume volume = alignedVolume(random);
  std::vector<Corners> triangles;
  for (int count = 1 + random.below(20); count > 0; --count) {
    const int axis = random.below(3);
    const double sign = random.chance(0.5) ? 1.0 : -1.0;
    constexpr double kStep = 0x1p-12;
    const double gap = kStep * (random.below(5) - 2);
    Corners corners;
    for (Eigen::Vector3d& p : corners) {
      p = random.inBox(volume.box.half_extents);
      for (int i = 0; i < 3; ++i) p[i] = kStep * std::round(p[i] / kStep);
      p[axis] = sign * (volume.box.half_extents[axis] + gap + (random.chance(0.5) ? 0.5 : 0.0));
      p = volume.box.X_MB * p;
    }
    triangles.push_back(corners);
  }
  return {asStreamed(separateTriangles(triangles)), volume};
}

std::string inDigits(const Eigen::Vector3d& v) {
  std::array<char, 100> text;
  std::snprintf(text.data(), text.size(), "{%.17g, %.17g, %.17g}", v.x(), v.y(), v.z());
  return text.data();
}

}  // namespace

double Random::uniform(double lower, double upper) {
  return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double Random::logUniform(double lower, double upper) { return std::exp(uniform(std::log(lower), std::log(upper))); }

int Random::below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }

bool Random::chance(double probability) { return uniform(0.0, 1.0) < probability; }

Eigen::Vector3d Random::inBox(const Eigen::Vector3d& half) {
  const double x = uniform(-half.x(), half.x());
  const double y = uniform(-half.y(), half.y());
  return {x, y, uniform(-half.z(), half.z())};
}

Eigen::Vector3d Random::direction() {
  Eigen::Vector3d v;
  do {
    v = inBox(Eigen::Vector3d::Ones());
  } while (v.squaredNorm() > 1.0 || v.squaredNorm() < 0.01);
  return v.normalized();
}

Eigen::Matrix3d Random::turn(double angle) { return Eigen::AngleAxisd(angle, direction()).toRotationMatrix(); }

Eigen::Matrix3d Random::rotation() {
  const Eigen::Matrix3d first = turn(uniform(0.0, M_PI));
  return first * turn(uniform(0.0, M_PI));
}

Eigen::Isometry3d Random::pose(const Eigen::Vector3d& place) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation();
  pose.translation() = place;
  return pose;
}

std::vector<std::uint32_t> Random::permutation(size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[static_cast<size_t>(below(static_cast<int>(i)))]);
  return order;
}

ConvexShape randomTool(Random& random, double scale) {
  const int kind = random.below(8);
  const double radius = kind == 0 ? 0.0 : scale * random.logUniform(0.01, 1.0);
  const double length = kind == 1 ? 0.0 : scale * random.logUniform(0.01, 1.0);
  return ConvexShape::cylinder(radius, length, 3 + random.below(30));
}

ConvexShape randomShape(Random& random, int hull_points) {
  switch (random.below(4)) {
    case 0:
      return ConvexShape::cylinder(random.uniform(0.005, 0.05), random.uniform(0.02, 0.2));
    case 1:
      return ConvexShape::sphere(random.uniform(0.01, 0.06));
    case 2:
      return ConvexShape::box({random.uniform(0.005, 0.1), random.uniform(0.005, 0.1), random.uniform(0.005, 0.1)});
    default: {
      std::vector<Eigen::Vector3d> points;
      for (int i = 0; i < hull_points; ++i) points.push_back(random.inBox({0.1, 0.05, 0.03}));
      return ConvexShape::hull(points);
    }
  }
}

Motion randomMotion(Random& random, const ConvexShape& tool, const Eigen::Vector3d& place, double max_angle) {
  const int kind = random.below(8);
  const double size = tool.radius() + tool.length();
  Motion motion;
  motion.X_MT_start = random.pose(place);
  motion.X_MT_end = motion.X_MT_start;
  if (kind > 1) motion.X_MT_end.translation() += random.logUniform(1e-6, 2.0) * size * random.direction();
  if (kind != 0 && kind != 2) {
    motion.X_MT_end.linear() = random.turn(random.uniform(0.0, max_angle)) * motion.X_MT_start.linear();
  }
  return motion;
}

Motion handMotion(Random& random) {
  Motion motion;
  motion.X_MT_start = random.pose(Eigen::Vector3d::Zero());
  motion.X_MT_end.linear() = random.turn(random.uniform(0.0, M_PI / 18.0)) * motion.X_MT_start.linear();
  motion.X_MT_end.translation() = random.uniform(0.001, 0.020) * random.direction();
  return motion;
}

Scene randomScene(std::uint64_t seed) {
  Random random(seed);
  const ConvexShape tool = randomTool(random, random.logUniform(1e-3, 1e3));
  const Motion motion = randomMotion(random, tool, randomPlace(random), /*max_angle=*/0.175);
  const SweptVolume swept_M = sweptVolume(tool, motion, randomKind(random));

  const Eigen::Vector3d half = swept_M.box.half_extents.cwiseMax(0.01 * swept_M.box.half_extents.norm());
  const double spread = random.logUniform(1.0, 100.0);
  std::vector<Corners> triangles;
  for (int count = 20 + random.below(81); count > 0; --count) {
    Corners corners = randomTriangle_B(random, half, spread);
    for (Eigen::Vector3d& p : corners) p = swept_M.box.X_MB * p;
    triangles.push_back(corners);
  }
  const TriangleMesh mesh = separateTriangles(triangles);
  return {random.chance(0.2) ? asStreamed(mesh) : mesh, swept_M};
}

Scene grazingScene(std::uint64_t seed) {
  Random random(seed);
  if (random.chance(0.1)) return alignedGrazingScene(random);
  const ConvexShape tool = randomTool(random, random.logUniform(1e-3, 1e3));
  const Motion motion = randomMotion(random, tool, randomPlace(random), /*max_angle=*/0.175);
  SweptVolume volume = sweptVolume(tool, motion, randomKind(random), 1e-3 * (tool.radius() + tool.length()));
  const double size = volume.box.half_extents.norm();
  const std::vector<Polygon> faces = largeFaces(volume);

  enum class Side { kEither, kInside, kOutside, kFarOutside };  // of every triangle of the scene
  const auto side = static_cast<Side>(random.below(4));
  std::vector<Touch> touches;
  std::vector<double> gaps;
  std::vector<Corners> triangles;
  for (int count = 1 + random.below(20); count > 0; --count) {
    touches.push_back(randomTouch(random, faces, size));
    double gap = size * randomGap(random);
    if (side == Side::kInside) gap = -std::abs(gap);
    if (side == Side::kOutside) gap = std::abs(gap);
    if (side == Side::kFarOutside) gap = size * random.logUniform(1e-5, 1e-2);
    gaps.push_back(gap);
    Corners corners = touches.back().corners;
    for (Eigen::Vector3d& p : corners) p = volume.box.X_MB * Eigen::Vector3d(p + gaps.back() * touches.back().normal);
    triangles.push_back(corners);
  }
  const TriangleMesh mesh = separateTriangles(triangles);

  // The first triangle's corners are where float32 puts them; so the volume is moved to it.
  const Eigen::Isometry3d X_BM = volume.box.X_MB.inverse();
  Corners kept;
  for (size_t i = 0; i < 3; ++i) {
    kept[i] = X_BM.linear() * (mesh.offset(i) - (volume.box.X_MB.translation() - mesh.origin()));
  }
  const Eigen::Vector3d normal = separatingNormal(touches[0], kept);
  double nearest = normal.dot(kept[0]);
  for (const Eigen::Vector3d& p : kept) nearest = std::min(nearest, normal.dot(p));
  const double gap = nearest - normal.dot(farthest(cornersOf(faces), normal));
  volume.box.X_MB.translation() += (gap - gaps[0]) * (volume.box.X_MB.linear() * normal);
  return {mesh, volume};
}

std::string describe(const Scene& scene, std::uint32_t triangle) {
  const OrientedBox& box = scene.swept_M.box;
  std::string text = "triangle " + std::to_string(triangle) + " of " + std::to_string(scene.mesh_M.triangles().size()) +
                     ", corners as offsets from the mesh's origin:";
  for (const std::uint32_t vertex : scene.mesh_M.triangles()[triangle]) {
    text += "\n  " + inDigits(scene.mesh_M.offset(vertex));
  }
  text += "\norigin of the mesh: " + inDigits(scene.mesh_M.origin());
  for (int i = 0; i < 3; ++i) text += "\naxis of the box: " + inDigits(box.X_MB.linear().col(i));
  text += "\ncenter of the box: " + inDigits(box.X_MB.translation());
  text += "\nhalf extents of the box: " + inDigits(box.half_extents);
  text += "\ninterior point: " + inDigits(scene.swept_M.interior_B);
  for (const HalfSpace& clip : scene.swept_M.clips_B) {
    std::array<char, 40> offset;
    std::snprintf(offset.data(), offset.size(), "%.17g", clip.offset());
    text += "\nclipping plane: normal " + inDigits(clip.normal()) + ", offset " + offset.data();
  }
  return text;
}

TriangleMesh wavyHull(int rings, int sectors, double phase) {
  std::vector<Eigen::Vector3d> vertices = {{0.0, 0.0, 0.1}, {0.0, 0.0, -0.1}};
  for (int ring = 1; ring < rings; ++ring) {
    const double polar = M_PI * ring / rings;
    for (int sector = 0; sector < sectors; ++sector) {
      const double azimuth = 2.0 * M_PI * sector / sectors;
      const double radius = 0.1 + 0.01 * std::sin(polar) * std::sin(5.0 * azimuth + phase) * std::cos(4.0 * polar);
      vertices.emplace_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                                     std::sin(polar) * std::sin(azimuth), std::cos(polar)));
    }
  }
  const auto at = [&](int ring, int sector) {
    return static_cast<std::uint32_t>(2 + (ring - 1) * sectors + sector % sectors);
  };
  std::vector<Triangle> triangles;
  for (int sector = 0; sector < sectors; ++sector) {
    triangles.push_back({0, at(1, sector), at(1, sector + 1)});
    for (int ring = 1; ring < rings - 1; ++ring) {
      triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)});
      triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)});
    }
    triangles.push_back({1, at(rings - 1, sector + 1), at(rings - 1, sector)});
  }
  return TriangleMesh(vertices, std::move(triangles));
}

TriangleMesh gridSurface(std::uint32_t cells, double side, const std::function<double(double x, double y)>& height) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t row = 0; row <= cells; ++row) {
    for (std::uint32_t column = 0; column <= cells; ++column) {
      const double x = side * column / cells - side / 2.0;
      const double y = side * row / cells - side / 2.0;
      vertices.emplace_back(x, y, height(x, y));
    }
  }
  for (std::uint32_t row = 0; row < cells; ++row) {
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t at = row * (cells + 1) + column;
      triangles.push_back({at, at + 1, at + cells + 2});
      triangles.push_back({at, at + cells + 2, at + cells + 1});
    }
  }
  return TriangleMesh(vertices, std::move(triangles));
}

std::vector<float> streamedPositions(const TriangleMesh& mesh) {
  std::vector<float> positions;
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    const Eigen::Vector3f p = mesh.vertex(i).cast<float>();
    positions.insert(positions.end(), p.data(), p.data() + 3);
  }
  return positions;
}

int sceneCount(int full_size, double default_percent) {
  const char* percent = std::getenv("SWEEP_GUARD_SCENES");
  return static_cast<int>(std::lround(full_size * (percent != nullptr ? std::atof(percent) : default_percent) / 100.0));
}

}  // namespace sweep_guard_core
