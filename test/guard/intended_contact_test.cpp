// A drill of two links goes into a slab with edges of 1 mm.
#include "guard/intended_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "guard/guard_results.h"
#include "guard/intention_store.h"
#include "monitor/warnings.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr int kSheetCells = 48;      // of 1 mm, along both sides
constexpr double kThickness = 0.06;  // [m]
constexpr double kHole = 0.015;      // radius of the region [m]
constexpr double kDepth = 0.012;     // allowed [m]
constexpr double kBit = 0.002;       // radius [m]
constexpr double kBitLength = 0.04;  // with its cone [m]
constexpr double kCone = 0.003;      // [m]

using Lift = std::function<double(double x, double y)>;  // of the upper side [m]

// A closed slab below z = 0, with its upper side lifted. The middle of the upper side is the origin.
std::vector<Eigen::Vector3d> slabVertices(const Lift& lift) {
  std::vector<Eigen::Vector3d> vertices;
  for (const bool upper : {true, false}) {
    for (int j = 0; j <= kSheetCells; ++j) {
      for (int i = 0; i <= kSheetCells; ++i) {
        const double x = 1e-3 * (i - kSheetCells / 2);
        const double y = 1e-3 * (j - kSheetCells / 2);
        vertices.emplace_back(x, y, upper ? lift(x, y) : -kThickness);
      }
    }
  }
  return vertices;
}

std::vector<Triangle> slabTriangles() {
  const auto at = [](bool upper, int i, int j) {
    return static_cast<std::uint32_t>((upper ? 0 : (kSheetCells + 1) * (kSheetCells + 1)) + j * (kSheetCells + 1) + i);
  };
  std::vector<Triangle> triangles;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (int j = 0; j < kSheetCells; ++j) {
    for (int i = 0; i < kSheetCells; ++i) {
      quad(at(true, i, j), at(true, i + 1, j), at(true, i + 1, j + 1), at(true, i, j + 1));
      quad(at(false, i, j), at(false, i, j + 1), at(false, i + 1, j + 1), at(false, i + 1, j));
    }
  }
  for (int i = 0; i < kSheetCells; ++i) {
    quad(at(false, i, 0), at(false, i + 1, 0), at(true, i + 1, 0), at(true, i, 0));
    quad(at(false, i + 1, kSheetCells), at(false, i, kSheetCells), at(true, i, kSheetCells),
         at(true, i + 1, kSheetCells));
    quad(at(false, 0, i + 1), at(false, 0, i), at(true, 0, i), at(true, 0, i + 1));
    quad(at(false, kSheetCells, i), at(false, kSheetCells, i + 1), at(true, kSheetCells, i + 1),
         at(true, kSheetCells, i));
  }
  return triangles;
}

const TriangleMesh& slab() {
  static const TriangleMesh mesh(slabVertices([](double, double) { return 0.0; }), slabTriangles());
  return mesh;
}

// Tip at the origin, z out of the tip: a cone and a cylinder are the bit, behind it is the shaft.
Tool drill() {
  std::vector<Eigen::Vector3d> cone = {Eigen::Vector3d::Zero()};
  for (int i = 0; i < 16; ++i) cone.emplace_back(kBit * std::cos(i * M_PI / 8), kBit * std::sin(i * M_PI / 8), -kCone);
  const auto behind = [](const ConvexShape& shape, double z) {
    return shape.placed(Eigen::Isometry3d(Eigen::Translation3d(0, 0, -z)));
  };
  return Tool({{"bit", ConvexShape::hull(cone)},
               {"bit", behind(ConvexShape::cylinder(kBit, kBitLength - kCone), kCone)},
               {"shaft", behind(ConvexShape::cylinder(0.01, 0.1), kBitLength)}});
}

Eigen::Isometry3d pointingDownAt(const Eigen::Vector3d& tip) {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() = tip;
  X_WT.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return X_WT;
}

