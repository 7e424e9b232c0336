// The last hop before a velocity controller, on the wall clock: silence has a limit.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>

#include <limits>

#include "child_process.h"
#include "guard_process.h"
#include "listener.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticArray;
using geometry_msgs::Twist;
using SteadyClock = std::chrono::steady_clock;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Twist twist(double x) {
  Twist twist;
  twist.linear.x = x;
  twist.angular.z = 0.1 * x;
  return twist;
}

bool isZero(const Twist& command) { return command == Twist(); }

class ZeroOnSilenceTest : public testing::Test {
 protected:
  ZeroOnSilenceTest() { spinner_.start(); }
  void TearDown() override {
    spinner_.stop();
    ros::param::del("/zero_on_silence");
  }

  // Commands that are sent before the connection would be lost.
  template <typename Msg>
  void connect(const ros::Publisher& publisher, const Listener<Msg>& output) {
    output.next();
    while (publisher.getNumSubscribers() == 0) output.next();
  }

  // Sends the command with each zero until it is passed on.
  template <typename Msg>
  void sendUntilPassed(const ros::Publisher& publisher, const Msg& command, const Listener<Msg>& output,
                       const std::function<bool(const Msg&)>& passed) {
    output.await("the command", [&](const Msg& message) {
      publisher.publish(command);
      return passed(message);
    });
  }

  void expectDiagnosis(const std::string& text) {
    diagnostics_.await(text, [&](const DiagnosticArray& array) {
      for (const auto& status : array.status) {
        if (status.name == "zero_on_silence: commands" && has(status.message, text)) {
          return status.level == diagnostic_msgs::DiagnosticStatus::ERROR;
        }
      }
      return false;
    });
  }

  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_{1};
  Listener<DiagnosticArray> diagnostics_{"/diagnostics"};
};

TEST_F(ZeroOnSilenceTest, SendsZeroUntilTheFirstCommandAndWithin200MillisecondsAfterTheLast) {
  const ChildProcess process(program("zero_on_silence"));
  const Listener<Twist> output("output");
  const ros::Publisher publisher = node_.advertise<Twist>("command", 1);
  EXPECT_TRUE(isZero(output.next()));
  connect(publisher, output);
  for (int i = 0; i < 20; ++i) {
    const auto sent = SteadyClock::now();
    sendUntilPassed<Twist>(publisher, twist(0.1 + i), output,
                           [i](const Twist& next) { return next == twist(0.1 + i); });
    output.await("zero", isZero);
    EXPECT_LT(SteadyClock::now() - sent, std::chrono::milliseconds(200));
  }
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(isZero(output.next()));
}

TEST_F(ZeroOnSilenceTest, ReplacesWhatIsNotFiniteByZeroAndReportsIt) {
  const ChildProcess process(program("zero_on_silence", {"_timeout:=1.0"}));
  const Listener<Twist> output("output");
  const ros::Publisher publisher = node_.advertise<Twist>("command", 1);
  connect(publisher, output);
  sendUntilPassed<Twist>(publisher, twist(0.5), output, [](const Twist& next) { return next == twist(0.5); });
  const auto sent = SteadyClock::now();
  publisher.publish(twist(kNaN));
  output.await("zero", isZero);
  EXPECT_LT(SteadyClock::now() - sent, std::chrono::milliseconds(500)) << "it is not the silence that did it";
  expectDiagnosis("refused: command is not finite");
}

TEST_F(ZeroOnSilenceTest, PassesOnStampedCommandsWithTheirHeaders) {
  const ChildProcess process(program("zero_on_silence", {"_command_type:=twist_stamped"}));
  const Listener<geometry_msgs::TwistStamped> output("output");
  const ros::Publisher publisher = node_.advertise<geometry_msgs::TwistStamped>("command", 1);
  connect(publisher, output);
  geometry_msgs::TwistStamped command;
  command.header.stamp = ros::Time(12.5);
  command.header.frame_id = "base";
  command.twist = twist(0.3);
  sendUntilPassed<geometry_msgs::TwistStamped>(publisher, command, output, [&](const auto& next) {
    return next.header.stamp == command.header.stamp && next.header.frame_id == "base" && next.twist == command.twist;
  });
  output.await("zero",
               [&](const auto& next) { return isZero(next.twist) && next.header.stamp > command.header.stamp; });
}

TEST_F(ZeroOnSilenceTest, PassesOnWrenchesAndReplacesWhatIsNotFinite) {
  using geometry_msgs::WrenchStamped;
  const ChildProcess process(program("zero_on_silence", {"_command_type:=wrench_stamped", "_timeout:=1.0"}));
  const Listener<WrenchStamped> output("output");
  const ros::Publisher publisher = node_.advertise<WrenchStamped>("command", 1);
  connect(publisher, output);
  WrenchStamped command;
  command.header.frame_id = "base";
  command.wrench.force.z = 1.5;
  sendUntilPassed<WrenchStamped>(publisher, command, output, [&](const WrenchStamped& next) {
    return next.header.frame_id == "base" && next.wrench == command.wrench;
  });
  command.wrench.torque.x = kNaN;
  const auto sent = SteadyClock::now();
  publisher.publish(command);
  output.await("zero", [](const WrenchStamped& next) { return next.wrench == geometry_msgs::Wrench(); });
  EXPECT_LT(SteadyClock::now() - sent, std::chrono::milliseconds(500)) << "it is not the silence that did it";
}

TEST_F(ZeroOnSilenceTest, SendsALastZeroWhenItEnds) {
  for (const int signal : {SIGINT, SIGTERM}) {
    ChildProcess process(program("zero_on_silence", {"_timeout:=1.0"}));
    const Listener<Twist> output("output");
    const ros::Publisher publisher = node_.advertise<Twist>("command", 1);
    connect(publisher, output);
    sendUntilPassed<Twist>(publisher, twist(0.5), output, [](const Twist& next) { return next == twist(0.5); });
    const auto asked = SteadyClock::now();
    process.signal(signal);
    output.await("zero", isZero);
    EXPECT_LT(SteadyClock::now() - asked, std::chrono::milliseconds(500)) << "it is not the silence that did it";
    EXPECT_EQ(process.wait(), 0);
  }
}

TEST_F(ZeroOnSilenceTest, ReportsASecondPublisherOnEitherSide) {
  const ChildProcess process(program("zero_on_silence"));
  {
    const ChildProcess second(program("zero_on_silence", {"__name:=second", "command:=other"}));
    expectDiagnosis("several publishers on /output: /second");
  }
  const ros::Publisher publisher = node_.advertise<Twist>("command", 1);
  const ChildProcess other(program("zero_on_silence", {"__name:=other", "command:=none", "output:=command"}));
  expectDiagnosis("several publishers on /command");
}

TEST_F(ZeroOnSilenceTest, AWrongParameterEndsItWithStatusTwo) {
  ChildProcess process(program("zero_on_silence", {"_timeout:=0"}));
  EXPECT_EQ(process.wait(), 2);
  EXPECT_TRUE(has(process.output(), "timeout"));
}

}  // namespace
}  // namespace sweep_guard_ros
