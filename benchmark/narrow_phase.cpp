// Prints what the fine phase costs per candidate [us]: a drill that moves as a hand does, and triangles about it.
#include "sweep_guard/detection/time_of_impact.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "microseconds.h"
#include "scenes.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

constexpr int kCandidates = 20000;
constexpr int kRepetitions = 10;
constexpr double kMaxRotation = 0.17453292519943295;  // 10 degrees [rad]

struct Candidate {
  std::vector<Motion> parts;
  MovingTriangle triangle;
};

struct Drill {
  const ConvexShape& shape_T;
  Eigen::Isometry3d X_MT;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return X_MT * shape_T.supportPoint(X_MT.linear().transpose() * direction);
  }
};

ConvexShape drill() { return ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1); }

// Triangles of 3 mm beside the drill's axis, up to `away` [m] from it.
std::vector<Candidate> candidates(double away, bool turning) {
  Random random(/*seed=*/1);
  std::vector<Candidate> all;
  for (int i = 0; i < kCandidates; ++i) {
    Motion motion = handMotion(random);
    if (!turning) motion.X_MT_end.linear() = motion.X_MT_start.linear();
    const Eigen::Vector3d on_axis = motion.X_MT_start * Eigen::Vector3d(0, 0, random.uniform(-0.1, 0.0));
    const Eigen::Vector3d place = on_axis + random.uniform(0.0, away) * random.direction();
    Corners corners;
    for (Eigen::Vector3d& p : corners) p = place + 0.003 * random.direction();
    all.push_back({split(motion, kMaxRotation), {corners, corners}});
  }
  return all;
}

// The least time of several [us], for each of so many.
template <typename Work>
double timePerEach(size_t count, const Work& work) {
  double best = microseconds(work);
  for (int repetition = 1; repetition < kRepetitions; ++repetition) best = std::min(best, microseconds(work));
  return best / static_cast<double>(count);
}

void printSeparation(double away) {
  const ConvexShape shape = drill();
  const std::vector<Candidate> all = candidates(away, /*turning=*/false);
  const auto each = [&](const auto& ask) {
    return timePerEach(all.size(), [&] {
      for (const Candidate& c : all) {
        const Eigen::Isometry3d& X_MT = c.parts[0].X_MT_start;
        ask(Drill{shape, X_MT}, PointHull(c.triangle.start_M), X_MT.translation() - c.triangle.start_M[0]);
      }
    });
  };
  double sum = 0.0;
  const double exact =
      each([&](const Drill& a, const PointHull& b, const auto& n) { sum += separation(a, b, 0, n).gap; });
  const double rough =
      each([&](const Drill& a, const PointHull& b, const auto& n) { sum += separation(a, b, 1e-9, n).gap; });
  const double farther = each(
      [&](const Drill& a, const PointHull& b, const auto& n) { sum += distanceExceeds(a, b, 0.001, n) ? 1.0 : 0.0; });
  std::printf("separation, up to %3.0f mm: exact %.2f, to 1 nm %.2f, farther apart than 1 mm %.2f%s\n", 1e3 * away,
              exact, rough, farther, sum == 0.0 ? " (nothing)" : "");
}

// Misses, hits and overlapping starts apart.
void printImpacts(double away, bool turning) {
  const ConvexShape shape = drill();
  std::vector<Candidate> misses;
  std::vector<Candidate> hits;
  std::vector<Candidate> starts;
  for (const Candidate& c : candidates(away, turning)) {
    const std::optional<Impact> impact = timeOfImpact(shape, c.parts, c.triangle, 0.0);
    (!impact ? misses : impact->time_of_impact > 0.0 ? hits : starts).push_back(c);
  }
  std::printf("first impact, %s, up to %3.0f mm:", turning ? "turning" : "straight", 1e3 * away);
  const auto print = [&](const char* what, const std::vector<Candidate>& some, const auto& contact_normal) {
    if (some.empty()) return;
    double sum = 0.0;
    const double time = timePerEach(some.size(), [&] {
      for (const Candidate& c : some) sum += timeOfImpact(shape, c.parts, c.triangle, 0.0, contact_normal) ? 1.0 : 0.0;
    });
    std::printf("  %s %.2f (%zu%s)", what, time, some.size(), sum < 0.0 ? "!" : "");
  };
  print("miss", misses, std::nullopt);
  print("hit", hits, std::nullopt);
  print("overlapping start", starts, std::nullopt);
  print("the same with its way in", starts, std::optional<Eigen::Vector3d>(Eigen::Vector3d::UnitZ()));
  std::printf("\n");
}

}  // namespace
}  // namespace sweep_guard_core

int main() {
  std::printf("us per candidate (number of candidates)\n");
  for (const double away : {0.02, 0.1}) sweep_guard_core::printSeparation(away);
  for (const double away : {0.02, 0.1}) {
    for (const bool turning : {false, true}) sweep_guard_core::printImpacts(away, turning);
  }
  return 0;
}