IntentionRequest hole(double depth = kDepth) { return {"bone", {}, kHole, Eigen::Vector3d::Zero(), depth, {"bit"}}; }

// What was warned of along a path.
struct Record {
  std::map<WarningLevel, int> levels;
  int intended = 0;  // warnings that say so
  std::optional<std::string> link_in_contact;
  std::string contact_text;

  int count(WarningLevel level) const {
    const auto found = levels.find(level);
    return found == levels.end() ? 0 : found->second;
  }
};

class DrillingTest : public ::testing::Test {
 protected:
  static GuardOptions options() {
    GuardOptions options;
    options.clock = [] { return SteadyTime(); };
    return options;
  }

  void place(TriangleMesh mesh) {
    workpieces_ = {std::make_shared<const Workpiece>(Workpiece{"bone", 1, Time(now_), SteadyTime(now_), "table",
                                                               std::move(mesh), updates_++, path_length_ += 1e-3})};
    store_.follow(workpieces_);
    monitor_.setWorkpieces(workpieces_);
  }

  void step(const Eigen::Vector3d& tip) {
    now_ += 10ms;
    const Instant at{Time(now_), SteadyTime(now_)};
    guard_.intend(store_.at(at.steady));
    const PoseWithFrames pose{at.stamp, at.steady, pointingDownAt(tip), {{"table", Eigen::Isometry3d::Identity()}}};
    const WarningMonitor::Checkpoint checkpoint = monitor_.checkpoint();
    report_ = reportOf(guard_, pose, workpieces_);
    monitor_.swept(report_, {at.stamp, at.steady}, checkpoint, at.steady);
    const bool predicts = ++steps_ % 3 == 0;
    if (predicts) monitor_.predicted(predictionOf(guard_, 0ms, workpieces_), {at.stamp, at.steady}, checkpoint, at);
    const Warning warning = warningOf(monitor_, at);
    ++record_.levels[warning.level];
    if (warning.intended) ++record_.intended;
    if (warning.level != WarningLevel::kContact || record_.link_in_contact) return;
    record_.contact_text = warning.text;
    record_.link_in_contact = warning.tool_piece ? guard_.tool().pieces()[*warning.tool_piece].link : "";
  }

  // Along a straight line; the hand trembles by 0.1 mm. Accelerates and brakes smoothly.
  void move(const Eigen::Vector3d& to, double speed) {
    const Eigen::Vector3d from = tip_;
    const double duration = std::max(0.2, 1.875 * (to - from).norm() / speed);
    for (double t = 0.0; t < duration; t += 0.01) {
      const double s = t / duration;
      const double x = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
      const double phase = 2.0 * M_PI * toSeconds(now_);
      const Eigen::Vector3d tremor(std::sin(9.0 * phase), std::sin(8.0 * phase + 1.0), std::sin(10.0 * phase + 2.0));
      before_step_();
      step(from + x * (to - from) + 1e-4 * tremor);
    }
    tip_ = to;
  }

  void drillAt(double x, double depth) {
    move({x, 0.0, 0.005}, 0.05);
    move({x, 0.0, -depth}, 0.01);
    move({x, 0.0, -depth}, 0.01);
    move({x, 0.0, 0.005}, 0.02);
    move({x, 0.0, 0.04}, 0.05);
  }

  Duration now_ = 100s;
  int steps_ = 0;
  std::uint64_t updates_ = 0;
  double path_length_ = 0.0;  // [m]
  Workpieces workpieces_;
  Eigen::Vector3d tip_ = {0.01, 0.0, 0.03};
  IntentionStore store_;
  Guard guard_{drill(), makeDetector("halfspace"), options()};
  WarningMonitor monitor_{{100ms, Duration::max(), 500ms}};
  SweepReport report_;
  Record record_;
  std::function<void()> before_step_ = [] {};
};

