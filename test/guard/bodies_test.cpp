#include <gtest/gtest.h>

#include <algorithm>

#include "guard/body_prediction.h"
#include "guard/fake_detector.h"
#include "guard/guard_results.h"
#include "guard/times.h"
#include "guard/triangle_set.h"
#include "guard/two_links.h"
#include "kinematics/random_robot.h"
#include "scenes.h"
#include "sweep_guard/kinematics/robot_path.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// Of a radius of half a metre.
std::shared_ptr<const Workpiece> hull(const std::string& id, double phase, int ms, const std::string& frame = "table") {
  TriangleMesh mesh_M = wavyHull(12, 18, phase);
  std::vector<float> positions = streamedPositions(mesh_M);
  for (float& coordinate : positions) coordinate *= 5.0F;
  return std::make_shared<const Workpiece>(
      Workpiece{id, 0, at(ms), SteadyTime{}, frame, deformed(mesh_M, std::move(positions))});
}

// Links of two pieces each.
Robot armOfPairs(Random& random) {
  KinematicTree tree = randomRobot(random, 4, /*branches=*/true);
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
  for (size_t link = 0; link < tree.links().size(); ++link) {
    const std::string name = "link" + std::to_string(link);
    pieces.push_back({link, {{name, ConvexShape::sphere(0.02)}, {name, ConvexShape::cylinder(0.01, 0.08)}}});
  }
  return robotOf(std::move(tree), pieces);
}

// A guard of all bodies, and a guard for each of them.
class BodiesTest : public testing::Test {
 protected:
  explicit BodiesTest(std::uint64_t seed = 1)
      : random_(seed), robot_(std::make_shared<const Robot>(armOfPairs(random_))) {
    for (const Tool& body : robot_->tools)
      alone_.push_back(std::make_unique<Guard>(body, std::make_unique<FakeDetector>(record_), timeless()));
  }

  // Time is never short. One link may touch the hull.
  static GuardOptions timeless() {
    GuardOptions options;
    options.allowed = {{"link1", "hull"}};
    options.clock = [] { return SteadyTime(); };
    return options;
  }

  size_t firstPiece(size_t body) const {
    size_t pieces = 0;
    for (size_t i = 0; i < body; ++i) pieces += robot_->tools[i].pieces().size();
    return pieces;
  }

  PoseWithFrames nextPose() {
    const RobotState from = state_;
    state_ = randomStateNear(random_, from, 0.02);
    const RobotMotion motion(robot_->tree, robot_->bodies, from, state_);
    std::vector<Eigen::Isometry3d> X_WB;
    bodyPoses(robot_->tree, robot_->bodies, state_, X_WB);
    ms_ += 10;
    PoseWithFrames pose{at(ms_), {}, state_.X_WR, {{"table", Eigen::Isometry3d::Identity()}}};
    pose.bodies.clear();
    for (size_t i = 0; i < X_WB.size(); ++i) pose.bodies.push_back({X_WB[i], motion.deviationBound(i, 1)});
    pose.state = state_;
    return pose;
  }

  // A frame that turns and slides, with less and less certainty, in the second after the newest pose.
  std::shared_ptr<const FrameMotions> slidingFrame() const {
    auto frame = std::make_shared<FrameMotion>();
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    for (int ms = 0; ms <= ms_; ms += 10) frame->measured.push_back({at(ms), X});
    frame->predicted_from = at(ms_);
    for (int i = 1; i <= 15; ++i) {
      X = Eigen::Translation3d(0.01, 0.0, -0.01) * X * Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX());
      frame->predicted.push_back({milliseconds(100 * i), X, 1e-6 * i * i * Matrix6d::Identity()});
    }
    return std::make_shared<const FrameMotions>(FrameMotions{{"sliding", frame}});
  }

  static PoseWithFrames ofBody(PoseWithFrames pose, size_t body) {
    pose.bodies = {pose.bodies[body]};
    pose.X_WT = pose.bodies[0].X_WB;
    return pose;
  }

  Random random_;
  std::shared_ptr<const Robot> robot_;
  RobotState state_{Eigen::Isometry3d::Identity(), std::vector<double>(robot_->tree.variables().size(), 0.0)};
  int ms_ = 0;
  FakeDetector::Record record_;
  Guard together_{robot_, std::make_unique<FakeDetector>(record_), timeless()};
  std::vector<std::unique_ptr<Guard>> alone_;
};

