// The input of poses in one process with their publisher, where a published message is queued at once.
#include "ros/input/pose_input.h"

#include <boost/make_shared.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base_and_arm.h"

namespace sweep_guard_ros {
namespace {

boost::shared_ptr<geometry_msgs::PoseStamped> poseIn(const std::string& frame, ros::Time stamp) {
  auto pose = boost::make_shared<geometry_msgs::PoseStamped>();
  pose->header.frame_id = frame;
  pose->header.stamp = stamp;
  pose->pose.orientation.w = 1.0;
  return pose;
}

class PoseInputFixture : public BaseAndArm {
 protected:
  sweep_guard_core::WarningMonitor monitor_{parameters_.limits};
  const sweep_guard_core::WorkpieceStore workpieces_;
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_core::FrameMotionStore frame_motions_;
  sweep_guard_core::RecentPoses recent_poses_;
};

class PoseInputTest : public PoseInputFixture {
 protected:
  PoseInputTest() { input_.start(supervisor_); }

  // Takes from the queue up to the pose of this stamp.
  std::vector<sweep_guard_core::PoseWithFrames> takeUpTo(ros::Time stamp) {
    std::vector<sweep_guard_core::PoseWithFrames> taken;
    sweep_guard_core::WorkQueue::Work work;
    while (taken.empty() || taken.back().anew || taken.back().stamp != fromMsg(stamp)) {
      await("a pose", [&] { return queue_.hasPoses(); });
      queue_.take(work);
      for (const sweep_guard_core::QueuedPose& queued : work.poses) taken.push_back(queued.pose);
    }
    return taken;
  }

  PoseInput input_{node_, live_, {frames_, workpieces_, monitor_, queue_, frame_motions_, recent_poses_}};
  const ros::Publisher publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", 1);
};

// 20 s at 1 kHz are published before the first pose is taken from the queue.
TEST_F(PoseInputTest, NoPoseOfALongBacklogIsLost) {
  constexpr int kPoses = 20000;
  const ros::Time end = ros::Time::now();
  ASSERT_EQ(publisher_.getNumSubscribers(), 1U);
  for (int i = 1; i <= kPoses; ++i) {
    publisher_.publish(poseIn(parameters_.fixed_frame, end - ros::Duration(0.001 * (kPoses - i))));
  }
  EXPECT_EQ(takeUpTo(end).size(), static_cast<size_t>(kPoses));
}

// The clock comes at 10 Hz. One that comes before the pose waits for it is tried again, and one that comes too late for it.
TEST_F(PoseInputTest, APoseThatWaitsForTheClockIsReceivedWhenThatHasCome) {
  ros::Time time = ros::Time::now();
  DrivenClock clock(time);
  const auto waits_for_clock = [&](double ahead) {
    const auto before = input_.record().summary();
    const ros::Time stamp = time + ros::Duration(ahead);
    publisher_.publish(poseIn(parameters_.fixed_frame, stamp));
    await("the pose", [&] { return input_.record().summary().received > before.received; });
    const sweep_guard_core::SteadyTime came = std::chrono::steady_clock::now();
    time += ros::Duration(0.1);
    clock.set(time);
    await("what becomes of it",
          [&] { return queue_.hasPoses() || input_.record().summary().refused > before.refused; });
    return queue_.hasPoses() && takeUpTo(stamp).back().received >= came;
  };
  for (const double ahead : {0.06, 0.08, 0.1}) {
    for (int tries_left = 300; !waits_for_clock(ahead); --tries_left) ASSERT_GT(tries_left, 1) << ahead;
  }
}

class StaticBaseTest : public PoseInputTest {
 protected:
  StaticBaseTest() { frames_.start(supervisor_); }

  void publishPose(const std::string& frame, ros::Time stamp, double z) {
    const auto pose = poseIn(frame, stamp);
    pose->pose.position.z = z;
    publisher_.publish(pose);
  }

