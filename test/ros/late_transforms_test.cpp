// Transforms that come late, seldom or changed: no contact is lost, and the warning does not flicker. The test is the clock.
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "connected_publisher.h"
#include "node_fixture.h"
#include "refusal.h"
#include "transform_message.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard::Contacts;
using sweep_guard::Warning;

constexpr double kStep = 0.02;  // between poses [s]

geometry_msgs::TransformStamped transformTo(const std::string& child, ros::Time stamp, const Eigen::Vector3d& place,
                                            const std::string& parent = "world") {
  return transformMsg(parent, child, Eigen::Isometry3d(Eigen::Translation3d(place)), stamp);
}

class LateTransformsTest : public NodeTest {
 protected:
  static void send(const geometry_msgs::TransformStamped& transform, const ros::Publisher& publisher) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    publisher.publish(message);
  }

  // Returns when the guard has the transform of a frame at this stamp. There must be a workpiece.
  static void awaitFrame(const std::string& frame) {
    CheckSweep::Request both;
    both.path = {poseAt(kAway, probe().time()), poseAt(kAway, probe().time())};
    both.path[1].header.frame_id = frame;
    while (!probe().check(both).success) continue;
  }
  void sendKnown(const std::string& frame, const Eigen::Vector3d& place) {
    send(transformTo(frame, probe().time(), place), moving_);
    awaitFrame(frame);
  }

  // Plays poses of the tool, and transforms of a tray that swings along x, each so late.
  template <typename Tip>
  void play(double seconds, double period, double late, const Tip& tip) {
    if (next_stamp_.isZero()) next_stamp_ = probe().time();
    for (double t = 0.0; t < seconds; t += kStep) {
      for (; next_stamp_ <= probe().time(); next_stamp_ += ros::Duration(period)) {
        const double x = 0.02 * std::sin(0.05 * next_stamp_.toSec());
        on_their_way_.push_back(transformTo("tray", next_stamp_, {x, 0.0, 0.0}));
      }
      while (!on_their_way_.empty() && on_their_way_.front().header.stamp + ros::Duration(late) <= probe().time()) {
        send(on_their_way_.front(), moving_);
        on_their_way_.pop_front();
      }
      auto pose = poseAt(tip(t), probe().time());
      pose.header.frame_id = pose_frame_;
      probe().publish(pose);
      probe().tick(kStep);
    }
  }

  static std::vector<Warning> warningsSince(size_t begin) {
    const std::vector<Warning> all = probe().warnings();
    return {all.begin() + static_cast<std::ptrdiff_t>(begin), all.end()};
  }
  static size_t count(const std::vector<Warning>& warnings, std::uint32_t reasons) {
    return static_cast<size_t>(std::count_if(warnings.begin(), warnings.end(),
                                             [&](const Warning& one) { return (one.reasons & reasons) != 0; }));
  }

  ros::Publisher moving_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 1000);
  std::string pose_frame_ = "world";
  ros::Time next_stamp_;  // of the next transform of the tray
  std::deque<geometry_msgs::TransformStamped> on_their_way_;
};

struct Rate {
  std::string name;
  double period;
  double late;
};

class UsableTransformsTest : public LateTransformsTest, public testing::WithParamInterface<Rate> {};

TEST_P(UsableTransformsTest, DoNotFlicker) {
  const Rate& rate = GetParam();
  placeSquare("square", {0.0, 0.0, 0.0}, "tray");
  const auto away = [](double) { return kAway; };
  play(2.0, rate.period, rate.late, away);
  probe().skipWarnings();
  play(1.0, rate.period, rate.late, away);
  probe().awaitWarning(isClear);
  const size_t begin = probe().warnings().size();
  play(3.0, rate.period, rate.late, away);
  EXPECT_EQ(count(warningsSince(begin), Warning::TF_FAIL | Warning::NOT_SWEPT), 0U) << probe().warnings().back().text;
}

