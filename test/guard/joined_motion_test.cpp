#include "guard/pose_history.h"

#include <gtest/gtest.h>

#include "guard/times.h"
#include "scenes.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

std::vector<int> stampsOf(const std::vector<PoseSample>& samples) {
  std::vector<int> stamps;
  for (const auto& sample : samples)
    stamps.push_back(static_cast<int>(std::chrono::duration_cast<milliseconds>(sample.stamp - at(0)).count()));
  return stamps;
}

class JoinedMotionTest : public testing::Test {
 protected:
  std::vector<PoseSample> join() {
    std::vector<PoseSample> samples;
    motion_.join(frame_, samples);
    return samples;
  }

  JoinedMotion motion_;
  FrameMotion frame_;
};

TEST_F(JoinedMotionTest, HasASampleAtEachStampUpToTheOlderOfBothNewest) {
  for (const int ms : {0, 10, 20, 30}) motion_.add(at(ms), {along(0.001 * ms), 0.1 * ms});
  frame_.measured = {{at(4), along(0.4), 0.0}, {at(14), along(1.4), 0.002}, {at(24), along(2.4), 0.003}};
  const auto samples = join();
  EXPECT_EQ(stampsOf(samples), (std::vector<int>{4, 10, 14, 20, 24}));
  for (const auto& sample : samples) {
    const double ms = 1e3 * toSeconds(sample.stamp - at(0));
    EXPECT_NEAR(sample.X_WT.translation().x(), 0.001 * ms, 1e-12);
    EXPECT_NEAR(sample.X_WM.translation().x(), 0.1 * ms, 1e-12);
  }
  EXPECT_NEAR(samples[1].deviation_bound, 1.0 + 0.002, 1e-12) << "of both in which it lies";
  EXPECT_NEAR(samples[4].deviation_bound, 3.0 + 0.003, 1e-12);
  EXPECT_TRUE(join().empty());
}

TEST_F(JoinedMotionTest, WaitsForTheOther) {
  frame_.measured = {{at(0), along(0.0), 0.0}, {at(10), along(1.0), 0.0}};
  EXPECT_TRUE(join().empty());
  motion_.add(at(20), {along(0.0)});
  EXPECT_TRUE(join().empty()) << "the frame is known up to 10 ms only";
  frame_.measured.push_back({at(30), along(3.0), 0.0});
  EXPECT_EQ(stampsOf(join()), (std::vector<int>{20}));
  motion_.add(at(30), {along(0.0)});
  EXPECT_EQ(stampsOf(join()), (std::vector<int>{30}));
  motion_.add(at(40), {along(0.0)});
  EXPECT_TRUE(join().empty());
  frame_.measured.push_back({at(41), along(4.1), 0.0});
  frame_.measured.erase(frame_.measured.begin(), frame_.measured.begin() + 2);
  EXPECT_EQ(stampsOf(join()), (std::vector<int>{40})) << "also if older ones were forgotten";
}

TEST_F(JoinedMotionTest, KeepsPosesOfEqualStamps) {
  frame_.measured = {{at(0), along(0.0), 0.0}, {at(30), along(0.0), 0.0}};
  for (const double x : {0.0, 1.0, 2.0}) motion_.add(at(x == 0.0 ? 0 : 10), {along(x)});
  const auto samples = join();
  EXPECT_EQ(stampsOf(samples), (std::vector<int>{0, 10, 10}));
  EXPECT_EQ(samples[1].X_WT.translation().x(), 1.0);
  EXPECT_EQ(samples[2].X_WT.translation().x(), 2.0);
}

TEST_F(JoinedMotionTest, ABodyThatIsPlacedAnewHasNoMotionThere) {
  frame_.measured = {{at(0), along(0.0), 0.0}, {at(30), along(3.0), 0.0}};
  motion_.add(at(0), {along(0.0)});
  motion_.add(at(10), {along(1.0)});
  motion_.add(at(10), {along(100.0)}, /*anew=*/true);
  motion_.add(at(10), {along(101.0)});
  motion_.add(at(20), {along(102.0)});
  const auto samples = join();
  EXPECT_EQ(stampsOf(samples), (std::vector<int>{0, 10, 10, 10, 20}));
  for (size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i].anew, i == 2) << i;
  EXPECT_EQ(samples[2].X_WT.translation().x(), 100.0);
}