struct Expected {
  TriangleSet triangles;
  TriangleSet not_ruled_out;
  std::vector<TriangleContact> in_contact;
};

void add(const SweepReport& report, size_t first_piece, Expected& expected) {
  const SweepResult& result = report.objects[0].result;
  unite(expected.triangles, result.triangles);
  unite(expected.not_ruled_out, result.not_ruled_out);
  for (TriangleContact contact : result.in_contact) {
    contact.piece += first_piece;
    expected.in_contact.push_back(contact);
  }
}

const TriangleContact* earliest(const std::vector<TriangleContact>& contacts, std::uint32_t triangle) {
  const TriangleContact* first = nullptr;
  for (const TriangleContact& contact : contacts) {
    const bool sooner = first == nullptr || contact.impact.time_of_impact < first->impact.time_of_impact;
    if (contact.triangle == triangle && sooner) first = &contact;
  }
  return first;
}

class RandomArmsTest : public BodiesTest, public testing::WithParamInterface<int> {
 protected:
  RandomArmsTest() : BodiesTest(static_cast<std::uint64_t>(GetParam())) {}
};

INSTANTIATE_TEST_SUITE_P(Seeds, RandomArmsTest, testing::Range(1, 9));

TEST_P(RandomArmsTest, MeetWhatTheirBodiesMeetAlone) {
  for (int i = 0; i < 40; ++i) {
    const PoseWithFrames pose = nextPose();
    const Workpieces workpieces = {hull("hull", 0.02 * i, ms_)};
    const SweepReport all = reportOf(together_, pose, workpieces);
    Expected expected;
    for (size_t body = 0; body < alone_.size(); ++body)
      add(reportOf(*alone_[body], ofBody(pose, body), workpieces), firstPiece(body), expected);
    ASSERT_EQ(all.objects.size(), 1U);
    const SweepResult& result = all.objects[0].result;
    EXPECT_EQ(result.triangles, expected.triangles);
    EXPECT_EQ(result.not_ruled_out, expected.not_ruled_out);
    EXPECT_TRUE(all.complete());
    for (const TriangleContact& contact : result.in_contact) {
      const TriangleContact* const first = earliest(expected.in_contact, contact.triangle);
      ASSERT_NE(first, nullptr);
      EXPECT_EQ(contact.piece, first->piece);
      EXPECT_EQ(contact.impact.time_of_impact, first->impact.time_of_impact);
    }
    for (const TriangleContact& contact : expected.in_contact)
      EXPECT_NE(earliest(result.in_contact, contact.triangle), nullptr);
  }
}

constexpr Duration kLater = std::chrono::seconds(1);
constexpr double kTolerance = 4e-4;  // of a probability, for 1e-3 deviations (ClearanceMeter)

// What is predicted of one workpiece.
struct ExpectedObject {
  TriangleSet triangles;
  double reflex = 0.0;
  double considered = 0.0;
  std::optional<Duration> first;
  double deviations = 0.0;  // of the piece that comes first
  std::optional<size_t> piece = {};
};

const PredictedSweep* firstWithContact(const PredictedObject& object) {
  const auto first = std::find_if(object.sweeps.begin(), object.sweeps.end(),
                                  [](const PredictedSweep& sweep) { return sweep.contact; });
  return first == object.sweeps.end() ? nullptr : &*first;
}

