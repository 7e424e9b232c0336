#include "guard/self_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "guard/swept_body.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

constexpr size_t kLargeMesh = 2048;  // [triangles]: several groups of clusters
constexpr double kGraze = 1e-4;      // of a half extent: several times the inflation of every detector here

// A triangle, and whether a volume meets it.
struct GoldenTriangle {
  std::string name;
  Corners corners;
  bool met;
};

using Ask = std::function<void(Detector& detector, const TriangleMesh& mesh_M, Detection& detection)>;

// A volume among triangles.
struct GoldenQuery {
  std::string name;
  Ask ask;
  Eigen::Isometry3d X_MN;
  Eigen::Vector3d unit;  // of the corners, which are in N [m]
  std::vector<GoldenTriangle> triangles;

  TriangleMesh mesh_M() const;
};

TriangleMesh GoldenQuery::mesh_M() const {
  std::vector<Eigen::Vector3d> vertices_M;
  std::vector<Triangle> mesh;
  for (const GoldenTriangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(vertices_M.size());
    mesh.push_back({first, first + 1, first + 2});
    for (const Eigen::Vector3d& corner : triangle.corners) vertices_M.push_back(X_MN * corner.cwiseProduct(unit));
  }
  return {vertices_M, std::move(mesh), /*is_sheet=*/true};
}

// A triangle that points at a place from outside.
Corners pointingAt(const Eigen::Vector3d& place) {
  const Eigen::Vector3d aside = place.unitOrthogonal();
  return {place, 3.0 * place + aside, 3.0 * place - aside};
}

// A triangle about a place, across a direction.
Corners across(const Eigen::Vector3d& place, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d u = direction.unitOrthogonal();
  const Eigen::Vector3d v = direction.normalized().cross(u);
  return {place + 2.0 * u, place - u + 1.7 * v, place - u - 1.7 * v};
}

using MakeCorners = Corners (*)(const Eigen::Vector3d& place);

Corners plane(const Eigen::Vector3d& place) { return across(place, place); }

void addGrazing(std::vector<GoldenTriangle>& all, const std::string& name, const Eigen::Vector3d& place,
                MakeCorners corners) {
  all.push_back({name + ", barely in", corners((1.0 - kGraze) * place), true});
  all.push_back({name + ", barely out", corners((1.0 + kGraze) * place), false});
}

// Around the cube from -1 to 1.
std::vector<GoldenTriangle> grazingTheCube() {
  std::vector<GoldenTriangle> all;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    for (const double side : {-1.0, 1.0}) {
      addGrazing(all, "tip at a face", side * axis, pointingAt);
      addGrazing(all, "plane along a face", side * axis, plane);
    }
    addGrazing(all, "plane at an edge", Eigen::Vector3d::Ones() - axis, plane);
  }
  addGrazing(all, "plane at a corner", Eigen::Vector3d::Ones(), plane);
  return all;
}

std::vector<GoldenTriangle> deepAndFar() {
  using V = Eigen::Vector3d;
  const V in(0.3, -0.2, 0.4);
  const V out(3.0, 3.0, 3.0);
  return {{"through the middle", across(V::Zero(), {1, 2, 3}), true},
          {"wholly inside", {in, V(-0.5, 0.1, 0.2), V(0.2, 0.6, -0.7)}, true},
          {"far away", across({4, 0, 0}, {1, 0, 0}), false},
          {"point inside", {in, in, in}, true},
          {"point outside", {out, out, out}, false},
          {"segment through it", {V(-2, 0, 0), V(2, 0.1, 0), V(2, 0.1, 0)}, true},
          {"segment beside it", {V(-2, 3, 0), V(2, 3, 0), V(2, 3, 0)}, false},
          {"sliver through it", {V(-2, 0, 0), V(2, 0, 0), V(2, 1e-9, 0)}, true}};
}

Eigen::Isometry3d placed(double distance, double angle) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
  return Eigen::Translation3d(distance * Eigen::Vector3d(0.6, -0.8, 0.1)) * Eigen::AngleAxisd(angle, axis);
}

