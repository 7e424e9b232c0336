#include "guard/sweep_checker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "guard/fake_detector.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

SweepResult testMotion(Detector& detector, const ConvexShape& tool, const Motion& motion, const TriangleMesh& mesh_M,
                       const SweepOptions& options) {
  return checkSweep(detector, {Tool(tool), split(motion, options.max_rotation), mesh_M, options});
}

using Indices = std::vector<std::uint32_t>;

Detector& reference() {
  static ReferenceDetector detector;
  return detector;
}

const ConvexShape kDrill = ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1);

// A square of 1 m in the plane at height z, and one 1 m to the side.
TriangleMesh square(double z) {
  return TriangleMesh({{-0.5, -0.5, z}, {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}, {1.5, -0.5, z}, {2.5, 0.5, z}},
                      {{0, 1, 2}, {0, 2, 3}, {4, 5, 4}});
}

class SweepCheckerTest : public testing::TestWithParam<std::string> {
 protected:
  SweepResult test(const Motion& motion, const TriangleMesh& mesh, const SweepOptions& options = {}) {
    return testMotion(*detector_, kDrill, motion, mesh, options);
  }

  std::unique_ptr<Detector> detector_ = makeDetector(GetParam());
};

// 0.1 mm thin; 2 m between the poses.
TEST_P(SweepCheckerTest, MeetsAThinSquareBetweenTwoPosesFarApart) {
  const Motion through{placedAt(0.1, 0.1, 1.0), placedAt(0.1, 0.1, -0.9)};
  EXPECT_EQ(test(through, square(0.0)).triangles, (Indices{0, 1}));
  EXPECT_EQ(test(through, square(0.0001)).triangles, (Indices{0, 1}));
  EXPECT_TRUE(test({placedAt(0.1, 0.1, 1.0), placedAt(0.1, 0.1, 1.0)}, square(0.0)).triangles.empty());
  EXPECT_TRUE(test({placedAt(0.1, 0.1, -0.9), placedAt(0.1, 0.1, -0.9)}, square(0.0)).triangles.empty());
}

// The drill turns by 90 degrees about its tip: its far end runs along an arc of 0.1 m, which deviates 0.029 m from its
// chord. The point of the triangle is on the arc, 0.02 m from the chord.
TEST_P(SweepCheckerTest, MeetsATriangleThatOnlyTheArcReaches) {
  Motion turn;
  turn.X_MT_end.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitX()).toRotationMatrix();
  const double reached = 0.095 * std::sqrt(0.5);
  const TriangleMesh spike({{0, reached, -reached}, {0, 1, -1.1}, {0, 1.1, -1}}, {{0, 1, 2}});
  const double from_chord = 0.095 - (0.1 + 0.005) * std::sqrt(0.5);
  ASSERT_GT(from_chord, 0.02);
  EXPECT_EQ(test(turn, spike).triangles, Indices{0});

  const TriangleMesh beyond({{0, 0.09, -0.09}, {0, 1, -1.1}, {0, 1.1, -1}}, {{0, 1, 2}});
  EXPECT_TRUE(test(turn, beyond).triangles.empty());
}

TEST_P(SweepCheckerTest, NamesEachTriangleOnceThoughSeveralSubMotionsMeetIt) {
  Motion turn{placedAt(0, 0, 0.01), placedAt(0, 0, -0.01)};
  turn.X_MT_end.linear() = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const SweepResult result = test(turn, square(0.0));
  EXPECT_EQ(result.volumes_M.size(), 9U);  // 1.5 / 0.175 = 8.6
  EXPECT_EQ(result.triangles, (Indices{0, 1}));
}

TEST_P(SweepCheckerTest, GrowsTheToolByTheMargin) {
  const Motion below{placedAt(0, 0, -0.011), placedAt(0.1, 0, -0.011)};
  SweepOptions options;
  options.margin = 0.010;
  EXPECT_TRUE(test(below, square(0.0), options).triangles.empty());
  options.margin = 0.012;
  EXPECT_EQ(test(below, square(0.0), options).triangles, (Indices{0, 1}));
}

