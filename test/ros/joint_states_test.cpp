// The arm of arm.urdf along x, 1 m above the origin; its base rests and its joints move.
#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <sweep_guard/Touches.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>

#include "connected_publisher.h"
#include "guard_probe.h"
#include "node_fixture.h"
#include "proximity_listener.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Contacts;
using sweep_guard::Prediction;
using sweep_guard::Warning;

using Positions = std::map<std::string, double>;

const Positions kStraight = {{"shoulder", 0.0}, {"elbow", 0.0}, {"jaw", 0.04}};

ros::Publisher& jointPublisher() {
  static ros::Publisher publisher = ros::NodeHandle().advertise<sensor_msgs::JointState>("joint_states", 1000);
  return publisher;
}

ros::Publisher& secondDriver() {
  static ConnectedPublisher<sensor_msgs::JointState> publisher("/other_robot/joint_states");
  return *publisher;
}

void placeBase(double z) {
  static ros::Publisher mount = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true);
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped& base = message.transforms.emplace_back();
  base.header.frame_id = "world";
  base.child_frame_id = "base";
  base.transform.translation.z = z;
  base.transform.rotation.w = 1.0;
  mount.publish(message);
}

GuardProbe& jointProbe() {
  static bool is_placed = false;
  if (!is_placed) placeBase(1.0);
  is_placed = true;
  static GuardProbe probe(/*drives_clock=*/true, ProbeSource::kTf);
  return probe;
}

class JointStatesTest : public testing::Test {
 protected:
  void SetUp() override {
    jointProbe().advance(2.0);
    jointProbe().skipWarnings();
    jointProbe().reset();
    jointProbe().awaitWarning(hasReason(Warning::NO_POSE));  // those before are of the test before
  }
  void TearDown() override {
    for (const std::string& id : placed_) jointProbe().remove(id);
  }

  void publish(const Positions& positions) { publish(positions, jointPublisher()); }
  static void publish(const Positions& positions, ros::Publisher& publisher) {
    sensor_msgs::JointState message;
    message.header.stamp = jointProbe().time();
    for (const auto& [name, position] : positions) {
      message.name.push_back(name);
      message.position.push_back(position);
    }
    publisher.publish(message);
  }

  void placeSquare(const std::string& id, const Eigen::Vector3d& center, double half_side) {
    placed_.insert(id);
    jointProbe().place(squareAt(id, center, jointProbe().time(), half_side));
  }

  // Publishes the positions until a warning fits.
  Warning holdUntil(const Positions& positions, const std::function<bool(const Warning&)>& fits) {
    for (int i = 0; i < 3000; ++i) {
      jointProbe().tick(0.01);
      publish(positions);
      Warning warning = jointProbe().awaitWarning([](const Warning&) { return true; });
      if (fits(warning)) return warning;
    }
    ADD_FAILURE() << "no such warning; the last: " << jointProbe().warnings().back().text;
    return {};
  }

  // Moves the joints from the first to the second positions within 0.2 s, and returns what was touched.
  std::vector<Contacts> move(const Positions& from, const Positions& to) {
    jointProbe().forgetContacts();
    for (int i = 0; i <= 20; ++i) {
      jointProbe().tick(0.01);
      Positions now;
      for (const auto& [name, position] : from) now[name] = position + 0.05 * i * (to.at(name) - position);
      publish(now);
    }
    return jointProbe().awaitContactsUpTo(jointProbe().time());
  }

  std::set<std::string> placed_;
};

std::set<std::string> linksIn(const std::vector<Contacts>& contacts) {
  std::set<std::string> links;
  for (const Contacts& sweep : contacts) {
    for (const auto& object : sweep.objects) {
      for (const auto& impact : object.impacts) links.insert(impact.tool_link);
    }
  }
  return links;
}

bool isClearNow(const Warning& warning) { return warning.clear; }

TEST_F(JointStatesTest, AnArmAtRestFarFromTheWorkpieceIsClear) {
  placeSquare("square", {0.0, 0.0, -3.0}, 0.1);
  EXPECT_TRUE(holdUntil(kStraight, isClearNow).clear);
}

// The hand stays 0.1 m above the square's plane and passes beside it.
TEST_F(JointStatesTest, TheUpperArmMeetsWhatTheHandMisses) {
  placeSquare("square", {0.15, 0.0, 0.85}, 0.02);
  holdUntil(kStraight, isClearNow);
  const auto contacts = move(kStraight, {{"shoulder", 1.0}, {"elbow", -1.0}, {"jaw", 0.04}});
  EXPECT_TRUE(endToEnd(contacts));
  EXPECT_EQ(linksIn(contacts), std::set<std::string>{"upper"});
  const Warning warning = jointProbe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_EQ(warning.mesh_id, "square");
  EXPECT_EQ(warning.tool_link, "upper");
}

