#include "soundness/depth_images.h"

#include <cmath>
#include <limits>
#include <optional>

#include "soundness/real.h"

namespace sweep_guard_core::soundness {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr Real kNone = std::numeric_limits<Real>::infinity();

struct Thing {
  enum class Kind { kPlane, kSphere, kBox };

  Kind kind = Kind::kPlane;
  Isometry3d X_FS = Isometry3d::Identity();  // at the first image; a plane is z = 0 of S
  Vector3d half = Vector3d::Zero();          // of a box; x is the radius of a sphere [m]
  Vector3d velocity_F = Vector3d::Zero();    // [m/s]
  double appears = -1.0;                     // [s] after the first image
  double leaves = 1.0;
};

Thing randomPlane(Random& random, const Isometry3d& X_FC, double z) {
  Thing thing;
  Isometry3d X_CS = placedAt(0.0, 0.0, z);
  X_CS.linear() = random.turn(random.uniform(0.0, random.chance(0.3) ? 1.4 : 0.5));
  thing.X_FS = X_FC * X_CS;
  return thing;
}

Vector3d velocity(Random& random, const Vector3d& along_F) {
  const double speed = random.logUniform(0.05, 5.0);
  const int kind = random.below(3);
  if (kind == 0) return Vector3d::Zero();
  if (kind == 1) return (random.chance(0.7) ? -speed : speed) * along_F;
  return speed * random.direction().cross(along_F);
}

Thing randomThing(Random& random, const Isometry3d& X_FC, double tangent) {
  Thing thing;
  thing.kind = random.chance(0.5) ? Thing::Kind::kSphere : Thing::Kind::kBox;
  for (double& half : thing.half) half = random.logUniform(0.01, 0.25);
  const double z = random.uniform(0.3, 2.0);
  const Vector3d p_C = z * Vector3d(random.uniform(-tangent, tangent), random.uniform(-tangent, tangent), 1.0);
  thing.X_FS = random.pose(X_FC * p_C);
  thing.velocity_F = velocity(random, X_FC.linear() * p_C.normalized());
  if (random.chance(0.15)) thing.appears = random.uniform(0.0, 0.1);
  if (random.chance(0.15)) thing.leaves = random.uniform(0.0, 0.1);
  return thing;
}

std::vector<Thing> randomThings(Random& random, const DepthImages& camera) {
  const Isometry3d& X_FC = camera.images.front().X_FC;
  std::vector<Thing> things;
  for (int count = 1 + random.below(2); count > 0; --count)
    things.push_back(randomPlane(random, X_FC, random.uniform(0.4, 3.5)));
  if (random.chance(0.3)) things.front().velocity_F = random.uniform(-2.0, 2.0) * X_FC.linear().col(2);
  for (int count = random.below(5); count > 0; --count)
    things.push_back(randomThing(random, X_FC, 0.6 * camera.width / camera.camera.fx));
  return things;
}

Real hitPlane(const Vector3r& from, const Vector3r& along) {
  const Real t = -from.z() / along.z();
  return t > 0 ? t : kNone;
}

Real hitSphere(const Vector3r& from, const Vector3r& along, Real radius) {
  const Real a = along.squaredNorm();
  const Real b = from.dot(along);
  const Real root = b * b - a * (from.squaredNorm() - radius * radius);
  const Real t = root < 0 ? kNone : (-b - std::sqrt(root)) / a;
  return t > 0 ? t : kNone;
}

Real hitBox(const Vector3r& from, const Vector3r& along, const Vector3r& half) {
  Real first = 0;
  Real last = kNone;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Real one = (-half[i] - from[i]) / along[i];
    const Real other = (half[i] - from[i]) / along[i];
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first > 0 && first <= last ? first : kNone;
}

// A thing as it is at one moment, seen by the camera.
struct Target {
  Target(const Thing& thing_in, const Isometry3d& X_FC, double seconds) : thing(&thing_in) {
    Isometry3d X_FS = thing->X_FS;
    X_FS.translation() += seconds * thing->velocity_F;
    const Matrix3r R_SF = X_FS.linear().transpose().cast<Real>();
    from = R_SF * (X_FC.translation() - X_FS.translation()).cast<Real>();
    R_SC = R_SF * X_FC.linear().cast<Real>();
  }

