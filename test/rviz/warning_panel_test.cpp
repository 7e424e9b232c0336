#include "rviz/warning_panel.h"

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Acknowledge.h>
#include <sweep_guard/Interaction.h>
#include <sweep_guard/MotionStatus.h>

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

#include "await.h"
#include "pictures.h"
#include "rviz/palette.h"
#include "rviz/strip_chart.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::Warning;

const char* const kTopic = "/guard/warning";
constexpr std::uint8_t kLoud[] = {Warning::UNKNOWN, Warning::CONSIDERED, Warning::REFLEX, Warning::CONTACT};

Warning warningLevel(std::uint8_t level) {
  Warning warning;
  warning.level = level;
  warning.clear = level == Warning::CLEAR;
  warning.time_to_collision = ros::Duration(-1.0);
  if (level >= Warning::CONSIDERED) {
    constexpr double kTimes[] = {0.62, 0.08, 0.0};
    warning.time_to_collision = ros::Duration(kTimes[level - Warning::CONSIDERED]);
    warning.mesh_id = "liver";
    warning.triangles.resize(34);
    warning.tool_link = "drill_tip";
  }
  if (level == Warning::UNKNOWN) {
    warning.reasons = Warning::POSE_STALE | Warning::TF_FAIL;
    warning.text = "UNKNOWN: newest tool pose tested is 0.52 s old; no transform from 'liver' to 'world'";
  }
  return warning;
}

/// A panel and a guard that repeats one warning.
class WarningPanelTest : public ::testing::Test {
 protected:
  WarningPanelTest() : publisher_(node_.advertise<Warning>(kTopic, 10)) {
    load(kTopic);
    panel_.resize(340, 560);
    panel_.show();
    QObject::connect(&timer_, &QTimer::timeout, [this] { publish(); });
  }

  void load(const QString& topic) {
    rviz::Config config;
    config.mapSetValue("Warning Topic", topic);
    panel_.load(config);
  }
  void speak(const Warning& warning, double valid_for) {
    warning_ = warning;
    valid_for_.fromSec(valid_for);
    timer_.start(std::chrono::milliseconds(20));
  }
  void say(const Warning& warning, double valid_for = 0.2) {
    speak(warning, valid_for);
    await("the light", [&] { return !panel_.state().silent && panel_.state().level == levelOf(warning); });
  }
  void fallSilent() { timer_.stop(); }

  QImage light() { return panel_.findChild<QWidget*>("light")->grab().toImage(); }
  QPushButton* button(const char* name) { return panel_.findChild<QPushButton*>(name); }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  WarningPanel panel_;

 private:
  void publish() {
    warning_.valid_until = ros::Time::now() + valid_for_;
    publisher_.publish(warning_);
  }

  Warning warning_;
  ros::Duration valid_for_;
  QTimer timer_;
};

template <typename Color>
auto isLike(const Color& color) {
  return [color](const QColor& c) {
    return std::abs(c.red() - color.red()) + std::abs(c.green() - color.green()) + std::abs(c.blue() - color.blue()) <
           12;
  };
}

TEST_F(WarningPanelTest, WarningsFillTheLightWithTheirColor) {
  for (const std::uint8_t level : kLoud) {
    say(warningLevel(level));
    await("the bright half", [this] { return panel_.state().bright; });
    EXPECT_GT(shareOf(light(), isLike(colorOf(static_cast<WarningLevel>(level)))), 0.4) << panel_.state().title;
    keepPicture(panel_.grab().toImage(), "panel_" + panel_.state().title);
  }
}

TEST_F(WarningPanelTest, ClearIsASmallGreenLamp) {
  say(warningLevel(Warning::CLEAR));
  const double green = shareOf(light(), isGreen);
  EXPECT_GT(green, 0.002);
  EXPECT_LT(green, 0.1);
  keepPicture(panel_.grab().toImage(), "panel_CLEAR");
}

TEST_F(WarningPanelTest, NothingButClearIsGreenAnywhereInTheLight) {
  for (const std::uint8_t level : kLoud) {
    say(warningLevel(level));
    EXPECT_EQ(shareOf(light(), isGreen), 0.0) << panel_.state().title;
  }
}

// The guard computes the force for its subscribers.
TEST_F(WarningPanelTest, OnlyInContactItListensToTheForceAndTellsIt) {
  ros::Publisher forces = node_.advertise<sweep_guard::Interaction>("/guard/interaction", 10);
  sweep_guard::Interaction interaction;
  interaction.wrench.force.z = 1.2;
  interaction.objects.resize(1);
  interaction.objects[0].volume = 1.2e-6;
  interaction.objects[0].depth = 0.0042;
  const auto* const force = panel_.findChild<QLabel*>("force");
  say(warningLevel(Warning::REFLEX));
  EXPECT_EQ(forces.getNumSubscribers(), 0U);
  EXPECT_FALSE(force->isVisible());
  say(warningLevel(Warning::CONTACT));
  await("the force", [&] {
    forces.publish(interaction);
    return force->isVisible() && force->text() == "1.20 N, 1.20 cm^3, 4.2 mm";
  });
  keepPicture(panel_.grab().toImage(), "panel_force");
  Warning held = warningLevel(Warning::CONTACT);
  held.held = 1;
  say(held);
  await("that it goes", [&] { return forces.getNumSubscribers() == 0 && !force->isVisible(); });
}

