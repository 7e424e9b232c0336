// Each node that outlives its master, with a master of the test's own.
#include <gtest/gtest.h>
#include <ros/duration.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>

#include "child_process.h"
#include "guard_probe.h"
#include "guard_process.h"

namespace sweep_guard_ros {
namespace {

using SteadyClock = std::chrono::steady_clock;
using XmlRpc::XmlRpcValue;

std::string freePort() {
  XmlRpc::XmlRpcServer server;
  server.bindAndListen(0);
  std::string port = std::to_string(server.get_port());
  server.shutdown();
  return port;
}

/// A master that the test itself does not use.
class Master {
 public:
  explicit Master(const std::string& port)
      : uri_("http://127.0.0.1:" + port), process_({"rosmaster", "--core", "-p", port}, {"ROS_MASTER_URI=" + uri_}) {
    const auto begin = SteadyClock::now();
    while (!xmlRpc().call(uri_, "getPid", {})) {
      if (secondsSince(begin) > 20.0) throw std::runtime_error("the master does not answer");
      ros::WallDuration(0.01).sleep();
    }
  }

  const std::string& uri() const { return uri_; }
  XmlRpcValue ask(const std::string& function, const std::vector<XmlRpcValue>& arguments) const {
    const auto answer = xmlRpc().call(uri_, function, arguments);
    return answer && answer->success ? answer->value : XmlRpcValue();
  }
  /// Returns what a node has registered: 0, 1 or 2 for publishers, subscribers and services, and the name.
  std::set<std::string> registered(const std::string& node) const {
    std::set<std::string> names;
    XmlRpcValue state = ask("getSystemState", {});
    for (int kind = 0; state.valid() && kind < 3; ++kind) {
      for (int i = 0; i < state[kind].size(); ++i) {
        const auto by = state[kind][i][1].toXml();
        if (by.find(node + "<") == std::string::npos) continue;
        names.insert(std::to_string(kind) + static_cast<std::string>(state[kind][i][0]));
      }
    }
    return names;
  }

 private:
  const std::string uri_;
  const ChildProcess process_;
};

struct Watched {
  const char* program;
  const char* node;
  const char* setting;    ///< command line of a parameter that is not the default
  const char* parameter;  ///< its name
  double value;
  std::vector<std::string> registered;  ///< some of what it registers
  const char* field;                    ///< is 0, and is sent without an input
};
void PrintTo(const Watched& watched, std::ostream* out) { *out << watched.program; }

class MasterWatchTest : public testing::TestWithParam<Watched> {
 protected:
  static std::set<std::string> await(const Master& master,
                                     const std::function<bool(const std::set<std::string>&)>& complete) {
    const auto begin = SteadyClock::now();
    std::set<std::string> names;
    while (!complete(names = master.registered(GetParam().node)) && secondsSince(begin) < 10.0) {
      ros::WallDuration(0.01).sleep();
    }
    return names;
  }
};

TEST_P(MasterWatchTest, AMasterThatIsStartedAnewKnowsTheNodeAgain) {
  const Watched& watched = GetParam();
  const std::string port = freePort();
  auto master = std::make_unique<Master>(port);
  const std::vector<std::string> at_master{"ROS_MASTER_URI=" + master->uri()};
  ChildProcess process(program(watched.program, {watched.setting}), at_master);
  const std::set<std::string> before = await(*master, [&](const auto& names) {
    return std::all_of(watched.registered.begin(), watched.registered.end(),
                       [&](const std::string& name) { return names.count(name) != 0; });
  });
  for (const std::string& name : watched.registered) ASSERT_EQ(before.count(name), 1U) << name;
  for (int cycle = 0; cycle < 2; ++cycle) {
    master.reset();  // kill -9
    master = std::make_unique<Master>(port);
    EXPECT_EQ(await(*master, [&](const auto& names) { return names == before; }), before);
    EXPECT_EQ(static_cast<double>(master->ask("getParam", {XmlRpcValue(watched.parameter)})), watched.value);
    ChildProcess subscriber({"rostopic", "echo", "-n", "1", watched.field}, at_master);
    EXPECT_EQ(subscriber.wait(), 0);
    EXPECT_EQ(subscriber.output().substr(0, 1), "0");
  }
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0) << process.output();
}

INSTANTIATE_TEST_SUITE_P(Nodes, MasterWatchTest,
                         testing::Values(Watched{"sweep_guard_node",
                                                 "/sweep_guard",
                                                 "_tool/radius:=0.02",
                                                 "/sweep_guard/tool/radius",
                                                 0.02,
                                                 {"0/diagnostics", "2/sweep_guard/check_sweep"},
                                                 "/sweep_guard/warning/level"},
                                         Watched{"motion_guard_node",
                                                 "/motion_guard",
                                                 "_standoff:=0.02",
                                                 "/motion_guard/standoff",
                                                 0.02,
                                                 {"0/diagnostics", "0/guarded_command", "1/command",
                                                  "2/motion_guard/rebase"},
                                                 "/motion_guard/status/code"},
                                         Watched{"zero_on_silence",
                                                 "/zero_on_silence",
                                                 "_timeout:=0.2",
                                                 "/zero_on_silence/timeout",
                                                 0.2,
                                                 {"0/diagnostics", "0/output", "1/command"},
                                                 "/output/linear/x"}),
                         [](const auto& test) { return std::string(test.param.program); });

}  // namespace
}  // namespace sweep_guard_ros
