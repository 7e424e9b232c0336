#include "evaluation/closed_loop_options.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;

ClosedLoopOptions parsedClosedLoop(std::vector<const char*> words) {
  words.insert(words.begin(), "evaluate_closed_loop");
  return parseClosedLoopOptions(static_cast<int>(words.size()), words.data());
}

TEST(ClosedLoopOptionsTest, HasDefaultsThatHelpPrints) {
  const ClosedLoopOptions options = parsedClosedLoop({"hand.txt"});
  EXPECT_EQ(options.files, std::vector<std::string>{"hand.txt"});
  EXPECT_EQ(options.placements, 120U);
  EXPECT_EQ(options.robot.lag, milliseconds(30));
  EXPECT_EQ(options.robot.max_speed, RobotOptions{}.max_speed);
  EXPECT_NE(closedLoopUsage().find("--plane-delay S (=0.02)"), std::string::npos) << closedLoopUsage();
}

TEST(ClosedLoopOptionsTest, TakesRobotGuardAndPlacements) {
  const ClosedLoopOptions options =
      parsedClosedLoop({"--placements", "7", "--seed", "2", "--dead-time", "0.05", "--lag", "0", "--standoff", "0.01",
                        "--reach", "0.5", "--csv", "x.csv", "a", "b"});
  EXPECT_EQ(options.placements, 7U);
  EXPECT_EQ(options.seed, 2U);
  EXPECT_EQ(options.robot.dead_time, milliseconds(50));
  EXPECT_EQ(options.robot.lag, milliseconds(0));
  EXPECT_EQ(options.guard.motion.standoff, 0.01);
  EXPECT_EQ(options.guard.reach, 0.5);
  EXPECT_EQ(options.files.size(), 2U);
}

TEST(ClosedLoopOptionsTest, RefusesWhatIsOutOfRange) {
  EXPECT_TRUE(has(refusal([] { parsedClosedLoop({}); }), "no recording"));
  EXPECT_TRUE(has(refusal([] { parsedClosedLoop({"--lag", "-1", "a"}); }), "--lag"));
  EXPECT_TRUE(has(refusal([] { parsedClosedLoop({"--placements", "0", "a"}); }), "--placements"));
  EXPECT_TRUE(has(refusal([] { parsedClosedLoop({"--plane-delay", "0", "a"}); }), "--plane-delay"));
  EXPECT_TRUE(has(refusal([] { parsedClosedLoop({"--wish", "a"}); }), "--wish"));
}

}  // namespace
}  // namespace sweep_guard_evaluation