TEST_F(WarningPanelTest, ContactFlashes) {
  say(warningLevel(Warning::CONTACT));
  await("the bright half", [this] { return panel_.state().bright; });
  const double bright = shareOf(light(), isRed);
  await("the other half", [this] { return !panel_.state().bright; });
  EXPECT_LT(shareOf(light(), isRed), 0.5 * bright);
  keepPicture(panel_.grab().toImage(), "panel_CONTACT_dark");
}

// On a simulated clock: Qt, and so the panel's timer, does not run meanwhile. A warning may still arrive, and counts.
TEST_F(WarningPanelTest, AGuardThatDiesTurnsItGrayWithinAFifthOfASecondAtTwentyFramesASecond) {
  constexpr auto kFrame = std::chrono::milliseconds(50);
  say(warningLevel(Warning::CLEAR), /*valid_for=*/3600.0);
  fallSilent();
  const std::deque<LevelHistory::Sample>& samples = panel_.history().samples();
  Instant now{toTime(ros::Time::now()), samples.back().since};
  while (!panel_.state().silent) {
    now.steady += WarningPanel::kPeriod;
    panel_.refresh(now);
  }
  const LevelHistory::Sample& last = samples[samples.size() - 2];
  EXPECT_EQ(last.level, WarningLevel::kClear);
  EXPECT_LE(samples.back().since - last.since + kFrame, std::chrono::milliseconds(200));
  EXPECT_EQ(shareOf(light(), isGreen), 0.0);
}

TEST_F(WarningPanelTest, AGuardThatDiesTurnsItGray) {
  say(warningLevel(Warning::CLEAR));
  fallSilent();
  await("gray", [this] { return panel_.state().silent; });
  EXPECT_EQ(shareOf(light(), isGreen), 0.0);
  EXPECT_EQ(panel_.history().samples().back().level, WarningLevel::kUnknown);
}

TEST_F(WarningPanelTest, TheChartShowsTheLevelsOfTheWarnings) {
  say(warningLevel(Warning::CLEAR));
  say(warningLevel(Warning::CONSIDERED));
  const auto& samples = panel_.history().samples();
  const auto has = [&](WarningLevel level) {
    return std::any_of(samples.begin(), samples.end(), [&](const auto& sample) { return sample.level == level; });
  };
  EXPECT_TRUE(has(WarningLevel::kClear));
  EXPECT_TRUE(has(WarningLevel::kConsidered));
  EXPECT_EQ(samples.back().time, 0.62);
}

TEST_F(WarningPanelTest, TheTopicIsSavedWithTheConfiguration) {
  rviz::Config config;
  panel_.save(config);
  QString topic;
  ASSERT_TRUE(config.mapGetString("Warning Topic", &topic));
  EXPECT_EQ(topic, kTopic);
}

TEST_F(WarningPanelTest, WhatAMotionGuardHoldsBackIsSaidInItsColorUntilItLetsGoOrIsSilent) {
  rviz::Config config;
  config.mapSetValue("Motion Status Topic", "/other/motion_guard/status");
  panel_.load(config);
  ros::Publisher statuses = node_.advertise<sweep_guard::MotionStatus>("/other/motion_guard/status", 10);
  auto* const held = panel_.findChild<QLabel*>("held");
  say(warningLevel(Warning::CLEAR));
  EXPECT_FALSE(held->isVisible());
  sweep_guard::MotionStatus status;
  const auto awaitHeld = [&](std::int8_t code, bool visible) {
    status.code = code;
    await("what is said", [&] {
      statuses.publish(status);
      return held->isVisible() == visible;
    });
  };
  status.text = "stopped before 'wall', triangle 7, 1.2 mm in front of link 'forearm'; back along the arrow";
  awaitHeld(sweep_guard::MotionStatus::HALT_FOR_COLLISION, true);
  EXPECT_EQ(held->text().toStdString(), status.text);
  keepPicture(panel_.grab().toImage(), "panel_held");
  EXPECT_GT(shareOf(held->grab().toImage(), isMagenta), 0.4);
  awaitHeld(sweep_guard::MotionStatus::NO_WARNING, false);
  status.text = "slowed before 'wall'";
  status.scale = 0.5;
  awaitHeld(sweep_guard::MotionStatus::DECELERATE_FOR_COLLISION, true);
  EXPECT_EQ(held->text(), "slowed before 'wall' (50 % of the speed)");
  keepPicture(panel_.grab().toImage(), "panel_slowed");
  await("silence", [&] { return !held->isVisible(); });
}

