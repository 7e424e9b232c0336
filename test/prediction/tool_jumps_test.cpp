#include "prediction/tool_jumps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prediction/predictors.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

const SpeedLimits kBelieved{/*max_speed=*/5.0, /*max_turn_rate=*/20.0};

Eigen::Isometry3d placedAt(double x, double turn = 0.0) {
  return Eigen::Translation3d(x, 0.0, 0.0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
}

class ToolJumpsTest : public testing::Test {
 protected:
  std::string moveTo(double seconds, double x, double turn = 0.0, const SpeedLimits& limits = kBelieved) {
    return tool_.add({at(seconds), placedAt(x, turn)}, limits);
  }
  std::string turnTo(double seconds, double elbow, double slide = 0.0) {
    return arm_.add({at(seconds), placedAt(0.0), {elbow, slide}}, kBelieved);
  }

  ToolJumps tool_{"drill", "world", {}};
  ToolJumps arm_{"hand",
                 "world",
                 {{"elbow", -kUnlimited, kUnlimited, false, /*velocity=*/2.0},
                  {"slide", -kUnlimited, kUnlimited, false, 0.0, /*turns=*/false}}};
};

TEST_F(ToolJumpsTest, AToolThatIsElsewhereAtTheNextPoseHasJumped) {
  EXPECT_EQ(moveTo(0.0, 0.0), "");
  EXPECT_EQ(moveTo(0.01, 0.001), "");
  EXPECT_EQ(moveTo(0.02, 1.001), "the tool 'drill' jumped against 'world': 50 m/s");
  EXPECT_EQ(moveTo(0.03, 1.002), "") << "it stays there";
  EXPECT_EQ(moveTo(0.04, 0.002), "the tool 'drill' jumped against 'world': 50 m/s") << "and back";
  EXPECT_EQ(moveTo(0.05, 0.002, 1.0), "the tool 'drill' jumped against 'world': 50 rad/s");
}

TEST_F(ToolJumpsTest, AJointThatIsElsewhereAtTheNextStateIsNamed) {
  for (int i = 0; i < 100; ++i) ASSERT_EQ(turnTo(0.008 * i, 0.01 * i), "");
  EXPECT_EQ(turnTo(0.8, 0.99 + 2.6), "joint 'elbow' jumped: 130 rad/s");
  EXPECT_EQ(turnTo(0.808, 1.0 + 2.6), "");
  EXPECT_EQ(turnTo(0.816, 1.01 + 2.6, 0.3), "joint 'slide' jumped: 15 m/s");
}

// 0.157 m/s, in millimeters.
TEST_F(ToolJumpsTest, AToolThatGoesOnAsFastIsToldOfWithItsSpeed) {
  for (const double rate : {20.0, 100.0, 1000.0}) {
    tool_.reset();
    std::string told;
    for (int i = 0; i < 0.2 * rate; ++i) told = moveTo(i / rate, 157.0 * i / rate);
    EXPECT_EQ(told, "the tool 'drill' moves at 157 m/s against 'world', as a pose in millimeters does") << rate;
    EXPECT_EQ(moveTo(0.2 + 1.0 / rate, 157.0 * (0.2 - 1.0 / rate)), "") << "it has stopped";
    EXPECT_EQ(moveTo(0.2 + 2.0 / rate, 0.0).find("the tool 'drill' jumped against 'world': "), 0U);
  }
}

TEST_F(ToolJumpsTest, TwoJumpsInARowAreNoMotion) {
  moveTo(0.0, 0.0);
  for (const double seconds : {0.1, 0.2})
    EXPECT_EQ(moveTo(seconds, 50.0 * seconds).find("the tool 'drill' jumped"), 0U);
}

TEST_F(ToolJumpsTest, PlacesThatAlternateAreNoMotion) {
  for (int ms = 0; ms < 200; ms += 10) {
    const std::string told = moveTo(0.001 * ms, ms % 20 == 0 ? 0.0 : 1.0);
    EXPECT_EQ(told.find("the tool 'drill' jumped"), ms > 0 ? 0U : std::string::npos) << told;
  }
}

TEST_F(ToolJumpsTest, AJumpThatComesInPartsIsFound) {
  for (int ms = 0; ms < 100; ++ms) ASSERT_EQ(turnTo(0.001 * ms, 0.0), "");
  int found = 0;
  for (int ms = 100; ms < 108; ++ms) found += turnTo(0.001 * ms, 0.3 * (ms - 99)).empty() ? 0 : 1;
  EXPECT_GE(found, 6);
  for (int ms = 108; ms < 200; ++ms) ASSERT_EQ(turnTo(0.001 * ms, 2.4), "") << "it rests again";
}

TEST_F(ToolJumpsTest, MotionWithinTheLimitsIsNone) {
  for (const double period : {0.001, 0.008, 0.033, 0.2}) {
    for (int i = 0; i < 200; ++i) ASSERT_EQ(moveTo(period * i, 4.9 * period * i, 19.5 * period * i), "") << period;
    tool_.reset();
  }
}

TEST_F(ToolJumpsTest, JitterAndBurstsOfStampsAreNone) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double jitter = random.chance(0.5) ? 0.0009 : 0.0;
    ASSERT_EQ(moveTo(0.001 * i + jitter, 3.0 * 0.001 * i), "") << "at 1 kHz, pose " << i;
  }
  tool_.reset();
  for (int i = 0; i < 500; ++i)
    ASSERT_EQ(moveTo(0.05 * (i / 5) + 0.001 * (i % 5), 2.0 * 0.01 * i), "") << "bursts of five";
}

TEST_F(ToolJumpsTest, LessThanTwentyMillimetersOrATenthOfARadianIsNone) {
  const SpeedLimits slow{0.1, 0.5};
  moveTo(0.0, 0.0, 0.0, slow);
  EXPECT_EQ(moveTo(0.01, 0.019, 0.09, slow), "");
  EXPECT_NE(moveTo(0.02, 0.040, 0.09, slow), "");
  EXPECT_NE(moveTo(0.03, 0.040, 0.20, slow), "");
}

TEST_F(ToolJumpsTest, AGapIsNoJumpWhereTheLimitsAllowIt) {
  moveTo(0.0, 0.0);
  EXPECT_EQ(moveTo(1.0, 4.5), "");
  EXPECT_EQ(moveTo(1.5, 7.5), "the tool 'drill' jumped against 'world': 6 m/s");
}

TEST_F(ToolJumpsTest, AJointFasterThanTwiceItsVelocityIsToldOfAndIsNoJump) {
  EXPECT_EQ(turnTo(0.0, 0.0), "");
  EXPECT_EQ(turnTo(0.1, 0.35), "");
  EXPECT_EQ(arm_.faster(), "");
  EXPECT_EQ(turnTo(0.2, 0.80), "");
  EXPECT_EQ(arm_.faster(), "joint 'elbow' moved at 4.5 rad/s: the robot description says 2 rad/s");
  EXPECT_EQ(turnTo(0.3, 0.80, 0.45), "") << "it says nothing of the slide";
  EXPECT_EQ(arm_.faster(), "");
}

}  // namespace
}  // namespace sweep_guard_core
