#include <CGAL/Gmpq.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <array>

#include "soundness/oracle.h"

namespace sweep_guard_core::soundness {
namespace {

using Rational = CGAL::Gmpq;
using Vector = std::array<Rational, 3>;
using Program = CGAL::Quadratic_program<Rational>;

Vector exact(const Eigen::Vector3d& v) { return {Rational(v.x()), Rational(v.y()), Rational(v.z())}; }

Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector inBox(const TriangleMesh& mesh_M, std::uint32_t vertex, const OrientedBox& box) {
  const Vector origin = exact(mesh_M.origin());
  const Vector offset = exact(mesh_M.offset(vertex));
  const Vector center = exact(box.X_MB.translation());
  const Vector p = {origin[0] + offset[0] - center[0], origin[1] + offset[1] - center[1],
                    origin[2] + offset[2] - center[2]};
  return {dot(exact(box.X_MB.linear().col(0)), p), dot(exact(box.X_MB.linear().col(1)), p),
          dot(exact(box.X_MB.linear().col(2)), p)};
}

}  // namespace

bool meetsByLinearProgram(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M,
                          double growth) {
  // The unknowns are the weights of the corners: >= 0, with sum 1.
  Program program(CGAL::SMALLER, /*default_l=*/true, Rational(0), /*default_u=*/false, Rational(0));
  int row = 0;
  for (int i = 0; i < 3; ++i) program.set_a(i, row, Rational(1));
  program.set_b(row, Rational(1));
  program.set_r(row, CGAL::EQUAL);
  std::array<Vector, 3> corners_B;
  for (size_t i = 0; i < 3; ++i) corners_B[i] = inBox(mesh_M, mesh_M.triangles()[triangle][i], swept_M.box);
  for (const HalfSpace& half_space : swept_M.halfSpaces_B()) {
    ++row;
    const Vector normal = exact(half_space.normal());
    for (int i = 0; i < 3; ++i) program.set_a(i, row, dot(normal, corners_B[static_cast<size_t>(i)]));
    program.set_b(row, Rational(half_space.offset()) + Rational(growth));
  }
  return !CGAL::solve_linear_program(program, Rational()).is_infeasible();
}

}  // namespace sweep_guard_core::soundness