TEST_F(WarningPanelTest, TheTopicOfTheMotionGuardIsSavedWithTheConfiguration) {
  QString topic;
  rviz::Config before;
  panel_.save(before);
  ASSERT_TRUE(before.mapGetString("Motion Status Topic", &topic));
  EXPECT_EQ(topic, "motion_guard/status");
  rviz::Config config;
  config.mapSetValue("Motion Status Topic", "/arm/status");
  panel_.load(config);
  rviz::Config after;
  panel_.save(after);
  ASSERT_TRUE(after.mapGetString("Motion Status Topic", &topic));
  EXPECT_EQ(topic, "/arm/status");
}

TEST_F(WarningPanelTest, WithADifferentClockTheChartIsAsGrayAsTheLight) {
  speak(warningLevel(Warning::CLEAR), /*valid_for=*/-1.0);
  await("a warning", [this] {
    const auto& reasons = panel_.state().reasons;
    return !reasons.empty() && reasons[0].rfind("the warning expired", 0) == 0;
  });
  for (const LevelHistory::Sample& sample : panel_.history().samples()) EXPECT_EQ(sample.level, WarningLevel::kUnknown);
}

TEST_F(WarningPanelTest, AnImpossibleTopicIsUnknownAndDoesNoHarm) {
  for (const char* const topic : {"no topic!", ""}) {
    load(topic);
    EXPECT_TRUE(panel_.state().silent);
    for (const char* const name : {"acknowledge", "enable", "reset"}) {
      EXPECT_FALSE(button(name)->isEnabled());
      button(name)->click();
    }
  }
  load(kTopic);
  EXPECT_TRUE(button("enable")->isEnabled());
}

// What the operator has seen is named, whatever is warned of by then.
TEST_F(WarningPanelTest, AcknowledgesTheWorkpieceThatIsShown) {
  std::string asked;
  const auto server = node_.advertiseService<sweep_guard::Acknowledge::Request, sweep_guard::Acknowledge::Response>(
      "/guard/acknowledge", [&](auto& request, auto& response) {
        asked = request.mesh_id;
        response.message = "acknowledged as asked";
        return true;
      });
  say(warningLevel(Warning::CONSIDERED));
  button("acknowledge")->click();
  const auto* const outcome = panel_.findChild<QLabel*>("outcome");
  await("the outcome", [&] {
    ros::spinOnce();
    return outcome->text() == "acknowledged as asked";
  });
  EXPECT_EQ(asked, "liver");
}

TEST_F(WarningPanelTest, OnlyAConsideredWarningThatIsNotAcknowledgedCanBe) {
  for (const int level : {Warning::UNKNOWN, Warning::CLEAR, Warning::REFLEX, Warning::CONTACT}) {
    say(warningLevel(static_cast<std::uint8_t>(level)));
    EXPECT_FALSE(button("acknowledge")->isEnabled()) << level;
  }
  Warning warning = warningLevel(Warning::CONSIDERED);
  say(warning);
  EXPECT_TRUE(button("acknowledge")->isEnabled());
  warning.acknowledged = true;
  speak(warning, 0.2);
  await("less emphasis", [&] { return panel_.state().acknowledged; });
  EXPECT_FALSE(button("acknowledge")->isEnabled());
}

// It stays amber, and is not taken for green.
TEST_F(WarningPanelTest, AnAcknowledgedWarningHasAnAmberLampOnADarkGround) {
  Warning warning = warningLevel(Warning::CONSIDERED);
  say(warning);
  const double loud = shareOf(light(), isAmber);
  warning.acknowledged = true;
  speak(warning, 0.2);
  await("less emphasis", [&] { return panel_.state().acknowledged; });
  const double known = shareOf(light(), isAmber);
  keepPicture(light(), "light_acknowledged");
  EXPECT_GT(known, 0.01);
  EXPECT_LT(known, 0.5 * loud);
  EXPECT_EQ(shareOf(light(), isGreen), 0.0);
}