Ask askAbout(const SweptVolume& volume_M) {
  return [volume_M](Detector& detector, const TriangleMesh& mesh_M, Detection& detection) {
    detection = detector.detect(mesh_M, volume_M.grown(mesh_M.rounding()));
  };
}

// A body that moves along z by half_way [m] to either side and turns about x by half_turn [rad], through the origin of N.
Ask askAbout(const ConvexShape& shape_T, double half_way, double half_turn, const Eigen::Isometry3d& X_MN,
             VolumeKind kind) {
  const auto pose = [&](double side) -> Eigen::Isometry3d {
    return X_MN * Eigen::Translation3d(0.0, 0.0, side * half_way) *
           Eigen::AngleAxisd(side * half_turn, Eigen::Vector3d::UnitX());
  };
  const Motion motion_M{pose(-1.0), pose(1.0)};
  return [=](Detector& detector, const TriangleMesh& mesh_M, Detection& detection) {
    const SweptBody body = sweptBody(shape_T, motion_M, kind, mesh_M.rounding());
    detection = detector.detect(mesh_M, body.volume_M);
    removeMissedByHull(body, mesh_M, detection);
  };
}

GoldenQuery box(const std::string& where, const Eigen::Isometry3d& X_MN, std::vector<GoldenTriangle> triangles) {
  SweptVolume volume_M;
  volume_M.box = {X_MN, {0.01, 0.02, 0.05}};
  return {"box " + where, askAbout(volume_M), X_MN, volume_M.box.half_extents, std::move(triangles)};
}

// The cube, cut off at x + y = 1.
GoldenQuery cutBox(const Eigen::Isometry3d& X_MN) {
  SweptVolume volume_M;
  volume_M.box = {X_MN, {0.01, 0.02, 0.05}};
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 1.0, 0.0).cwiseQuotient(volume_M.box.half_extents);
  volume_M.clips_B.push_back(HalfSpace(normal, 1.0 / normal.norm()));
  std::vector<GoldenTriangle> triangles;
  addGrazing(triangles, "plane along the cut", {0.5, 0.5, 0.0}, plane);
  return {"cut box", askAbout(volume_M), X_MN, volume_M.box.half_extents, std::move(triangles)};
}

std::vector<GoldenQuery> volumes() {
  const Eigen::Isometry3d turned = placed(1.0, 1.0);
  std::vector<GoldenQuery> all = {
      box("at the origin", Eigen::Isometry3d::Identity(), grazingTheCube()), box("turned", turned, grazingTheCube()),
      box("1000 km away", placed(1e6, -2.0), grazingTheCube()), cutBox(turned),
      box("among huge triangles", turned,
          {{"through it", across({0, 0, 0}, {3, 1, 2}), true}, {"beside it", across({0, 0.1, 0}, {0, 1, 0}), false}})};
  all.back().unit *= 1000.0;
  return all;
}

// Of a box of 2 x 4 x 6 cm that goes 4 cm; far away, too.
std::vector<GoldenQuery> movingBoxes() {
  const ConvexShape body = ConvexShape::box({0.01, 0.02, 0.03});
  std::vector<GoldenQuery> all;
  for (const double distance : {1.0, 1e6}) {
    const Eigen::Isometry3d X_MN = placed(distance, -1.0);
    for (const VolumeKind kind : {VolumeKind::kObb, VolumeKind::kObbPlanes, VolumeKind::kHull}) {
      all.push_back({"moving box, " + nameOf(kind),
                     askAbout(body, 0.02, 0.0, X_MN, kind),
                     X_MN,
                     {0.01, 0.02, 0.05},
                     deepAndFar()});
    }
  }
  return all;
}

