#include "sweep_guard/haptics/passive_device.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "common/rotation_between.h"
#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Translation3d;
using Eigen::Vector3d;

Instant instantAt(double ms) { return {Time(fromSeconds(5.0 + 1e-3 * ms)), SteadyTime(fromSeconds(1.0 + 1e-3 * ms))}; }

// A hand in a frame that is turned, and twice as large as the device.
TEST(PassiveDeviceTest, ObservesTheEnergyAlongTheAxesAndInTheUnitsOfTheDevice) {
  ForceOptions options;
  options.output_delay = {};
  PassiveDevice device(options, {});
  const Eigen::Matrix3d R_FD(AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
  const auto observe = [&](const Vector3d& p_F, int ms) {
    device.observe({Isometry3d(Translation3d(p_F)), R_FD, 2.0, {instantAt(ms).stamp, instantAt(ms).steady}},
                   instantAt(ms));
  };
  observe(Vector3d::Zero(), 0);
  EXPECT_EQ(device.limit({Vector3d(1.0, 0.0, 0.0), Vector3d::Zero()}, instantAt(0).steady).force_D.x(), 1.0);
  observe(Vector3d(0.0, 4e-4, 0.0), 1);
  EXPECT_NEAR(device.energy(), 1.0 * 2e-4, 1e-12);
}

TEST(PassiveDeviceTest, ATorqueIsLimitedLikeAForce) {
  ForceOptions options;
  options.output_delay = {};
  options.max_torque = 0.1;
  PassiveDevice device(options, {/*max_speed=*/0.5, /*max_acceleration=*/50.0, /*max_turn_rate=*/2.0});
  double torque = 0.1;
  for (int ms = 0; ms < 100; ++ms) {
    const Isometry3d X_FH(AngleAxisd(1e-3 * ms, Vector3d::UnitY()));
    device.observe({X_FH, Eigen::Matrix3d::Identity(), 1.0, {instantAt(ms).stamp, instantAt(ms).steady}},
                   instantAt(ms));
    torque = device.limit({Vector3d::Zero(), Vector3d(0.0, 0.1, 0.0)}, instantAt(ms).steady).torque_D.y();
  }
  EXPECT_LT(torque, 1e-2) << "it turned the hand until nothing was left";
}

// A hand that does its worst within its limits: it turns with the torque that acts, or goes around a cone about it, which does
// work between two positions that are alike, or turns as it likes.
class WorstWrist {
 public:
  WorstWrist(RandomScenes& random, const HandLimits& limits) : random_(random), limits_(limits) {}

  Vector3d turn(const Vector3d& torque_D, double seconds) {
    if (random_.chance(0.01)) choose();
    phase_ += lap_ * seconds;
    const Vector3d along_D = torque_D.stableNormalized();
    Vector3d target = free_;
    if (mode_ == Mode::kAlong) target = along_D;
    if (mode_ == Mode::kAround)
      target = std::cos(phase_) * along_D.unitOrthogonal() + std::sin(phase_) * along_D.cross(along_D.unitOrthogonal());
    const Vector3d change = limits_.max_turn_rate * target - rate_;
    const double most = limits_.max_turn_acceleration * seconds;
    rate_ += std::min(1.0, most / std::max(1e-12, change.norm())) * change;
    const Quaterniond turn(AngleAxisd(seconds * rate_.norm(), rate_.stableNormalized()));
    orientation_ = (turn * orientation_).normalized();
    return seconds * rate_;
  }

  const Quaterniond& orientation() const { return orientation_; }

 private:
  enum class Mode { kAlong, kAround, kFree };

  void choose() {
    mode_ = random_.chance(0.4) ? Mode::kAround : random_.chance(0.7) ? Mode::kAlong : Mode::kFree;
    lap_ = (random_.chance(0.5) ? 1.0 : -1.0) * random_.logUniform(20.0, 2000.0);
    free_ = random_.uniform(-1.0, 1.0) * random_.direction();
  }

  RandomScenes& random_;
  const HandLimits limits_;
  Mode mode_ = Mode::kAlong;
  double lap_ = 100.0;  // [rad/s]
  double phase_ = 0.0;
  Vector3d free_ = Vector3d::Zero();
  Vector3d rate_ = Vector3d::Zero();
  Quaterniond orientation_ = Quaterniond::Identity();
};

// Positions come every so many milliseconds, and late. Returns the largest energy of an axis.
double largestTurnEnergy(RandomScenes& random, const ForceOptions& force, int period, double delay, bool passive) {
  const HandLimits limits;
  PassiveDevice device(force, limits);
  WorstWrist wrist(random, limits);
  std::deque<std::pair<double, Quaterniond>> seen;
  Vector3d wanted = Vector3d::Zero();
  Vector3d energy = Vector3d::Zero();
  double largest = 0.0;
  for (int ms = 0; ms < 400; ++ms) {
    if (ms % period == 0) seen.emplace_back(ms, wrist.orientation());
    for (; !seen.empty() && seen.front().first + delay <= ms; seen.pop_front()) {
      const Instant then = instantAt(seen.front().first);
      device.observe(
          {Isometry3d(seen.front().second), Eigen::Matrix3d::Identity(), 1.0, {then.stamp, instantAt(ms).steady}},
          instantAt(ms));
    }
    if (random.chance(0.02)) wanted = force.max_torque * random.uniform(-1.0, 1.0) * random.direction();
    const Vector3d sent = passive ? device.limit({Vector3d::Zero(), wanted}, instantAt(ms).steady).torque_D : wanted;
    for (int step = 0; step < 10; ++step) {
      energy += sent.cwiseProduct(wrist.turn(sent, 1e-4));
      largest = std::max(largest, energy.maxCoeff());
    }
  }
  return largest;
}

TEST(PassiveDeviceTest, NoHandThatTurnsGetsMoreThanTheToleranceAboutAnyAxis) {
  RandomScenes random(12);
  ForceOptions force;
  force.output_delay = {};
  force.max_torque = 0.1;
  const double tolerance = PassiveDevice(force, {}).turnTolerance();
  int active = 0;
  const std::uint64_t cases = caseCount(300);
  for (std::uint64_t i = 0; i < cases; ++i) {
    const int period = random.chance(0.3) ? 1 : static_cast<int>(random.logUniform(1.0, 60.0));
    const double delay = random.chance(0.5) ? 0.0 : random.uniform(0.0, 50.0);
    ASSERT_LE(largestTurnEnergy(random, force, period, delay, /*passive=*/true), tolerance + 1e-12);
    active += largestTurnEnergy(random, force, period, delay, /*passive=*/false) > tolerance ? 1 : 0;
  }
  EXPECT_GT(active, static_cast<int>(cases / 4)) << "the hand does its worst";
}

constexpr HandLimits kLimits{0.5, 50.0, /*max_turn_rate=*/5.0, /*max_turn_acceleration=*/500.0};

Vector3d rotationVector(const Quaterniond& turn) {
  const AngleAxisd from(turn.normalized());
  return from.angle() * from.axis();
}

struct Turned {
  Vector3d integral = Vector3d::Zero();  // of the turn rate
  Quaterniond orientation = Quaterniond::Identity();

  void step(const Vector3d& rate, double duration) {
    integral += duration * rate;
    const Quaterniond turn(AngleAxisd(duration * rate.norm(), rate.stableNormalized()));
    orientation = turn * orientation;
  }
};

// One lap around a cone turns about its axis by its solid angle, without a turn rate about that axis in the mean of the path.
TEST(ConingBoundTest, AHandThatGoesAroundAConeTurnsMoreThanItsEndsShow) {
  constexpr double kInterval = 0.05;
  constexpr int kParts = 20000;
  Turned turned;
  for (int i = 0; i < kParts; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.5) / kParts;
    turned.step({std::cos(angle), std::sin(angle), 0.0}, kInterval / kParts);
  }
  const Vector3d shown = rotationVector(turned.orientation);
  EXPECT_LT(turned.integral.norm(), 1e-12);
  const double radius = 1.0 * kInterval / (2.0 * M_PI);
  EXPECT_NEAR(shown.norm(), M_PI * radius * radius, 1e-2 * shown.norm());
  EXPECT_LE(shown.norm(), coningBound(shown.norm(), kInterval, kLimits));
}

