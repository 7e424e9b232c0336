#include "soundness/positives.h"

#include <algorithm>
#include <array>

#include "soundness/exact_motion.h"

namespace sweep_guard_core::soundness {
namespace {

// A point of the tool at a fraction of the motion.
struct ToolPoint {
  Real fraction;
  Real mesh_fraction;  // of the mesh's path at that time
  Vector3r p_T;
  Eigen::Vector3d outward_M;  // in which the sweep ends at the point, or random
};

Motion randomPath(Random& random, const Eigen::Vector3d& place, double size) {
  Motion motion;
  motion.X_MT_start = random.pose(place);
  motion.X_MT_end = motion.X_MT_start;
  if (random.chance(0.8)) {
    motion.X_MT_end.translation() += size * random.logUniform(1e-6, 10.0) * random.direction();
  }
  motion.X_MT_end.linear() = random.turn(randomAngle(random)) * motion.X_MT_start.linear();
  return motion;
}

Vector3r randomPointOf(Random& random, const Body& body, Real inset) {
  Vector3r p = support(body, random.direction().cast<Real>(), inset);
  if (random.chance(0.5)) return p;
  const Vector3r q = support(body, random.direction().cast<Real>(), inset);
  return p + static_cast<Real>(random.uniform(0.0, 1.0)) * (q - p);
}

// The point of the body that moves farthest in a direction, at a dyadic fraction.
ToolPoint farthestOfSweep(Random& random, const Body& body, const ExactMotion& motion,
                          const Eigen::Vector3d& translation, Real inset) {
  // In half of the cases the direction is radial, where an arc is widest.
  const auto during = static_cast<Real>(random.uniform(0.0, 1.0));
  const Vector3r p_T = support(body, random.direction().cast<Real>(), inset);
  const Vector3r radial = motion.at(during, p_T) - motion.at(during, Vector3r::Zero());
  const Eigen::Vector3d outward = radial.norm() > 0 && random.chance(0.5)
                                      ? Eigen::Vector3d(radial.normalized().cast<double>())
                                      : random.direction();
  const Vector3r direction = outward.cast<Real>();
  const auto pointAt = [&](Real fraction) { return support(body, motion.directionInTool(fraction, direction), inset); };
  const auto extentAt = [&](Real fraction) { return direction.dot(motion.at(fraction, pointAt(fraction))); };
  Real best = 0;
  Real farthest = extentAt(0);
  Real step = 1.0L / 16;
  for (int i = 1; i <= 16; ++i) {
    if (const Real here = extentAt(i * step); here > farthest) {
      farthest = here;
      best = i * step;
    }
  }
  for (; step > 1e-5L; step /= 2) {
    for (const Real fraction : {best - step / 2, best + step / 2}) {
      if (fraction < 0 || fraction > 1) continue;
      if (const Real here = extentAt(fraction); here > farthest) {
        farthest = here;
        best = fraction;
      }
    }
  }
  return {best, outward.dot(translation) > 0.0 ? Real{0} : Real{1}, pointAt(best), outward};
}

ToolPoint randomToolPoint(Random& random, const Body& body, const ExactMotion& motion,
                          const Eigen::Vector3d& translation, size_t sub_motions, Real inset) {
  if (random.chance(0.4)) return farthestOfSweep(random, body, motion, translation, inset);
  Real fraction = static_cast<Real>(random.below(1 + (1 << 12))) / (1 << 12);
  if (random.chance(0.2)) fraction = random.below(2);
  if (random.chance(0.2)) {
    fraction = static_cast<Real>(random.below(static_cast<int>(sub_motions) + 1)) / static_cast<Real>(sub_motions);
  }
  const Real mesh_fraction = random.chance(0.5) ? fraction : static_cast<Real>(random.below(17)) / 16;
  return {fraction, mesh_fraction, randomPointOf(random, body, inset), random.direction()};
}

// A triangle around one of its points.
struct Shape {
  std::array<Real, 3> weights;  // barycentric weights of the point
  Eigen::Vector3d first_edge;   // from corner 0
  Eigen::Vector3d second_edge;
};

Eigen::Vector3d across(Random& random, const Eigen::Vector3d& normal) {
  return normal.cross(random.direction()).normalized();
}

Eigen::Vector3d edgeDirection(Random& random, const Eigen::Vector3d& outward, int lean) {
  Eigen::Vector3d along = across(random, outward);
  if (lean == 0) return along;
  if (lean == 1) return (along + random.logUniform(1e-9, 10.0) * outward).normalized();
  return random.direction();
}

Shape randomShape(Random& random, const Eigen::Vector3d& outward, double size) {
  const int lean = random.below(3);  // tangent, away from the tool, any
  Shape shape;
  shape.first_edge = size * edgeDirection(random, outward, lean);
  shape.second_edge = size * random.logUniform(0.01, 1.0) * edgeDirection(random, outward, lean);
  switch (random.below(8)) {
    case 0:  // sliver
      shape.second_edge = 0.5 * shape.first_edge + 1e-9 * size * random.direction();
      break;
    case 1:  // needle
      shape.second_edge = shape.first_edge;
      break;
    case 2:  // point
      shape.first_edge = shape.second_edge = Eigen::Vector3d::Zero();
      break;
    default:
      break;
  }
  const auto u = static_cast<Real>(random.uniform(0.0, 1.0));
  const auto v = static_cast<Real>(random.uniform(0.0, 1.0)) * (1 - u);
  switch (random.below(3)) {
    case 0:
      shape.weights = {1, 0, 0};
      break;
    case 1:
      shape.weights = {1 - u, u, 0};
      break;
    default:
      shape.weights = {1 - u - v, u, v};
      break;
  }
  return shape;
}

using Corners = std::array<Eigen::Vector3d, 3>;

// A triangle at both ends of the motion.
struct MovedTriangle {
  Corners now;
  Corners before;
};

MovedTriangle cornersAbout(const Shape& shape, const Vector3r& p, const std::array<Eigen::Vector3d, 3>& translations,
                           Real mesh_fraction) {
  const Vector3r first =
      p - shape.weights[1] * shape.first_edge.cast<Real>() - shape.weights[2] * shape.second_edge.cast<Real>();
  const std::array<Vector3r, 3> corners = {first, first + shape.first_edge.cast<Real>(),
                                           first + shape.second_edge.cast<Real>()};
  MovedTriangle moved;
  for (size_t i = 0; i < 3; ++i) {
    moved.now[i] = (corners[i] + (1 - mesh_fraction) * translations[i].cast<Real>()).cast<double>();
    moved.before[i] = (corners[i] - mesh_fraction * translations[i].cast<Real>()).cast<double>();
  }
  return moved;
}

Vector3r pointOf(const Shape& shape, const MovedTriangle& moved, Real mesh_fraction) {
  Vector3r p = Vector3r::Zero();
  for (size_t i = 0; i < 3; ++i) {
    p += shape.weights[i] *
         ((1 - mesh_fraction) * moved.before[i].cast<Real>() + mesh_fraction * moved.now[i].cast<Real>());
  }
  return p;
}

double largestTranslation(const Motion& motion) {
  return std::max(motion.X_MT_start.translation().cwiseAbs().maxCoeff(),
                  motion.X_MT_end.translation().cwiseAbs().maxCoeff());
}

// Depth of the points: 2 to 64 roundings of the largest number, or more.
double randomInset(Random& random, double size, double largest) {
  const double rounding = 0x1p-52 * (largest + size);
  constexpr std::array<double, 4> kRoundings = {2.0, 4.0, 8.0, 64.0};
  if (random.chance(0.2)) return std::max(64.0 * rounding, size * random.logUniform(1e-9, 1e-2));
  return kRoundings[static_cast<size_t>(random.below(4))] * rounding;
}

// GCC 12 at -O3 omits this conversion for the last of several numbers in a row unless they must be stored.
double inFloat(double x) {
  const volatile auto kept = static_cast<float>(x);
  return kept;
}

class Builder {
 public:
  Builder(Random& random, SweepCase& sweep, const Eigen::Vector3d& translation)
      : random_(random), sweep_(sweep), size_(extentOf(sweep.tool)), translation_(translation) {}