std::vector<GoldenQuery> otherBodies() {
  using V = Eigen::Vector3d;
  const Eigen::Isometry3d X_MN = placed(1.0, 2.0);
  const auto body = [&](const std::string& name, const ConvexShape& shape_T, double half_way, double half_turn,
                        VolumeKind kind, std::vector<GoldenTriangle> triangles) {
    return GoldenQuery{name + ", " + nameOf(kind), askAbout(shape_T, half_way, half_turn, X_MN, kind), X_MN,
                       V::Constant(0.05), std::move(triangles)};
  };
  const std::vector<GoldenTriangle> thin = {{"through it", across(V::Zero(), {1, 2, 3}), true},
                                            {"beside it", across({0.5, 0, 0}, {1, 0, 0}), false}};
  const ConvexShape ball = ConvexShape::sphere(0.02);  // to and fro by 0.02
  const V rim(0.38, 0.0, 0.78);                        // within the box around both balls, 1.4 radii off the nearer
  const V tip(0.0, 0.0, 0.98);
  const V aside(0.0, 0.5, 0.0);
  std::vector<GoldenTriangle> slanting;
  addGrazing(slanting, "slanting plane", (0.4 + 0.4 * 0.6) * V(0.8, 0.0, 0.6), plane);
  return {body("flat box", ConvexShape::box({0.0, 0.02, 0.03}), 0.02, 0.0, VolumeKind::kObbPlanes, thin),
          body("needle", ConvexShape::box({0.0, 0.0, 0.03}), 0.02, 0.0, VolumeKind::kObbPlanes, thin),
          body("box at rest", ConvexShape::box({0.01, 0.02, 0.03}), 0.0, 0.0, VolumeKind::kObbPlanes, thin),
          body("ball", ball, 0.02, 0.0, VolumeKind::kObb, {{"within its box", {rim, rim, rim}, true}}),
          body("ball", ball, 0.02, 0.0, VolumeKind::kHull, {{"off its hull", {rim, rim, rim}, false}}),
          body("ball", ball, 0.02, 0.0, VolumeKind::kHull, slanting),
          body("turning rod", ConvexShape::box({0.002, 0.002, 0.05}), 0.0, 0.085, VolumeKind::kHull,
               {{"at its tip", {tip, tip, tip}, true}, {"beside it", {aside, aside, aside}, false}})};
}

// A small triangle, one of many around the cube.
GoldenTriangle farAway(size_t i) {
  const double z = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(kLargeMesh);
  const double angle = 2.4 * static_cast<double>(i);  // the golden angle: even
  const double radius = std::sqrt(1.0 - z * z);
  const Eigen::Vector3d place = 4.0 * Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  return {"around it", {place, 1.02 * place, place + 0.1 * place.unitOrthogonal()}, false};
}

// The same question about triangles at spread places of a large mesh.
GoldenQuery spread(const GoldenQuery& query) {
  GoldenQuery large{query.name + " in a large mesh", query.ask, query.X_MN, query.unit, {}};
  const size_t count = query.triangles.size();
  for (size_t i = 0, next = 0; i < kLargeMesh; ++i) {
    if (i * count >= next * kLargeMesh && next < count) large.triangles.push_back(query.triangles[next++]);
    large.triangles.push_back(farAway(i));
  }
  return large;
}

std::string test(Detector& detector, const GoldenQuery& query) {
  Detection detection;
  query.ask(detector, query.mesh_M(), detection);
  for (std::uint32_t i = 0; i < query.triangles.size(); ++i) {
    const GoldenTriangle& golden = query.triangles[i];
    const bool found = std::binary_search(detection.triangles.begin(), detection.triangles.end(), i);
    if (found == golden.met) continue;
    return "triangle '" + golden.name + "' of '" + query.name +
           (found ? "' is found and not met" : "' is met and not found");
  }
  return {};
}

}  // namespace

std::string selfTest(Detector& detector) {
  try {
    for (const auto& queries : {volumes(), movingBoxes(), otherBodies()}) {
      for (const GoldenQuery& query : queries) {
        for (const GoldenQuery& asked : {query, spread(query)}) {
          std::string wrong = test(detector, asked);
          if (!wrong.empty()) return wrong;
        }
      }
    }
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace sweep_guard_core