TEST(ConingBoundTest, IsNothingForTheShortestPath) {
  EXPECT_EQ(coningBound(0.0, 0.0, kLimits), 0.0);
  EXPECT_LT(coningBound(0.3, 0.06, {0.5, 50.0, 5.0, 1e-3}), 1e-6) << "the rate cannot change";
}

TEST(ConingBoundTest, WhereTheHandMayHaveTurnedAllAroundOnlyTheLongestWayIsKnown) {
  EXPECT_DOUBLE_EQ(coningBound(0.1, 2.0, kLimits), 10.1);
}

// Each motion keeps to its limits: the rate goes around, as tightly as the acceleration allows, or after random targets.
TEST(ConingBoundTest, NoMotionTurnsFartherFromWhatItsEndsShow) {
  RandomScenes random(21);
  double closest = 0.0;
  for (std::uint64_t i = 0, cases = caseCount(3000); i < cases; ++i) {
    const double rate = random.logUniform(0.5, 20.0);
    const HandLimits limits{0.5, 50.0, rate, rate * random.logUniform(2.0, 1000.0)};
    const double interval = random.logUniform(1e-3, 0.3);
    constexpr int kParts = 200;
    const double step = interval / kParts;
    const bool around = random.chance(0.3);
    const Quaterniond frame = rotationBetween(Vector3d::UnitZ(), random.direction());
    const double lap = limits.max_turn_acceleration / rate * random.uniform(0.2, 1.0);
    const double changes = random.uniform(0.0, 0.1);
    Vector3d target = rate * random.direction();
    Vector3d w = random.uniform(0.0, 1.0) * target;
    Turned turned;
    for (int k = 0; k < kParts; ++k) {
      if (random.chance(changes)) target = rate * random.direction();
      const Vector3d change = target - w;
      w += std::min(1.0, limits.max_turn_acceleration * step / std::max(1e-12, change.norm())) * change;
      const double angle = lap * step * (k + 0.5);
      turned.step(around ? Vector3d(frame * Vector3d(rate * std::cos(angle), rate * std::sin(angle), 0.0)) : w, step);
    }
    const Vector3d shown = rotationVector(turned.orientation);
    const double deviation = (shown - turned.integral).norm();
    const double bound = coningBound(shown.norm(), interval, limits);
    ASSERT_LE(deviation, (1.0 + 1e-6) * bound + 1e-12);
    closest = std::max(closest, deviation / bound);
  }
  EXPECT_GT(closest, 0.8) << "the bound is not far off";
}

}  // namespace
}  // namespace sweep_guard_core
