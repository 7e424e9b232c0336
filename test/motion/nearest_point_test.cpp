#include "sweep_guard/motion/nearest_point.h"

#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>

#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector4d;

constexpr double kPointTolerance = 1e-9;  // in units of the target
constexpr double kMaxRounding = 1.5e-6;   // where normals are nearly dependent

Vector4d unit(RandomScenes& random) {
  return Vector4d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
      .normalized();
}

HalfSpace4 drawHalfSpace(RandomScenes& random, const std::vector<HalfSpace4>& before) {
  const double offset = random.chance(0.3) ? 0.0 : random.logUniform(1e-6, 1.0);
  if (before.empty() || random.chance(0.6)) return {unit(random), offset};
  const HalfSpace4& other = before[random.count(before.size())];
  if (random.chance(0.2)) return other;
  if (random.chance(0.3)) return {-other.normal, offset};
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  return {(side * other.normal + random.logUniform(1e-7, 1e-1) * unit(random)).normalized(), offset};
}

std::vector<HalfSpace4> drawHalfSpaces(RandomScenes& random) {
  std::vector<HalfSpace4> half_spaces;
  const size_t count = random.chance(0.1) ? random.count(200) : random.count(20);
  for (size_t i = 0; i < count; ++i) half_spaces.push_back(drawHalfSpace(random, half_spaces));
  return half_spaces;
}

// Returns by how much the conditions of Karush, Kuhn and Tucker are violated: they prove that a point is nearest.
double optimalityError(const Vector4d& target, const std::vector<HalfSpace4>& half_spaces,
                       const NearestPoint& nearest) {
  double error = 0.0;
  Vector4d gradient = target - nearest.point;
  double largest = 1.0;
  for (size_t i = 0; i < nearest.active.size(); ++i) {
    const HalfSpace4& active = half_spaces[nearest.active[i]];
    const double multiplier = nearest.multipliers[i];
    gradient -= multiplier * active.normal;
    largest = std::max(largest, std::abs(multiplier));
    error = std::max({error, -multiplier / largest, std::abs(active.normal.dot(nearest.point) - active.offset)});
  }
  for (const HalfSpace4& half_space : half_spaces) {
    error = std::max(error, half_space.normal.dot(nearest.point) - half_space.offset);
  }
  return std::max(error, gradient.norm() / largest);
}

TEST(NearestPointTest, FulfillsTheConditionsOfOptimality) {
  RandomScenes random(1);
  const std::uint64_t cases = caseCount(50000);
  std::array<std::uint64_t, 5> active{};
  double worst = 0.0;
  std::uint64_t inexact = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const std::vector<HalfSpace4> half_spaces = drawHalfSpaces(random);
    const Vector4d target = random.logUniform(0.1, 2.0) * unit(random);
    const auto nearest = nearestPoint(target, half_spaces);
    ASSERT_TRUE(nearest) << "case " << i;
    ++active[nearest->active.size()];
    const double error = optimalityError(target, half_spaces, *nearest);
    ASSERT_LT(error, kMaxRounding) << "case " << i;
    inexact += error < kPointTolerance ? 0 : 1;
    worst = std::max(worst, error);
  }
  std::printf("%" PRIu64 " cases, largest error %.2g, %" PRIu64 " above %.0e\n", cases, worst, inexact,
              kPointTolerance);
  EXPECT_LE(inexact, cases / 10000);
  for (const std::uint64_t count : active) EXPECT_GT(count, cases / 1000);
}

}  // namespace
}  // namespace sweep_guard_core