// Twenty seconds in which the tool approaches twice and touches.
LevelHistory approach() {
  LevelHistory history;
  const SteadyTime begin = SteadyTime(std::chrono::hours(1));
  const auto at = [&](double seconds) { return begin + std::chrono::milliseconds(std::lround(1000.0 * seconds)); };
  for (double t = 0.0; t < 20.0; t += 0.05) {
    const double left = t < 3.0 ? 9.0 : std::abs(std::fmod(t - 3.0, 8.0) - 3.0) * (t < 11.0 ? 0.5 : 0.3) - 0.1;
    const WarningLevel level = t < 1.0      ? WarningLevel::kUnknown
                               : left > 1.0 ? WarningLevel::kClear
                               : left > 0.1 ? WarningLevel::kConsidered
                               : left > 0.0 ? WarningLevel::kReflex
                                            : WarningLevel::kContact;
    const bool timed = level >= WarningLevel::kConsidered;
    history.add({at(t), level, timed ? std::optional<double>(std::max(0.0, left)) : std::nullopt});
  }
  return history;
}

TEST(StripChartTest, ShowsLevelsByColor) {
  StripChart chart;
  chart.resize(320, 150);
  const LevelHistory history = approach();
  chart.show(history, history.samples().back().since);
  const QImage image = chart.grab().toImage();
  keepPicture(image, "strip_chart");
  EXPECT_GT(shareOf(image, isAmber), 0.01);
  EXPECT_GT(shareOf(image, isRed), 0.001);
  EXPECT_GT(shareOf(image, isGreen), 0.001);
}

TEST(StripChartTest, IsEmptyWithoutHistory) {
  StripChart chart;
  const QImage image = chart.grab().toImage();
  EXPECT_EQ(shareOf(image, isAmber) + shareOf(image, isRed) + shareOf(image, isGreen), 0.0);
}

/// Services of a guard on a thread of their own; they answer after answer().
class SlowGuard {
 public:
  SlowGuard() {
    node_.setCallbackQueue(&queue_);
    enable_ = node_.advertiseService<std_srvs::SetBool::Request, std_srvs::SetBool::Response>(
        "/guard/enable", [this](auto& request, auto& response) {
          asked.set_value(request.data);
          may_answer_.get_future().wait();
          response.success = true;
          response.message = "done as asked";
          return true;
        });
    spinner_.start();
  }
  ~SlowGuard() {
    answer();
    spinner_.stop();
    enable_.shutdown();
  }

  void answer() {
    if (!std::exchange(answered_, true)) may_answer_.set_value();
  }

  std::promise<bool> asked;

 private:
  std::promise<void> may_answer_;
  bool answered_ = false;
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_{1, &queue_};
  ros::ServiceServer enable_;
};

TEST_F(WarningPanelTest, GoesOnWhileTheGuardHasNotAnswered) {
  SlowGuard guard;
  say(warningLevel(Warning::CLEAR));
  button("enable")->click();
  EXPECT_FALSE(guard.asked.get_future().get());
  say(warningLevel(Warning::REFLEX));
  EXPECT_FALSE(button("enable")->isEnabled());
  guard.answer();
  await("the button", [this] { return button("enable")->isEnabled(); });
}

TEST_F(WarningPanelTest, AGuardThatNeverAnswersIsLeftForAnother) {
  SlowGuard guard;
  button("enable")->click();
  guard.asked.get_future().wait();
  const auto* const outcome = panel_.findChild<QLabel*>("outcome");
  EXPECT_EQ(outcome->text(), "waiting for /guard/enable");
  load("/other/warning");
  await("the button", [this] { return button("enable")->isEnabled(); });
  EXPECT_TRUE(outcome->isHidden());
}

TEST_F(WarningPanelTest, TheButtonOfADisabledGuardEnablesIt) {
  SlowGuard guard;
  Warning warning = warningLevel(Warning::UNKNOWN);
  warning.reasons = Warning::DISABLED;
  warning.text = "UNKNOWN: disabled by /operator: nothing is tested";
  say(warning);
  await("the level", [this] { return panel_.state().disabled; });
  EXPECT_EQ(button("enable")->text(), "Enable");
  keepPicture(panel_.grab().toImage(), "panel_DISABLED");
  button("enable")->click();
  EXPECT_TRUE(guard.asked.get_future().get());
  guard.answer();
  await("the button", [this] { return button("enable")->isEnabled(); });
}

TEST_F(WarningPanelTest, ResetCallsTheGuard) {
  bool called = false;
  const ros::ServiceServer server = node_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
      "/guard/reset", [&](auto& /*request*/, auto& /*response*/) { return called = true; });
  button("reset")->click();
  await("the call", [&] {
    ros::spinOnce();
    return called;
  });
}

TEST_F(WarningPanelTest, AGuardThatNeverAnswersDoesNotKeepThePanelFromClosing) {
  SlowGuard guard;
  {
    WarningPanel panel;
    rviz::Config config;
    config.mapSetValue("Warning Topic", kTopic);
    panel.load(config);
    panel.findChild<QPushButton*>("enable")->click();
    guard.asked.get_future().wait();
  }
}

}  // namespace
}  // namespace sweep_guard_rviz

int main(int argc, char** argv) {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "warning_panel_test");
  ros::NodeHandle keeps_ros_running;
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