// It lies between the fingers, 0.02 m left of the middle.
TEST_F(JointStatesTest, TheFingerThatClosesOnAWorkpieceIsNamed) {
  placeSquare("square", {0.52, 0.02, 1.0}, 0.003);
  holdUntil(kStraight, isClearNow);
  const auto contacts = move(kStraight, {{"shoulder", 0.0}, {"elbow", 0.0}, {"jaw", 0.0}});
  EXPECT_EQ(linksIn(contacts), std::set<std::string>{"left"});
}

class BaseChangeTest : public JointStatesTest {
 protected:
  void TearDown() override {
    change(1.0);
    holdUntil(kStraight, isClearNow);
    JointStatesTest::TearDown();
  }

  // What was published before is swept before.
  void change(double z) {
    jointProbe().awaitContactsUpTo(jointProbe().time());
    jointProbe().skipWarnings();
    placeBase(z);
    jointProbe().awaitWarning([](const Warning& next) { return (next.reasons & Warning::TIME_JUMP) != 0; });
  }
};

TEST_F(BaseChangeTest, TheMoveItselfIsNoMotion) {
  placeSquare("square", {0.3, 0.0, 2.0}, 0.1);
  holdUntil(kStraight, isClearNow);
  change(3.0);
  EXPECT_EQ(linksIn(move(kStraight, kStraight)), std::set<std::string>{});
}

TEST_F(BaseChangeTest, WhatTheJointsMeetMeanwhileIsFoundInBothPlaces) {
  for (const double square_z : {0.7, 2.7}) {
    placeSquare("square", {0.32, 0.0, square_z}, 0.05);
    holdUntil(kStraight, isClearNow);
    change(3.0);
    jointProbe().forgetContacts();
    const Positions down = {{"shoulder", 1.5}, {"elbow", 0.0}, {"jaw", 0.04}};
    for (int i = 0; i < 2; ++i) {
      jointProbe().tick(0.01);
      publish(down);
    }
    EXPECT_FALSE(linksIn(jointProbe().awaitContactsUpTo(jointProbe().time())).empty()) << square_z;
    holdUntil(kStraight, isClearNow);
    change(1.0);
  }
  change(3.0);
}

TEST_F(JointStatesTest, TheLinkThatWillTouchFirstIsPredicted) {
  placeSquare("square", {0.36, 0.0, 0.75}, 0.02);
  holdUntil(kStraight, isClearNow);
  Positions now = kStraight;
  jointProbe().skipWarnings();
  for (int i = 0; i < 60; ++i) {
    now["shoulder"] += 0.005;
    jointProbe().tick(0.01);
    publish(now);
    jointProbe().awaitPrediction(jointProbe().time());
  }
  const Warning warning = jointProbe().awaitWarning(
      [](const Warning& next) { return next.level == Warning::CONSIDERED || next.level == Warning::REFLEX; });
  EXPECT_EQ(warning.tool_link, "fore") << warning.text;
  const Prediction prediction = jointProbe().predictions().back();
  ASSERT_EQ(prediction.bodies.size(), 4U);
  std::set<std::string> links;
  for (const auto& body : prediction.bodies) {
    EXPECT_EQ(body.poses.size(), prediction.poses.size());
    links.insert(body.links.begin(), body.links.end());
  }
  EXPECT_EQ(links, (std::set<std::string>{"fore", "left", "right", "upper"}));
}

TEST_F(JointStatesTest, JointsMayComeInMessagesOfTheirOwn) {
  placeSquare("square", {0.45, 0.0, 0.9}, 0.03);
  holdUntil(kStraight, isClearNow);
  jointProbe().forgetContacts();
  for (int i = 0; i <= 40; ++i) {
    jointProbe().tick(0.005);
    publish({{"shoulder", 0.01 * i}});
    publish({{"elbow", 0.0}, {"jaw", 0.04}, {"of another arm", 7.0}});
  }
  EXPECT_EQ(linksIn(jointProbe().awaitContactsUpTo(jointProbe().time())), std::set<std::string>{"fore"});
}

