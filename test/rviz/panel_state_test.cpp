#include "rviz/panel_state.h"

#include <gtest/gtest.h>

#include "rviz/strip_chart.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_rviz {
namespace {

using std::chrono::milliseconds;
using sweep_guard::Warning;

const ros::Time kStamp(1000.0);
const Instant kNow{toTime(kStamp), SteadyTime(std::chrono::hours(1))};

Warning warningLevel(std::uint8_t level, std::uint32_t reasons = 0) {
  Warning warning;
  warning.level = level;
  warning.reasons = reasons;
  warning.clear = level == Warning::CLEAR;
  warning.time_to_collision = ros::Duration(-1.0);
  warning.valid_until = kStamp + ros::Duration(0.2);
  return warning;
}

PanelState shown(const Warning& warning, milliseconds age = milliseconds(10)) {
  return panelState(ReceivedWarning{warning, {kNow.stamp, kNow.steady - age}}, kNow, "/guard/warning");
}

TEST(PanelStateTest, EveryLevelHasItsName) {
  const char* const names[] = {"UNKNOWN", "CLEAR", "CONSIDERED", "REFLEX", "CONTACT"};
  for (std::uint8_t level = Warning::UNKNOWN; level <= Warning::CONTACT; ++level) {
    const PanelState state = shown(warningLevel(level));
    EXPECT_EQ(static_cast<int>(state.level), level);
    EXPECT_EQ(state.title, names[level]);
    EXPECT_FALSE(state.silent);
  }
}

TEST(PanelStateTest, NoWarningIsUnknownAndNamesTheTopic) {
  const PanelState state = panelState(std::nullopt, kNow, "/guard/warning");
  EXPECT_EQ(state.level, WarningLevel::kUnknown);
  EXPECT_TRUE(state.silent);
  EXPECT_EQ(state.reasons, std::vector<std::string>{"no warning from /guard/warning"});
}

TEST(PanelStateTest, IntendedContactIsSaidAndStaysClear) {
  Warning warning = warningLevel(Warning::CLEAR);
  warning.intended = true;
  warning.text = "CLEAR: intended contact with 'bone'";
  const PanelState state = shown(warning);
  EXPECT_EQ(state.level, WarningLevel::kClear);
  EXPECT_EQ(state.meaning, "intended contact");
  EXPECT_EQ(state.reasons, std::vector<std::string>{"intended contact with 'bone'"});
  warning = warningLevel(Warning::CONTACT);
  warning.intended = true;
  EXPECT_EQ(shown(warning).meaning, "the tool touches");
}

TEST(PanelStateTest, SilenceIsUnknown) {
  EXPECT_EQ(shown(warningLevel(Warning::CLEAR), kSilence).level, WarningLevel::kClear);
  const PanelState state = shown(warningLevel(Warning::CLEAR), kSilence + milliseconds(1));
  EXPECT_EQ(state.level, WarningLevel::kUnknown);
  EXPECT_TRUE(state.silent);
}

TEST(PanelStateTest, AWarningThatRanOutIsUnknownHoweverFreshItCame) {
  Warning warning = warningLevel(Warning::CLEAR);
  warning.valid_until = kStamp - ros::Duration(0.01);
  EXPECT_EQ(shown(warning).level, WarningLevel::kUnknown);
}

TEST(PanelStateTest, AZeroInitializedWarningIsUnknown) { EXPECT_EQ(shown(Warning()).level, WarningLevel::kUnknown); }

TEST(PanelStateTest, ClearWithAReasonOrWithoutPermissionIsUnknown) {
  EXPECT_EQ(shown(warningLevel(Warning::CLEAR, Warning::MESH_STALE)).level, WarningLevel::kUnknown);
  Warning warning = warningLevel(Warning::CLEAR);
  warning.clear = false;
  EXPECT_EQ(shown(warning).level, WarningLevel::kUnknown);
}

TEST(PanelStateTest, OverloadKeepsClearAndIsShown) {
  const PanelState state = shown(warningLevel(Warning::CLEAR, Warning::OVERLOAD));
  EXPECT_EQ(state.level, WarningLevel::kClear);
  EXPECT_EQ(state.reasons.size(), 1U);
}

TEST(PanelStateTest, ALevelThatDoesNotExistIsUnknown) {
  EXPECT_EQ(shown(warningLevel(5)).level, WarningLevel::kUnknown);
}

TEST(PanelStateTest, EveryReasonHasATextWhereTheWarningHasNone) {
  for (std::uint32_t bit = 1; bit <= sweep_guard_core::kNotSeen; bit <<= 1U) {
    EXPECT_EQ(shown(warningLevel(Warning::UNKNOWN, bit)).reasons.size(), 1U) << bit;
  }
}

TEST(PanelStateTest, TheReasonsThatLeaveTheLevelAreThoseOfTheGuard) {
  for (std::uint32_t bit = 1; bit <= sweep_guard_core::kNotSeen; bit <<= 1U) {
    const bool stays_clear = shown(warningLevel(Warning::CLEAR, bit)).level == WarningLevel::kClear;
    EXPECT_EQ(stays_clear, (bit & sweep_guard_core::kDegraded) != 0) << bit;
  }
}

TEST(PanelStateTest, TheSentencesOfTheWarningBecomeReasons) {
  Warning warning = warningLevel(Warning::UNKNOWN, Warning::POSE_STALE | Warning::NO_MESH);
  warning.text = "UNKNOWN: newest tool pose tested is 0.52 s old; no workpiece yet";
  EXPECT_EQ(shown(warning).reasons,
            (std::vector<std::string>{"newest tool pose tested is 0.52 s old", "no workpiece yet"}));
}

TEST(PanelStateTest, NothingIsSaidTwice) {
  Warning warning = warningLevel(Warning::CONTACT, Warning::POSE_STALE);
  warning.text = "CONTACT: tool meets 'liver', 3 triangles; newest tool pose tested is 0.52 s old";
  EXPECT_EQ(shown(warning).reasons, std::vector<std::string>{"newest tool pose tested is 0.52 s old"});
}

TEST(PanelStateTest, NamesWhatWillBeHit) {
  Warning warning = warningLevel(Warning::REFLEX);
  warning.time_to_collision = ros::Duration(0.084);
  warning.mesh_id = "liver";
  warning.triangles = {3, 4, 8};
  warning.tool_link = "tip";
  const PanelState state = shown(warning);
  EXPECT_EQ(state.time, "0.08 s");
  EXPECT_EQ(state.meaning, "to collision");
  EXPECT_EQ(state.target, "ahead: liver, 3 triangles, by tip");
}

TEST(PanelStateTest, ACollisionThatIsMerelyProbableHasNoTime) {
  const PanelState state = shown(warningLevel(Warning::CONSIDERED));
  EXPECT_EQ(state.time, "-");
  EXPECT_EQ(state.meaning, "collision is probable");
}

TEST(PanelStateTest, OnlyContactFlashesAndDoesSoTwiceASecond) {
  for (std::uint8_t level = Warning::UNKNOWN; level <= Warning::CONTACT; ++level) {
    int changes = 0;
    bool bright = true;
    for (int tick = 0; tick < 1000; tick += 10) {
      const Instant now{kNow.stamp, kNow.steady + milliseconds(tick)};
      const PanelState state = panelState(ReceivedWarning{warningLevel(level), now}, now, "");
      changes += state.bright != bright ? 1 : 0;
      bright = state.bright;
    }
    if (level == Warning::CONTACT) {
      EXPECT_GE(changes, 3);
    } else {
      EXPECT_EQ(changes, 0);
    }
  }
}

TEST(PanelStateTest, AHeldContactIsNotNow) {
  Warning warning = warningLevel(Warning::CONTACT);
  warning.time_to_collision = ros::Duration(0.0);
  warning.mesh_id = "liver";
  EXPECT_EQ(shown(warning).time, "now");
  EXPECT_EQ(shown(warning).meaning, "the tool touches");
  warning.held = true;
  warning.held_since = kStamp - ros::Duration(0.3);
  warning.text = "CONTACT: tool touched 'liver' 0.28 s ago";
  const PanelState state = shown(warning);
  EXPECT_EQ(state.level, WarningLevel::kContact);
  EXPECT_EQ(state.time, "-");
  EXPECT_EQ(state.meaning, "touched 0.3 s ago");
  EXPECT_EQ(state.target, "touched liver");
  EXPECT_TRUE(state.reasons.empty());
}

TEST(PanelStateTest, AHeldContactDoesNotFlash) {
  Warning warning = warningLevel(Warning::CONTACT);
  warning.held = true;
  for (int tick = 0; tick < 1000; tick += 10) {
    const Instant now{kNow.stamp, kNow.steady + milliseconds(tick)};
    EXPECT_TRUE(panelState(ReceivedWarning{warning, now}, now, "").bright);
  }
}

TEST(PanelStateTest, AHeldWarningSaysSinceWhen) {
  Warning warning = warningLevel(Warning::REFLEX);
  warning.held = true;
  warning.held_since = kStamp - ros::Duration(0.2);
  EXPECT_EQ(shown(warning).meaning, "collision was expected, 0.2 s ago");
}

TEST(PanelStateTest, OnlyConsideredIsShownAsAcknowledged) {
  for (std::uint8_t level = Warning::UNKNOWN; level <= Warning::CONTACT; ++level) {
    Warning warning = warningLevel(level);
    warning.acknowledged = true;
    const PanelState state = shown(warning);
    EXPECT_EQ(static_cast<int>(state.level), level);
    EXPECT_EQ(state.acknowledged, level == Warning::CONSIDERED);
    EXPECT_EQ(state.meaning.find("acknowledged") == 0, level == Warning::CONSIDERED) << state.meaning;
  }
}

TEST(PanelStateTest, DisabledIsNotClearAndSaysSo) {
  const PanelState state = shown(warningLevel(Warning::UNKNOWN, Warning::DISABLED));
  EXPECT_EQ(state.level, WarningLevel::kUnknown);
  EXPECT_TRUE(state.disabled);
  EXPECT_EQ(state.title, "DISABLED");
}

sweep_guard::MotionStatus motionStatus(std::int8_t code, double scale) {
  sweep_guard::MotionStatus status;
  status.code = code;
  status.scale = scale;
  status.text = "what is done and why";
  return status;
}

TEST(HeldStateTest, SaysNothingOfACommandThatIsPassedOn) {
  EXPECT_EQ(heldState(motionStatus(sweep_guard::MotionStatus::NO_WARNING, 1.0)).text, "");
  EXPECT_EQ(heldState({}).text, "");
}

TEST(HeldStateTest, SaysWhyARobotIsStopped) {
  for (const std::int8_t code : {sweep_guard::MotionStatus::HALT_FOR_COLLISION, sweep_guard::MotionStatus::INVALID}) {
    const HeldState state = heldState(motionStatus(code, 0.0));
    EXPECT_TRUE(state.stopped);
    EXPECT_EQ(state.text, "what is done and why");
  }
}

TEST(HeldStateTest, SaysHowMuchOfTheSpeedIsLeft) {
  const HeldState state = heldState(motionStatus(sweep_guard::MotionStatus::DECELERATE_FOR_COLLISION, 0.347));
  EXPECT_FALSE(state.stopped);
  EXPECT_EQ(state.text, "what is done and why (35 % of the speed)");
}

TEST(LevelHistoryTest, KeepsTheLevelOfTwentySecondsAgo) {
  LevelHistory history;
  const auto at = [](double seconds) {
    return SteadyTime(std::chrono::hours(1)) + milliseconds(static_cast<int>(1000 * seconds));
  };
  history.add({at(0.0), WarningLevel::kClear, {}});
  history.add({at(5.0), WarningLevel::kConsidered, 0.8});
  history.add({at(24.0), WarningLevel::kReflex, 0.1});
  ASSERT_EQ(history.samples().size(), 3U);
  history.add({at(26.0), WarningLevel::kContact, 0.0});
  ASSERT_EQ(history.samples().size(), 3U);
  EXPECT_EQ(history.samples().front().level, WarningLevel::kConsidered);
  EXPECT_EQ(history.longestTime(), 0.8);
}

TEST(LevelHistoryTest, TimeDoesNotGoBack) {
  LevelHistory history;
  history.add({kNow.steady, WarningLevel::kClear, {}});
  history.add({kNow.steady - milliseconds(5), WarningLevel::kReflex, {}});
  EXPECT_EQ(history.samples().back().since, kNow.steady);
}

}  // namespace
}  // namespace sweep_guard_rviz
