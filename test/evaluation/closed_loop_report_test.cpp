#include "evaluation/closed_loop_report.h"

#include <gtest/gtest.h>

#include "common/csv.h"
#include "evaluation/motions.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvFields;

namespace {

ClosedLoopCount twoEpisodes(bool guarded) {
  ClosedLoopCount count{"hand", guarded, std::vector<ClosedLoopEpisode>(2), {false, true}};
  for (ClosedLoopEpisode& episode : count.episodes) episode.free_commands = 50;
  return count;
}

std::vector<std::string> fieldsOf(const ClosedLoopCount& count) {
  const std::string csv = closedLoopCsv({count});
  const size_t end = csv.find('\n');
  return csvFields(csv.substr(end + 1, csv.size() - end - 2));
}

TEST(ClosedLoopReportTest, HasTheFiguresOfEachArmInALine) {
  ClosedLoopCount count = twoEpisodes(true);
  count.episodes[0].retreats.resize(4);
  count.episodes[0].retreats[0].speed_kept = 0.5;
  count.episodes[0].retreats[0].time_until_free = 0.2;
  count.episodes[1].slowed = true;
  count.episodes[1].path_kept = 0.75;
  count.episodes[1].free_changed = 1;
  count.episodes[1].contact = LoopCycle::Contact{0.3, 0.1};
  count.episodes[0].standoff_speed = 0.0005;
  EXPECT_EQ(fieldsOf(count), (std::vector<std::string>{"hand", "1", "2", "1", "0.3", "0.01", "0.5", "0.2", "4", "0.75",
                                                       "0.0005", "1", "1", "0.75", "0.1"}));
  EXPECT_EQ(closedLoopCsv({}).find("recording,guarded,placements,contacts,speed_at_contact_p95,free_motion_changed,"
                                   "retreat_speed_kept_least,time_until_free_median,"),
            0U);
}

TEST(ClosedLoopReportTest, IsEmptyWhereThereIsNothingToSay) {
  const std::vector<std::string> fields = fieldsOf(twoEpisodes(false));
  EXPECT_EQ(fields[3], "0");
  EXPECT_EQ(fields[4], "");
  EXPECT_EQ(fields[5], "0");
  EXPECT_EQ(fields[6], "");
}

TEST(ClosedLoopReportTest, KeepsItsPromiseOnlyIfNothingIsTouchedChangedOrHeldBackAndTheStandoffIsReachedSlowly) {
  EXPECT_TRUE(keepsItsPromise({twoEpisodes(true)}));
  ClosedLoopCount count = twoEpisodes(true);
  count.episodes[0].contact = LoopCycle::Contact{0.1, 0.1};
  EXPECT_FALSE(keepsItsPromise({count}));
  count.guarded = false;
  EXPECT_TRUE(keepsItsPromise({count}));
  count = twoEpisodes(true);
  count.episodes[1].free_changed = 1;
  EXPECT_FALSE(keepsItsPromise({count}));
  count = twoEpisodes(true);
  count.episodes[1].standoff_speed = 0.001;
  EXPECT_FALSE(keepsItsPromise({count}));
  count = twoEpisodes(true);
  count.episodes[1].retreats.resize(1);
  EXPECT_TRUE(keepsItsPromise({count}));
  count.episodes[1].retreats[0].contact = true;
  EXPECT_FALSE(keepsItsPromise({count}));
  count.episodes[1].retreats[0].contact = false;
  count.episodes[1].retreats[0].speed_kept = 0.98;
  EXPECT_FALSE(keepsItsPromise({count}));
}

TEST(ClosedLoopReportTest, SumsTheRecordingsButNotTheKinds) {
  ClosedLoopCount comes = twoEpisodes(true);
  comes.recording = "hand, surface comes";
  const auto sums =
      summed({twoEpisodes(false), twoEpisodes(true), comes, twoEpisodes(false), twoEpisodes(true), comes});
  ASSERT_EQ(sums.size(), 3U);
  EXPECT_EQ(sums[0].recording, "all");
  EXPECT_EQ(sums[2].recording, "all, surface comes");
  for (const ClosedLoopCount& sum : sums) EXPECT_EQ(sum.episodes.size(), 4U);
}

TEST(ClosedLoopReportTest, CountsARecordingTheSameEveryTime) {
  ClosedLoopOptions setup;
  setup.random_retreats = 1;
  setup.placements = 6;
  size_t left_out = 0;
  const auto count = [&] {
    return closedLoopCsv(countClosedLoops({{"hand", winding()}}, setup, left_out, [](size_t) {}));
  };
  const std::string csv = count();
  EXPECT_EQ(csv, count());
  EXPECT_NE(csv.find("\nhand,0,6,3,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nhand,1,6,0,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n\"hand, surface comes to a tool at rest\",1,3,3,"), std::string::npos) << csv;
}

}  // namespace
}  // namespace sweep_guard_evaluation