TEST_F(JointStatesTest, ASilentJointIsNamed) {
  placeSquare("square", {0.0, 0.0, -3.0}, 0.1);
  holdUntil(kStraight, isClearNow);
  const auto names = [](const std::string& joint) {
    return [joint](const Warning& warning) {
      return hasReason(Warning::POSE_STALE)(warning) && warning.text.find("joint '" + joint + "'") != std::string::npos;
    };
  };
  const ros::Time last = jointProbe().time();
  holdUntil({{"shoulder", 0.0}, {"jaw", 0.04}}, names("elbow"));
  EXPECT_GT((jointProbe().time() - last).toSec(), 0.1);
  holdUntil(kStraight, isClearNow);
  const ros::Time last_jaw = jointProbe().time();
  holdUntil({{"shoulder", 0.0}, {"elbow", 0.0}}, names("jaw"));
  EXPECT_GT((jointProbe().time() - last_jaw).toSec(), 0.3) << "it has a time-out of its own";
  holdUntil(kStraight, isClearNow);
}

sensor_msgs::JointState message(ros::Time stamp, const std::vector<std::string>& names,
                                const std::vector<double>& positions) {
  sensor_msgs::JointState message;
  message.header.stamp = stamp;
  message.name = names;
  message.position = positions;
  return message;
}

TEST_F(JointStatesTest, BadPositionsAreRefusedByNodeAndJoint) {
  placeSquare("square", {0.0, 0.0, -3.0}, 0.1);
  const struct {
    double stamp;  // [s], after now; NaN: none
    std::vector<double> positions;
    std::uint32_t reason;
    std::string expected;
  } cases[] = {
      {0.0, {0.0, std::nan("")}, Warning::POSE_INVALID, "joint 'shoulder' is at nan"},
      {0.0, {}, Warning::POSE_INVALID, "it names 2 joints, 'shoulder' among them, and has 0 positions"},
      {std::nan(""), {0.0, 0.0}, Warning::POSE_INVALID, "joint 'shoulder': stamp is 0: stamp each message"},
      {3.0, {0.0, 0.0}, Warning::FUTURE_STAMP, "joint 'shoulder': stamp lies in the future"},
  };
  for (const auto& one : cases) {
    holdUntil(kStraight, isClearNow);
    jointProbe().tick(0.01);
    const ros::Time stamp = std::isnan(one.stamp) ? ros::Time() : jointProbe().time() + ros::Duration(one.stamp);
    jointPublisher().publish(message(stamp, {"wheel", "shoulder"}, one.positions));
    const Warning warning = jointProbe().awaitWarning(hasReason(one.reason));
    const std::string expected = "joint_states of " + ros::this_node::getName() + ": " + one.expected;
    EXPECT_NE(warning.text.find(expected), std::string::npos) << warning.text;
  }
  holdUntil(kStraight, isClearNow);
}

// The other node publishes every third time, and positions in between are swept. The fault ends after that node has fallen silent.
TEST_F(JointStatesTest, JointsThatTwoNodesPublishAreNeverClear) {
  placeSquare("square", {0.0, 0.0, -3.0}, 0.1);
  for (const Positions& others : {kStraight, Positions{{"shoulder", 1.5}}, Positions{{"jaw", 0.0}}}) {
    holdUntil(kStraight, isClearNow);
    int steps = 0;
    const auto hold_against = [&](const std::function<bool(const Warning&)>& fits) {
      return holdUntil(kStraight, [&](const Warning& warning) {
        if (++steps % 3 == 0) publish(others, secondDriver());
        return fits(warning);
      });
    };
    const Warning first = hold_against(hasReason(Warning::MULTI_PUBLISHER));
    EXPECT_NE(first.text.find("/other_robot: let one of them"), std::string::npos) << first.text;
    const size_t begin = jointProbe().warnings().size();
    steps = 0;
    hold_against([&](const Warning&) { return steps == 100; });
    const auto warnings = jointProbe().warnings();
    EXPECT_TRUE(std::none_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(), isClearNow));
  }
  holdUntil(kStraight, isClearNow);
}

