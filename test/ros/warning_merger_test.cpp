// Three guards and their merger, as a node and as a nodelet, on the wall clock: silence has a limit.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>
#include <std_msgs/Bool.h>

#include <array>
#include <initializer_list>
#include <utility>

#include "child_process.h"
#include "fake_guard.h"
#include "guard_process.h"
#include "listener.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;
using SteadyClock = std::chrono::steady_clock;

class WarningMergerNodeTest : public testing::TestWithParam<const char*> {
 protected:
  WarningMergerNodeTest() { spinner_.start(); }
  ~WarningMergerNodeTest() override {
    for (FakeGuard& guard : guards_) {
      guard.setLevel(Warning::CLEAR);
      guard.setSilent(false);
    }
    spinner_.stop();
  }

  // Once for all tests: new ones would be silent until they are connected.
  static std::array<FakeGuard, 3>& guards() {
    static auto* const guards = new std::array<FakeGuard, 3>{FakeGuard("/a"), FakeGuard("/b"), FakeGuard("/c")};
    return *guards;
  }

  Warning await(std::uint8_t level) const {
    return merged_.await("level " + std::to_string(level),
                         [level](const Warning& warning) { return warning.level == level; });
  }

  ros::AsyncSpinner spinner_{1};
  Listener<Warning> merged_{GetParam()};
  std::array<FakeGuard, 3>& guards_ = guards();
};

TEST_P(WarningMergerNodeTest, IsClearOnlyWhileEachGuardIs) {
  await(Warning::CLEAR);
  using Levels = std::initializer_list<std::uint8_t>;
  for (const std::uint8_t level : Levels{Warning::UNKNOWN, Warning::CONSIDERED, Warning::REFLEX, Warning::CONTACT}) {
    guards_[1].setLevel(level);
    const std::uint32_t reasons = level == Warning::UNKNOWN ? std::uint32_t{Warning::MESH_STALE} : 0U;
    const Warning merged = merged_.await("what /b says", [&](const Warning& warning) {
      return warning.level == level && warning.reasons == reasons && has(warning.text, "/b: ");
    });
    EXPECT_FALSE(merged.clear);
    EXPECT_TRUE(merged.considered);
    EXPECT_EQ(merged.reflex != 0, level != Warning::CONSIDERED);
    EXPECT_EQ(merged.contact != 0, level == Warning::CONTACT);
    guards_[1].setLevel(Warning::CLEAR);
    const Warning clear = await(Warning::CLEAR);
    EXPECT_TRUE(clear.clear);
    EXPECT_GT(clear.sequence, merged.sequence);
    EXPECT_EQ(clear.tool, "tool");
  }
}

TEST_P(WarningMergerNodeTest, SilenceOfOneOfThreeGuardsIsUnknownSoon) {
  for (int i = 0; i < 10; ++i) {
    await(Warning::CLEAR);
    guards_[2].setSilent(true);
    const auto silent = SteadyClock::now();
    const Warning unknown = merged_.await("the silence of /c", [](const Warning& warning) {
      return warning.level == Warning::UNKNOWN && has(warning.text, "/c: silent for");
    });
    EXPECT_LT(SteadyClock::now() - silent, std::chrono::milliseconds(250));
    EXPECT_EQ(unknown.reasons, Warning::NOT_COVERED);
    EXPECT_TRUE(unknown.reflex);
    guards_[2].setSilent(false);
  }
}

TEST_P(WarningMergerNodeTest, FlagsFollowTheWarning) {
  const std::string scope = std::string(GetParam()).substr(0, std::string(GetParam()).rfind('/'));
  const Listener<std_msgs::Bool> reflex(scope + "/reflex_warning");
  const Listener<std_msgs::Bool> considered(scope + "/considered_warning");
  const auto is = [](bool raised) {
    return [raised](const std_msgs::Bool& flag) { return (flag.data != 0) == raised; };
  };
  await(Warning::CLEAR);
  reflex.await("no reflex flag", is(false));
  considered.await("no considered flag", is(false));
  guards_[1].setLevel(Warning::CONSIDERED);
  considered.await("considered", is(true));
  guards_[1].setLevel(Warning::REFLEX);
  reflex.await("reflex", is(true));
}

TEST_P(WarningMergerNodeTest, AContactIsShownWhileAnotherGuardIsSilent) {
  guards_[0].setSilent(true);
  guards_[1].setLevel(Warning::CONTACT);
  const Warning contact = merged_.await("both", [](const Warning& warning) {
    return warning.level == Warning::CONTACT && (warning.reasons & Warning::NOT_COVERED) != 0;
  });
  EXPECT_TRUE(contact.contact);
  EXPECT_EQ(contact.covered_until, ros::Time());
}

INSTANTIATE_TEST_SUITE_P(Both, WarningMergerNodeTest,
                         testing::Values("/warning_merger/warning", "/in_manager/warning_merger/warning"));

void expectRefused(const std::string& guards, const std::string& reason) {
  ChildProcess process(program("warning_merger_node", {"__name:=refused", "_guards:=" + guards}));
  EXPECT_EQ(process.wait(), 2);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, reason, process.output());
  ros::param::del("/refused");
}

TEST(WarningMergerStartTest, RefusesGuardsThatCannotBeMerged) {
  expectRefused("[]", "parameter guards has 0 names: set it to the nodes of 1 to 64 guards");
  expectRefused("[/a, a]", "parameter guards has /a twice");
  expectRefused("[/a, /refused]", "which is this node");
  expectRefused("['/a b']", "parameter guards has no name of a node");
}

TEST(WarningMergerEndTest, SaysUnknownWhenItEnds) {
  ros::AsyncSpinner spinner(1);
  spinner.start();
  FakeGuard guard("/alone");
  const Listener<Warning> merged("/ending/warning");
  ChildProcess process(program("warning_merger_node", {"__name:=ending", "_guards:=[/alone]"}));
  bool ends = false;
  const Warning last = merged.await("the end", [&](const Warning& warning) {
    if (warning.clear != 0 && !std::exchange(ends, true)) process.signal(SIGTERM);
    return warning.text == "UNKNOWN: the merger ends";
  });
  EXPECT_TRUE(ends);
  EXPECT_EQ(last.level, Warning::UNKNOWN);
  EXPECT_EQ(last.reasons, Warning::DISABLED);
  EXPECT_EQ(process.wait(), 0);
  spinner.stop();
}

}  // namespace
}  // namespace sweep_guard_ros
