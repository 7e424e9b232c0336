// A gripper of two links, a finger before a palm, among workpieces.
#include "sweep_guard/guard/allowed_contact.h"

#include <gtest/gtest.h>

#include "guard/guard_results.h"
#include "monitor/warnings.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kFinger = 0.01;  // radius [m]; at the origin
constexpr double kPalm = 0.02;    // radius [m]
constexpr double kBehind = 0.3;   // distance of the palm [m]

ConvexPiece finger() { return {"finger", ConvexShape::sphere(kFinger)}; }
ConvexPiece palm() {
  return {"palm", ConvexShape::sphere(kPalm).placed(Isometry3d(Eigen::Translation3d(0.0, 0.0, -kBehind)))};
}
Tool gripper() { return Tool(std::vector<ConvexPiece>{finger(), palm()}); }

// A closed cube around a place.
TriangleMesh cube(const Vector3d& center, double half) {
  std::vector<Vector3d> vertices;
  for (const double x : {-half, half}) {
    for (const double y : {-half, half}) {
      for (const double z : {-half, half}) vertices.emplace_back(center + Vector3d(x, y, z));
    }
  }
  return TriangleMesh(vertices, {{0, 1, 3},
                                 {0, 3, 2},
                                 {4, 6, 7},
                                 {4, 7, 5},
                                 {0, 4, 5},
                                 {0, 5, 1},
                                 {2, 3, 7},
                                 {2, 7, 6},
                                 {0, 2, 6},
                                 {0, 6, 4},
                                 {1, 5, 7},
                                 {1, 7, 3}});
}

std::shared_ptr<const Workpiece> workpieceOf(const std::string& id, TriangleMesh mesh_M) {
  return std::make_shared<const Workpiece>(Workpiece{id, 1, Time(1s), SteadyTime(1s), "table", std::move(mesh_M)});
}

GuardOptions allowing(const AllowedPairs& pairs) {
  GuardOptions options;
  options.clock = [] { return SteadyTime(); };
  options.allowed = pairs;
  return options;
}

Guard guardOf(const Tool& tool, const GuardOptions& options) { return {tool, makeDetector("reference"), options}; }

class AllowedContactTest : public ::testing::Test {
 protected:
  PoseWithFrames next(const Vector3d& place, const Isometry3d& X_WM = Isometry3d::Identity()) {
    now_ += 10ms;
    return {Time(now_), SteadyTime(now_), placedAt(place), {{"table", X_WM}}};
  }

  SweepResult resultOf(Guard& guard, const Vector3d& place, const std::shared_ptr<const Workpiece>& workpiece) {
    return reportOf(guard, next(place), {workpiece}).objects.at(0).result;
  }

  Duration now_ = 1s;
  const std::shared_ptr<const Workpiece> payload_ = workpieceOf("payload", cube({0.0, 0.0, 0.0}, 0.03));
};

TEST_F(AllowedContactTest, IsReportedApart) {
  Guard guard = guardOf(gripper(), allowing({{"finger", "payload"}}));
  const SweepResult touching = resultOf(guard, {0.0, 0.0, -0.035}, payload_);
  EXPECT_FALSE(touching.contact());
  EXPECT_TRUE(touching.triangles.empty());
  ASSERT_FALSE(touching.allowed.in_contact.empty());
  EXPECT_EQ(touching.allowed.in_contact[0].piece, 0U);
  EXPECT_NEAR(touching.allowed.in_contact[0].impact.depth, 0.005, 1e-9);
  EXPECT_EQ(touching.allowedTriangles(), touching.allowed.triangles);
  resultOf(guard, {0.0, 0.0, -0.08}, payload_);
  EXPECT_TRUE(resultOf(guard, {0.0, 0.0, -0.08}, payload_).allowed.triangles.empty());
}

TEST_F(AllowedContactTest, OfAnotherLinkOrWithAnotherWorkpieceCounts) {
  for (const AllowedPair& other : {AllowedPair{"palm", "payload"}, AllowedPair{"finger", "table"},
                                   AllowedPair{"Finger", "payload"}, AllowedPair{"*", "pay*"}}) {
    Guard guard = guardOf(gripper(), allowing({other}));
    const SweepResult touching = resultOf(guard, {0.0, 0.0, -0.035}, payload_);
    EXPECT_TRUE(touching.unintendedContact()) << describe(other);
    EXPECT_TRUE(touching.allowed.triangles.empty()) << describe(other);
  }
}

TEST_F(AllowedContactTest, AStarStandsForEachLinkAndEachWorkpiece) {
  for (const AllowedPair& any : {AllowedPair{"*", "payload"}, AllowedPair{"finger", "*"}, AllowedPair{"*", "*"}}) {
    Guard guard = guardOf(gripper(), allowing({any}));
    const SweepResult touching = resultOf(guard, {0.0, 0.0, -0.035}, payload_);
    EXPECT_FALSE(touching.contact()) << describe(any);
    EXPECT_FALSE(touching.allowed.triangles.empty()) << describe(any);
  }
}