TEST_F(DrillingTest, AnIntendedHoleIsDrilledWithoutReflexAndContact) {
  place(slab());
  store_.set({hole()}, SteadyTime(now_));
  drillAt(0.0, 0.01);
  EXPECT_EQ(record_.count(WarningLevel::kContact), 0) << record_.contact_text;
  EXPECT_EQ(record_.count(WarningLevel::kReflex), 0);
  EXPECT_GT(record_.intended, 100);
  std::cout << "[ drilling ] " << record_.count(WarningLevel::kConsidered) << " CONSIDERED of "
            << record_.count(WarningLevel::kConsidered) + record_.count(WarningLevel::kClear) << " warnings, "
            << record_.intended << " with intended contact\n";
}

TEST_F(DrillingTest, WithoutTheIntentionTheSameHoleIsAContact) {
  place(slab());
  drillAt(0.0, 0.01);
  EXPECT_GT(record_.count(WarningLevel::kContact), 100);
  EXPECT_GT(record_.count(WarningLevel::kReflex), 0);
  EXPECT_EQ(record_.intended, 0);
}

TEST_F(DrillingTest, TwoMillimetersBesideTheRegionWarns) {
  place(slab());
  store_.set({hole()}, SteadyTime(now_));
  drillAt(kHole + 0.002, 0.01);
  EXPECT_GT(record_.count(WarningLevel::kReflex), 0);
  EXPECT_GT(record_.count(WarningLevel::kContact), 0);
  EXPECT_EQ(record_.link_in_contact, "bit");
}

TEST_F(DrillingTest, TwoMillimetersTooDeepWarns) {
  place(slab());
  store_.set({hole()}, SteadyTime(now_));
  drillAt(0.0, kDepth + 0.002);
  EXPECT_GT(record_.count(WarningLevel::kReflex), 0);
  EXPECT_GT(record_.count(WarningLevel::kContact), 0);
  EXPECT_EQ(record_.link_in_contact, "bit");
}

TEST_F(DrillingTest, TheShaftAtTheRimWarns) {
  place(slab());
  store_.set({hole(0.05)}, SteadyTime(now_));
  drillAt(0.0, kBitLength + 0.001);
  EXPECT_GT(record_.count(WarningLevel::kReflex), 0);
  EXPECT_GT(record_.count(WarningLevel::kContact), 0);
  EXPECT_EQ(record_.link_in_contact, "shaft");
}

TEST_F(DrillingTest, TheRegionFollowsTheBreathingWorkpiece) {
  const auto lift = [this](double /*x*/, double /*y*/) { return 0.003 * std::sin(2.0 * M_PI * 0.3 * toSeconds(now_)); };
  place(slab());
  before_step_ = [&] {
    TriangleMesh mesh = workpieces_.front()->mesh_M;
    std::vector<float> positions;
    for (const Eigen::Vector3d& p : slabVertices(lift)) {
      for (const double coordinate : {p.x(), p.y(), p.z()}) positions.push_back(static_cast<float>(coordinate));
    }
    mesh.deform(positions);
    place(std::move(mesh));
  };
  store_.set({hole(0.016)}, SteadyTime(now_));
  drillAt(0.0, 0.01);
  EXPECT_EQ(record_.count(WarningLevel::kContact), 0) << record_.contact_text;
  EXPECT_EQ(record_.count(WarningLevel::kReflex), 0);
  EXPECT_GT(record_.intended, 100);
}

TEST_F(DrillingTest, WhatIsTakenBackWarnsAtOnce) {
  place(slab());
  store_.set({hole()}, SteadyTime(now_));
  move({0.0, 0.0, 0.005}, 0.05);
  move({0.0, 0.0, -0.005}, 0.005);
  EXPECT_EQ(record_.count(WarningLevel::kContact), 0);
  store_.clear();
  step({0.0, 0.0, -0.005});
  EXPECT_EQ(record_.count(WarningLevel::kContact), 1);
}