INSTANTIATE_TEST_SUITE_P(AllDetectors, SweepCheckerTest, testing::ValuesIn(detectorNames()),
                         [](const auto& test) { return test.param; });

TEST(SweepResultTest, SubMotionsAreEndToEndFromPoseToPose) {
  FakeDetector::Record record;
  FakeDetector detector(record);
  Random random(/*seed=*/1);
  const Motion motion{random.pose({0, 0, 0}), random.pose({1, 0, 0})};
  const SweepResult result = testMotion(detector, kDrill, motion, square(0.0), {});
  const std::vector<Motion> sub_motions = split(motion, SweepOptions{}.max_rotation);
  ASSERT_EQ(result.volumes_M.size(), sub_motions.size());
  ASSERT_EQ(record.volumes.size(), sub_motions.size());
  for (size_t i = 0; i < sub_motions.size(); ++i) {
    const SweptVolume expected = sweptVolume(kDrill, sub_motions[i], VolumeKind::kObbPlanes);
    EXPECT_TRUE(record.volumes[i].box.X_MB.isApprox(expected.box.X_MB, 1e-9)) << "part " << i;
  }
}

TEST(SweepResultTest, UsesTheVolumeAskedFor) {
  FakeDetector::Record record;
  FakeDetector detector(record);
  const Motion motion{placedAt(0, 0, 0), placedAt(0.1, 0.05, 0.02)};
  SweepOptions options;
  options.volume = VolumeKind::kObb;
  testMotion(detector, kDrill, motion, square(0.0), options);
  EXPECT_TRUE(record.volumes.back().clips_B.empty());
  options.volume = VolumeKind::kObbPlanes;
  testMotion(detector, kDrill, motion, square(0.0), options);
  EXPECT_FALSE(record.volumes.back().clips_B.empty());
}

// What is reported holds: chord error, the margin asked for, the mesh's own rounding and the detector's inflation.
TEST(SweepResultTest, ReportsAMarginThatAddsUp) {
  FakeDetector::Record record;
  record.inflation = 0.5;
  FakeDetector detector(record);
  Motion turn;
  turn.X_MT_end.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  SweepOptions options;
  options.margin = 0.25;
  const TriangleMesh mesh({{0.1, 0.2, 0.3}, {1e3, 0, 0}, {0, 1e3, 0}}, {{0, 1, 2}});
  ASSERT_GT(mesh.rounding(), 1e-6);
  const double margin = testMotion(detector, kDrill, turn, mesh, options).margin;
  EXPECT_NEAR(margin, 0.25 + 0.5 + 0.105 * 0.1 * 0.1 / 8.0 + mesh.rounding(), 1e-9);
}

// A ball touches a triangle where it is; in float32 some triangles lie apart from it.
TEST(SweepResultTest, MeetsTrianglesWhereTheyWereBeforeTheirSenderRoundedThem) {
  constexpr double kRadius = 0.005;
  Random random(11);
  for (const double distance : {0.3, 30e3, 130e3, 4000e3}) {
    int apart = 0;
    for (int i = 0; i < 100; ++i) {
      const Eigen::Isometry3d X_MF = random.pose(distance * random.direction());
      std::vector<Eigen::Vector3d> vertices;
      std::vector<float> sent;
      for (const Eigen::Vector3d& p_F : {Eigen::Vector3d(0.2, 0, 0), {-0.1, 0.2, 0}, {-0.1, -0.2, 0}}) {
        vertices.emplace_back(X_MF * p_F);
        for (const int axis : {0, 1, 2}) sent.push_back(static_cast<float>(vertices.back()[axis]));
      }
      const TriangleMesh mesh = deformed({vertices, {{0, 1, 2}}}, sent);
      const double overlap = 1e-3 * mesh.rounding();
      const Eigen::Vector3d center = X_MF * Eigen::Vector3d(0, 0, kRadius - overlap);
      const Eigen::Vector3d normal =
          (mesh.vertex(1) - mesh.vertex(0)).cross(mesh.vertex(2) - mesh.vertex(0)).normalized();
      if (std::abs(normal.dot(center - mesh.vertex(0))) > kRadius) ++apart;
      const Motion rest{placedAt(center), placedAt(center)};
      EXPECT_EQ(testMotion(reference(), ConvexShape::sphere(kRadius), rest, mesh, {}).triangles, Indices{0})
          << distance << " m, " << i;
    }
    EXPECT_GT(apart, 10) << distance << " m";
  }
}

