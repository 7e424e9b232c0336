// The listener of transforms in one process with their publisher, where a published message is queued at once.
#include "ros/input/frames.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <atomic>
#include <cmath>
#include <set>
#include <string>
#include <thread>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

class FramesTest : public testing::Test {
 protected:
  FramesTest() { frames_.start(supervisor_); }

  static geometry_msgs::TransformStamped transformTo(const std::string& child, ros::Time stamp, double x) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "world";
    transform.header.stamp = stamp;
    transform.child_frame_id = child;
    transform.transform.translation.x = x;
    transform.transform.rotation.w = 1.0;
    return transform;
  }

  void publish(const std::string& child, ros::Time stamp, double x) {
    tf2_msgs::TFMessage message;
    message.transforms = {transformTo(child, stamp, x)};
    publisher_.publish(message);
  }

  // @returns whether the frame comes to lie there
  bool arrives(const std::string& child, double x) const {
    for (int i = 0; i < 1000; ++i) {
      try {
        if (frames_.lookup("world", child, {}).translation().x() == x) return true;
      } catch (const FrameError&) {
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  ros::NodeHandle node_;
  Supervisor supervisor_{Process::kShared};
  Frames frames_{node_, /*max_message_size=*/1U << 24U, [](const auto& /*parent*/, const auto& /*child*/) {}};
  const ros::Publisher publisher_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
};

// tf2 would ignore whatever is older than the newest transform of a frame.
TEST_F(FramesTest, ATransformFromFarAheadSilencesNoFrame) {
  publish("camera", ros::Time::now() + ros::Duration(3600.0), 1.0);
  publish("camera", ros::Time::now(), 2.0);
  EXPECT_TRUE(arrives("camera", 2.0));
}

TEST_F(FramesTest, FreshNamesFillNoMemoryAndTakeNoRoomFromKnownFrames) {
  publish("camera", ros::Time::now(), 1.0);
  ASSERT_TRUE(arrives("camera", 1.0));
  tf2_msgs::TFMessage flood;
  for (int i = 0; i < 10100; ++i) {
    flood.transforms.push_back(transformTo("made_up_" + std::to_string(i), ros::Time::now(), 0.0));
  }
  publisher_.publish(flood);
  publish("camera", ros::Time::now(), 2.0);
  EXPECT_TRUE(arrives("camera", 2.0));
  EXPECT_THROW(frames_.lookup("world", "made_up_10050", {}), FrameError);
  EXPECT_NO_THROW(frames_.lookup("world", "made_up_1000", {}));
}

class StaticFramesTest : public FramesTest {
 protected:
  void publishStatic(const std::string& child, double x) {
    tf2_msgs::TFMessage message;
    message.transforms = {transformTo(child, {}, x)};
    static_publisher_.publish(message);
  }
  // @returns whether so many changes are told
  bool areTold(std::uint64_t changes) const {
    for (int i = 0; i < 1000 && frames_.staticChanges() != changes; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return frames_.staticChanges() == changes;
  }

  const ros::Publisher static_publisher_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 10);
};

TEST_F(StaticFramesTest, AChangeThatCountsIsHeldBackUntilItIsApplied) {
  publishStatic("table", 1.0);
  ASSERT_TRUE(arrives("table", 1.0));
  frames_.use("workpieces", "world", {"table"});
  publishStatic("table", 2.0);
  publishStatic("table", 2.0);  // again: nothing changes, and it stays held back
  publishStatic("camera", 1.0);
  ASSERT_TRUE(areTold(1));
  ASSERT_TRUE(arrives("camera", 1.0));
  EXPECT_EQ(frames_.lookup("world", "table", {}).translation().x(), 1.0);
  EXPECT_FALSE(frames_.holdsBack(std::chrono::hours(1)));
  EXPECT_TRUE(frames_.holdsBack({}));
  EXPECT_TRUE(frames_.applyStaticChanges());
  EXPECT_EQ(frames_.lookup("world", "table", {}).translation().x(), 2.0);
  EXPECT_FALSE(frames_.applyStaticChanges());
}

TEST_F(StaticFramesTest, AnyOtherChangeIsMadeAtOnceAndIsNotTold) {
  publishStatic("camera", 1.0);
  ASSERT_TRUE(arrives("camera", 1.0));
  frames_.use("workpieces", "world", {"table"});
  publishStatic("camera", 2.0);
  EXPECT_TRUE(arrives("camera", 2.0));
  EXPECT_TRUE(areTold(0));
}

TEST_F(StaticFramesTest, AChangeThatIsHeldBackReplacesNoLaterOne) {
  for (const std::string table : {"table", "tray", "shelf"}) {
    publishStatic(table, 1.0);
    ASSERT_TRUE(arrives(table, 1.0));
    frames_.use("workpieces", "world", {table});
    const std::uint64_t told = frames_.staticChanges();
    publishStatic(table, 2.0);
    ASSERT_TRUE(areTold(told + 1));
    frames_.use("workpieces", "world", {});
    publishStatic(table, 3.0);
    EXPECT_TRUE(arrives(table, 3.0));
    frames_.applyStaticChanges();
    EXPECT_EQ(frames_.lookup("world", table, {}).translation().x(), 3.0);
  }
}

// The listener takes what moves, and another thread what is held back.
TEST_F(StaticFramesTest, AFrameThatBeginsToMoveWhileAChangeIsAppliedMoves) {
  std::set<std::string> carts;
  for (int i = 0; i < 50; ++i) carts.insert("cart" + std::to_string(i));
  for (const std::string& cart : carts) publishStatic(cart, 1.0);
  for (const std::string& cart : carts) ASSERT_TRUE(arrives(cart, 1.0));
  frames_.use("workpieces", "world", carts);
  std::uint64_t changes = 0;
  for (const std::string& cart : carts) {
    publishStatic(cart, 2.0);
    ASSERT_TRUE(areTold(++changes));
    publish(cart, ros::Time::now(), 3.0);
    frames_.applyStaticChanges();
  }
  for (const std::string& cart : carts) EXPECT_TRUE(arrives(cart, 3.0)) << cart;
}

TEST_F(FramesTest, TellsOfTransformsThatCountAndMove) {
  std::atomic<int> told = 0;
  const auto handle = frames_.onMove([&] { ++told; });
  publish("table", ros::Time::now(), 1.0);
  ASSERT_TRUE(arrives("table", 1.0));
  EXPECT_EQ(told, 0);
  frames_.use("workpieces", "world", {"table"});
  publish("camera", ros::Time::now(), 1.0);
  publish("table", ros::Time::now(), 2.0);
  ASSERT_TRUE(arrives("table", 2.0));
  publish("camera", ros::Time::now(), 3.0);  // its callback is after that of the table
  ASSERT_TRUE(arrives("camera", 3.0));
  EXPECT_EQ(told, 1);
}

class RefusedTransformsTest : public StaticFramesTest {
 protected:
  RefusedTransformsTest() { frames_.use("tool", "world", {"tool"}); }

  void send(const geometry_msgs::TransformStamped& transform, const ros::Publisher& publisher) {
    tf2_msgs::TFMessage message;
    message.transforms = {transform};
    publisher.publish(message);
  }
  // Sends a transform with this quaternion, then a good one to another frame, and returns when both were received.
  void turn(const std::string& child, const Eigen::Vector4d& xyzw) {
    auto transform = transformTo(child, ros::Time::now(), 1.0);
    transform.transform.rotation.x = xyzw.x();
    transform.transform.rotation.y = xyzw.y();
    transform.transform.rotation.z = xyzw.z();
    transform.transform.rotation.w = xyzw.w();
    send(transform, publisher_);
    passTheQueue();
  }
  void passTheQueue() {
    publish("other", ros::Time::now(), ++others_);
    ASSERT_TRUE(arrives("other", others_));
  }

  std::string refusedBy(const std::string& why) const {
    return "transform to 'tool' from node '" + ros::this_node::getName() + "' refused: " + why;
  }

  double others_ = 0.0;
};

TEST(RefusedFramesTest, AFrameBeyondAThousandIsToldToAllForGood) {
  RefusedTransforms refused;
  for (int i = 0; i < 1000; ++i) refused.add("made_up_" + std::to_string(i), "made up");
  const auto of = [&](const std::string& frame) {
    return refused.find([&](const std::string& child) { return child == frame; });
  };
  for (const std::string frame : {"tool", "table", "camera"}) {
    EXPECT_EQ(of(frame).empty(), frame == "tool");
    refused.add(frame, "transform to '" + frame + "' refused");
    EXPECT_NE(of(frame).find("the first after these was: transform to 'tool' refused"), std::string::npos);
    refused.accepted(frame);
    EXPECT_NE(of(frame), "");
  }
  refused.add("made_up_3", "again");
  EXPECT_EQ(of("made_up_3"), "again");
}

// As typed by hand, and as filters leave them. A pose is taken with these, too.
TEST_F(RefusedTransformsTest, AQuaternionOfAlmostUnitLengthIsOneOfUnitLength) {
  for (const Eigen::Vector4d& xyzw :
       {Eigen::Vector4d(0.7, 0.0, 0.0, 0.7), {0.0, 0.0, 0.0, 1.04}, {0.0, 0.0, 0.0, 0.98}, {0.0, 0.0, 0.1, 0.9}}) {
    turn("tool", xyzw);
    EXPECT_EQ(frames_.refusal(), "");
    const Eigen::Isometry3d X = frames_.lookup("world", "tool", {});
    EXPECT_TRUE(X.linear().isApprox(Eigen::Quaterniond(xyzw).normalized().toRotationMatrix(), 1e-9));
  }
}

TEST_F(RefusedTransformsTest, AreToldWithFramePublisherValueAndLengthUntilAGoodOneComes) {
  std::atomic<int> told = 0;
  const auto handle = frames_.onRefusal([&] { ++told; });
  turn("tool", {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(frames_.refusal(), refusedBy("orientation is not a unit quaternion: the length of (0, 0, 0, 0) is 0"));
  turn("tool", {0.0, 0.6, 0.0, 0.6});
  EXPECT_EQ(frames_.refusal(),
            refusedBy("orientation is not a unit quaternion: the length of (0, 0.6, 0, 0.6) is 0.848528"));
  EXPECT_EQ(frames_.refusalFor("tool"), frames_.refusal());
  EXPECT_EQ(frames_.refusalFor("workpieces"), "");
  EXPECT_EQ(told, 2);
  try {
    frames_.lookup("world", "tool", {});
    FAIL() << "is known";
  } catch (const FrameError& error) {
    EXPECT_NE(std::string(error.what()).find(frames_.refusal()), std::string::npos) << error.what();
  }
  turn("tool", {0.0, 0.0, 0.0, 1.0});
  EXPECT_EQ(frames_.refusal(), "");
  EXPECT_EQ(told, 2);
}

TEST_F(RefusedTransformsTest, NumbersAndClocksAreToldToo) {
  auto transform = transformTo("tool", ros::Time::now(), NAN);
  send(transform, publisher_);
  passTheQueue();
  EXPECT_EQ(frames_.refusal(), refusedBy("position is NaN, infinite or beyond 1e7 m: (nan, 0, 0)"));
  send(transformTo("tool", ros::Time::now() + ros::Duration(3600.0), 1.0), publisher_);
  passTheQueue();
  EXPECT_NE(frames_.refusal().find(" s in the future, more than 10 s"), std::string::npos) << frames_.refusal();
  transform = transformTo("tool", ros::Time::now(), 1.0);
  transform.header.frame_id = "/tool";
  send(transform, publisher_);
  passTheQueue();
  EXPECT_EQ(frames_.refusal(), refusedBy("the frame is placed in itself"));
}

TEST_F(RefusedTransformsTest, OfAStaticFrameAreToldAsLong) {
  auto transform = transformTo("tool", {}, 1.0);
  transform.transform.rotation.w = 0.5;
  send(transform, static_publisher_);
  while (frames_.refusal().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_NE(frames_.refusal().find("(0, 0, 0, 0.5) is 0.5"), std::string::npos) << frames_.refusal();
  publishStatic("tool", 2.0);
  ASSERT_TRUE(arrives("tool", 2.0));
  EXPECT_EQ(frames_.refusal(), "");
}

// The tool does not stand on these frames: the transforms that say so are passed over.
TEST_F(RefusedTransformsTest, OfAFrameThatWasOnlyToBeStoodOnAreNotTold) {
  publishStatic("tool", 1.0);
  ASSERT_TRUE(arrives("tool", 1.0));
  auto passed_over = transformTo("tool", ros::Time::now(), 1.0);
  passed_over.header.frame_id = "wall";
  send(passed_over, static_publisher_);
  ASSERT_TRUE(areTold(1));
  publish("tool", passed_over.header.stamp, 2.0);
  ASSERT_TRUE(arrives("tool", 2.0));
  EXPECT_TRUE(frames_.applyStaticChanges()) << "too late: it moves";
  for (const std::string parent : {"wall", "cart", "rail"}) {
    passed_over.header.frame_id = parent;
    if (parent != "wall") send(passed_over, publisher_);  // its stamp is there already
    turn(parent, {0.0, 0.0, 0.0, 0.5});
    EXPECT_EQ(frames_.refusal(), "") << parent;
  }
}

TEST_F(RefusedTransformsTest, OfAFrameThatNobodyUsesAreNotTold) {
  std::atomic<int> told = 0;
  const auto handle = frames_.onRefusal([&] { ++told; });
  turn("camera", {0.0, 0.0, 0.0, 0.5});
  turn("imu", {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(frames_.refusal(), "");
  EXPECT_EQ(told, 0);
  frames_.use("workpieces", "world", {"camera"});
  EXPECT_NE(frames_.refusalFor("workpieces").find("'camera'"), std::string::npos) << "it is used now";
}

}  // namespace
}  // namespace sweep_guard_ros
