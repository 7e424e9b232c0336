#include "guard/tool_distances.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// 0.2 m wide and long, 0.1 m high, its middle at the origin.
TriangleMesh flatBox() {
  return TriangleMesh({{-0.1, -0.1, -0.05}, {0.1, -0.1, -0.05}, {0.1, 0.1, 0.05}, {-0.1, 0.1, 0.05}},
                      {{0, 1, 2}, {0, 2, 3}});
}

std::shared_ptr<const Workpiece> slabNamed(const std::string& id, const std::string& frame = "table") {
  return std::make_shared<const Workpiece>(Workpiece{id, 1, {}, {}, frame, flatBox()});
}

class ToolDistancesTest : public testing::Test {
 protected:
  // The tip of a drill of 0.2 m that points down, and where the table is.
  void measure(int ms, const Eigen::Vector3d& tip, const Workpieces& workpieces,
               const Eigen::Isometry3d& X_WM = Eigen::Isometry3d::Identity()) {
    PoseWithFrames pose;
    pose.X_WT = placedAt(tip) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
    pose.bodies = {{pose.X_WT}};
    pose.X_WM["table"] = X_WM;
    distances_.add(pose, workpieces, SteadyTime(milliseconds(ms)), {&drill_});
  }
  double now(const std::string& id = "slab") const { return distances_.get().at(id).now; }
  double least(const std::string& id = "slab") const { return distances_.get().at(id).least; }

  const Tool drill_{ConvexShape::cylinder(0.01, 0.2)};
  const Workpieces workpieces_{slabNamed("slab")};
  ToolDistances distances_;
};

TEST_F(ToolDistancesTest, AreThoseToTheBoxAroundTheMesh) {
  measure(0, {0.0, 0.0, 0.45}, workpieces_);
  EXPECT_NEAR(now(), 0.4, 1e-6);
  measure(20, {0.5, 0.0, 0.0}, workpieces_);
  EXPECT_NEAR(now(), 0.39, 1e-3) << "beside it: from the side of the drill";
  measure(40, {0.0, 0.0, 0.0}, workpieces_);
  EXPECT_EQ(now(), 0.0);
  measure(60, {0.0, 0.0, 0.45}, workpieces_, placedAt(0.0, 0.0, -2.0));
  EXPECT_NEAR(now(), 2.4, 1e-6) << "the table has moved";
  EXPECT_EQ(least(), 0.0);
}

TEST_F(ToolDistancesTest, AreNeverMoreThanThatOfATurnedTool) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d X_MT = random.pose(random.inBox({0.6, 0.6, 0.6}));
    double nearest = std::numeric_limits<double>::infinity();
    for (const double z : {0.0, -0.1, -0.2}) {
      const Eigen::Vector3d p_M = X_MT * Eigen::Vector3d(0.0, 0.0, z);
      nearest = std::min(nearest, flatBox().bounds_M().exteriorDistance(p_M));
    }
    const double distance = boxDistance(drill_, X_MT, flatBox());
    EXPECT_LE(distance, nearest + 1e-9);
    EXPECT_GE(distance, 0.0);
  }
}

TEST_F(ToolDistancesTest, TheLeastIsKeptAsLongAsTheWorkpieceIsThere) {
  measure(0, {0.0, 0.0, 0.25}, workpieces_);
  measure(20, {0.0, 0.0, 1.05}, workpieces_);
  EXPECT_NEAR(least(), 0.2, 1e-6);
  EXPECT_NEAR(now(), 1.0, 1e-6);
  measure(40, {0.0, 0.0, 1.05}, {slabNamed("other"), slabNamed("slab"), slabNamed("unplaced", "nowhere")});
  EXPECT_NEAR(least(), 0.2, 1e-6);
  EXPECT_NEAR(least("other"), 1.0, 1e-6);
  EXPECT_EQ(distances_.get().count("unplaced"), 0U);
  measure(60, {0.0, 0.0, 1.05}, {slabNamed("other")});
  EXPECT_EQ(distances_.get().size(), 1U);
  measure(80, {0.0, 0.0, 1.05}, workpieces_);
  EXPECT_NEAR(least(), 1.0, 1e-6) << "it came again";
}

TEST_F(ToolDistancesTest, AreKeptWhileTheFrameIsNotKnown) {
  measure(0, {0.0, 0.0, 0.25}, {slabNamed("slab")});
  measure(20, {0.0, 0.0, 1.05}, {slabNamed("slab", "nowhere")});
  EXPECT_NEAR(now(), 0.2, 1e-6);
  EXPECT_NEAR(least(), 0.2, 1e-6);
}

TEST_F(ToolDistancesTest, OfAThousandWorkpiecesAreMeasuredEveryTwentyMilliseconds) {
  Workpieces many;
  for (int i = 1000; i < 2000; ++i) many.push_back(slabNamed(std::to_string(i)));
  for (int ms = 0; ms < 20; ++ms) measure(ms, {0.0, 0.0, 1.05 - 0.04 * ms}, many);
  EXPECT_NEAR(least("1500"), 1.0, 1e-6);
  measure(20, {0.0, 0.0, 0.25}, many);
  EXPECT_NEAR(least("1500"), 0.2, 1e-6);
  measure(40, {0.0, 0.0, 0.25}, workpieces_);
  measure(41, {0.0, 0.0, 0.15}, workpieces_);
  EXPECT_NEAR(now(), 0.1, 1e-6) << "a single one at each pose";
}

TEST_F(ToolDistancesTest, AreThoseOfTheNearestBody) {
  PoseWithFrames pose;
  pose.X_WM["table"] = Eigen::Isometry3d::Identity();
  pose.bodies = {{placedAt(0.0, 0.0, 5.0)}, {placedAt(0.0, 0.0, 1.05 + 0.2)}, {placedAt(0.0, 0.0, -9.0)}};
  distances_.add(pose, workpieces_, SteadyTime(), {&drill_, &drill_, &drill_});
  EXPECT_NEAR(now(), 1.0, 1e-6);
}

}  // namespace
}  // namespace sweep_guard_core