// A vertex on the drill's rim is met as it was given, though the mesh, 1 km large, keeps it up to 0.04 mm off.
TEST(SweepResultTest, MeetsVerticesWhereTheyWereGiven) {
  int kept_outside = 0;
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const TriangleMesh mesh({kDrill.radius() * out, 1000.0 * out, 1000.0 * out + Eigen::Vector3d::UnitZ()},
                            {{0, 1, 2}});
    if (mesh.vertex(0).head<2>().norm() > kDrill.radius() + 1e-6) ++kept_outside;
    EXPECT_EQ(testMotion(reference(), kDrill, Motion{}, mesh, {}).triangles, Indices{0}) << degrees << " degrees";
  }
  EXPECT_GT(kept_outside, 50);
}

// Every triangle named lies within the reported margin of the tool, of its volume that is: here against the box that
// the drill itself is, at rest.
TEST(SweepResultTest, NamesNothingFartherThanItsMargin) {
  const auto detector = makeDetector("select");
  for (int exponent = -12; exponent < 0; ++exponent) {
    const double gap = std::pow(10.0, exponent);
    const TriangleMesh ahead = square(gap);
    const SweepResult result = testMotion(*detector, kDrill, Motion{}, ahead, {});
    if (!result.triangles.empty()) {
      EXPECT_LE(gap, result.margin);
    }
    if (gap > result.margin) {
      EXPECT_TRUE(result.triangles.empty()) << gap;
    }
  }
}

// The box around a drill that goes aslant holds corners that the drill never comes to. Whoever looks closely sees that.
TEST(NarrowPhaseTest, RulesOutWhatOnlyTheVolumeMeets) {
  const Motion aslant{placedAt(0, 0, 0), placedAt(0.1, 0.02, 0.05)};
  const SweptVolume volume = sweptVolume(kDrill, aslant, VolumeKind::kObb);
  const Eigen::Vector3d corner = volume.box.X_MB * (0.999 * volume.box.half_extents);
  const TriangleMesh dot({corner, corner, corner}, {{0, 1, 2}});
  SweepOptions options;
  options.volume = VolumeKind::kObb;
  const SweepResult fine = testMotion(reference(), kDrill, aslant, dot, options);
  EXPECT_EQ(fine.triangles, Indices{0});
  EXPECT_TRUE(fine.fine && fine.not_ruled_out.empty() && fine.in_contact.empty() && !fine.contact());
  EXPECT_EQ(firstTimeOfImpact(fine), std::nullopt);
  options.fine = false;
  EXPECT_TRUE(testMotion(reference(), kDrill, aslant, dot, options).contact());
}

TEST(NarrowPhaseTest, ReportsTimePointAndDepth) {
  const SweepResult down =
      testMotion(reference(), kDrill, {placedAt(0.2, 0.1, 0.3), placedAt(0.2, 0.1, -0.1)}, square(0.0), {});
  EXPECT_EQ(down.not_ruled_out, (Indices{0}));
  ASSERT_EQ(down.in_contact.size(), 1U);
  // The drill points up: its far end, 0.1 m below the tip, comes first, after 0.2 of 0.4 m.
  EXPECT_NEAR(down.in_contact[0].impact.time_of_impact, 0.5, 1e-6);
  EXPECT_TRUE(down.in_contact[0].impact.normal_M.isApprox(Eigen::Vector3d::UnitZ(), 1e-6));
  EXPECT_NEAR(down.in_contact[0].impact.depth, 0.2, 1e-9);
  EXPECT_NEAR(down.in_contact[0].impact.point_M.z(), 0.0, 1e-9);
  EXPECT_NEAR(*firstTimeOfImpact(down), 0.5, 1e-6);
}

