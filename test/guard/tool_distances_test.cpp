#include "guard/tool_distances.h"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// 0.2 m wide and long, 0.1 m high, its middle at the origin.
TriangleMesh flatBox(double scale = 1.0) {
  std::vector<Eigen::Vector3d> corners = {{-0.1, -0.1, -0.05}, {0.1, -0.1, -0.05}, {0.1, 0.1, 0.05}, {-0.1, 0.1, 0.05}};
  for (Eigen::Vector3d& corner : corners) corner *= scale;
  return TriangleMesh(corners, {{0, 1, 2}, {0, 2, 3}});
}

std::shared_ptr<const Workpiece> slabNamed(const std::string& id, const std::string& frame = "table",
                                           double scale = 1.0) {
  return std::make_shared<const Workpiece>(Workpiece{id, 1, {}, {}, frame, flatBox(scale)});
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
  double now(const std::string& id = "slab") const { return distances_.get().at(id).now.value(); }
  double least(const std::string& id = "slab") const { return distances_.get().at(id).least.value(); }
  bool isKnown() const { return distances_.get().at("slab").now.has_value(); }

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
  EXPECT_FALSE(distances_.get().at("unplaced").least);
  measure(60, {0.0, 0.0, 1.05}, {slabNamed("other")});
  EXPECT_EQ(distances_.get().size(), 1U);
  measure(80, {0.0, 0.0, 1.05}, workpieces_);
  EXPECT_NEAR(least(), 1.0, 1e-6) << "it came again";
}

// Its mesh was in millimeters, inches or feet, and comes in meters; or the other way round.
TEST_F(ToolDistancesTest, TheLeastBeginsAnewWithTheUnit) {
  int ms = 0;
  for (const double unit : {1000.0, 39.37, 3.281, 0.0254, 0.001}) {
    measure(ms += 20, {0.0, 0.0, 0.0}, {slabNamed("slab", "table", unit)});
    EXPECT_EQ(least(), 0.0) << unit;
    measure(ms += 20, {0.0, 0.0, 1.05}, workpieces_);
    EXPECT_NEAR(least(), 1.0, 1e-6) << unit;
  }
}

TEST_F(ToolDistancesTest, TheLeastIsKeptWhileTheMeshDeforms) {
  int ms = 0;
  double scale = 1.0;
  measure(ms, {0.0, 0.0, 0.25}, workpieces_);
  for (const double factor : {2.9, 2.9, 0.4, 0.35, 1.0}) {
    measure(ms += 20, {0.0, 0.0, 9.0}, {slabNamed("slab", "table", scale *= factor)});
    EXPECT_NEAR(least(), 0.2, 1e-6) << factor;
  }
}

TEST_F(ToolDistancesTest, ThereIsNoneWhileTheFrameIsNotKnown) {
  measure(0, {0.0, 0.0, 0.25}, workpieces_);
  int ms = 0;
  for (const std::string frame : {"nowhere", "", "bench"}) {
    measure(ms += 20, {0.0, 0.0, 1.05}, {slabNamed("slab", frame)});
    EXPECT_FALSE(isKnown()) << frame;
    EXPECT_NEAR(least(), 0.2, 1e-6) << "as before";
    measure(ms += 20, {0.0, 0.0, 1.05}, workpieces_);
    EXPECT_NEAR(now(), 1.0, 1e-6) << "it is known again";
    EXPECT_NEAR(least(), 0.2, 1e-6);
  }
  measure(ms + 20, {0.0, 0.0, 1.05}, {slabNamed("slab", "nowhere", 1000.0)});
  EXPECT_FALSE(distances_.get().at("slab").least) << "of the other unit nothing is known";
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
