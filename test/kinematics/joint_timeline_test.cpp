#include "sweep_guard/kinematics/joint_timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Positions = std::vector<JointTimeline::Position>;

Time at(double seconds) { return Time(fromSeconds(seconds)); }

TreeLink linkAt(size_t i) {
  TreeLink link;
  link.name = "link" + std::to_string(i);
  if (i > 0) link.parent = i - 1;
  link.type = JointType::kRevolute;
  link.variable = i;
  return link;
}

// Joints a, b and c; c is continuous.
KinematicTree armOfThree() {
  std::vector<JointVariable> variables(3);
  for (size_t i = 0; i < 3; ++i) variables[i].name = std::string(1, static_cast<char>('a' + i));
  variables[2].continuous = true;
  return {variables, {linkAt(0), linkAt(1), linkAt(2)}};
}

struct Stamped {
  Time stamp;
  RobotState state;
};

class JointTimelineTest : public testing::Test {
 protected:
  static std::vector<Stamped> allOf(JointTimeline& timeline) {
    std::vector<Stamped> all;
    RobotState state;
    while (const auto stamp = timeline.next(state)) all.push_back({*stamp, state});
    return all;
  }

  static std::string refusalOf(JointTimeline& timeline, const std::string& publisher, double seconds,
                               const Positions& positions) {
    try {
      timeline.add(publisher, at(seconds), positions);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }

  const KinematicTree tree_ = armOfThree();
  JointTimeline timeline_{tree_, {{}, {}, {}}, /*root_moves=*/false};
  JointTimeline only_a_{tree_, {{}, 0.5, 0.25}, /*root_moves=*/false};
};

TEST_F(JointTimelineTest, SaysNothingUntilEveryJointHasBeenHeardOf) {
  timeline_.add("driver", at(1.0), {{0, 0.1}, {2, 0.3}});
  timeline_.add("driver", at(1.1), {{0, 0.2}, {2, 0.4}});
  EXPECT_TRUE(allOf(timeline_).empty());
  timeline_.add("driver", at(1.1), {{1, 0.5}});
  const std::vector<Stamped> states = allOf(timeline_);
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].stamp, at(1.1));
  EXPECT_EQ(states[0].state.positions, (std::vector<double>{0.2, 0.5, 0.4}));
}

TEST_F(JointTimelineTest, AStateWaitsForTheJointThatIsBehind) {
  timeline_.add("arm", at(1.0), {{0, 0.0}, {1, 0.0}});
  timeline_.add("hand", at(1.0), {{2, 0.0}});
  EXPECT_EQ(allOf(timeline_).size(), 1U);
  for (int i = 1; i <= 10; ++i) timeline_.add("arm", at(1.0 + 0.01 * i), {{0, 0.1 * i}, {1, 0.0}});
  EXPECT_TRUE(allOf(timeline_).empty());
  timeline_.add("hand", at(1.055), {{2, 1.1}});
  const std::vector<Stamped> states = allOf(timeline_);
  ASSERT_EQ(states.size(), 6U);
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(states[i].stamp, at(1.01 + 0.01 * static_cast<double>(i)));
    EXPECT_NEAR(states[i].state.positions[0], 0.1 * static_cast<double>(i + 1), 1e-12);
    EXPECT_NEAR(states[i].state.positions[2], 0.2 * static_cast<double>(i + 1), 1e-12);
  }
  EXPECT_EQ(states[5].stamp, at(1.055));
  EXPECT_NEAR(states[5].state.positions[0], 0.55, 1e-12);
}

TEST_F(JointTimelineTest, TheFirstStateIsWhereAllJointsAreKnown) {
  timeline_.add("hand", at(1.0), {{2, 1.0}});
  timeline_.add("arm", at(1.5), {{0, 0.0}, {1, 0.0}});
  EXPECT_TRUE(allOf(timeline_).empty());
  timeline_.add("hand", at(2.0), {{2, 2.0}});
  const std::vector<Stamped> states = allOf(timeline_);
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].stamp, at(1.5));
  EXPECT_NEAR(states[0].state.positions[2], 1.5, 1e-12);
}

TEST_F(JointTimelineTest, AContinuousJointGoesTheShorterWay) {
  double turned = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.5 * i;
    timeline_.add("driver", at(1.0 + 0.01 * i), {{0, 0.0}, {1, 0.0}, {2, std::remainder(angle, 2.0 * M_PI)}});
    for (const Stamped& next : allOf(timeline_)) turned = next.state.positions[2];
    EXPECT_NEAR(turned, angle, 1e-9);
  }
}

