#include "soundness/body.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard::soundness {

bool hasInset(const Body& body, Real inset) {
  return inset <= static_cast<Real>(body.radius) && 2 * inset <= static_cast<Real>(body.length);
}

Vector3r support(const Body& body, const Vector3r& direction_T, Real inset) {
  const Real across = std::hypot(direction_T.x(), direction_T.y());
  const Real radius = across == 0 ? Real{0} : (static_cast<Real>(body.radius) - inset) / across;
  const Real z = direction_T.z() < 0 ? inset - static_cast<Real>(body.length) : -inset;
  return {radius * direction_T.x(), radius * direction_T.y(), z};
}

Real depth(const Body& body, const Vector3r& p_T) {
  const Real radial = static_cast<Real>(body.radius) - std::hypot(p_T.x(), p_T.y());
  return std::min({radial, -p_T.z(), p_T.z() + static_cast<Real>(body.length)});
}

Vector3r nearest(const Body& body, const Vector3r& p_T) {
  const Real across = std::hypot(p_T.x(), p_T.y());
  const Real scale = across > static_cast<Real>(body.radius) ? static_cast<Real>(body.radius) / across : Real{1};
  return {scale * p_T.x(), scale * p_T.y(), std::clamp(p_T.z(), -static_cast<Real>(body.length), Real{0})};
}

double extentOf(const Bodies& bodies) {
  double extent = 0.0;
  for (const Body& body : bodies) extent = std::max(extent, std::hypot(body.radius, body.length));
  return extent;
}

Body scaled(Body body, double scale) {
  body.radius *= scale;
  body.length *= scale;
  return body;
}

Body enlarged(Body body, double more) {
  body.radius += more;
  body.length += more;
  return body;
}

Tool toolOf(const Bodies& bodies) {
  const Body& body = bodies.front();
  return Tool::cylinder(body.radius, body.length, body.sides);
}

Bodies randomBodies(Random& random, double scale) {
  Body body;
  const int kind = random.below(8);
  body.radius = kind == 0 ? 0.0 : scale * random.logUniform(0.01, 1.0);
  body.length = kind == 1 ? 0.0 : scale * random.logUniform(0.01, 1.0);
  body.sides = 3 + random.below(14);
  return {body};
}

}  // namespace sweep_guard::soundness
