// How the guard ends. On the wall clock, because ends have a limit.
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/master.h>
#include <signal.h>

#include "child_process.h"
#include "guard_probe.h"
#include "guard_process.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;
using SteadyClock = std::chrono::steady_clock;
using XmlRpc::XmlRpcValue;

constexpr double kLongestEnd = 1.0;  // [s]
constexpr int kMaxRounds = 50;       // of poses, until some wait

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
void sendPoses(GuardProbe& probe) {
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(i % 2 == 0 ? 0.0 : 3.0, Eigen::Vector3d::UnitX()));
    probe.publish(poseAt({0.001 * (i % 7), 0, 0}, ros::Time::now(), turned));
  }
}

// Until the guard says that poses wait.
void sendBacklog(GuardProbe& probe) {
  for (int i = 0; i < kMaxRounds; ++i) {
    probe.skipWarnings();
    sendPoses(probe);
    probe.awaitWarning([](const Warning&) { return true; });
    if ((probe.warnings().back().reasons & Warning::POSES_UNSWEPT) != 0) return;
  }
  FAIL() << "no poses wait: " << probe.warnings().back().text;
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
  ASSERT_NO_FATAL_FAILURE(sendBacklog(probe));
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
  ASSERT_NO_FATAL_FAILURE(sendBacklog(probe));
  nodelet::NodeletUnload unload;
  unload.request.name = "/sweep_guard";
  const auto asked = SteadyClock::now();
  ASSERT_TRUE(ros::service::call("/manager/unload_nodelet", unload) && unload.response.success);
  EXPECT_LT(secondsSince(asked), kLongestEnd);
  probe.awaitWarning(isFinal);
}

}  // namespace
}  // namespace sweep_guard_ros