TEST_F(JointTimelineTest, AJointAtTwoPlacesInOneMomentIsAtBoth) {
  only_a_.add("driver", at(1.0), {{0, 0.0}});
  only_a_.add("driver", at(1.1), {{0, 1.0}});
  only_a_.add("driver", at(1.1), {{0, 2.0}});
  const std::vector<Stamped> states = allOf(only_a_);
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[1].state.positions, (std::vector<double>{1.0, 0.5, 0.25}));
  EXPECT_EQ(states[2].state.positions[0], 2.0);
  EXPECT_EQ(states[2].stamp, at(1.1));
}

TEST_F(JointTimelineTest, PositionsOfFixedJointsArePassedOver) {
  only_a_.add("driver", at(1.0), {{0, 0.0}, {1, 7.0}, {1, std::nan("")}});
  EXPECT_EQ(allOf(only_a_)[0].state.positions[1], 0.5);
}

TEST_F(JointTimelineTest, AMovingRootIsJoinedLikeAMotion) {
  JointTimeline timeline(tree_, {{}, 0.0, 0.0}, /*root_moves=*/true);
  const Motion motion{Eigen::Isometry3d::Identity(),
                      Eigen::Translation3d(1.0, 0.0, 0.0) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ())};
  timeline.addRoot(at(1.0), motion.X_MT_start);
  timeline.addRoot(at(2.0), motion.X_MT_end);
  EXPECT_EQ(timeline.newestOfRoot(), at(2.0));
  timeline.add("driver", at(1.0), {{0, 0.0}});
  timeline.add("driver", at(1.25), {{0, 0.0}});
  const std::vector<Stamped> states = allOf(timeline);
  ASSERT_EQ(states.size(), 2U);
  EXPECT_TRUE(states[1].state.X_WR.isApprox(motion.at(0.25), 1e-12));
}

TEST_F(JointTimelineTest, RefusesAJointThatTwoPublish) {
  timeline_.add("one", at(1.0), {{0, 0.0}});
  EXPECT_EQ(refusalOf(timeline_, "other", 1.1, {{0, 0.5}}), "joint 'a' is published by one and other: let one of them");
  EXPECT_EQ(refusalOf(timeline_, "other", 1.1, {{1, 0.5}}), "");
}

TEST_F(JointTimelineTest, AnotherMayPublishAJointThatWasSilentForASecond) {
  timeline_.add("one", at(1.0), {{0, 0.0}});
  EXPECT_NE(refusalOf(timeline_, "other", 1.999, {{0, 0.5}}), "");
  EXPECT_EQ(refusalOf(timeline_, "other", 2.0, {{0, 0.5}}), "");
}

TEST_F(JointTimelineTest, RefusesWhatIsNoPosition) {
  EXPECT_NE(refusalOf(timeline_, "driver", 1.0, {{0, std::nan("")}}).find("joint 'a' is at nan"), std::string::npos);
  EXPECT_NE(refusalOf(timeline_, "driver", 1.0, {{1, 1e5}}).find("within 1e4"), std::string::npos);
  EXPECT_NE(refusalOf(timeline_, "driver", 1.0, {{0, 1e227}}).find("joint 'a' is at 1e+227, but"), std::string::npos);
  EXPECT_NE(refusalOf(timeline_, "driver", 1.0, {{1, 0.0}, {1, 0.0}}).find("named twice"), std::string::npos);
}

// A spindle whose driver counts its turns, for years.
TEST_F(JointTimelineTest, AContinuousJointMayCountItsTurnsOn) {
  for (const double start : {9990.0, -2e4, 3e9}) {
    timeline_.reset();
    for (int i = 0; i <= 20; ++i) {
      const double turned = start + std::copysign(2.0 * i, start);
      EXPECT_EQ(refusalOf(timeline_, "driver", 1.0 + 0.01 * i, {{0, 0.0}, {1, 0.0}, {2, turned}}), "") << turned;
    }
    const std::vector<Stamped> states = allOf(timeline_);
    ASSERT_EQ(states.size(), 21U);
    EXPECT_EQ(states[0].state.positions[2], start);
    EXPECT_NEAR(states[20].state.positions[2], start + std::copysign(40.0, start), 1e-5);
  }
}

TEST_F(JointTimelineTest, RefusesTurnsThatNoNumberResolves) {
  for (const double turned : {1.1e10, -1e227, HUGE_VAL}) {
    EXPECT_NE(refusalOf(timeline_, "driver", 1.0, {{2, turned}}).find("but must be within 1e10 rad"),
              std::string::npos);
  }
}

TEST_F(JointTimelineTest, AMessageThatIsRefusedHasNoEffect) {
  timeline_.add("driver", at(1.0), {{0, 0.0}, {1, 0.0}, {2, 0.0}});
  EXPECT_NE(refusalOf(timeline_, "driver", 1.1, {{0, 1.0}, {1, std::nan("")}}), "");
  EXPECT_NE(refusalOf(timeline_, "driver", 0.9, {{0, 1.0}}).find("older"), std::string::npos);
  EXPECT_EQ(allOf(timeline_).size(), 1U);
  EXPECT_EQ(timeline_.newestOf(0), at(1.0));
}