void add(const PredictedObject& object, size_t first_piece, ExpectedObject& expected) {
  unite(expected.triangles, object.triangles());
  expected.reflex = std::max(expected.reflex, object.probability(PredictionInterval::kReflex, kLater));
  expected.considered = std::max(expected.considered, object.probability(PredictionInterval::kConsidered, kLater));
  const PredictedSweep* const first = firstWithContact(object);
  if (first == nullptr) return;
  const auto rank = std::pair(first->from, first->deviations);
  if (expected.first && std::pair(*expected.first, expected.deviations) <= rank) return;
  expected.first = first->from;
  expected.deviations = first->deviations;
  expected.piece = *first->tool_piece + first_piece;
}

TEST_P(RandomArmsTest, ArePredictedToMeetWhatTheirBodiesMeetAlone) {
  Prediction all;
  for (int i = 0; i < 20; ++i) {
    const PoseWithFrames pose = nextPose();
    const Workpieces workpieces = {hull("hull", 0.0, 0), hull("other", 1.0, 0), hull("sliding", 2.0, 0, "sliding")};
    const std::shared_ptr<const FrameMotions> frames = slidingFrame();
    together_.follow(frames);
    reportOf(together_, pose, workpieces);
    together_.predict({}, workpieces, all);
    ExpectedObject expected[3];
    FakeDetector detector(record_);
    for (size_t body = 0; body < alone_.size(); ++body) {
      PredictedMotion of_body{ofBody(pose, body), all.path, all.reflex_sweeps, {all.body_paths[body]}, frames};
      const Prediction one = predictContacts(detector, {robot_->tools[body]}, of_body, workpieces, timeless(), {});
      for (size_t k = 0; k < one.objects.size(); ++k) add(one.objects[k], firstPiece(body), expected[k]);
    }
    double probability = 0.0;
    for (const ExpectedObject& object : expected) probability = std::max(probability, object.considered);
    EXPECT_EQ(all.probability(PredictionInterval::kConsidered, kLater), probability);
    ASSERT_EQ(all.objects.size(), i == 0 ? 0U : 3U);
    EXPECT_EQ(all.complete(), i > 0);
    for (size_t k = 0; k < all.objects.size(); ++k) {
      const PredictedObject& object = all.objects[k];
      EXPECT_EQ(object.triangles(), expected[k].triangles);
      EXPECT_NEAR(object.probability(PredictionInterval::kReflex, kLater), expected[k].reflex, kTolerance);
      EXPECT_NEAR(object.probability(PredictionInterval::kConsidered, kLater), expected[k].considered, kTolerance);
      EXPECT_EQ(object.firstContact(), expected[k].first);
      if (expected[k].piece) {
        EXPECT_EQ(firstWithContact(object)->tool_piece, expected[k].piece);
      }
      for (const PredictedSweep& sweep : object.sweeps)
        EXPECT_EQ(sweep.tool_piece.has_value(), sweep.deviations < GuardOptions().max_deviations);
    }
  }
}

TEST_F(BodiesTest, AnyOfThemIsNearAWorkpiece) {
  const PoseWithFrames pose = nextPose();
  const Workpieces workpieces = {hull("hull", 0.0, 0)};
  reportOf(together_, pose, workpieces);
  bool near = false;
  for (size_t body = 0; body < alone_.size(); ++body) {
    reportOf(*alone_[body], ofBody(pose, body), workpieces);
    near = near || alone_[body]->isWithin(0.01, *workpieces[0]);
  }
  EXPECT_EQ(together_.isWithin(0.01, *workpieces[0]), near);
}

// Balls that slide along z, half a metre apart.
std::shared_ptr<const Robot> twoBalls(const std::string& first, const std::string& second) {
  TwoLinks balls(first, second, JointType::kPrismatic, ConvexShape::sphere(0.01));
  balls.links[1].X_PJ = along(0.5);
  return balls.robot();
}