TEST_F(JoinedMotionTest, AFrameThatIsPlacedAnewIsInTheOldPlaceUpToThenAndThenInTheNewOne) {
  for (const int ms : {0, 10, 20, 30}) motion_.add(at(ms), {along(0.0)});
  frame_.measured = {{at(0), along(0.0), 0.0}, {at(15), along(1.5), 0.0}};
  frame_.measured.push_back({at(15) + Duration(1), along(50.0), 0.0, /*anew=*/true});
  frame_.measured.push_back({at(30), along(51.5), 0.0});
  const auto samples = join();
  EXPECT_EQ(stampsOf(samples), (std::vector<int>{0, 10, 15, 15, 20, 30}));
  for (size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i].anew, i == 3) << i;
  EXPECT_NEAR(samples[2].X_WM.translation().x(), 1.5, 1e-12);
  EXPECT_NEAR(samples[4].X_WM.translation().x(), 50.5, 1e-6);
}

TEST_F(JoinedMotionTest, RepeatsAWayWhereTheFrameWasPlacedAnewAtItsNewestStamp) {
  for (const double x : {0.0, 1.0}) motion_.add(x == 0.0 ? at(0) : at(10) - Duration(1), {along(x)});
  motion_.add(at(10), {along(0.0)}, /*anew=*/true);
  motion_.add(at(10), {along(0.5)});
  motion_.add(at(10), {along(1.0)});
  frame_.measured = {{at(0), along(0.0), 0.0}, {at(10) - Duration(1), along(0.0), 0.0}};
  frame_.measured.push_back({at(10), along(9.0), 0.0, /*anew=*/true});
  std::vector<double> repeated;
  for (const auto& sample : join()) {
    if (sample.X_WM.translation().x() == 9.0) repeated.push_back(sample.X_WT.translation().x());
  }
  EXPECT_EQ(repeated, (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_TRUE(join().empty());
}

TEST_F(JoinedMotionTest, WhatIsPlacedAnewLaterIsInItsOldPlaceUntilThen) {
  for (const int ms : {0, 10, 20, 30}) frame_.measured.push_back({at(ms), along(0.0), 0.0});
  motion_.add(at(0), {along(1.0)});
  motion_.add(at(25), {along(100.0)}, /*anew=*/true);
  motion_.add(at(30), {along(101.0)});
  const auto samples = join();
  EXPECT_EQ(stampsOf(samples), (std::vector<int>{0, 10, 20, 25, 30}));
  for (const size_t i : {1U, 2U}) EXPECT_EQ(samples[i].X_WT.translation().x(), 1.0);
  EXPECT_TRUE(samples[3].anew);
}

TEST_F(JoinedMotionTest, SaysWhereTheFrameWentStraightPastPoses) {
  for (const int ms : {0, 10, 20, 30}) motion_.add(at(ms), {along(0.0)});
  frame_.measured = {{at(0), along(0.0), 0.0}, {at(15), along(1.5), 0.0}, {at(30), along(3.0), 0.0}};
  frame_.measured[1].left_out = true;
  std::vector<bool> left_out;
  for (const auto& sample : join()) left_out.push_back(sample.left_out);
  EXPECT_EQ(left_out, (std::vector<bool>{true, true, true, false, false}));
}

TEST_F(JoinedMotionTest, SaysWhenAPoseIsPassedOver) {
  for (size_t i = 0; i < PoseHistory::kMaxSize; ++i) ASSERT_TRUE(motion_.add(at(static_cast<int>(i)), {along(0.0)}));
  EXPECT_FALSE(motion_.add(at(100000), {along(0.0)}));
}

// Whatever comes in which order, the samples are those of both motions joined at once.
TEST_F(JoinedMotionTest, DependsOnNoOrderOfArrival) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    JoinedMotion at_once;
    JoinedMotion in_turn;
    FrameMotion all;
    FrameMotion known;
    std::vector<PoseSample> expected;
    std::vector<PoseSample> samples;
    std::vector<PoseSample> more;
    int body_ms = 0;
    int frame_ms = 0;
    for (int i = 0; i < 40; ++i) {
      if (random.chance(0.5)) {
        body_ms += 1 + random.below(20);
        const BodyPose pose{random.pose(random.inBox({1.0, 1.0, 1.0}))};
        at_once.add(at(body_ms), pose);
        in_turn.add(at(body_ms), pose);
      } else {
        frame_ms += 1 + random.below(20);
        all.measured.push_back({at(frame_ms), random.pose(random.inBox({1.0, 1.0, 1.0})), 0.0});
        known = all;
      }
      if (all.measured.empty()) continue;
      in_turn.join(known, more);
      samples.insert(samples.end(), more.begin(), more.end());
    }
    if (all.measured.empty()) continue;
    at_once.join(all, expected);
    ASSERT_EQ(stampsOf(samples), stampsOf(expected));
    for (size_t i = 0; i < samples.size(); ++i) {
      EXPECT_TRUE(samples[i].X_WT.isApprox(expected[i].X_WT, 1e-12));
      EXPECT_TRUE(samples[i].X_WM.isApprox(expected[i].X_WM, 1e-12));
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
