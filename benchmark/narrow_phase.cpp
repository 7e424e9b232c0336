// Measures what the narrow phase costs per candidate: a drill that moves like a hand, and triangles around it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "drill.h"
#include "scenes.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

constexpr int kCandidates = 20000;
constexpr double kMaxRotation = 0.17453292519943295;  // 10 degrees [rad]

struct Candidate {
  std::vector<Motion> sub_motions;
  MovingTriangle triangle;
};

struct Drill {
  const ConvexShape& shape_T;
  Eigen::Isometry3d X_MT;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return X_MT * shape_T.supportPoint(X_MT.linear().transpose() * direction);
  }
};

// Triangles of 3 mm up to `away` [mm] from the drill's axis.
std::vector<Candidate> candidates(std::int64_t away, bool turning) {
  Random random(/*seed=*/1);
  std::vector<Candidate> all;
  for (int i = 0; i < kCandidates; ++i) {
    Motion motion = handMotion(random);
    if (!turning) motion.X_MT_end.linear() = motion.X_MT_start.linear();
    const Eigen::Vector3d on_axis = motion.X_MT_start * Eigen::Vector3d(0, 0, random.uniform(-0.1, 0.0));
    const Eigen::Vector3d place = on_axis + random.uniform(0.0, 1e-3 * static_cast<double>(away)) * random.direction();
    Corners corners;
    for (Eigen::Vector3d& p : corners) p = place + 0.003 * random.direction();
    all.push_back({split(motion, kMaxRotation), {corners, corners}});
  }
  return all;
}

template <typename Query>
void measure(benchmark::State& state, const std::vector<Candidate>& all, const Query& query) {
  for ([[maybe_unused]] const auto iteration : state) {
    for (const Candidate& candidate : all) benchmark::DoNotOptimize(query(candidate));
  }
  const auto count = static_cast<double>(all.size());
  state.counters["candidates"] = count;
  state.counters["each"] = {count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

template <typename Query>
void separate(benchmark::State& state, const Query& query) {
  const ConvexShape shape = drill();
  measure(state, candidates(state.range(0), /*turning=*/false), [&](const Candidate& c) {
    const Eigen::Isometry3d& X_MT = c.sub_motions[0].X_MT_start;
    return query(Drill{shape, X_MT}, PointHull(c.triangle.start_M), X_MT.translation() - c.triangle.start_M[0]);
  });
}

enum class Outcome { kMiss, kHit, kOverlappingStart };

void findImpact(benchmark::State& state, Outcome outcome, const std::optional<Eigen::Vector3d>& contact_normal = {}) {
  const ConvexShape shape = drill();
  std::vector<Candidate> some = candidates(state.range(0), state.range(1) != 0);
  const auto differs = [&](const Candidate& c) {
    const std::optional<Impact> impact = timeOfImpact(shape, c.sub_motions, c.triangle, 0.0);
    const Outcome hit = impact && impact->time_of_impact > 0.0 ? Outcome::kHit : Outcome::kOverlappingStart;
    return (impact ? hit : Outcome::kMiss) != outcome;
  };
  some.erase(std::remove_if(some.begin(), some.end(), differs), some.end());
  measure(state, some, [&](const Candidate& c) {
    return timeOfImpact(shape, c.sub_motions, c.triangle, 0.0, contact_normal).has_value();
  });
}

const auto exact = [](const auto& a, const auto& b, const auto& guess) { return separation(a, b, 0.0, guess).gap; };
const auto to_1_nm = [](const auto& a, const auto& b, const auto& guess) { return separation(a, b, 1e-9, guess).gap; };
const auto exceeds_1_mm = [](const auto& a, const auto& b, const auto& guess) {
  return distanceExceeds(a, b, 0.001, guess);
};

BENCHMARK_CAPTURE(separate, exact, exact)->ArgName("mm")->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(separate, to_1_nm, to_1_nm)->ArgName("mm")->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(separate, exceeds_1_mm, exceeds_1_mm)->ArgName("mm")->Arg(20)->Arg(100);

const std::vector<std::vector<std::int64_t>> kArguments = {{20, 100}, {0, 1}};
BENCHMARK_CAPTURE(findImpact, miss, Outcome::kMiss)->ArgNames({"mm", "turning"})->ArgsProduct(kArguments);
BENCHMARK_CAPTURE(findImpact, hit, Outcome::kHit)->ArgNames({"mm", "turning"})->ArgsProduct(kArguments);
BENCHMARK_CAPTURE(findImpact, overlapping_start, Outcome::kOverlappingStart)
    ->ArgNames({"mm", "turning"})
    ->ArgsProduct(kArguments);
BENCHMARK_CAPTURE(findImpact, contact_normal, Outcome::kOverlappingStart, Eigen::Vector3d::UnitZ().eval())
    ->ArgNames({"mm", "turning"})
    ->ArgsProduct(kArguments);

}  // namespace
}  // namespace sweep_guard_core

BENCHMARK_MAIN();