TEST_F(DrillingTest, WithoutNarrowPhaseNothingIsIntended) {
  place(slab());
  GuardChange change;
  change.options = options();
  change.options.sweep.fine = false;
  guard_.exchange(change);
  store_.set({hole()}, SteadyTime(now_));
  move({0.0, 0.0, 0.005}, 0.05);
  move({0.0, 0.0, -0.005}, 0.005);
  EXPECT_GT(record_.count(WarningLevel::kContact), 0);
  EXPECT_EQ(record_.intended, 0);
}

TEST_F(DrillingTest, TheReportNamesTrianglesMetAsIntended) {
  place(slab());
  store_.set({hole()}, SteadyTime(now_));
  move({0.0, 0.0, 0.005}, 0.05);
  move({0.0, 0.0, -0.005}, 0.005);
  const SweepResult& result = report_.objects.front().result;
  EXPECT_FALSE(result.intended.empty());
  EXPECT_EQ(result.intended, result.not_ruled_out);
  EXPECT_TRUE(result.contact());
  EXPECT_FALSE(result.unintendedContact());
  const Warning warning = warningOf(monitor_, {Time(now_), SteadyTime(now_)});
  EXPECT_TRUE(warning.intended);
  EXPECT_NE(warning.text.find("intended contact with 'bone'"), std::string::npos) << warning.text;
}

// How far the tool reaches behind a tilted triangle, by its corners.
TEST(IntendedTrianglesTest, DepthIsMeasuredAlongTheNormalOfTheTriangle) {
  Random random(3);
  const ConvexShape shape = ConvexShape::box({0.01, 0.02, 0.03});
  const Tool tool({{"tip", shape}, {"other", ConvexShape::sphere(0.5)}});
  const Intention everywhere{"bone", nullptr, {0}, 1.0};
  for (int i = 0; i < sceneCount(1000, 10); ++i) {
    const std::array<Eigen::Vector3d, 3> corners = {random.inBox({1, 1, 1}), random.inBox({1, 1, 1}),
                                                    random.inBox({1, 1, 1})};
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    const Eigen::Isometry3d X_MT = random.pose(random.inBox({1, 1, 1}));
    Motion motion{X_MT, X_MT};
    if (random.chance(0.5)) motion.X_MT_end = random.pose(random.inBox({1, 1, 1}));
    const bool rests = motion.angle() == 0.0;
    double deepest = -1e9;
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d q(corner & 1 ? 0.01 : -0.01, corner & 2 ? 0.02 : -0.02, corner & 4 ? 0.03 : -0.03);
        deepest = std::max(deepest, normal.dot(corners[0] - motion.at(s) * q));
      }
    }
    const std::vector<Motion> sub_motions = split(motion, 0.1);
    IntendedTriangles triangles({&everywhere}, tool, "tip", sub_motions, 0.001);
    const double depth = triangles.depthBehind({corners, corners}).value();
    EXPECT_GE(depth, deepest + 0.001 - 1e-12);
    if (rests) {
      EXPECT_LE(depth, deepest + 0.001 + 1e-12);
    }
  }
}

TEST(IntendedTrianglesTest, ATriangleWithoutANormalIsNotIntended) {
  const Tool tool({{"tip", ConvexShape::sphere(0.01)}});
  const Intention everywhere{"bone", nullptr, {0}, 0.5};
  IntendedTriangles triangles({&everywhere}, tool, "tip", {Motion()}, 0.0);
  const std::array<Eigen::Vector3d, 3> needle = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                                 Eigen::Vector3d(2, 0, 0)};
  EXPECT_FALSE(triangles.contains(0, {needle, needle}));
  const std::array<Eigen::Vector3d, 3> triangle = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                                   Eigen::Vector3d(0, 1, 0)};
  EXPECT_TRUE(triangles.contains(0, {triangle, triangle}));
  EXPECT_FALSE(triangles.contains(1, {triangle, triangle}));
}

