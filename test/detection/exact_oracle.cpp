#include "detection/exact_oracle.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace sweep_guard_core {
namespace {

// Wide enough for products of nine doubles; throws if it were not.
using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<4096, 4096, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::checked, void>,
    boost::multiprecision::et_off>;
using Vector = std::array<Integer, 3>;

constexpr int kBits = 300;  // a double is an integer of 2^-kBits

Integer exact(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  Integer integer = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + kBits;
  if (integer != 0 && shift < 0) throw std::domain_error("exact oracle: a number below 2^-247");
  return integer * pow(Integer(2), static_cast<unsigned>(std::max(shift, 0)));
}

Vector exact(const Eigen::Vector3d& v) { return {exact(v.x()), exact(v.y()), exact(v.z())}; }

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Integer dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// a u + b v <= c
struct Inequality {
  Integer a;
  Integer b;
  Integer c;
};

// At u = u_times_w / w, v = v_times_w / w; w > 0.
bool holds(const Inequality& inequality, const Integer& u_times_w, const Integer& v_times_w, const Integer& w) {
  return inequality.a * u_times_w + inequality.b * v_times_w <= inequality.c * w;
}

bool allHold(const std::vector<Inequality>& inequalities, const Integer& u_times_w, const Integer& v_times_w,
             const Integer& w) {
  return std::all_of(inequalities.begin(), inequalities.end(),
                     [&](const Inequality& inequality) { return holds(inequality, u_times_w, v_times_w, w); });
}

// A bounded region that is not empty has a corner: there two of the inequalities are equalities.
bool solvable(const std::vector<Inequality>& inequalities) {
  for (size_t i = 0; i < inequalities.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Inequality& p = inequalities[i];
      const Inequality& q = inequalities[j];
      Integer w = p.a * q.b - q.a * p.b;
      if (w == 0) continue;
      Integer u_times_w = p.c * q.b - q.c * p.b;
      Integer v_times_w = p.a * q.c - q.a * p.c;
      if (w < 0) {
        w = -w;
        u_times_w = -u_times_w;
        v_times_w = -v_times_w;
      }
      if (allHold(inequalities, u_times_w, v_times_w, w)) return true;
    }
  }
  return false;
}

}  // namespace

bool meetsExactly(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M, double growth) {
  const Eigen::Matrix3d& R_MB = swept_M.box.X_MB.linear();
  const Vector center = exact(swept_M.box.X_MB.translation());
  std::array<Vector, 3> corners_B;  // in units of 2^-2kBits
  for (size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = mesh_M.triangles()[triangle][i];
    const Vector from_center = exact(mesh_M.origin()) + exact(mesh_M.offset(vertex)) - center;
    for (int axis = 0; axis < 3; ++axis) {
      corners_B[i][static_cast<size_t>(axis)] = dot(exact(R_MB.col(axis)), from_center);
    }
  }

  std::vector<Inequality> inequalities = {{-1, 0, 0}, {0, -1, 0}, {1, 1, 1}};
  for (const HalfSpace& half_space : swept_M.halfSpaces_B()) {
    const Vector normal = exact(half_space.normal());
    const Integer offset = (exact(half_space.offset()) + exact(growth)) * pow(Integer(2), 2 * kBits);
    const Integer at_first = dot(normal, corners_B[0]);
    Inequality inequality{dot(normal, corners_B[1] - corners_B[0]), dot(normal, corners_B[2] - corners_B[0]),
                          offset - at_first};
    const bool none_inside = !holds(inequality, 0, 0, 1) && !holds(inequality, 1, 0, 1) && !holds(inequality, 0, 1, 1);
    if (none_inside) return false;
    inequalities.push_back(std::move(inequality));
  }
  return allHold(inequalities, 0, 0, 1) || allHold(inequalities, 1, 0, 1) || allHold(inequalities, 0, 1, 1) ||
         solvable(inequalities);
}

}  // namespace sweep_guard_core