  // Adds a triangle whose corners are float32 numbers, and moves the tool to it.
  void addTriangleInFloat(double triangle_size) {
    sweep_.triangles.streamed = true;
    choosePoint(largestTranslation(sweep_.motion) + triangle_size);
    const Shape shape = randomShape(random_, point_.outward_M, triangle_size);
    MovedTriangle moved = cornersAbout(shape, position(), randomTranslations(), point_.mesh_fraction);
    for (size_t i = 0; i < 3; ++i) {
      moved.now[i] = moved.now[i].unaryExpr(&inFloat);
      moved.before[i] = moved.before[i].unaryExpr(&inFloat);
    }
    const Eigen::Vector3d shift = (pointOf(shape, moved, point_.mesh_fraction) - position()).cast<double>();
    sweep_.motion.X_MT_start.translation() += shift;
    sweep_.motion.X_MT_end.translation() += shift;
    addIfMet(shape, moved);
  }

  void addTriangles(int count, double triangle_size) {
    const double largest =
        largestTranslation(sweep_.motion) + (sweep_.frame_W ? largestTranslation(*sweep_.frame_W) : 0);
    choosePoint(largest + triangle_size);
    while (count-- > 0) {
      point_ = randomToolPoint(random_, body(), motion(), translation_, sub_motions_, inset_);
      const Shape shape = randomShape(random_, point_.outward_M, triangle_size);
      addIfMet(shape, cornersAbout(shape, position(), randomTranslations(), point_.mesh_fraction));
    }
  }

