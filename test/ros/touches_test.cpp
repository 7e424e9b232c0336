// Reads what a running guard has counted.
#include <gtest/gtest.h>
#include <sweep_guard/Touches.h>

#include "node_fixture.h"
#include "proximity_listener.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::ObjectTouches;
using sweep_guard::Touches;

const Eigen::Vector3d kBefore(0.03, -0.05, 0.02);  // over one triangle of the square, far from the other
const Eigen::Vector3d kBehind(0.03, -0.05, -0.01);

class TouchesTest : public NodeTest {
 protected:
  void SetUp() override {
    NodeTest::SetUp();
    resetTouches();
  }

  void resetTouches() {
    std_srvs::Trigger service;
    ASSERT_TRUE(ros::service::call("/sweep_guard/reset_touches", service));
    EXPECT_TRUE(service.response.success) << service.response.message;
  }

  void touch(const Eigen::Vector3d& tip = kBehind) {
    moveTo(kBefore);
    moveTo(tip);
    moveTo(kBefore);
  }

  // Once something was touched at the newest pose that touched.
  Touches touchesUpTo(ros::Time stamp) const {
    return touches_.awaitNewest([&](const Touches& touches) { return touches.header.stamp >= stamp; });
  }
  // After the touch, the tool leaves: its last sweep touches, too.
  ObjectTouches afterTheTouch() const {
    const Touches touches = touchesUpTo(probe().time());
    EXPECT_EQ(touches.objects.size(), 1U);
    return touches.objects.empty() ? ObjectTouches() : touches.objects[0];
  }

  TopicListener<Touches> touches_{"touches"};
};

TEST_F(TouchesTest, CountsTheSweepsThatTouchATriangleAndItsDepth) {
  placeSquare("square", {0.0, 0.0, 0.0});
  touch();
  const ObjectTouches square = afterTheTouch();
  EXPECT_EQ(square.mesh_id, "square");
  EXPECT_EQ(square.revision, 1U);
  ASSERT_EQ(square.triangles.size(), 1U);
  EXPECT_EQ(square.sweeps, std::vector<std::uint32_t>{2});
  ASSERT_EQ(square.depths.size(), 1U);
  EXPECT_NEAR(square.depths[0], 0.01, 1e-6);
}

TEST_F(TouchesTest, ADeformationKeepsTheCountsAndOtherTrianglesBeginAnew) {
  placeSquare("square", {0.0, 0.0, 0.0});
  touch();
  ASSERT_EQ(afterTheTouch().sweeps, std::vector<std::uint32_t>{2});
  probe().place(squareMovedTo("square", {0.0, 0.0, -0.004}, probe().time()));
  touch();
  const ObjectTouches deformed = afterTheTouch();
  EXPECT_EQ(deformed.sweeps, std::vector<std::uint32_t>{2 + 1 + 2});  // the path was swept again along the deformation
  ASSERT_EQ(deformed.depths.size(), 1U);
  EXPECT_NEAR(deformed.depths[0], 0.01, 1e-6);

  auto turned = squareAt("square", {0.0, 0.0, 0.0}, probe().time());
  std::swap(turned.mesh.triangles[0], turned.mesh.triangles[1]);
  turned.revision = 2;
  probe().place(turned);
  touch();
  const ObjectTouches anew = afterTheTouch();
  EXPECT_EQ(anew.revision, 2U);
  EXPECT_EQ(anew.sweeps, std::vector<std::uint32_t>{2});
}

TEST_F(TouchesTest, ResetTouchesBeginsAnewAndSaysSo) {
  placeSquare("square", {0.0, 0.0, 0.0});
  touch();
  ASSERT_EQ(afterTheTouch().sweeps, std::vector<std::uint32_t>{2});
  resetTouches();
  const Touches none = touches_.awaitNewest([](const Touches& touches) { return touches.objects.empty(); });
  EXPECT_EQ(none.header.stamp, ros::Time());
  touch();
  EXPECT_EQ(afterTheTouch().sweeps, std::vector<std::uint32_t>{2});
}

TEST_F(TouchesTest, AResetOfTheGuardKeepsTheCounts) {
  placeSquare("square", {0.0, 0.0, 0.0});
  touch();
  ASSERT_TRUE(probe().reset().success);
  touch();
  EXPECT_EQ(afterTheTouch().sweeps, std::vector<std::uint32_t>{4});
}

TEST_F(TouchesTest, ARemovedWorkpieceIsForgotten) {
  placeSquare("square", {0.0, 0.0, 0.0});
  touch();
  afterTheTouch();
  probe().remove("square");
  probe().tick(0.01);
  probe().publish(poseAt(kBefore, probe().time()));  // without a workpiece there are no contacts to wait for
  touches_.awaitNewest([](const Touches& touches) { return touches.objects.empty(); });
}

TEST_F(TouchesTest, WhoSubscribesLaterGetsThem) {
  placeSquare("square", {0.0, 0.0, 0.0});
  touch();
  const TopicListener<Touches> late("touches");
  const ros::Time stamp = probe().time();
  const Touches heard = late.awaitNewest([&](const Touches& touches) { return touches.header.stamp >= stamp; });
  EXPECT_EQ(heard.objects.size(), 1U);
}

TEST_F(TouchesTest, WhereNothingIsTouchedNothingIsCounted) {
  placeSquare("square", {0.0, 0.0, 0.0});
  placeSquare("plate", {0.0, 0.0, -0.05});
  touch();
  EXPECT_EQ(afterTheTouch().mesh_id, "square");
}

}  // namespace
}  // namespace sweep_guard_ros