TEST_F(AllowedContactTest, WithoutNarrowPhaseNamesWhatTheVolumesMeet) {
  GuardOptions options = allowing({{"finger", "payload"}});
  options.sweep.fine = false;
  Guard guard = guardOf(gripper(), options);
  const SweepResult touching = resultOf(guard, {0.0, 0.0, -0.035}, payload_);
  EXPECT_FALSE(touching.contact());
  EXPECT_FALSE(touching.allowed.triangles.empty());
  EXPECT_EQ(touching.allowedTriangles(), touching.allowed.triangles);
  EXPECT_TRUE(touching.allowed.in_contact.empty());
}

// The cube holds the finger, or the palm, and neither touches its surface.
TEST_F(AllowedContactTest, ALinkThatMayIsNeverInside) {
  const auto around = [](double z) { return workpieceOf("payload", cube({0.0, 0.0, z}, 0.03)); };
  Guard guard = guardOf(gripper(), allowing({{"finger", "payload"}}));
  EXPECT_FALSE(resultOf(guard, Vector3d::Zero(), around(0.0)).contact());
  Guard same = guardOf(gripper(), allowing({{"finger", "payload"}}));
  EXPECT_TRUE(resultOf(same, Vector3d::Zero(), around(-kBehind)).inside);
}

// What is remembered of the sweeps before says nothing about the links that might.
TEST_F(AllowedContactTest, EndsWhenItIsNoLongerAllowed) {
  Guard guard = guardOf(gripper(), allowing({{"finger", "payload"}}));
  EXPECT_FALSE(resultOf(guard, Vector3d::Zero(), payload_).contact());
  EXPECT_FALSE(resultOf(guard, Vector3d::Zero(), payload_).contact());
  GuardChange change{allowing({})};
  guard.exchange(change);
  EXPECT_TRUE(resultOf(guard, Vector3d::Zero(), payload_).inside);
}

// Motions without turns: the size of the whole tool widens no volume.
TEST_F(AllowedContactTest, OtherLinksMeetWhatTheyMeetWithoutTheAllowedOnes) {
  Random random(3);
  int met = 0;
  int allowed = 0;
  for (int path = 0; path < 60; ++path) {
    const auto hull = workpieceOf("payload", wavyHull(12, 18, random.uniform(0.0, 6.0)));
    Guard both = guardOf(gripper(), allowing({{"finger", "payload"}}));
    Guard palm_alone = guardOf(Tool(std::vector<ConvexPiece>{palm()}), allowing({}));
    Guard finger_alone = guardOf(Tool(std::vector<ConvexPiece>{finger()}), allowing({}));
    Vector3d place = random.inBox({0.15, 0.15, 0.35});
    for (int step = 0; step < 6; ++step) {
      place += random.inBox({0.02, 0.02, 0.02});
      const PoseWithFrames pose = next(place);
      const SweepResult result = reportOf(both, pose, {hull}).objects.at(0).result;
      const SweepResult of_palm = reportOf(palm_alone, pose, {hull}).objects.at(0).result;
      const SweepResult of_finger = reportOf(finger_alone, pose, {hull}).objects.at(0).result;
      EXPECT_EQ(result.not_ruled_out, of_palm.not_ruled_out);
      EXPECT_EQ(result.inside, of_palm.inside);
      ASSERT_EQ(result.allowed.in_contact.size(), of_finger.in_contact.size());
      for (size_t i = 0; i < of_finger.in_contact.size(); ++i) {
        EXPECT_EQ(result.allowed.in_contact[i].triangle, of_finger.in_contact[i].triangle);
        EXPECT_NEAR(result.allowed.in_contact[i].impact.time_of_impact, of_finger.in_contact[i].impact.time_of_impact,
                    1e-6);
      }
      met += of_palm.contact() ? 1 : 0;
      allowed += of_finger.in_contact.empty() ? 0 : 1;
      const Prediction ahead = predictionOf(both, 0ms, {hull});
      const Prediction of_palm_ahead = predictionOf(palm_alone, 0ms, {hull});
      EXPECT_EQ(ahead.firstContact().has_value(), of_palm_ahead.firstContact().has_value());
    }
  }
  EXPECT_GT(met, 10);
  EXPECT_GT(allowed, 5);
}