// Over a triangle.
class TwoBallsTest : public testing::Test {
 protected:
  PoseWithFrames pose(int ms, double z_first, double z_second) const {
    PoseWithFrames pose{at(ms), {}, Eigen::Isometry3d::Identity(), {{"table", Eigen::Isometry3d::Identity()}}};
    pose.bodies = {{Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z_first))},
                   {Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, z_second))}};
    pose.state.positions = {z_first, z_second};
    return pose;
  }

  const std::shared_ptr<const Workpiece> triangle_ = std::make_shared<const Workpiece>(Workpiece{
      "triangle", 0, at(0), SteadyTime{}, "table", TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}})});
  FakeDetector::Record record_;
  Guard guard_{twoBalls("first", "second"), std::make_unique<FakeDetector>(record_), {}};
};

TEST_F(TwoBallsTest, TheFirstToTouchIsNamed) {
  reportOf(guard_, pose(0, 0.11, 0.21), {triangle_});
  const SweepReport report = reportOf(guard_, pose(10, -0.29, -0.19), {triangle_});
  ASSERT_EQ(report.objects[0].result.in_contact.size(), 1U);
  EXPECT_EQ(report.objects[0].result.in_contact[0].piece, 0U);
  EXPECT_NEAR(report.objects[0].result.in_contact[0].impact.time_of_impact, 0.25, 1e-6);
}

TEST_F(TwoBallsTest, TheFailureOfOneLeavesTheContactOfTheOther) {
  reportOf(guard_, pose(0, 0.02, 0.11), {triangle_});
  record_.failures_left = 1;
  const SweepReport report = reportOf(guard_, pose(10, 0.02, -0.09), {triangle_});
  ASSERT_EQ(report.failures.size(), 1U);
  EXPECT_EQ(report.failures[0].workpiece, triangle_);
  EXPECT_FALSE(report.complete());
  ASSERT_EQ(report.objects.size(), 1U);
  EXPECT_EQ(report.objects[0].result.in_contact[0].piece, 1U);
}

// Its way of 20 ms begins with a rest of 10 ms; the other goes back in the second half.
TEST_F(TwoBallsTest, TheOneThatFailedIsSweptFromWhereItWas) {
  reportOf(guard_, pose(0, 0.02, 0.11), {triangle_});
  record_.failures_left = 1;
  reportOf(guard_, pose(10, 0.02, -0.19), {triangle_});
  const SweepReport report = reportOf(guard_, pose(20, 0.02, 0.21), {triangle_});
  EXPECT_TRUE(report.complete());
  EXPECT_EQ(report.start, at(0));
  EXPECT_EQ(report.objects[0].interval_start, at(0));
  ASSERT_EQ(report.objects[0].result.in_contact.size(), 1U);
  EXPECT_EQ(report.objects[0].result.in_contact[0].piece, 1U);
  EXPECT_NEAR(report.objects[0].result.in_contact[0].impact.time_of_impact, 0.5 + 0.5 * 0.18 / 0.4, 1e-6);
}

TEST_F(TwoBallsTest, ASweepTakenBackIsRepeatedForBoth) {
  reportOf(guard_, pose(0, 0.11, 0.11), {triangle_});
  const SweepReport lost = reportOf(guard_, pose(10, 0.11, -0.09), {triangle_});
  guard_.takeBack();
  const SweepReport again = reportOf(guard_, pose(10, 0.11, -0.09), {triangle_});
  EXPECT_EQ(again.start, at(0));
  EXPECT_EQ(again.objects[0].result.in_contact.size(), lost.objects[0].result.in_contact.size());
}

TEST_F(TwoBallsTest, TrianglesThatWereReplacedAreSweptForBoth) {
  const auto far = std::make_shared<const Workpiece>(
      Workpiece{"triangle", 1, at(5), SteadyTime{}, "table",
                TriangleMesh({{-1, -1, -9}, {1, -1, -9}, {0, 1, -9}, {0, 0, -9}}, {{0, 1, 2}, {0, 1, 3}})});
  reportOf(guard_, pose(0, 0.11, 0.11), {triangle_});
  const SweepReport report = reportOf(guard_, pose(10, 0.11, -0.09), {far});
  ASSERT_EQ(report.replaced.size(), 1U);
  EXPECT_EQ(report.replaced[0].workpiece, triangle_);
  ASSERT_EQ(report.replaced[0].result.in_contact.size(), 1U);
  EXPECT_EQ(report.replaced[0].result.in_contact[0].piece, 1U);
  EXPECT_FALSE(report.objects[0].result.contact());
  EXPECT_TRUE(report.contact());
}