// The tool is in the square for 40 ms, between two transforms.
TEST_P(UsableTransformsTest, LoseNoTouch) {
  const Rate& rate = GetParam();
  placeSquare("square", {0.0, 0.0, 0.0}, "tray");
  for (int i = 0; i < 2; ++i) {
    const double touch = 1.0 + 0.09 * i;
    probe().forgetContacts();
    play(2.2, rate.period, rate.late, [&](double t) {
      return std::abs(t - touch) < 0.02 ? Eigen::Vector3d(0.0, 0.0, -0.02) : Eigen::Vector3d(0.0, 0.0, 0.3);
    });
    const auto contacts = probe().awaitContacts(1);
    EXPECT_GT(contactCount(contacts), 0U) << "touch " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(OfAWorkpiece, UsableTransformsTest,
                         testing::Values(Rate{"AtOnce", 0.02, 0.0}, Rate{"Seldom", 0.33, 0.0},
                                         Rate{"SeldomAndLate", 0.33, 0.6}, Rate{"OftenAndLate", 0.02, 0.5}),
                         [](const auto& info) { return info.param.name; });

TEST_F(LateTransformsTest, TooLateIsSteadilyUnknownAndNamesFrameAgeAndParameter) {
  placeSquare("square", {0.0, 0.0, 0.0}, "tray");
  const auto away = [](double) { return kAway; };
  play(4.0, 1.0, 1.05, away);
  const size_t begin = probe().warnings().size();
  play(4.0, 1.0, 1.05, away);
  const std::vector<Warning> warnings = warningsSince(begin);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(count(warnings, Warning::TF_FAIL), warnings.size());
  for (const char* const part : {"'tray'", "timing/pose_timeout", " s old"})
    EXPECT_TRUE(has(warnings.back().text, part)) << warnings.back().text;
}

TEST_F(LateTransformsTest, ATransformIsSweptWithoutANewPose) {
  placeSquare("square", {0.0, 0.0, 0.0}, "tray");
  sendKnown("tray", {0.0, 0.0, -1.0});
  probe().tick(kStep);
  sendKnown("tray", {0.0, 0.0, -1.0});
  probe().move(poseAt({0.0, 0.0, 0.0}, probe().time()));
  probe().tick(kStep);
  const ros::Time last = probe().time();
  probe().publish(poseAt({0.0, 0.0, 0.0}, last));
  probe().forgetContacts();
  sendKnown("tray", {0.0, 0.0, 1.0});
  probe().awaitWarning([](const Warning& warning) { return warning.contact; });
}

// The tool's own frame comes at a third of the rate of the poses, and late.
TEST_F(LateTransformsTest, PosesWaitInOrderForTheirOwnFrame) {
  placeSquare("square", {0.0, 0.0, 0.0});
  pose_frame_ = "tray";
  probe().forgetContacts();
  play(3.0, 0.33, 0.3, [](double t) {
    return std::abs(t - 1.0) < 0.02 ? Eigen::Vector3d(0.0, 0.0, -0.02) : Eigen::Vector3d(0.0, 0.0, 0.3);
  });
  const auto contacts = probe().awaitContacts(1);
  EXPECT_TRUE(endToEnd(contacts));
  EXPECT_GT(contactCount(contacts), 0U);
}

TEST_F(LateTransformsTest, APoseWhoseFrameDoesNotComeIsRefused) {
  placeSquare("square", {0.0, 0.0, 0.0});
  sendKnown("tray", {0.0, 0.0, 0.0});
  Warning newest;
  while ((newest.reasons & Warning::TF_FAIL) == 0) {
    probe().tick(0.001);
    auto pose = poseAt(kAway, probe().time());
    pose.header.frame_id = "tray";
    probe().publish(pose);
    newest = probe().warnings().back();
  }
  EXPECT_TRUE(has(newest.text, "timing/pose_timeout")) << newest.text;
}

// Static transforms, of a fixture that holds a workpiece or of a camera that nobody uses.
class StaticChangeTest : public LateTransformsTest {
 protected:
  void place(const std::string& frame, double z) {
    auto transform = transformTo(frame, {}, {0.0, 0.0, z});
    send(transform, *static_);
  }
  // The guard knows the fixture, and the tool is above it.
  void begin(double fixture_z, const Eigen::Vector3d& tip) {
    place("fixture", fixture_z);
    placeSquare("square", {0.0, 0.0, 0.0}, "fixture");
    restAt(tip);
    restAt(tip);
    probe().skipWarnings();
  }
  void change(double z, const std::string& frame = "fixture") {
    place(frame, z);
    const Warning warning = probe().awaitWarning(hasReason(Warning::TIME_JUMP));
    EXPECT_TRUE(has(warning.text, "'" + frame + "' to 'world' has changed")) << warning.text;
  }
  // What is swept twice may be reported twice for one pose: the next pose comes after both.
  bool touchesOnTheWayTo(const Eigen::Vector3d& tip) {
    probe().forgetContacts();
    for (int i = 0; i < 2; ++i) {
      probe().tick(0.01);
      probe().publish(poseAt(tip, probe().time()));
    }
    return contactCount(probe().awaitContactsUpTo(probe().time())) > 0;
  }

  ConnectedPublisher<tf2_msgs::TFMessage> static_{"/tf_static", /*latch=*/true};
};

TEST_F(StaticChangeTest, InFramesThatNobodyUsesChangeNothing) {
  place("camera", 0.1);
  begin(-1.0, {0.0, 0.0, 0.5});
  const size_t warned = probe().warnings().size();
  for (int i = 0; i < 10; ++i) {
    place("camera", 0.2 + 0.01 * i);
    EXPECT_FALSE(touchesOnTheWayTo({0.0, 0.0, 0.5}));
  }
  EXPECT_EQ(count(warningsSince(warned), Warning::TIME_JUMP | Warning::NOT_SWEPT | Warning::NO_POSE | Warning::TF_FAIL),
            0U)
      << probe().warnings().back().text;
}

TEST_F(StaticChangeTest, WhatIsCrossedWhenAnUnusedOneChangesIsFound) {
  place("camera", 0.1);
  begin(0.0, {0.0, 0.0, 0.5});
  place("camera", 0.2);
  EXPECT_TRUE(touchesOnTheWayTo({0.0, 0.0, -0.5}));
}

TEST_F(StaticChangeTest, OfAWorkpieceIsUnknownUntilItIsSweptWhereItIs) {
  begin(-1.0, {0.0, 0.0, 0.5});
  change(-1.1);
  restAt({0.0, 0.0, 0.5});
  EXPECT_TRUE(touchesOnTheWayTo({0.0, 0.0, -1.2}));
}

TEST_F(StaticChangeTest, WhatIsCrossedMeanwhileIsFoundInTheOldPlace) {
  begin(0.0, {0.0, 0.0, 0.5});
  change(-5.0);
  EXPECT_TRUE(touchesOnTheWayTo({0.0, 0.0, -0.5}));
  EXPECT_FALSE(touchesOnTheWayTo({0.0, 0.0, 0.5}));
}

TEST_F(StaticChangeTest, WhatIsCrossedMeanwhileIsFoundInTheNewPlace) {
  begin(-5.0, {0.0, 0.0, 0.5});
  change(0.0);
  EXPECT_TRUE(touchesOnTheWayTo({0.0, 0.0, -0.5}));
}

TEST_F(StaticChangeTest, TheMoveItselfIsNoMotion) {
  begin(-1.0, {0.0, 0.0, 0.5});
  change(5.0);
  EXPECT_FALSE(touchesOnTheWayTo({0.0, 0.0, 0.5}));
  EXPECT_TRUE(touchesOnTheWayTo({0.0, 0.0, 6.0}));
}

// Of the frame that poses are given in: the tool is placed anew.
TEST_F(StaticChangeTest, OfTheToolsOwnFrameCountsInBothPlaces) {
  placeSquare("square", {0.0, 0.0, 0.0});
  place("base", 0.0);
  awaitFrame("base");
  const auto move_in_base = [](double z) {
    probe().tick(0.01);
    auto pose = poseAt({0.0, 0.0, z}, probe().time());
    pose.header.frame_id = "base";
    probe().forgetContacts();
    probe().publish(pose);
    return contactCount(probe().awaitContactsUpTo(probe().time()));
  };
  move_in_base(0.5);
  EXPECT_EQ(move_in_base(0.5), 0U);
  probe().skipWarnings();
  place("base", 3.0);
  probe().awaitWarning(hasReason(Warning::TIME_JUMP));
  EXPECT_EQ(move_in_base(-0.5), 1U) << "crossed in the old place";
  EXPECT_EQ(move_in_base(-2.0), 0U) << "3 m higher now";
  EXPECT_EQ(move_in_base(-4.0), 1U);
}

// Both poses wait for the frame that they are given in; the fixture changes its place between them. A pose that is refused tells
// that the one before it was received.
TEST_F(StaticChangeTest, ThatCameBetweenTwoPosesIsSweptOnTheWayBetweenThem) {
  begin(0.0, {0.0, 0.0, 0.5});
  const auto publishInTray = [](double z, ros::Time stamp) {
    auto pose = poseAt({0.0, 0.0, z}, stamp);
    pose.header.frame_id = "tray";
    probe().publish(pose);
  };
  sendKnown("tray", {0.0, 0.0, 0.0});
  const ros::Time known = probe().time();
  probe().forgetContacts();
  probe().tick(0.01);
  publishInTray(0.5, probe().time());
  publishInTray(0.5, known);
  probe().awaitWarning(hasReason(Warning::OUT_OF_ORDER));
  change(-5.0);
  probe().tick(0.01);
  publishInTray(-0.5, probe().time());
  sendKnown("tray", {0.0, 0.0, 0.0});
  EXPECT_GT(contactCount(probe().awaitContactsUpTo(probe().time())), 0U);
}

// The tray moves on a rail that stands still until it is placed anew.
class RailChangeTest : public StaticChangeTest {
 protected:
  void begin(double rail_z) {
    place("rail", rail_z);
    send(transformTo("tray", probe().time(), Eigen::Vector3d::Zero(), "rail"), moving_);
    placeSquare("square", {0.0, 0.0, 0.0}, "tray");
    for (int i = 0; i < 5; ++i) moveBoth({0.0, 0.0, 0.5});
    probe().forgetContacts();
    probe().skipWarnings();
  }
  // The tray moves along x at 10 cm/s.
  void moveBoth(const Eigen::Vector3d& tip) {
    probe().tick(0.01);
    send(transformTo("tray", probe().time(), {0.001 * ++steps_, 0.0, 0.0}, "rail"), moving_);
    awaitFrame("tray");
    probe().publish(poseAt(tip, probe().time()));
    probe().awaitContactsUpTo(probe().time());
  }
  size_t contactsOnTheWayTo(const Eigen::Vector3d& tip) {
    for (int i = 0; i < 2; ++i) moveBoth(tip);
    return contactCount(probe().awaitContacts(1));
  }

  int steps_ = 0;
};

TEST_F(RailChangeTest, WhatIsCrossedMeanwhileIsFoundInTheOldPlace) {
  begin(0.0);
  change(-5.0, "rail");
  EXPECT_GT(contactsOnTheWayTo({0.0, 0.0, -0.5}), 0U);
}

TEST_F(RailChangeTest, WhatIsCrossedMeanwhileIsFoundInTheNewPlace) {
  begin(-5.0);
  change(0.0, "rail");
  EXPECT_GT(contactsOnTheWayTo({0.0, 0.0, -0.5}), 0U);
}

TEST_F(RailChangeTest, TheMoveItselfIsNoMotion) {
  begin(-1.0);
  change(5.0, "rail");
  EXPECT_EQ(contactsOnTheWayTo({0.0, 0.0, 0.5}), 0U);
}

}  // namespace
}  // namespace sweep_guard_ros
