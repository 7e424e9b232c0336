#include "sweep_guard/kinematics/joint_limits.h"

#include <gtest/gtest.h>

#include <limits>

namespace sweep_guard_core {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

JointVariable turning(const std::string& name, double lower, double upper) { return {name, lower, upper}; }

JointVariable sliding(const std::string& name, double lower, double upper) {
  JointVariable joint{name, lower, upper};
  joint.turns = false;
  return joint;
}

// An arm whose shoulder and slide are within their limits, and one joint more.
std::string textOf(const JointVariable& joint, double position) {
  return contradictedLimits({turning("shoulder", -2.0, 2.0), sliding("slide", 0.0, 0.2), joint}, {2.0, 0.0, position});
}

TEST(JointLimitsTest, AJointInAnotherUnitIsToldOf) {
  EXPECT_EQ(contradictedLimits({turning("shoulder", -2.0, 2.0)}, {90.0}),
            "joint 'shoulder' is at 90, beyond its limits -2 to 2 of the robot description: degrees?");
  EXPECT_EQ(textOf(turning("elbow", -3.0, 0.5), -120.0),
            "joint 'elbow' is at -120, beyond its limits -3 to 0.5 of the robot description: degrees?");
  EXPECT_EQ(textOf(sliding("jaw", 0.0, 0.04), 20.0),
            "joint 'jaw' is at 20, beyond its limits 0 to 0.04 of the robot description: millimeters?");
}

TEST(JointLimitsTest, LimitsThatAreTooNarrowAreToldOfWithoutAnotherUnit) {
  EXPECT_EQ(textOf(turning("wrist", 0.0, 0.0), 0.1),
            "joint 'wrist' is at 0.1, beyond its limits 0 to 0 of the robot description");
  EXPECT_EQ(textOf(turning("wrist", -3.14159, 3.14159), 4.5),
            "joint 'wrist' is at 4.5, beyond its limits -3.14159 to 3.14159 of the robot description");
  EXPECT_EQ(textOf(turning("wrist", -2.0, 2.0), 500.0),
            "joint 'wrist' is at 500, beyond its limits -2 to 2 of the robot description");
  EXPECT_EQ(textOf(sliding("lift", 0.1, 0.3), 0.09),
            "joint 'lift' is at 0.09, beyond its limits 0.1 to 0.3 of the robot description");
}

TEST(JointLimitsTest, AThousandthOfTheRangeButAtLeastOneThousandthIsTolerated) {
  EXPECT_EQ(textOf(turning("wrist", -2.0, 2.0), 2.0039), "");
  EXPECT_NE(textOf(turning("wrist", -2.0, 2.0), 2.0041), "");
  EXPECT_EQ(textOf(sliding("jaw", 0.0, 0.04), -0.0009), "");
  EXPECT_NE(textOf(sliding("jaw", 0.0, 0.04), -0.0011), "");
  EXPECT_EQ(textOf(turning("wrist", -kUnlimited, 1.0), 1.0009), "");
  EXPECT_NE(textOf(turning("wrist", -kUnlimited, 1.0), 1.0011), "");
}

TEST(JointLimitsTest, AJointWithoutLimitsContradictsNone) {
  JointVariable spindle = turning("spindle", -1.0, 1.0);
  spindle.continuous = true;
  for (const double position : {3.0, -90.0, 1e9}) {
    EXPECT_EQ(textOf(spindle, position), "") << position;
    EXPECT_EQ(textOf(turning("wheel", -kUnlimited, kUnlimited), position), "") << position;
  }
}

}  // namespace
}  // namespace sweep_guard_core
