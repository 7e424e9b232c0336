// Two guards in one nodelet manager: roscpp connects to a topic once, and reads each message once, for both.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/master.h>

#include <algorithm>
#include <chrono>
#include <future>

#include "guard_probe.h"
#include "guard_process.h"
#include "listener.h"
#include "nodelet_manager.h"
#include "raw_message.h"
#include "ros/connection/bounded.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;
using XmlRpc::XmlRpcValue;

constexpr size_t kMaxSize = 1U << 20;  // [bytes]

class SharedMessagesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(awaitManager());
    ASSERT_TRUE(loadGuard("/sweep_guard"));
    ASSERT_TRUE(loadGuard("/second"));
  }
  void TearDown() override {
    EXPECT_TRUE(unloadGuard("/second"));
    EXPECT_TRUE(unloadGuard("/sweep_guard"));
  }

  // Of each connection of the manager to a publisher.
  static std::vector<std::string> connectedTopics() {
    const auto manager = xmlRpc().call(ros::master::getURI(), "lookupNode", {XmlRpcValue("/manager")});
    auto connections = xmlRpc().call(manager.value().value, "getBusInfo", {}).value().value;
    std::vector<std::string> topics;
    for (int i = 0; i < connections.size(); ++i) {
      if (static_cast<std::string&>(connections[i][2]) == "i") topics.push_back(connections[i][4]);
    }
    return topics;
  }
};

bool hasMesh(const Warning& warning) { return (warning.reasons & Warning::NO_MESH) == 0; }
bool isRefused(const Warning& warning) { return (warning.reasons & Warning::MESH_INVALID) != 0; }

TEST_F(SharedMessagesTest, TwoGuardsHaveOneConnectionToEachTopicOfMeshes) {
  const Listener<Warning> second("/second/warning");
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0.0, 0.0, 0.0}, ros::Time::now()));
  second.await("the mesh", hasMesh);
  const std::vector<std::string> topics = connectedTopics();
  for (const char* const topic : {"/mesh", "/mesh_vertices"})
    EXPECT_EQ(std::count(topics.begin(), topics.end(), topic), 1) << topic;
}

// The second subscriber misses no message of the first, except that the newest may be on its way.
TEST_F(SharedMessagesTest, AMessageIsOneObjectForAllSubscribersOfAProcess) {
  std::vector<Warning::ConstPtr> of_first;
  std::vector<Warning::ConstPtr> of_second;
  const auto keep_in = [](std::vector<Warning::ConstPtr>& kept) {
    return subscribeBounded<Warning>(
        ros::NodeHandle(), {"/sweep_guard/warning", 100, kMaxSize},
        [&](const auto& event) { kept.push_back(event.getConstMessage()); }, [](const std::string& /*reason*/) {});
  };
  const BoundedSubscriber first = keep_in(of_first);
  const BoundedSubscriber second = keep_in(of_second);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (of_second.size() < 6 && std::chrono::steady_clock::now() < end)
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  ASSERT_GE(of_second.size(), 6U);
  of_second.resize(5);
  for (const Warning::ConstPtr& message : of_second)
    EXPECT_EQ(std::count(of_first.begin(), of_first.end(), message), 1);
}

TEST_F(SharedMessagesTest, BothGuardsReportAMessageThatIsRefused) {
  const Listener<Warning> second("/second/warning");
  GuardProbe probe(/*drives_clock=*/false);
  const ros::Publisher vertices = ros::NodeHandle().advertise<Raw<sweep_guard::MeshVertices>>("mesh_vertices", 10);
  auto reported = std::async(std::launch::async, [&] { return second.await("the refusal", isRefused); });
  vertices.publish(forged(serialized(sweep_guard::MeshVertices()), 4, 0x40000001));
  EXPECT_NE(probe.awaitWarning(isRefused).text.find("announces 1073741825 elements"), std::string::npos);
  EXPECT_NE(reported.get().text.find("announces 1073741825 elements"), std::string::npos);
}

}  // namespace
}  // namespace sweep_guard_ros
