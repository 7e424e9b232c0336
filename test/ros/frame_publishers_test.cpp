#include "ros/input/frame_publishers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace sweep_guard_ros {
namespace {

using Conflicts = std::vector<FramePublishers::Conflict>;
using PoseAt = std::function<Eigen::Isometry3d(double)>;

sweep_guard_core::SteadyTime steadyAt(int ms) {
  return sweep_guard_core::SteadyTime(std::chrono::milliseconds(5000 + ms));
}

Eigen::Isometry3d posed(double x, double turn = 0.0) {
  return Eigen::Translation3d(x, 0.0, 0.0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
}

// A node that publishes a frame. Times are in milliseconds.
struct Publisher {
  std::string node;
  PoseAt pose_at;  // of the stamp [s]
  int period;
  int first = 0;
  int last = 100000;
  int late = 0;  // stamps are older by this
  std::string parent = "world";
};

class FramePublishersTest : public testing::Test {
 protected:
  // Lets nodes publish for a time, and returns when the first conflict was there [ms]; -1: never.
  int publish(const std::vector<Publisher>& publishers, int until = 3000) {
    frames_ = std::make_unique<FramePublishers>();
    for (int ms = 0; ms < until; ++ms) {
      for (const Publisher& one : publishers) {
        if (ms < one.first || ms > one.last || (ms - one.first) % one.period != 0) continue;
        const auto stamp = std::chrono::milliseconds(1000000 + ms - one.late);
        const auto pose = one.pose_at(1e-3 * (ms - one.late));
        frames_->add("tray", one.node, {sweep_guard_core::Time(stamp), one.parent, pose}, steadyAt(ms));
      }
      if (frames_->hasConflicts() && !conflictsAt(ms).empty()) return ms;
    }
    return -1;
  }

  Conflicts conflictsAt(int ms) const { return frames_->conflicts(steadyAt(ms)); }

  std::unique_ptr<FramePublishers> frames_ = std::make_unique<FramePublishers>();
};

const PoseAt kRest = [](double) { return posed(0.3); };
const PoseAt kSlides = [](double t) { return posed(0.3 * t, 0.2 * t); };
const PoseAt kSways = [](double t) { return posed(0.2 * std::sin(3.0 * t), 0.3 * std::sin(2.0 * t)); };

PoseAt beside(const PoseAt& pose_at, const Eigen::Isometry3d& offset) {
  return [=](double t) { return pose_at(t) * offset; };
}

struct Placed {
  PoseAt pose_at;
  Eigen::Isometry3d offset;  // of the second node
  int slowest;               // period at which they are compared [ms]
};

TEST_F(FramePublishersTest, NodesByTurnsThatDifferAreFoundWithinHalfASecondOrThreeOfTheirMessages) {
  const Placed all[] = {{kRest, posed(0.0015), 500},   {kRest, posed(0.0, 0.003), 500},
                        {kSlides, posed(0.0015), 500}, {kSlides, posed(0.0, 0.003), 500},
                        {kSways, posed(0.02), 100},    {kSways, posed(0.0, 0.03), 100}};
  for (const auto& [one, other] :
       {std::pair(10, 10), std::pair(10, 200), std::pair(33, 100), std::pair(100, 100), std::pair(500, 500)}) {
    for (const Placed& placed : all) {
      for (const int late : {0, 4, 60}) {
        if (std::min(one, other) > placed.slowest) continue;
        const Publisher second{"/b", beside(placed.pose_at, placed.offset), other, 7, 100000, late};
        const int found = publish({{"/a", placed.pose_at, one}, second});
        EXPECT_GE(found, 0) << one << " and " << other << " ms, " << late << " ms late";
        EXPECT_LE(found, std::max(500, 3 * std::max(one, other) + late)) << one << " and " << other << " ms";
      }
    }
  }
}

TEST_F(FramePublishersTest, TheTextNamesTheFrameAndTheNodes) {
  const int found = publish({{"/b", kRest, 10}, {"/a", beside(kRest, posed(0.012)), 10, 5}});
  const Conflicts conflicts = conflictsAt(found);
  ASSERT_EQ(conflicts.size(), 1U);
  EXPECT_EQ(conflicts[0].frame, "tray");
  EXPECT_EQ(conflicts[0].text, "frame 'tray' is published by '/a' and '/b', which are 12.0 mm and 0.0 mrad apart");
}

TEST_F(FramePublishersTest, NodesThatAgreeMayShareAFrame) {
  EXPECT_EQ(publish({{"/a", kSways, 10}, {"/b", kSways, 10}}), -1);
  EXPECT_EQ(publish({{"/a", kSways, 10}, {"/b", kSways, 33, 4}}), -1);
  EXPECT_EQ(publish({{"/a", kSways, 100}, {"/b", kSways, 100, 50}}), -1) << "though the chords leave the arc";
  EXPECT_EQ(publish({{"/a", kRest, 10}, {"/b", beside(kRest, posed(0.0008, 0.0008)), 20}}), -1);
}

TEST_F(FramePublishersTest, ANodeMayTakeAFrameOver) {
  EXPECT_EQ(publish({{"/a", kRest, 10, 0, 500}, {"/b", beside(kRest, posed(0.1)), 10, 501}}), -1);
  EXPECT_EQ(
      publish({{"/a", kRest, 10, 0, 400}, {"/b", beside(kRest, posed(0.1)), 10, 500, 900}, {"/a", kRest, 10, 2000}}),
      -1)
      << "and give it back later than 1 s";
}

TEST_F(FramePublishersTest, OneNodeAloneMayJump) {
  const PoseAt jumps = [](double t) { return posed(std::fmod(t, 0.02) < 0.01 ? 0.0 : 1.0); };
  EXPECT_EQ(publish({{"/a", jumps, 10}}), -1);
}

TEST_F(FramePublishersTest, NodesThatHangItFromDifferentFramesDiffer) {
  EXPECT_GE(publish({{"/a", kRest, 10}, {"/b", kRest, 10, 5, 100000, 0, "map"}}), 0);
}

TEST_F(FramePublishersTest, AConflictEndsWithOneOfTheNodes) {
  ASSERT_GE(publish({{"/a", kRest, 10}, {"/b", beside(kRest, posed(0.1)), 10, 5}}), 0);
  EXPECT_FALSE(conflictsAt(1000).empty());
  EXPECT_TRUE(conflictsAt(3000).empty());
  EXPECT_FALSE(frames_->hasConflicts());
}

TEST_F(FramePublishersTest, AFloodOfNodesIsNoFloodOfMemory) {
  for (int i = 0; i < 5000; ++i) {
    const auto stamp = sweep_guard_core::Time(std::chrono::milliseconds(1000000 + i));
    frames_->add("tray", "/node" + std::to_string(i), {stamp, "world", posed(0.0)}, steadyAt(i));
  }
  EXPECT_FALSE(frames_->hasConflicts());
}

}  // namespace
}  // namespace sweep_guard_ros
