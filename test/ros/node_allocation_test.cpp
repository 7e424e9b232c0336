// What a node that runs still allocates, from a message to a warning. The guard is a part of this process, the demo's
// workpiece and operator are others.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/Prediction.h>

#include <set>
#include <string>
#include <vector>

#include "allocations.h"
#include "ros/allowed_allocations.h"
#include "ros/node.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kWarmUpPoses = 2000;
constexpr size_t kCountedPoses = 1000;
const std::set<std::string> kGuardThreads = {"guard", "poses", "meshes", "converting", "storing", "warnings"};

const std::vector<AllowedAllocation> kAllowed = {
    {"ResultPublisher::publish", false, 40.0, "messages are published as shared pointers, which nodelets keep"},
    {"WarningPublisher::publish", false, 5.0, "the warning and its flags, at 20 Hz or changed"},
    {"ros::MessageDeserializer::deserialize", false, 4.0, "received messages: roscpp makes each anew"},
    {"MeshVertices", false, 4.0, "jobs for the thread that stores: messages wait there, bounded in bytes"},
    {"MovingFrames::", true, 1.1, "where the frames of the workpieces are, for the guard's thread"},
    {"tf2::BufferCore::getLatestCommonTime", false, 1.1, "tf2 looks for the newest time at which a frame is known"},
    {"WorkpieceStore::snapshot < sweep_guard_ros::GuardSteps::sweep", true, 1.1,
     "the list of the workpieces: the store goes on meanwhile"},
    {"WorkpieceStore::snapshot < sweep_guard_ros::GuardSteps::beginPrediction", true, 1.1, "the same for a prediction"},
};

// The messages of the guard, received by this process.
class Results {
 public:
  explicit Results(ros::NodeHandle guard) {
    guard.setCallbackQueue(&queue_);
    contacts_ = guard.subscribe<sweep_guard::Contacts>("contacts", kWarmUpPoses, [&](const auto&) { ++swept_; });
    predictions_ =
        guard.subscribe<sweep_guard::Prediction>("prediction", kWarmUpPoses, [&](const auto&) { ++predicted_; });
  }

  void awaitContacts(size_t count) {
    while (ros::ok() && swept_ < count) queue_.callOne(ros::WallDuration(1.0));
  }
  size_t swept() const { return swept_; }
  size_t predicted() const { return predicted_; }

 private:
  size_t swept_ = 0;
  size_t predicted_ = 0;
  ros::CallbackQueue queue_;
  ros::Subscriber contacts_;
  ros::Subscriber predictions_;
};

TEST(NodeAllocationTest, FromAMessageToAWarningOnlyWhatIsListedAllocates) {
  SweepGuardNode guard(ros::NodeHandle(), ros::NodeHandle("sweep_guard"), Process::kShared);
  guard.start();
  Results results(ros::NodeHandle("sweep_guard"));
  results.awaitContacts(kWarmUpPoses);

  const sweep_guard_core::AllocationsOfAllThreads made;
  const size_t begin = results.swept();
  results.awaitContacts(begin + kCountedPoses);
  expectAllocations(made, kGuardThreads, kAllowed, static_cast<double>(results.swept() - begin));
  EXPECT_GT(results.predicted(), kCountedPoses / 2);
}

}  // namespace
}  // namespace sweep_guard_ros