  struct Placed {
    double z;
    bool anew;
    bool operator==(const Placed& other) const { return z == other.z && anew == other.anew; }
  };
  std::vector<Placed> placedUpTo(ros::Time stamp) {
    std::vector<Placed> placed;
    for (const auto& pose : takeUpTo(stamp)) placed.push_back({pose.X_WT.translation().z(), pose.anew.has_value()});
    return placed;
  }
};

TEST_F(StaticBaseTest, TheWayToThePoseAfterItIsInBothPlaces) {
  placeBase(0.0);
  awaitFrame("base");
  publishPose("base", now_, 0.5);
  takeUpTo(now_);
  placeBase(3.0);
  changed_.get_future().wait();
  const ros::Time next = now_ + ros::Duration(0.01);
  publishPose("base", next, -0.5);
  const auto poses = takeUpTo(next);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].X_WT.translation().z(), -0.5);
  EXPECT_EQ(poses[0].stamp, fromMsg(next) - std::chrono::nanoseconds(1));
  EXPECT_EQ(poses[1].X_WT.translation().z(), 3.5);
  ASSERT_TRUE(poses[1].anew);
  EXPECT_TRUE(poses[1].anew->tool);
  EXPECT_EQ(poses[1].stamp, fromMsg(next));
  EXPECT_EQ(poses[2].X_WT.translation().z(), 2.5);
}

// Both wait for the transform of the arm: the first came before the change, the second after it.
TEST_F(StaticBaseTest, APoseThatWaitedIsWhereThingsWereWhenItCame) {
  placeBase(0.0);
  moveArm(now_);
  awaitFrame("arm");
  publishPose("arm", now_, 0.5);
  takeUpTo(now_);
  const ros::Time first = now_ + ros::Duration(0.01);
  const ros::Time second = now_ + ros::Duration(0.02);
  publishPose("arm", first, 0.1);
  const auto is_refused = [&] { return monitor_.checkpoint().faults > 0; };
  publishPose("arm", now_, 0.5);  // is older: a refusal that tells that the first was received
  await("a refusal", is_refused);
  placeBase(3.0);
  changed_.get_future().wait();
  publishPose("arm", second, -0.5);
  moveArm(second);
  const std::vector<Placed> expected = {{0.1, false}, {-0.5, false}, {3.1, true}, {2.5, false}};
  EXPECT_EQ(placedUpTo(second), expected);
}

// The tool is the arm on its base, and its pose comes from tf.
class RestingToolTest : public PoseInputFixture {
 protected:
  static Parameters fromTf() {
    Parameters parameters = patient();
    parameters.tool_source = ToolSource::kTf;
    parameters.tool_frame = "arm";
    return parameters;
  }
  RestingToolTest() {
    frames_.start(supervisor_);
    input_.start(supervisor_);
  }

  void restArm(double z) { static_transforms_.publish(transform("base", "arm", ros::Time(), z)); }
  void moveBase(ros::Time stamp, double z) {
    transforms_.publish(transform(parameters_.fixed_frame, "base", stamp, z));
  }
  // Returns the poses that are queued until so many are.
  std::vector<sweep_guard_core::PoseWithFrames> take(size_t count) {
    std::vector<sweep_guard_core::PoseWithFrames> taken;
    sweep_guard_core::WorkQueue::Work work;
    while (taken.size() < count) {
      await("a pose", [&] {
        input_.addRestingPose();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return queue_.hasPoses();
      });
      queue_.take(work);
      for (const sweep_guard_core::QueuedPose& queued : work.poses) taken.push_back(queued.pose);
    }
    return taken;
  }
  std::string text() const {
    sweep_guard_core::Warning warning;
    monitor_.warning(now(), warning);
    return warning.text;
  }

  const Parameters from_tf_ = fromTf();
  const LiveParameters live_from_tf_{from_tf_};
  PoseInput input_{node_, live_from_tf_, {frames_, workpieces_, monitor_, queue_, frame_motions_, recent_poses_}};
};

