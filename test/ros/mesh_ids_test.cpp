// A guard that knows which workpieces there are is not clear without each of them. The test is the clock.
#include <ros/service.h>
#include <signal.h>

#include <thread>

#include "guard_process.h"
#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard::DeformableMesh;
using sweep_guard::Warning;

bool known(const std::string& id) {
  CheckSweep::Request request;
  request.path = {poseAt(kAway, ros::Time())};
  request.mesh_ids = {id};
  return probe().check(request).success;
}

class MeshIdsTest : public NodeTest {
 protected:
  // Returns the next warning. Contacts may not be connected to a guard that has just begun.
  static Warning sendPose() {
    probe().tick(0.01);
    probe().publish(poseAt(kAway, probe().time()));
    probe().skipWarnings();
    return probe().awaitWarning([](const Warning&) { return true; });
  }

  // Poses alone: none of the warnings is clear, and the last one says what is missing.
  static void expectMissing(const std::string& id, size_t begin) {
    for (int i = 0; i < 50; ++i) sendPose();
    const std::vector<Warning> warnings = probe().warnings();
    for (size_t i = begin; i < warnings.size(); ++i) EXPECT_FALSE(warnings[i].clear) << warnings[i].text;
    EXPECT_EQ(warnings.back().reasons & Warning::NO_MESH, Warning::NO_MESH);
    EXPECT_TRUE(has(warnings.back().text, "workpiece '" + id + "' has not arrived"));
  }
};

TEST_F(MeshIdsTest, OneOfTwoIsNeverClearAndOthersAreNotListenedToAndNamed) {
  const size_t begin = probe().warnings().size();
  placeSquare("left", {0, 0, -1});
  expectMissing("right", begin);
  probe().publish(squareAt("other", {0, 0, -2}, probe().time()));
  probe().publish(squareMovedTo("ghost", {0, 0, -2}, probe().time()));
  placeSquare("right", {0, 0, -2});  // after `other`, on the same topic
  EXPECT_FALSE(known("other"));
  for (const std::string id : {"other", "ghost"}) {
    probe().awaitStatus("workpieces", [&](const diagnostic_msgs::DiagnosticStatus& status) {
      return valueOf(status, "'" + id + "'") == "not heard: none of mesh_ids";
    });
  }
  restAt(kAway);
}

// A latched publisher delivers only its newest message again.
TEST_F(MeshIdsTest, ARestartedGuardThatGetsOneOfTwoLatchedMeshesIsNotClear) {
  ros::Publisher latched = ros::NodeHandle().advertise<DeformableMesh>("mesh", 10, /*latch=*/true);
  for (const char* const id : {"left", "right"}) latched.publish(squareAt(id, {0, 0, -1}, probe().time()));
  while (!known("left") || !known("right")) ros::spinOnce();
  restAt(kAway);

  const pid_t before = guardPid();
  const size_t begin = probe().warnings().size();
  std::thread caller([] {  // until a call fails
    ros::ServiceClient client = ros::NodeHandle().serviceClient<CheckSweep>("/sweep_guard/check_sweep");
    CheckSweep::Request request;
    request.path.assign(1000, poseAt(kAway, ros::Time()));
    CheckSweep::Response response;
    while (client.call(request, response)) continue;
  });
  ASSERT_EQ(kill(before, SIGKILL), 0);
  caller.join();
  probe().awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::NO_POSE) != 0; });
  ASSERT_TRUE(ros::service::waitForService("/sweep_guard/check_sweep", ros::Duration(-1.0)));
  while (!known("right")) ros::spinOnce();
  EXPECT_NE(guardPid(), before);
  while ((sendPose().reasons & Warning::NO_POSE) != 0) continue;
  const size_t again = probe().warnings().size();
  ASSERT_GT(again, begin);
  EXPECT_FALSE(known("left"));
  expectMissing("left", again);
  placeSquare("left", {0, 0, -1});
  placeSquare("right", {0, 0, -1});
  restAt(kAway);
}

}  // namespace
}  // namespace sweep_guard_ros
