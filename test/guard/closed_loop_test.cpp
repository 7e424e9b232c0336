// A tool moves at constant velocity; the guard sees poses as they come, and is asked for its warning at every pose and
// every tick, as in the node.
#include <gtest/gtest.h>

#include <cmath>

#include "detection/reference_detector.h"
#include "guard/guard_results.h"
#include "monitor/warnings.h"
#include "scenes.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr auto kTick = 15ms;
const ConvexShape kLongDrill = ConvexShape::cylinder(0.005, 0.1);

struct Approach {
  Eigen::Isometry3d X_WT;    // at time 0
  Eigen::Vector3d velocity;  // [m/s]
  Eigen::Vector3d turn;      // [rad/s]

  Eigen::Isometry3d at(Duration time) const {
    Eigen::Isometry3d X = X_WT;
    X.translation() += toSeconds(time) * velocity;
    X.linear() = Eigen::AngleAxisd(toSeconds(time) * turn.norm(), turn.normalized()) * X_WT.linear();
    return X;
  }
};

// A wall of two triangles through the origin, kilometres wide.
struct Wall {
  Eigen::Vector3d normal_W;  // towards the tool
  std::shared_ptr<const Workpiece> workpiece;
  Eigen::Isometry3d X_WM;

  // Of the nearest point of the tool; negative: beyond.
  double distance(const Eigen::Isometry3d& X_WT) const { return -support(kLongDrill, X_WT, -normal_W); }
};

