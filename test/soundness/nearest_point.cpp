#include "soundness/nearest_point.h"

namespace sweep_guard_core::soundness {

// Ericson, Real-Time Collision Detection, 5.1.5.
Vector3r nearestOfTriangle(const std::array<Vector3r, 3>& corners, const Vector3r& p) {
  const auto& [a, b, c] = corners;
  const Vector3r ab = b - a;
  const Vector3r ac = c - a;
  const Real d1 = ab.dot(p - a);
  const Real d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const Real d3 = ab.dot(p - b);
  const Real d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Real d5 = ab.dot(p - c);
  const Real d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const Real sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace sweep_guard_core::soundness
