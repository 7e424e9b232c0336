#include "soundness/enclosed.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "detection/inside.h"
#include "scenes.h"
#include "solids.h"

namespace sweep_guard_core::soundness {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using LongVector = Eigen::Matrix<long double, 3, 1>;

constexpr int kPoints = 8;
constexpr double kOff = 1e-3;  // of the solid: nearer to its surface nothing is asked

struct Solid {
  Affine3d X_WU = Affine3d::Identity();  // U: where the solid is a cube or octahedron that reaches from -1 to 1
  bool is_octahedron = false;
  bool is_cavity = false;
  std::uint32_t cells = 1;
  bool has_hole = false;
  SentSurface surface = {};

  // Below 1 inside, above 1 outside.
  double reach(const Vector3d& p_W) const {
    const Vector3d p_U = X_WU.inverse() * p_W;
    return is_octahedron ? p_U.lpNorm<1>() : p_U.lpNorm<Eigen::Infinity>();
  }
};

Affine3d randomMap(Random& random) {
  Affine3d X = Affine3d::Identity();
  X.linear() = random.rotation() * Vector3d(1.0, random.logUniform(0.2, 1.0), random.logUniform(0.2, 1.0)).asDiagonal();
  if (random.chance(0.5)) X.linear() = X.linear() * random.rotation();
  if (random.chance(0.3)) X.linear().col(0) *= -1.0;  // turns the triangles inside out
  return X;
}

SentSurface octahedron() {
  SentSurface surface;
  for (const double sign : {1.0, -1.0}) {
    for (int axis = 0; axis < 3; ++axis) surface.vertices.emplace_back(sign * Vector3d::Unit(axis));
  }
  for (const std::uint32_t x : {0U, 3U}) {
    for (const std::uint32_t y : {1U, 4U}) {
      for (const std::uint32_t z : {2U, 5U}) {
        const bool odd = ((x != 0) + (y != 1) + (z != 2)) % 2 != 0;
        surface.triangles.push_back({x, odd ? z : y, odd ? y : z});
      }
    }
  }
  return surface;
}

Solid randomSolid(Random& random) {
  Solid solid;
  solid.is_octahedron = random.chance(0.3);
  solid.cells = 1 + static_cast<std::uint32_t>(random.below(4));
  return solid;
}

std::vector<Solid> randomSolids(Random& random, bool may_have_cavity) {
  std::vector<Solid> solids{randomSolid(random)};
  solids[0].X_WU = Eigen::Translation3d(random.inBox({3.0, 3.0, 3.0})) * randomMap(random);
  for (int more = random.below(3); more > 0; --more) {
    Solid solid = randomSolid(random);
    const int where = random.below(3);  // apart, overlapping, nested
    if (where == 2) {
      solid.X_WU = solids[0].X_WU * Eigen::Translation3d(random.inBox({0.05, 0.05, 0.05})) *
                   Eigen::Scaling(random.uniform(0.05, 0.2));
      solid.is_cavity = may_have_cavity && random.chance(0.5);
    } else {
      const double distance = where == 0 ? 6.0 : random.uniform(0.1, 1.5);
      solid.X_WU = Eigen::Translation3d(distance * random.direction()) * solids[0].X_WU * randomMap(random);
    }
    solids.push_back(solid);
    if (where == 2) break;
  }
  return solids;
}

void setSurface(Solid& solid) {
  solid.surface = solid.is_octahedron ? octahedron() : cubeSurface(1.0, solid.cells);
  const bool turned = (solid.X_WU.linear().determinant() < 0.0) != solid.is_cavity;
  solid.surface = solid.surface.moved(solid.X_WU);
  if (turned) solid.surface = solid.surface.reversed();
}

// Returns what it is.
const char* addFlaw(Random& random, Solid& solid) {
  SentSurface& surface = solid.surface;
  const int flaw = random.below(4);
  if (flaw == 0 && !solid.is_octahedron && solid.cells % 2 == 0) {
    surface.add(plate(1.0, solid.cells).moved(solid.X_WU));
    return " with a plate";
  }
  if (flaw == 1) {
    const Triangle& at =
        surface.triangles[static_cast<size_t>(random.below(static_cast<int>(surface.triangles.size())))];
    const auto tip = static_cast<std::uint32_t>(surface.vertices.size());
    const Triangle fin = {at[0], at[1], tip};
    surface.vertices.emplace_back(surface.vertices[at[0]] + random.logUniform(0.01, 3.0) * random.direction());
    surface.triangles.push_back(fin);
    return " with a fin";
  }
  if (flaw == 2) {
    surface.triangles.erase(surface.triangles.begin() + random.below(static_cast<int>(surface.triangles.size())));
    solid.has_hole = true;
    return " with a hole";
  }
  return "";
}

void disturb(Random& random, double diagonal, SentSurface& surface) {
  for (Vector3d& vertex : surface.vertices) vertex += random.inBox(1e-7 * diagonal * Vector3d::Ones());
}

// Of a closed part, or one with a hole.
long double windingNumber(const SentSurface& surface, const Vector3d& p) {
  long double sum = 0.0L;
  for (const auto& [i, k, l] : surface.triangles) {
    const LongVector a = (surface.vertices[i] - p).cast<long double>();
    const LongVector b = (surface.vertices[k] - p).cast<long double>();
    const LongVector c = (surface.vertices[l] - p).cast<long double>();
    const long double la = a.norm();
    const long double lb = b.norm();
    const long double lc = c.norm();
    sum += 2.0L * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0L * std::acos(-1.0L));
}

struct EnclosedCase {
  std::vector<Solid> solids;
  SentSurface sheet;  // beside them
  SentSurface sent;
  std::string how;                              // it is sent
  Affine3d deformation = Affine3d::Identity();  // after it was sent: solid angles change