TEST(NarrowPhaseTest, DoesNotTestAConfirmedTriangleAgain) {
  const std::vector<Motion> down = {{placedAt(0.2, 0.1, 0.3), placedAt(0.2, 0.1, -0.1)}};
  const SweepCache confirmed{{}, {}, {0, 7}};
  const SweepResult already_confirmed = checkSweep(reference(), {Tool(kDrill), down, square(0.0), {}, confirmed});
  EXPECT_EQ(already_confirmed.not_ruled_out, (Indices{0}));
  EXPECT_TRUE(already_confirmed.in_contact.empty());
  const std::vector<Motion> above = {{placedAt(0.2, 0.1, 0.5), placedAt(0.2, 0.1, 0.3)}};
  EXPECT_FALSE(checkSweep(reference(), {Tool(kDrill), above, square(0.0), {}, confirmed}).contact());
}

// Pushed in further, it keeps the normal of its first contact, though the square's other side is nearer by then.
TEST(NarrowPhaseTest, KeepsTheContactNormalOfItsFirstContact) {
  SweepCache before;
  double depth = 0.0;
  for (double z = 0.11; z > -0.05; z -= 0.01) {
    const std::vector<Motion> push = split({placedAt(0.2, 0.1, z), placedAt(0.2, 0.1, z - 0.01)}, 0.1);
    const SweepResult result = checkSweep(reference(), {Tool(kDrill), push, square(0.0), {}, before});
    before = sweepCache(result);
    if (result.in_contact.empty()) continue;
    EXPECT_TRUE(result.in_contact[0].impact.normal_M.isApprox(Eigen::Vector3d::UnitZ(), 1e-6)) << z;
    EXPECT_NEAR(result.in_contact[0].impact.depth, 0.11 - z, 1e-9);
    EXPECT_GE(result.in_contact[0].impact.depth, depth);
    depth = result.in_contact[0].impact.depth;
  }
  EXPECT_NEAR(depth, 0.11, 1e-9);  // the whole drill, and the last step
}

TEST(VolumeTest, HullIsTighterThanPlanesAndPlanesThanTheBoxAndNoneMissesAContact) {
  Random random(/*seed=*/21);
  const TriangleMesh mesh = wavyHull(24, 40, 0.5);
  size_t named[] = {0, 0, 0};
  for (int i = 0; i < 60; ++i) {
    const Motion motion{random.pose(0.12 * random.direction()), random.pose(0.12 * random.direction())};
    Indices before;
    Indices in_contact;
    for (const VolumeKind kind : {VolumeKind::kObb, VolumeKind::kObbPlanes, VolumeKind::kHull}) {
      SweepOptions options;
      options.volume = kind;
      const SweepResult result = testMotion(reference(), kDrill, motion, mesh, options);
      named[static_cast<size_t>(kind)] += result.triangles.size();
      if (kind == VolumeKind::kObb) in_contact = result.not_ruled_out;
      EXPECT_EQ(result.not_ruled_out, in_contact);
      if (kind != VolumeKind::kObb) {
        const Indices& found = result.triangles;
        EXPECT_TRUE(std::includes(before.begin(), before.end(), found.begin(), found.end()));
      }
      before = result.triangles;
    }
  }
  EXPECT_LT(named[1], 0.95 * static_cast<double>(named[0]));
  EXPECT_LT(named[2], 0.95 * static_cast<double>(named[1]));
}