TEST_F(AllowedContactTest, RaisesNoLevelAndKeepsNothingFromBeingClear) {
  const auto levelsWith = [&](const AllowedPairs& pairs) {
    Guard guard = guardOf(gripper(), allowing(pairs));
    WarningMonitor monitor{{100ms, Duration::max(), 500ms}};
    monitor.setWorkpieces({payload_});
    std::map<WarningLevel, int> levels;
    for (int step = 0; step < 40; ++step) {
      const PoseWithFrames pose = next({0.0, 0.0, -0.08 + 0.0015 * step});
      const Instant now{pose.stamp, pose.received};
      const WarningMonitor::Checkpoint checkpoint = monitor.checkpoint();
      monitor.swept(reportOf(guard, pose, {payload_}), {now.stamp, now.steady}, checkpoint, now.steady);
      monitor.predicted(predictionOf(guard, 0ms, {payload_}), {now.stamp, now.steady}, checkpoint, now);
      ++levels[warningOf(monitor, now).level];
    }
    return levels;
  };
  auto strict = levelsWith({});
  EXPECT_GT(strict[WarningLevel::kContact], 0);
  EXPECT_GT(strict[WarningLevel::kReflex], 0);
  auto allowed = levelsWith({{"finger", "payload"}});
  EXPECT_EQ(allowed[WarningLevel::kContact] + allowed[WarningLevel::kReflex] + allowed[WarningLevel::kConsidered], 0);
  EXPECT_GE(allowed[WarningLevel::kClear], 38);
}

TEST_F(AllowedContactTest, IsLeftOutOfAPathAndOfTheDistance) {
  const Tool tool = gripper();
  const std::vector<Isometry3d> path = {placedAt({0.0, 0.0, -0.2}), placedAt({0.0, 0.0, 0.0})};
  const auto detector = makeDetector("reference");
  const AllowedPairs pairs = {{"finger", "payload"}};
  const ContactPolicy contact(tool, *payload_, &pairs);
  const PathResult found = checkPath(*detector, {tool, path, payload_->mesh_M, {}, [] {}, {}, contact});
  const PathResult strict = checkPath(*detector, {tool, path, payload_->mesh_M, {}});
  EXPECT_TRUE(strict.first_contact);
  EXPECT_FALSE(found.first_contact);
  EXPECT_FALSE(found.all.contact());
  EXPECT_FALSE(found.all.allowed.in_contact.empty());

  Guard guard = guardOf(tool, allowing({{"finger", "payload"}}));
  reportOf(guard, next({0.0, 0.0, -0.045}), {payload_});
  EXPECT_FALSE(guard.isWithin(0.02, *payload_));
  EXPECT_FALSE(guard.isWithin(0.02, *workpieceOf("payload", cube({0.0, 0.0, 0.0}, 0.03))));
  EXPECT_TRUE(guard.isWithin(0.02, *workpieceOf("other", cube({0.0, 0.0, 0.0}, 0.03))));
}

// The allowed body is the second: its pieces are counted from those of the first.
TEST_F(AllowedContactTest, OfOneBodyOfSeveralNamesItsPiece) {
  std::vector<TreeLink> links(2);
  links[0].type = links[1].type = JointType::kPrismatic;
  links[1].variable = 1;
  const auto robot = std::make_shared<const Robot>(
      robotOf({{{"of the palm"}, {"of the finger"}}, links}, {{0, {palm()}}, {1, {finger()}}}));
  Guard guard(robot, makeDetector("reference"), allowing({{"finger", "payload"}}));
  PoseWithFrames pose = next({0.0, 0.0, 0.0});
  pose.bodies = {{placedAt({0.0, 0.0, -0.3})}, {placedAt({0.0, 0.0, -0.035})}};
  pose.state.positions = {-0.3, -0.035};
  const SweepReport report = reportOf(guard, pose, {payload_});
  EXPECT_FALSE(report.contact());
  ASSERT_FALSE(report.objects.at(0).result.allowed.in_contact.empty());
  EXPECT_EQ(report.objects[0].result.allowed.in_contact[0].piece, 1U);
}

TEST(AllowedMatchesTest, RemembersWhichWorkpiecesHaveBeenThere) {
  AllowedMatches matches({{"finger", "payload"}, {"palm", "pailoud"}, {"palm", "*"}});
  EXPECT_EQ(matches.matched(), (std::vector<bool>{false, false, true}));
  matches.follow({workpieceOf("payload", cube(Vector3d::Zero(), 0.03))});
  matches.follow({});
  EXPECT_EQ(matches.matched(), (std::vector<bool>{true, false, true}));
}

TEST(AllowedPairTest, IsDescribedInWords) {
  EXPECT_EQ(describe(AllowedPair{"finger", "payload"}), "link 'finger' with 'payload'");
  EXPECT_EQ(describe(AllowedPair{"*", "*"}), "any link with any workpiece");
}

}  // namespace
}  // namespace sweep_guard_core