TEST(IntendedContactTest, TheLargestDepthOfALinkCounts) {
  const Tool tool = drill();
  const auto triangles = slab().sharedTriangles();
  const Workpiece bone{"bone", 1, Time(), SteadyTime(), "table", slab()};
  const Intentions all = {{"bone", triangles, {1, 2}, 0.01, {"bit"}},
                          {"bone", triangles, {2, 3}, 0.02},
                          {"tendon", triangles, {1, 2, 3}, 0.5}};
  const ContactPolicy contact(tool, bone, nullptr, &all);
  EXPECT_EQ(contact.intendedDepth(/*piece=*/0, 1), 0.01);
  EXPECT_EQ(contact.intendedDepth(1, 2), 0.02);
  EXPECT_EQ(contact.intendedDepth(/*the shaft*/ 2, 1), 0.0);
  EXPECT_EQ(contact.intendedDepth(2, 3), 0.02);
  EXPECT_EQ(contact.intendedDepth(0, 4), 0.0);
}

TEST(IntendedTouchesTest, ALinkHasLeftWhenItIsAwayByThePaddingAndACentimeter) {
  const Tool tool({{"tip", ConvexShape::sphere(0.001)}});
  for (const double padding : {0.0, 0.02}) {
    TriangleMesh mesh = slab();
    mesh.pad(padding);
    const auto bone = std::make_shared<const Workpiece>(Workpiece{"bone", 1, Time(), SteadyTime(), "table", mesh});
    const Intentions intended = {{"bone", mesh.sharedTriangles(), {0}, 0.01}};
    SweepReport report;
    report.objects.emplace_back().workpiece = bone;
    report.objects[0].result.in_contact.emplace_back().intended = true;
    const PoseWithFrames pose{Time(), SteadyTime(), Eigen::Isometry3d(), {{"table", Eigen::Isometry3d::Identity()}}};
    const auto at = [](double z) { return Eigen::Isometry3d(Eigen::Translation3d(-0.024, -0.024, z)); };
    IntendedTouches touches;
    touches.update(report, pose, at(0.0), tool, intended);
    report.objects[0].result.in_contact.clear();
    touches.update(report, pose, at(padding + 0.0109), tool, intended);
    EXPECT_TRUE(touches.contains("bone", "tip")) << padding;
    touches.update(report, pose, at(padding + 0.0111), tool, intended);
    EXPECT_FALSE(touches.contains("bone", "tip")) << padding;
  }
}

// A quick answer from the neighbor's normal is the same as the exact one, or no.
TEST(IntendedTrianglesTest, NeighborsDoNotChangeTheAnswer) {
  Random random(5);
  const Tool tool({{"tip", ConvexShape::cylinder(0.01, 0.1)}});
  const Intention shallow{"bone", nullptr, {0}, 0.03};
  int intended = 0;
  for (int i = 0; i < sceneCount(1000, 10); ++i) {
    const std::vector<Motion> motion = {{random.pose({0, 0, 0}), random.pose({0, 0, 0.01})}};
    IntendedTriangles shared({&shallow}, tool, "tip", motion, 0.0);
    Eigen::Vector3d normal = random.direction();
    for (int j = 0; j < 20; ++j) {
      normal = (normal + random.logUniform(1e-6, 1e-1) * random.direction()).normalized();
      const Eigen::Vector3d one = normal.unitOrthogonal();
      const Eigen::Vector3d corner = random.uniform(-0.1, 0.05) * normal;
      const std::array<Eigen::Vector3d, 3> corners = {corner, corner + 0.01 * one, corner + 0.01 * normal.cross(one)};
      const bool exact = IntendedTriangles({&shallow}, tool, "tip", motion, 0.0).contains(0, {corners, corners});
      EXPECT_EQ(shared.contains(0, {corners, corners}), exact);
      intended += exact ? 1 : 0;
    }
  }
  EXPECT_GT(intended, 0);
}

}  // namespace
}  // namespace sweep_guard_core