Wall wall(Random& random) {
  const TriangleMesh mesh({{-512, -512, 0}, {512, -512, 0}, {512, 512, 0}, {-512, 512, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Eigen::Isometry3d X_WM = random.pose({0, 0, 0});
  return {X_WM.linear().col(2),
          std::make_shared<const Workpiece>(Workpiece{"wall", 1, Time(), SteadyTime(), "table", mesh}), X_WM};
}

// The first contact, to a nanosecond; the tool comes nearer all the time.
Duration timeOfContact(const Approach& approach, const Wall& wall) {
  Duration lower = 0ms;
  Duration upper = 10min;
  for (Duration time = 0ms; time < upper; time += 1ms) {
    if (wall.distance(approach.at(time)) > 0.0) {
      lower = time;
    } else {
      upper = time;
    }
  }
  while (upper - lower > 1ns) {
    const Duration middle = lower + (upper - lower) / 2;
    (wall.distance(approach.at(middle)) > 0.0 ? lower : upper) = middle;
  }
  return upper;
}

// Starts 3.1 to 3.4 s before it meets the wall: 2 s of motion before the warning of the considered interval is due.
Approach approachTo(const Wall& wall, Random& random) {
  const double speed = random.logUniform(0.02, 1.0);
  Eigen::Vector3d direction = random.direction();
  if (direction.dot(wall.normal_W) > 0.0) direction = -direction;
  if (direction.dot(wall.normal_W) > -0.2) direction -= 0.3 * wall.normal_W;
  Approach approach{random.pose({0, 0, 0}), speed * direction.normalized(), random.direction()};
  approach.turn *= random.chance(0.5) ? random.logUniform(0.01, 1.0) : 1e-12;
  const double distance = -approach.velocity.dot(wall.normal_W) * random.uniform(3.1, 3.4);
  const double reach = -wall.distance(approach.at(3250ms)) - approach.velocity.dot(wall.normal_W) * 3.25;
  approach.X_WT.translation() = (distance + reach) * wall.normal_W + random.inBox({1, 1, 1});
  approach.X_WT.translation() += (distance + reach - approach.X_WT.translation().dot(wall.normal_W)) * wall.normal_W;
  return approach;
}

struct Alarms {
  std::optional<Duration> considered;  // of CONSIDERED or more
  std::optional<Duration> reflex;      // of REFLEX or more
  std::optional<Duration> contact;
  WarningLevel last = WarningLevel::kUnknown;

  void note(Duration time, WarningLevel level) {
    last = level;
    if (level >= WarningLevel::kConsidered && !considered) considered = time;
    if (level >= WarningLevel::kReflex && !reflex) reflex = time;
    if (level == WarningLevel::kContact && !contact) contact = time;
  }
};

class Loop {
 public:
  Loop(const std::string& predictor, double min_probability, const Wall& wall, Duration hold_time = 500ms)
      : wall_(wall),
        guard_(Tool(kLongDrill), std::make_unique<ReferenceDetector>(), optionsFor(predictor)),
        monitor_(limits(min_probability, hold_time)) {
    monitor_.setWorkpieces({wall.workpiece});
  }

  // A pose that is received `latency` after its time.
  void pose(Duration time, Duration latency, const Eigen::Isometry3d& X_WT, bool sweep, bool predict) {
    const Instant came = instant(time + latency);
    const Timestamps timestamps{instant(time).stamp, came.steady};
    const WarningMonitor::Checkpoint checkpoint = monitor_.checkpoint();
    const Workpieces all = {wall_.workpiece};
    const PoseWithFrames pose{timestamps.stamp, timestamps.received, X_WT, {{"table", wall_.X_WM}}};
    monitor_.swept(reportOf(guard_, pose, sweep ? all : Workpieces()), timestamps, checkpoint, came.steady);
    if (predict) monitor_.predicted(predictionOf(guard_, age(timestamps, came), all), timestamps, checkpoint, came);
  }

  void tick(Duration time) { alarms.note(time, warningOf(monitor_, instant(time)).level); }
  Warning warning(Duration time) const { return warningOf(monitor_, instant(time)); }

  Alarms alarms;

 private:
  static Instant instant(Duration time) { return {Time(100s + time), SteadyTime(100s + time)}; }

  static GuardOptions optionsFor(const std::string& predictor) {
    GuardOptions options;
    options.predictor.predictor = predictor;
    options.clock = [] { return SteadyTime(); };
    return options;
  }

  static WarningLimits limits(double min_probability, Duration hold_time) {
    WarningLimits limits{100ms, Duration::max(), hold_time};
    limits.tick = kTick;
    limits.thresholds = WarningThresholds::ofMinProbability(min_probability);
    return limits;
  }

  Wall wall_;
  Guard guard_;
  WarningMonitor monitor_;
};

struct Episode {
  double rate;    // [Hz]
  double jitter;  // of the period
  Duration latency;
};

// Where nothing is due, it is enough to predict ahead now and then, and not to sweep: that would take the time.
constexpr auto kNear = 1300ms;
bool predictionIsUseful(Duration left, Duration since_last) {
  const bool soon = (left < 1110ms && left > 1000ms) || (left < 160ms && left > 50ms);
  return since_last >= (soon ? 20ms : 400ms);
}

// Runs until the contact is reported.
Alarms run(const std::string& predictor, const Approach& approach, const Wall& wall, Duration contact,
           const Episode& episode, Random& random) {
  Loop loop(predictor, /*min_probability=*/1.0, wall);
  Duration now = 0ms;
  Duration next_pose = 0ms;
  Duration next_tick = 0ms;
  Duration predicted = -10s;
  while (now < contact + 200ms && !loop.alarms.contact) {
    if (next_pose + episode.latency <= next_tick) {
      now = next_pose + episode.latency;
      const bool predict = predictionIsUseful(contact - now, now - predicted);
      loop.pose(next_pose, episode.latency, approach.at(next_pose), contact - now < kNear, predict);
      if (predict) predicted = now;
      const double period = random.uniform(1.0 - episode.jitter, 1.0 + episode.jitter) / episode.rate;
      next_pose += fromSeconds(period);
    } else {
      now = next_tick;
      next_tick += kTick;
    }
    loop.tick(now);
  }
  return loop.alarms;
}

struct Subject {
  const char* predictor;
  double percent;  // of the episodes, unless more are asked for
};
void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.predictor; }

class ClosedLoopTest : public testing::TestWithParam<Subject> {};

// The path alone warns here, however small the doubt about it. 2 s of motion come before the warning is due.
TEST_P(ClosedLoopTest, WarnsInTimeOfEveryWallOnThePathOfASteadyTool) {
  Random random(7);
  const int episodes = sceneCount(1000, GetParam().percent);
  for (int i = 0; i < episodes; ++i) {
    const Wall ahead = wall(random);
    Approach approach = approachTo(ahead, random);
    Duration contact = timeOfContact(approach, ahead);
    while (contact < 3050ms) {  // it turns into the wall
      approach = approachTo(ahead, random);
      contact = timeOfContact(approach, ahead);
    }
    const Episode episode{random.logUniform(15.0, 1000.0), random.uniform(0.0, 0.2),
                          fromSeconds(random.uniform(0.0, 0.01))};
    SCOPED_TRACE("episode " + std::to_string(i) + " at " + std::to_string(episode.rate) + " Hz");
    const Alarms alarms = run(GetParam().predictor, approach, ahead, contact, episode, random);
    ASSERT_TRUE(alarms.contact && alarms.reflex && alarms.considered);
    EXPECT_GE(contact - *alarms.reflex, 100ms);
    EXPECT_GE(contact - *alarms.considered, 1000ms);
    const double farthest = ahead.distance(approach.at(contact - 1030ms)) + 0.004;  // the box is not round
    EXPECT_LE(ahead.distance(approach.at(*alarms.considered)), farthest);
  }
}

INSTANTIATE_TEST_SUITE_P(Predictors, ClosedLoopTest,
                         testing::Values(Subject{"constant_velocity", 10}, Subject{"polynomial", 5},
                                         Subject{"direct", 5}),
                         [](const auto& test) { return std::string(test.param.predictor); });

// Straight up or down, at 100 Hz; nothing else moves.
class VerticalTest : public testing::Test {
 protected:
  explicit VerticalTest(Duration hold_time = 500ms)
      : loop_("constant_velocity", /*min_probability=*/0.1, floor(), hold_time) {}

  // @param z  of the tip over the wall [m], by time [s]
  void follow(double from, double to, const std::function<Eigen::Vector3d(double)>& tip,
              const std::function<void(double, const Warning&)>& check) {
    for (double time = from; time < to; time += 0.01) {
      const Duration now = fromSeconds(time);
      Eigen::Isometry3d X_WT(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
      X_WT.translation() = tip(time);
      loop_.pose(now, 0ms, X_WT, /*sweep=*/true, /*predict=*/true);
      check(time, loop_.warning(now));
    }
  }

  static Wall floor() {
    Random random(1);
    Wall floor = wall(random);
    floor.X_WM = Eigen::Isometry3d::Identity();
    floor.normal_W = Eigen::Vector3d::UnitZ();
    return floor;
  }

  Loop loop_;
};

class VerticalTestWithoutHold : public VerticalTest {
 protected:
  VerticalTestWithoutHold() : VerticalTest(0ms) {}
};

// Down at 0.1 m/s, contact at 3 s. The threshold is low: doubt alone warns before the path does. Nothing is held.
TEST_F(VerticalTestWithoutHold, AWarningOfASteadyToolNeverFallsAndComesNearerEvenly) {
  WarningLevel before = WarningLevel::kUnknown;
  std::optional<double> left_before;
  follow(
      0.0, 3.0, [](double time) { return Eigen::Vector3d(0, 0, 0.1 * (3.0 - time)); },
      [&](double time, const Warning& warning) {
        if (time < 0.02) return;  // no motion yet
        ASSERT_GE(warning.level, before) << time;
        before = warning.level;
        if (warning.level == WarningLevel::kReflex) {
          ASSERT_LE(3.0 - time, 0.2);
        }
        if (!warning.time_to_collision) return;
        const double left = toSeconds(*warning.time_to_collision);
        if (left_before) {
          ASSERT_LE(left, *left_before + 0.03) << time;
        }
        left_before = left;
      });
  EXPECT_GE(before, WarningLevel::kReflex);
}

TEST_F(VerticalTest, AToolThatLeavesIsNotWarnedOf) {
  follow(
      0.0, 2.0, [](double time) { return Eigen::Vector3d(0, 0, 0.01 + 0.1 * time); },
      [](double time, const Warning& warning) {
        if (time < 0.02) return;  // no motion yet
        ASSERT_EQ(warning.level, WarningLevel::kClear) << time << ": " << warning.text;
      });
}

TEST_F(VerticalTest, AToolThatPassesByIsNotWarnedOf) {
  follow(
      0.0, 2.0, [](double time) { return Eigen::Vector3d(0.1 * time, 0, 0.1); },
      [](double time, const Warning& warning) {
        if (time < 0.02) return;
        ASSERT_EQ(warning.level, WarningLevel::kClear) << time << ": " << warning.text;
      });
}

// Down at 0.1 m/s to 2 cm over the wall, and up again.
TEST_F(VerticalTest, AToolThatTurnsBackIsWarnedOfUntilTheHoldTimeIsOver) {
  const auto tip = [](double time) { return Eigen::Vector3d(0, 0, 0.02 + 0.1 * std::abs(time - 3.0)); };
  bool warned = false;
  double last = 0.0;
  follow(0.0, 5.0, tip, [&](double time, const Warning& warning) {
    ASSERT_NE(warning.level, WarningLevel::kContact);
    if (time > 2.25 && time < 3.0) {
      ASSERT_GE(warning.level, WarningLevel::kConsidered) << time;
    }
    if (warning.level < WarningLevel::kConsidered) return;
    warned = true;
    last = time;
  });
  EXPECT_TRUE(warned);
  EXPECT_LT(last, 3.0 + 0.5 + 0.15) << "warned until then";
}

}  // namespace
}  // namespace sweep_guard_core