TEST_F(JointTimelineTest, KnowsWhenAJointWasNamedLast) {
  EXPECT_FALSE(timeline_.newestOf(1));
  timeline_.add("driver", at(1.0), {{0, 0.0}, {1, 0.0}, {2, 0.0}});
  timeline_.add("driver", at(1.1), {{0, 0.0}, {2, 0.0}});
  EXPECT_EQ(timeline_.newestOf(1), at(1.0));
  EXPECT_TRUE(timeline_.expects(1));
  EXPECT_FALSE(only_a_.expects(1));
  timeline_.reset();
  EXPECT_FALSE(timeline_.newestOf(1));
  EXPECT_TRUE(allOf(timeline_).empty());
}

TEST_F(JointTimelineTest, AJointFarAheadOfASilentOneGoesStraightPastItsOldestPositions) {
  timeline_.add("driver", at(1.0), {{0, 0.0}, {1, 0.0}, {2, 0.0}});
  for (int i = 1; i <= 10000; ++i) timeline_.add("driver", at(1.0 + 0.001 * i), {{0, 0.1 * i}, {1, 0.0}});
  timeline_.add("driver", at(11.0), {{2, 0.0}});
  const std::vector<Stamped> states = allOf(timeline_);
  ASSERT_EQ(states.size(), 1 + Track<double>::kMaxSize - 1);
  EXPECT_EQ(states[0].stamp, at(1.0));
  EXPECT_EQ(states[1].stamp, at(11.0 - 0.001 * (Track<double>::kMaxSize - 2)));
  EXPECT_EQ(states.back().stamp, at(11.0));
}

TEST_F(JointTimelineTest, TheStatePastDroppedPositionsTellsOfThem) {
  timeline_.add("driver", at(1.0), {{0, 0.0}, {1, 0.0}, {2, 0.0}});
  RobotState state;
  ASSERT_TRUE(timeline_.next(state));
  EXPECT_FALSE(timeline_.leavesOut());
  for (int i = 1; i <= 10000; ++i) timeline_.add("driver", at(1.0 + 0.001 * i), {{0, 0.1 * i}, {1, 0.0}});
  timeline_.add("driver", at(11.0), {{2, 0.0}});
  ASSERT_TRUE(timeline_.next(state));
  EXPECT_TRUE(timeline_.leavesOut());
  ASSERT_TRUE(timeline_.next(state));
  EXPECT_FALSE(timeline_.leavesOut());
}

// Each joint is published on its own, at 10 Hz to 1 kHz, late by up to 50 ms.
TEST(RandomJointTimelineTest, TheStatesAreTheMotionOfAllJoints) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const KinematicTree tree = armOfThree();
    JointTimeline timeline(tree, {{}, {}, {}}, /*root_moves=*/false);
    std::map<Time, double> sent[3];
    std::multimap<double, std::pair<size_t, Time>> arrivals;
    for (size_t joint = 0; joint < 3; ++joint) {
      const double period = random.logUniform(0.001, 0.1);
      const double delay = random.uniform(0.0, 0.05);
      for (double t = 1.0 + random.uniform(0.0, period); t < 2.0; t += period * random.uniform(0.5, 1.5)) {
        sent[joint][at(t)] = random.uniform(-1.0, 1.0);
        arrivals.emplace(t + delay, std::pair(joint, at(t)));
      }
    }
    std::vector<Time> stamps;
    RobotState state;
    for (const auto& [arrival, sample] : arrivals) {
      const auto& [joint, stamp] = sample;
      timeline.add("driver" + std::to_string(joint), stamp, {{joint, sent[joint].at(stamp)}});
      while (const auto next = timeline.next(state)) {
        stamps.push_back(*next);
        for (size_t k = 0; k < 3; ++k) {
          const auto after = sent[k].lower_bound(*next);
          ASSERT_NE(after, sent[k].end());
          if (after->first == *next) {
            EXPECT_EQ(state.positions[k], after->second);
            continue;
          }
          const auto before = std::prev(after);
          const double share = toSeconds(*next - before->first) / toSeconds(after->first - before->first);
          EXPECT_NEAR(state.positions[k], before->second + share * (after->second - before->second), 1e-9);
        }
      }
    }
    EXPECT_TRUE(std::is_sorted(stamps.begin(), stamps.end()));
    const Time start = std::max({sent[0].begin()->first, sent[1].begin()->first, sent[2].begin()->first});
    const Time end = std::min({sent[0].rbegin()->first, sent[1].rbegin()->first, sent[2].rbegin()->first});
    for (const auto& joint : sent) {
      for (const auto& [stamp, position] : joint) {
        const bool covered = stamp >= start && stamp <= end;
        EXPECT_EQ(std::count(stamps.begin(), stamps.end(), stamp), covered ? 1 : 0);
      }
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
