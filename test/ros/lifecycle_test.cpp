// How the guard ends, is started again, and outlives its master. On the wall clock, because ends have a limit.
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/package.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "child_process.h"
#include "guard_probe.h"
#include "guard_process.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;
using SteadyClock = std::chrono::steady_clock;
using XmlRpc::XmlRpcValue;

constexpr double kLongestEnd = 1.0;  // [s]

bool isFinal(const Warning& warning) {
  return warning.level == Warning::UNKNOWN && !warning.clear && warning.reflex &&
         warning.text == "UNKNOWN: the guard is shutting down";
}

void shutDownByXmlRpc() {
  const auto node = xmlRpc().call(ros::master::getURI(), "lookupNode", {XmlRpcValue("/sweep_guard")});
  ASSERT_TRUE(node && node->success);
  EXPECT_TRUE(xmlRpc().call(node->value, "shutdown", {XmlRpcValue("as rosnode kill does")}));
}

// Each pose turns the tool by half a turn, and each sweep meets the square: the backlog would last for minutes.
void sendBacklog(GuardProbe& probe) {
  for (int i = 0; i < 60000; ++i) {
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(i % 2 == 0 ? 0.0 : 3.0, Eigen::Vector3d::UnitX()));
    probe.publish(poseAt({0.001 * (i % 7), 0, 0}, ros::Time::now(), turned));
  }
  probe.awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::POSES_UNSWEPT) != 0; });
}

struct End {
  const char* name;
  std::function<void(const ChildProcess&)> ask;
};
void PrintTo(const End& end, std::ostream* out) { *out << end.name; }

class EndTest : public ::testing::TestWithParam<End> {
 protected:
  void TearDown() override { ros::param::del("/sweep_guard"); }

  // Asks the guard to end, and expects that it does so in time, after a last warning.
  static void expectGoodEnd(ChildProcess& guard, GuardProbe& probe) {
    const auto asked = SteadyClock::now();
    GetParam().ask(guard);
    EXPECT_EQ(guard.wait(), 0) << guard.output();
    EXPECT_LT(secondsSince(asked), kLongestEnd);
    probe.awaitWarning(isFinal);
    EXPECT_TRUE(isFinal(probe.warnings().back())) << probe.warnings().back().text;
  }
};

TEST_P(EndTest, PublishesAFinalUnknownWithinASecond) {
  ChildProcess guard(guardWith({}));
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", kSquare, ros::Time::now()));
  expectGoodEnd(guard, probe);
}

TEST_P(EndTest, InTheMidstOfABacklogTakesASecond) {
  ChildProcess guard(
      guardWith({"_max_rotation_per_sweep:=0.01", "_timing/mesh_timeout:=inf", "_limits/max_turn_rate:=1000.0"}));
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0, 0, 0}, ros::Time::now(), /*half_side=*/0.5));
  sendBacklog(probe);
  expectGoodEnd(guard, probe);
}

INSTANTIATE_TEST_SUITE_P(Requests, EndTest,
                         ::testing::Values(End{"SIGINT", [](const auto& guard) { guard.signal(SIGINT); }},
                                           End{"SIGTERM", [](const auto& guard) { guard.signal(SIGTERM); }},
                                           End{"RosnodeKill", [](const auto&) { shutDownByXmlRpc(); }}),
                         [](const auto& test) { return test.param.name; });

TEST(NodeletEndTest, UnloadingPublishesAFinalUnknownWithinASecond) {
  ASSERT_TRUE(ros::service::waitForService("/manager/unload_nodelet", ros::Duration(20.0)));
  ros::param::set("/sweep_guard/max_rotation_per_sweep", 0.01);
  ros::param::set("/sweep_guard/timing/mesh_timeout", 1000.0);
  nodelet::NodeletLoad load;
  load.request.name = "/sweep_guard";
  load.request.type = "sweep_guard/SweepGuardNodelet";
  ASSERT_TRUE(ros::service::call("/manager/load_nodelet", load) && load.response.success);
  ros::param::del("/sweep_guard");
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0, 0, 0}, ros::Time::now(), /*half_side=*/0.5));
  sendBacklog(probe);
  nodelet::NodeletUnload unload;
  unload.request.name = "/sweep_guard";
  const auto asked = SteadyClock::now();
  ASSERT_TRUE(ros::service::call("/manager/unload_nodelet", unload) && unload.response.success);
  EXPECT_LT(secondsSince(asked), kLongestEnd);
  probe.awaitWarning(isFinal);
}

/// Ends with all that it started: roslaunch gives each of its nodes a process group.
class Roslaunch : public ChildProcess {
 public:
  using ChildProcess::ChildProcess;
  ~Roslaunch() {
    signal(SIGINT);
    wait();
  }
};