TEST_F(RestingToolTest, IsWhereItIsNowAtTheLeastRate) {
  placeBase(1.0);
  restArm(0.5);
  awaitFrame("arm");
  const auto begin = std::chrono::steady_clock::now();
  const auto poses = take(4);
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(took, 3 * (from_tf_.guard.cycle - std::chrono::milliseconds(1)));
  for (const auto& pose : poses) {
    EXPECT_EQ(pose.X_WT.translation().z(), 1.5);
    EXPECT_GE(pose.stamp, fromMsg(now_));
  }
  EXPECT_LT(poses[0].stamp, poses[3].stamp);
  EXPECT_EQ(text().find("stamp"), std::string::npos) << text();
}

TEST_F(RestingToolTest, MovesWithTheFirstTransformsThatMoveWhateverTheirDelay) {
  placeBase(1.0);
  restArm(0.5);
  awaitFrame("arm");
  const sweep_guard_core::Time rested = take(1).back().stamp;
  const std::uint64_t faults = monitor_.checkpoint().faults;
  const ros::Time stamp = toMsg(rested);
  for (const double late : {0.06, 0.04, 0.02}) moveBase(stamp - ros::Duration(late), 1.0);
  moveBase(stamp + ros::Duration(0.04), 3.0);
  std::vector<sweep_guard_core::PoseWithFrames> poses;
  while (poses.empty() || poses.back().X_WT.translation().z() < 3.5) poses = take(1);
  EXPECT_EQ(poses.back().stamp, rested + std::chrono::milliseconds(40));
  EXPECT_EQ(monitor_.checkpoint().faults, faults) << text();
}

TEST_F(RestingToolTest, IsWhereItIsNowWhileItsTransformsLieAheadUntilTheyMove) {
  ros::Time time = ros::Time::now();
  DrivenClock clock(time);
  placeBase(1.0);
  awaitFrame("base");
  const std::uint64_t faults = monitor_.checkpoint().faults;
  const auto place = [&](double ahead, double z) {
    time += ros::Duration(0.1);
    clock.set(time);
    const ros::Time stamp = time + ros::Duration(ahead);
    transforms_.publish(transform("base", "arm", stamp, z));
    awaitArm(stamp);
  };
  place(0.0, 0.5);
  for (const double ahead : {0.9, 0.92, 0.95}) {
    place(ahead, 0.5);
    const auto pose = take(1).back();
    EXPECT_NEAR(pose.X_WT.translation().z(), 1.5, 1e-9);
    EXPECT_LE(pose.stamp, now().stamp);
  }
  EXPECT_EQ(monitor_.checkpoint().faults, faults) << text();
  place(1.5, 0.7);
  await("a fault", [&] { return monitor_.checkpoint().faults != faults; });
  EXPECT_NE(text().find("stamp lies in the future"), std::string::npos) << text();
}

TEST_F(RestingToolTest, ATransformThatIsRefusedIsInTheTextAndTheRecord) {
  placeBase(1.0);
  for (const double length : {0.0, 0.85, 1.2}) {
    auto arm = transform("base", "arm", ros::Time(), 0.5);
    arm.transforms[0].transform.rotation.w = length;
    const std::uint64_t faults = monitor_.checkpoint().faults;
    static_transforms_.publish(arm);
    await("a fault", [&] { return monitor_.checkpoint().faults != faults; });
    EXPECT_NE(text().find("transform to 'arm' from node '"), std::string::npos) << text();
    EXPECT_NE(text().find("orientation is not a unit quaternion"), std::string::npos) << text();
    EXPECT_NE(text().find(input_.record().summary().last_error), std::string::npos) << text();
  }
  EXPECT_EQ(input_.record().summary().refused, 3U);
}

TEST_F(RestingToolTest, TransformsThatMoveWithoutAStampAreRefusedInTheirWords) {
  moveBase(ros::Time(), 1.0);
  restArm(0.5);
  awaitFrame("arm");
  const std::uint64_t faults = monitor_.checkpoint().faults;
  input_.addRestingPose();
  await("a fault", [&] { return monitor_.checkpoint().faults != faults; });
  EXPECT_NE(text().find("the transforms to 'arm' have the stamp 0: stamp each"), std::string::npos) << text();
}

}  // namespace
}  // namespace sweep_guard_ros