TEST_F(TwoBallsTest, ContactOfOneAsIntendedDoesNotHideThatOfTheOther) {
  Intention intention{"triangle", triangle_->mesh_M.sharedTriangles(), {0}, 0.05, {"first"}};
  Guard guard(twoBalls("first", "second"), std::make_unique<FakeDetector>(record_), {});
  guard.intend(std::make_shared<const Intentions>(Intentions{intention}));
  reportOf(guard, pose(0, 0.05, 0.05), {triangle_});
  const SweepReport meant = reportOf(guard, pose(10, 0.0, 0.05), {triangle_});
  EXPECT_TRUE(meant.contact());
  EXPECT_FALSE(meant.unintendedContact());
  const SweepReport both = reportOf(guard, pose(20, 0.0, 0.0), {triangle_});
  EXPECT_TRUE(both.unintendedContact());
  ASSERT_EQ(both.objects[0].result.in_contact.size(), 1U);
  EXPECT_EQ(both.objects[0].result.in_contact[0].piece, 1U);
  EXPECT_TRUE(both.objects[0].result.intended.empty());
}

// The elbow is thick, and the lower link is folded back. The shoulder turns at 0.5 rad/s towards a sheet 0.3 m to its side: the
// elbow comes to it after 1.35 s, the tip never does.
TEST(ArmBesideASheetTest, AContactOfTheElbowIsPredictedAhead) {
  TwoLinks arm = planarArm();
  arm.pieces[0].second.push_back({"upper", ConvexShape::sphere(0.05).placed(along(0.4))});
  const auto robot = arm.robot();
  GuardOptions options;
  options.clock = [] { return SteadyTime(); };
  for (const char* predictor : {"direct", "polynomial", "constant_velocity"}) {
    options.predictor.predictor = predictor;
    Guard guard(robot, makeDetector("halfspace"), options);
    const Workpieces workpieces = {std::make_shared<const Workpiece>(
        Workpiece{"sheet", 0, at(0), SteadyTime{}, "table",
                  TriangleMesh({{-1, 0.3, -1}, {1, 0.3, -1}, {1, 0.3, 1}, {-1, 0.3, 1}}, {{0, 1, 2}, {0, 2, 3}})})};
    for (int ms = 0; ms <= 800; ms += 10) {
      PoseWithFrames pose{at(ms), {}, Eigen::Isometry3d::Identity(), {{"table", Eigen::Isometry3d::Identity()}}};
      pose.state.positions = {0.0005 * ms, 2.6};
      std::vector<Eigen::Isometry3d> X_WB;
      bodyPoses(robot->tree, robot->bodies, pose.state, X_WB);
      pose.bodies.clear();
      for (const Eigen::Isometry3d& X : X_WB) pose.bodies.push_back({X});
      EXPECT_FALSE(reportOf(guard, pose, workpieces).contact());
    }
    const Prediction prediction = predictionOf(guard, {}, workpieces);
    ASSERT_TRUE(prediction.firstContact()) << predictor;
    EXPECT_LT(toSeconds(*prediction.firstContact()), 0.55) << predictor;
    EXPECT_GT(toSeconds(*prediction.firstContact()), 0.55 - 0.14) << "its box is 21 mm nearer, with " << predictor;
    const auto& sweeps = prediction.objects[0].sweeps;
    const auto first = std::find_if(sweeps.begin(), sweeps.end(), [](const auto& sweep) { return sweep.contact; });
    ASSERT_TRUE(first->tool_piece);
    EXPECT_EQ(*first->tool_piece, 1U) << "the elbow of the upper link, with " << predictor;
  }
}

}  // namespace
}  // namespace sweep_guard_core