TEST_F(JointStatesTest, AJointBeyondItsLimitsIsToldOf) {
  placeSquare("square", {0.0, 0.0, -3.0}, 0.1);
  const std::pair<std::string, double> cases[] = {{"shoulder", 90.0}, {"elbow", 3.5}, {"jaw", -0.01}};
  for (const auto& [joint, position] : cases) {
    holdUntil(kStraight, isClearNow);
    Positions beyond = kStraight;
    beyond[joint] = position;
    const auto is_told = [name = joint](const GuardProbe::Status& status) {
      return status.level != GuardProbe::Status::OK &&
             status.message.find("joint '" + name + "' is at ") != std::string::npos &&
             status.message.find("of the robot description") != std::string::npos;
    };
    bool told = false;
    for (int tries_left = 10; !told && tries_left > 0; --tries_left) {
      jointProbe().tick(0.01);
      publish(beyond);
      jointProbe().awaitStatus("tool pose", [&](const GuardProbe::Status& status) {
        told = is_told(status);
        return true;
      });
    }
    EXPECT_TRUE(told) << joint;
  }
  holdUntil(kStraight, isClearNow);
}

// Each of them would be refused if it named a joint of the tool.
TEST_F(JointStatesTest, MessagesOfOtherJointsChangeNothing) {
  placeSquare("square", {0.0, 0.0, -3.0}, 0.1);
  holdUntil(kStraight, isClearNow);
  const size_t before = jointProbe().warnings().size();
  for (int i = 0; i < 20; ++i) {
    jointProbe().tick(0.01);
    const ros::Time now = jointProbe().time();
    jointPublisher().publish(message(now, {"wheel_left", "wheel_right"}, {}));
    jointPublisher().publish(message(ros::Time(), {"gripper_finger"}, {0.02}));
    jointPublisher().publish(message(now + ros::Duration(3.0), {"gripper_finger"}, {0.02}));
    jointPublisher().publish(message(now, {"ankle", "knee", "hip"}, {std::nan(""), std::nan(""), std::nan("")}));
    jointPublisher().publish(message(now, {"torso", "torso"}, {0.0, 1.0}));
    jointPublisher().publish(message(ros::Time(), {}, {}));
    publish(kStraight);
  }
  jointProbe().awaitContactsUpTo(jointProbe().time());
  jointProbe().skipWarnings();
  jointProbe().awaitWarning(isClearNow);
  const std::vector<Warning> warnings = jointProbe().warnings();
  for (size_t i = before; i < warnings.size(); ++i) EXPECT_TRUE(warnings[i].clear) << warnings[i].text;
}

TEST_F(JointStatesTest, TheTextListsWhichJointsAreMissingAndWhichCameInTheirPlace) {
  publish({{"jaw", 0.04}});
  publish({{"arm_arm_shoulder", 0.0}, {"arm_arm_elbow", 0.0}});
  const std::string expected =
      "joints 'shoulder', 'elbow' have not been published yet, but joint_states has arm_arm_elbow, arm_arm_shoulder";
  jointProbe().awaitWarning(
      [&](const Warning& warning) { return !warning.clear && warning.text.find(expected) != std::string::npos; });
  jointProbe().awaitStatus("tool pose", [&](const GuardProbe::Status& status) {
    return status.level == GuardProbe::Status::ERROR && status.message.find(expected) != std::string::npos;
  });
}

// By 1.5 rad within 8 ms, past the square. A joint that is only fast is told of by the diagnostics.
TEST_F(JointStatesTest, AJointThatJumpsIsNamedAndItsTouchesAreKeptApart) {
  const TopicListener<sweep_guard::Touches> listener("touches");
  placeSquare("past", {0.15, 0.0, 0.85}, 0.02);
  holdUntil(kStraight, isClearNow);
  Positions jumped = kStraight;
  jumped["shoulder"] = 1.5;
  jointProbe().skipWarnings();
  jointProbe().tick(0.008);
  publish(jumped);
  const Warning warning = jointProbe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_NE(warning.reasons & Warning::JUMP, 0U);
  EXPECT_NE(warning.text.find("joint 'shoulder' jumped: 75 rad/s"), std::string::npos) << warning.text;
  const auto touches = listener.awaitNewest(
      [](const sweep_guard::Touches& next) { return !next.objects.empty() && next.objects[0].mesh_id == "past"; });
  EXPECT_FALSE(touches.objects[0].jump_triangles.empty());
  EXPECT_TRUE(touches.objects[0].triangles.empty());
  holdUntil(jumped, isClearNow);

  jumped["shoulder"] += 0.3;
  jointProbe().advance(0.1);
  publish(jumped);
  jointProbe().awaitStatus("tool pose", [](const GuardProbe::Status& status) {
    return status.message.find("joint 'shoulder' moved at 3 rad/s: the robot description says 1 rad/s") !=
           std::string::npos;
  });
}

}  // namespace
}  // namespace sweep_guard_ros