class LaunchTest : public ::testing::Test {
 protected:
  static std::vector<std::string> launch(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{"roslaunch", "sweep_guard", "sweep_guard.launch"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
  }
  static std::string configured(const std::string& file) {
    return ros::package::getPath("sweep_guard") + "/config/" + file;
  }
};

// The files are rigid workpieces: a latched mesh is all that a new guard needs.
TEST_F(LaunchTest, AKilledGuardIsStartedAgainAndBeginsUnknown) {
  Roslaunch launched(launch({"config:=" + configured("static_workpiece.yaml")}));
  ros::Publisher latched = ros::NodeHandle().advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
  latched.publish(squareAt("square", kSquare, ros::Time::now()));
  GuardProbe probe(/*drives_clock=*/false);
  const auto awaitClear = [&](const std::string& not_of) {
    Warning newest;
    do {
      probe.publish(poseAt(kAway, ros::Time::now()));
      newest = probe.awaitWarning([](const Warning&) { return true; });
    } while (!newest.clear || newest.run_id == not_of);
    return newest.run_id;
  };
  std::string run = awaitClear("");
  for (int cycle = 0; cycle < 2; ++cycle) {
    ASSERT_EQ(kill(guardPid(), SIGKILL), 0);
    const Warning first = probe.awaitWarning([&](const Warning& warning) { return warning.run_id != run; });
    EXPECT_EQ(first.level, Warning::UNKNOWN);
    EXPECT_EQ(first.level_counts[Warning::CLEAR], 0U);
    run = awaitClear(run);
  }
  launched.signal(SIGINT);
  EXPECT_EQ(launched.wait(), 0);
}

// Nobody may overlook a guard that cannot start: roslaunch itself says only that it has died.
TEST_F(LaunchTest, ARefusedParameterIsReportedAtEveryStart) {
  ros::NodeHandle node;
  std::vector<std::string> reported;
  const ros::Subscriber diagnostics = node.subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", 100, [&](const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
        for (const auto& status : message->status) {
          if (status.name == "/sweep_guard: start") reported.push_back(status.message);
        }
      });
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("refused_" + std::to_string(getpid()));
  std::ofstream(file) << "tool: {radius: -1.0}\n";
  Roslaunch launched(launch({"config:=" + file.string()}));
  const auto begin = SteadyClock::now();
  while (reported.size() < 2 && secondsSince(begin) < 20.0) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  }
  ASSERT_GE(reported.size(), 2U);
  launched.signal(SIGINT);
  launched.wait();
  EXPECT_EQ(reported[0].rfind("parameter /sweep_guard/tool/radius is -1", 0), 0U) << reported[0];
  EXPECT_EQ(reported[1], reported[0]);
  size_t on_screen = 0;
  for (size_t at = 0; (at = launched.output().find(reported[0], at)) != std::string::npos; ++at) ++on_screen;
  EXPECT_GE(on_screen, 2U) << launched.output();
  std::filesystem::remove(file);
  ros::param::del("/sweep_guard");
}

// The warnings of the contact are not looked at, as if they had been lost: the counts before and after tell of it.
TEST(LostWarningTest, ACountTellsOfAContactThatNobodyHeard) {
  ChildProcess guard(guardWith({"_warning/hold_time:=0.0", "_timing/pose_timeout:=2.0"}));
  GuardProbe probe(/*drives_clock=*/false);
  const Warning before = probe.warnings().back();
  probe.place(squareAt("square", {0, 0, 0}, ros::Time::now()));
  for (const double z : {0.1, -0.1, 0.1, 0.1}) probe.move(poseAt({0, 0, z}, ros::Time::now()));
  const Warning after = probe.awaitWarning([&](const Warning& warning) {
    return warning.sequence > before.sequence + 1 && warning.level != Warning::CONTACT;
  });
  EXPECT_EQ(after.level_counts[Warning::CONTACT], before.level_counts[Warning::CONTACT] + 1);
  EXPECT_EQ(
      std::accumulate(after.level_counts.begin(), after.level_counts.end(), 0U),
      std::accumulate(before.level_counts.begin(), before.level_counts.end(), 0U) + after.sequence - before.sequence);
  guard.signal(SIGTERM);
  EXPECT_EQ(guard.wait(), 0);
  ros::param::del("/sweep_guard");
}

// Every refused pose is logged, or would be.
TEST(DiskTest, WithoutRoomForALogTheGuardWarns) {
  ChildProcess guard(guardWith({"__log:=/dev/full", "_timing/mesh_timeout:=inf"}), {"ROS_LOG_DIR=/proc/none"});
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", kSquare, ros::Time::now()));
  for (int i = 0; i < 50; ++i) {
    do {
      probe.publish(poseAt(kAway, ros::Time::now()));
    } while (!probe.awaitWarning([](const Warning&) { return true; }).clear);
    probe.publish(poseAt({NAN, 0, 0}, ros::Time::now()));
    const Warning refused =
        probe.awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::POSE_INVALID) != 0; });
    EXPECT_EQ(refused.level, Warning::UNKNOWN);
  }
  guard.signal(SIGTERM);
  EXPECT_EQ(guard.wait(), 0) << guard.output();
  ros::param::del("/sweep_guard");
}

// Its configuration is lost with the parameters: a guard with the defaults would guard another tool.
TEST(MasterTest, WithoutParametersStartsNoConfiguredGuard) {
  ChildProcess guard(guardWith({"--configured"}));
  EXPECT_EQ(guard.wait(), 2);
  EXPECT_NE(guard.output().find("there is no parameter in /sweep_guard"), std::string::npos) << guard.output();
}

}  // namespace
}  // namespace sweep_guard_ros