  Real depth(const Vector3r& ray_C) const {
    const Vector3r along = R_SC * ray_C;
    if (thing->kind == Thing::Kind::kPlane) return hitPlane(from, along);
    if (thing->kind == Thing::Kind::kSphere) return hitSphere(from, along, static_cast<Real>(thing->half.x()));
    return hitBox(from, along, thing->half.cast<Real>());
  }

  const Thing* thing;
  Vector3r from;
  Matrix3r R_SC;
};

struct Errors {
  double noise;  // [m] at 1 m
  double unit;   // [m]; 0: depths are not rounded
  double steps;  // share of pixels that are off by much

  float seen(Random& random, Real depth) const {
    if (depth == kNone || random.chance(0.05)) return std::numeric_limits<float>::quiet_NaN();
    auto z = static_cast<double>(depth);
    z += noise * z * z * (random.uniform(-1.0, 1.0) + random.uniform(-1.0, 1.0));
    if (steps > 0.0 && random.chance(steps)) z += random.uniform(-0.3, 0.3);
    if (unit > 0.0) z = unit * std::round(z / unit);
    return static_cast<float>(z);
  }
};

void render(Random& random, const std::vector<Thing>& things, const Errors& errors, const DepthImages& camera,
            DepthImages::Image& image) {
  const double seconds = toSeconds(image.stamp - camera.images.front().stamp);
  std::vector<Target> targets;
  for (const Thing& thing : things) {
    if (thing.appears <= seconds && seconds <= thing.leaves) targets.emplace_back(thing, image.X_FC, seconds);
  }
  const auto& [fx, fy, cx, cy] = camera.camera;
  for (std::uint32_t v = 0; v < camera.height; ++v) {
    for (std::uint32_t u = 0; u < camera.width; ++u) {
      const Vector3r ray_C((static_cast<Real>(u) - static_cast<Real>(cx)) / static_cast<Real>(fx),
                           (static_cast<Real>(v) - static_cast<Real>(cy)) / static_cast<Real>(fy), 1);
      Real nearest = kNone;
      for (const Target& target : targets) nearest = std::min(nearest, target.depth(ray_C));
      image.depths.push_back(errors.seen(random, nearest));
    }
  }
}

DepthImages randomCamera(Random& random) {
  DepthImages camera;
  camera.width = 32 + static_cast<std::uint32_t>(random.below(random.chance(0.2) ? 129 : 49));
  camera.height = static_cast<std::uint32_t>(camera.width * random.uniform(0.5, 1.0));
  camera.camera.fx = camera.width * random.uniform(0.6, 1.4);
  camera.camera.fy = camera.camera.fx * random.uniform(0.9, 1.1);
  camera.camera.cx = camera.width * random.uniform(0.4, 0.6);
  camera.camera.cy = camera.height * random.uniform(0.4, 0.6);
  camera.options.nearest = random.uniform(0.05, 0.4);
  camera.options.farthest = random.uniform(2.0, 4.0);
  camera.options.margin = {random.chance(0.2) ? 0.0 : random.logUniform(1e-4, 0.02), random.logUniform(1e-4, 0.01)};
  camera.options.surface_speed = random.chance(0.1) ? 0.0 : random.logUniform(0.2, 5.0);
  return camera;
}

}  // namespace

DepthImages renderedImages(Random& random) {
  DepthImages camera = randomCamera(random);
  const bool moves = random.chance(0.25);
  const Errors errors{random.chance(0.3) ? 0.0 : random.logUniform(1e-4, 5e-3), random.chance(0.5) ? 0.001 : 0.0,
                      random.chance(0.7) ? 0.0 : 0.02};
  DepthImages::Image image{Time(std::chrono::seconds(100)), random.pose(random.inBox({2.0, 2.0, 2.0})), {}};
  for (int count = 2 + random.below(3); count > 0; --count) {
    camera.images.push_back(image);
    image.stamp += fromSeconds(random.uniform(0.01, 0.06));
    if (!moves || random.chance(0.3)) continue;
    image.X_FC.translation() += random.inBox({0.02, 0.02, 0.02});
    image.X_FC.linear() = image.X_FC.linear() * random.turn(random.uniform(0.0, 0.03));
  }
  const std::vector<Thing> things = randomThings(random, camera);
  for (DepthImages::Image& each : camera.images) render(random, things, errors, camera, each);
  return camera;
}

}  // namespace sweep_guard_core::soundness