// Two fingers, open: what is between them meets the box around both, and neither finger.
TEST(SeveralPiecesTest, MeetWhatEachOfThemMeetsAndNotWhatIsBetweenThem) {
  const auto finger = [](double y) {
    return ConvexPiece{
        "finger",
        ConvexShape::box({0.005, 0.005, 0.05}).placed(Eigen::Isometry3d(Eigen::Translation3d(0.0, y, -0.05)))};
  };
  const Tool gripper({finger(-0.04), finger(0.04)});
  const TriangleMesh three({{0, -0.04, -0.01}, {0, 0, -0.01}, {0, 0.04, -0.01}}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  for (const std::string& name : detectorNames()) {
    const auto detector = makeDetector(name);
    const SweepResult result = checkSweep(*detector, {gripper, {Motion{}}, three, {}});
    EXPECT_EQ(result.triangles, (Indices{0, 2})) << name;
    ASSERT_EQ(result.in_contact.size(), 2U);
    EXPECT_EQ(result.in_contact[0].piece, 0U);
    EXPECT_EQ(result.in_contact[1].piece, 1U);
    EXPECT_EQ(result.volumes_M.size(), 2U);
    const SweepResult aside = checkSweep(*detector, {gripper, {{placedAt(1, 0, 0), placedAt(1.1, 0, 0)}}, three, {}});
    EXPECT_TRUE(aside.triangles.empty());
    EXPECT_EQ(aside.volumes_M.size(), 1U);  // of the box around both
  }
}

TEST(InsideOfAWorkpieceTest, IsContactIfTheMeshIsClosedOrLacksLittle) {
  const TriangleMesh closed = wavyHull(24, 40, 0.0);
  std::vector<Eigen::Vector3d> corners;
  for (size_t i = 0; i < closed.vertexCount(); ++i) corners.push_back(closed.vertex(i));
  std::vector<Triangle> some = closed.triangles();
  some.pop_back();
  const TriangleMesh with_a_hole(corners, some);
  some.resize(some.size() / 2);
  const TriangleMesh open(corners, some);
  const ConvexShape bead = ConvexShape::cylinder(0.005, 0.01);
  const SweepResult within = testMotion(reference(), bead, Motion{}, closed, {});
  EXPECT_TRUE(within.triangles.empty());
  EXPECT_TRUE(within.inside && within.contact());
  EXPECT_EQ(firstTimeOfImpact(within), 0.0);
  EXPECT_TRUE(testMotion(reference(), bead, Motion{}, with_a_hole, {}).inside);
  EXPECT_FALSE(testMotion(reference(), bead, Motion{}, open, {}).contact());
  EXPECT_FALSE(testMotion(reference(), bead, Motion{}, TriangleMesh(corners, closed.triangles(), /*is_sheet=*/true), {})
                   .contact());
  EXPECT_FALSE(testMotion(reference(), bead, {placedAt(1, 0, 0), placedAt(1, 0, 0)}, closed, {}).contact());
}

TEST(InsideOfAWorkpieceTest, StaysSoUntilATriangleIsTouched) {
  const TriangleMesh closed = wavyHull(24, 40, 0.0);
  const Tool bead = Tool::cylinder(0.005, 0.01);
  const SweepResult outside = checkSweep(reference(), {bead, {{placedAt(1, 0, 0), placedAt(1, 0, 0)}}, closed, {}});
  EXPECT_EQ(outside.sides, std::vector{PieceSide::kOutside});
  const SweepResult in =
      checkSweep(reference(), {bead, {{placedAt(1, 0, 0), placedAt(0, 0, 0)}}, closed, {}, sweepCache(outside)});
  EXPECT_FALSE(in.not_ruled_out.empty());
  EXPECT_EQ(in.sides, std::vector{PieceSide::kUnknown});
  const SweepResult within = checkSweep(reference(), {bead, {Motion{}}, closed, {}, sweepCache(in)});
  EXPECT_TRUE(within.inside);
  const TriangleMesh another = TriangleMesh({{5, 0, 0}, {5, 1, 0}, {5, 0, 1}}, {{0, 1, 2}});
  EXPECT_TRUE(checkSweep(reference(), {bead, {Motion{}}, another, {}, sweepCache(within)}).inside);
}

}  // namespace
}  // namespace sweep_guard_core