 private:
  const Body& body() const { return sweep_.tool[body_]; }
  ExactMotion motion() const {
    return sweep_.frame_W ? ExactMotion(RelativeMotion{sweep_.motion, *sweep_.frame_W}) : ExactMotion(sweep_.motion);
  }
  Vector3r position() const { return motion().at(point_.fraction, point_.p_T); }

  // Translations of the corners: that of the mesh, in half of the cases with a small difference.
  std::array<Eigen::Vector3d, 3> randomTranslations() {
    std::array<Eigen::Vector3d, 3> translations = {translation_, translation_, translation_};
    if (translation_.isZero(0.0) || random_.chance(0.5)) return translations;
    const double own = translation_.norm() * random_.logUniform(1e-6, 1.0);
    for (Eigen::Vector3d& translation : translations) translation += own * random_.direction();
    return translations;
  }

  void choosePoint(double largest) {
    body_ = static_cast<size_t>(random_.below(static_cast<int>(sweep_.tool.size())));
    depth_ = static_cast<Real>(randomInset(random_, size_, largest));
    inset_ = hasInset(body(), depth_) ? depth_ : Real{0};
    // A body without interior is grown instead, which also makes the point that deep.
    if (inset_ == 0) sweep_.options.margin = static_cast<double>(depth_);
    sub_motions_ = sweep_.subMotions().size();
    point_ = randomToolPoint(random_, body(), motion(), translation_, sub_motions_, inset_);
  }

  void addIfMet(const Shape& shape, const MovedTriangle& moved) {
    if ((pointOf(shape, moved, point_.mesh_fraction) - position()).norm() >= depth_) return;
    Triangles& triangles = sweep_.triangles;
    const auto triangle = static_cast<std::uint32_t>(triangles.count());
    triangles.corners_M.insert(triangles.corners_M.end(), moved.now.begin(), moved.now.end());
    if (!translation_.isZero(0.0)) {
      triangles.before_M.insert(triangles.before_M.end(), moved.before.begin(), moved.before.end());
    }
    sweep_.contacts.push_back(
        {triangle, static_cast<double>(point_.fraction), static_cast<double>(point_.mesh_fraction)});
  }

  Random& random_;
  SweepCase& sweep_;
  double size_;
  Eigen::Vector3d translation_;  // of the mesh [m]
  size_t body_ = 0;
  size_t sub_motions_ = 1;
  Real depth_ = 0;
  Real inset_ = 0;
  ToolPoint point_;
};

}  // namespace

double randomAngle(Random& random) {
  switch (random.below(8)) {
    case 0:
      return 0.0;
    case 1:
      return random.logUniform(1e-12, 1e-6);
    case 2:
      return M_PI / 2.0;
    case 3:
      return M_PI - random.logUniform(1e-9, 1e-4);
    case 4:
      return M_PI;
    case 5:
      return random.uniform(0.0, M_PI);
    default:
      return random.uniform(0.0, 0.35);
  }
}

SweepCase randomSweep(Random& random) {
  SweepCase sweep;
  const double scale = random.logUniform(1e-6, 1e3);
  sweep.tool = randomBodies(random, scale);
  const double distance = random.chance(0.4) ? scale * random.uniform(0.0, 3.0) : random.logUniform(1e-3, 5e6);
  sweep.motion = randomPath(random, distance * random.direction(), scale);
  if (random.chance(0.5)) sweep.options.max_rotation = random.logUniform(0.02, 1.5);
  return sweep;
}

SweepCase constructedPositives(std::uint64_t seed) {
  Random random(seed);
  SweepCase sweep;
  do {
    sweep = randomSweep(random);
    const double size = extentOf(sweep.tool);
    const double distance = largestTranslation(sweep.motion);
    const double triangle_size = std::min(size * random.logUniform(1e-6, 1e6), 0.3 * (kMaxDistance - distance));
    const bool moves = random.chance(0.3);
    const Eigen::Vector3d translation = size * random.logUniform(1e-6, 3.0) * random.direction();
    Builder builder(random, sweep, moves ? translation : Eigen::Vector3d::Zero());
    if (random.chance(0.5)) {
      builder.addTriangleInFloat(triangle_size);
    } else {
      if (random.chance(0.2)) {
        // Both may be far from the origin of W.
        const Eigen::Vector3d place = (random.chance(0.5) ? 0.0 : random.logUniform(1.0, 1e6)) * random.direction();
        sweep.frame_W = randomPath(random, place, size);
        sweep.motion.X_MT_start.pretranslate(place);
        sweep.motion.X_MT_end.pretranslate(place);
      }
      builder.addTriangles(1 + random.below(8), triangle_size);
    }
  } while (sweep.triangles.count() == 0);
  return sweep;
}

}  // namespace sweep_guard_core::soundness