  double numberOf(const SentSurface& surface, const Vector3d& p) const {
    return std::abs(static_cast<double>(windingNumber(surface.moved(deformation), deformation * p)));
  }

  enum class Answer { kInside, kOutside, kNotAsked };
  Answer answer(const Vector3d& p) const {
    bool is_inside = false;
    bool in_cavity = false;
    double open = sheet.triangles.empty() ? 0.0 : numberOf(sheet, p);
    for (const Solid& solid : solids) {
      if (std::abs(solid.reach(p) - 1.0) < kOff) return Answer::kNotAsked;
      const double number = solid.has_hole ? numberOf(solid.surface, p) : 0.0;
      if (solid.is_cavity && !solid.has_hole) in_cavity = in_cavity || solid.reach(p) < 1.0;
      if (solid.is_cavity && solid.has_hole && solid.reach(p) < 1.0) return Answer::kNotAsked;
      if (!solid.is_cavity) is_inside = is_inside || (solid.has_hole ? number > 0.751 : solid.reach(p) < 1.0);
      open += number;
    }
    if (in_cavity && solids.size() > 2) return Answer::kNotAsked;  // another solid may lie in it
    if (is_inside && in_cavity) is_inside = false;
    return is_inside ? Answer::kInside : open < 0.249 ? Answer::kOutside : Answer::kNotAsked;
  }
};

double diagonalOf(const SentSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  return box.sizes().norm();
}

EnclosedCase randomCase(Random& random) {
  EnclosedCase made;
  const bool is_turned = random.chance(0.3);
  const bool is_doubled = random.chance(0.3);
  made.solids = randomSolids(random, !is_turned && !is_doubled);
  for (Solid& solid : made.solids) {
    setSurface(solid);
    if (random.chance(0.4)) made.how += addFlaw(random, solid);
    made.sent.add(solid.surface);
  }
  if (is_doubled) {
    SentSurface again = made.sent;
    made.how += " doubled";
    if (random.chance(0.5)) again = again.reversed();
    if (random.chance(0.3)) again.triangles.resize(again.triangles.size() / 2 + 1);
    made.sent.add(again);
  }
  if (random.chance(0.2)) {
    made.sheet = plate(0.5, 2).moved(Eigen::Translation3d(20.0 * random.direction()) * randomMap(random));
    made.sent.add(made.sheet);
  }
  if (is_turned) {
    made.how += " turned";
    for (Triangle& triangle : made.sent.triangles) {
      if (random.chance(0.5)) std::swap(triangle[0], triangle[1]);
    }
  }
  if (random.chance(0.5)) {
    made.sent = made.sent.separate();
    made.how += " separate";
  }
  if (random.chance(0.3)) {
    disturb(random, diagonalOf(made.sent), made.sent);
    made.how += " disturbed";
  }
  const std::vector<std::uint32_t> order = random.permutation(made.sent.triangles.size());
  std::vector<Triangle> shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(made.sent.triangles[i]);
  made.sent.triangles = shuffled;
  return made;
}

std::string described(const EnclosedCase& made, const Vector3d& p) {
  std::ostringstream text;
  text.precision(17);
  text << "point " << p.transpose() << ", sent" << made.how << ", " << made.sent.mesh().openEdges() << " open edges\n";
  for (const Solid& solid : made.solids) {
    text << (solid.is_octahedron ? "octahedron" : "cube") << (solid.is_cavity ? " cavity" : "")
         << (solid.has_hole ? " with a hole" : "") << ", reach " << solid.reach(p) << '\n';
  }
  return text.str();
}

}  // namespace

void checkEnclosed(const Context& context, std::uint64_t seed) {
  Random random(seed);
  EnclosedCase made = randomCase(random);
  TriangleMesh mesh = made.sent.mesh();
  if (random.chance(0.3)) {
    made.deformation = randomMap(random);
    std::vector<float> positions;
    for (const Vector3d& vertex : made.sent.vertices) {
      const Vector3d moved = made.deformation * vertex;
      for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(moved[i]));
    }
    mesh.deform(positions);
  }
  Tally& tally = context.report.of(context.detectors.front().name, context.family);
  for (int i = 0; i < kPoints; ++i) {
    const Solid& near = made.solids[static_cast<size_t>(random.below(static_cast<int>(made.solids.size())))];
    const Vector3d p = near.X_WU * random.inBox(1.3 * Vector3d::Ones());
    const EnclosedCase::Answer answer = made.answer(p);
    if (answer == EnclosedCase::Answer::kNotAsked) continue;
    ++tally.cases;
    const bool should = answer == EnclosedCase::Answer::kInside;
    tally.positives += should ? 1 : 0;
    if (inside(mesh, made.deformation * p) == should) continue;
    ++(should ? tally.misses : tally.unexplained);
    context.report.fail(
        context.family + " " + context.about + (should ? ": inside is missed" : ": outside is called inside"),
        [&] { return described(made, p); });
  }
}

}  // namespace sweep_guard_core::soundness
