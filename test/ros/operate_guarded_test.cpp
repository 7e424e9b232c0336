// The demo with motion_guard between the operator and a simulated robot.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/Warning.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace sweep_guard_ros {
namespace {

using sweep_guard::MotionStatus;
using sweep_guard::Warning;

class GuardedDemoTest : public ::testing::Test {
 protected:
  void SetUp() override { spinner_.start(); }
  void TearDown() override { spinner_.stop(); }

  void await(const std::string& what, const std::function<bool()>& condition) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::seconds(60), condition)) FAIL() << "waited for " << what;
  }

  void onWarning(const Warning::ConstPtr& warning) {
    const std::lock_guard lock(mutex_);
    warning_ = *warning;
    contact_ = contact_ || warning->level == Warning::CONTACT;
    changed_.notify_all();
  }
  void onStatus(const MotionStatus::ConstPtr& status) {
    const std::lock_guard lock(mutex_);
    slowed_ = slowed_ || (status->code == MotionStatus::DECELERATE_FOR_COLLISION && !status->mesh_id.empty());
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Warning warning_;
  bool contact_ = false;
  bool slowed_ = false;
  ros::NodeHandle node_;
  ros::Subscriber warnings_ = node_.subscribe("sweep_guard/warning", 1000, &GuardedDemoTest::onWarning, this);
  ros::Subscriber statuses_ = node_.subscribe("motion_guard/status", 1000, &GuardedDemoTest::onStatus, this);
  ros::AsyncSpinner spinner_{1};
};

TEST_F(GuardedDemoTest, TheDrillIsSlowedDownTouchesWhereThatIsMeantAndBacksOut) {
  ASSERT_NO_FATAL_FAILURE(await("the drill to touch as intended", [this] { return warning_.intended != 0; }));
  ASSERT_NO_FATAL_FAILURE(
      await("the drill to come out", [this] { return warning_.intended == 0 && warning_.clear != 0; }));
  ASSERT_NO_FATAL_FAILURE(await("the next hole", [this] { return warning_.intended != 0; }));
  EXPECT_FALSE(contact_);
  EXPECT_TRUE(slowed_);
}

}  // namespace
}  // namespace sweep_guard_ros
