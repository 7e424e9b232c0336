#include "ros/input/frame_buffer.h"

#include <gtest/gtest.h>

#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

geometry_msgs::TransformStamped transformAlongX(const std::string& child, const std::string& parent, double stamp,
                                                double x) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = ros::Time(stamp);
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  return transform;
}

class FrameBufferTest : public testing::Test {
 protected:
  void rest(const std::string& child, const std::string& parent, double x) {
    buffer_.set(transformAlongX(child, parent, 0.0, x), "/calibration", /*is_static=*/true);
  }
  void move(const std::string& child, const std::string& parent, double stamp, double x) {
    buffer_.set(transformAlongX(child, parent, stamp, x), "/driver", /*is_static=*/false);
  }
  double x(const std::string& child, double stamp, const std::string& target = "world") const {
    return buffer_.lookup(target, child, ros::Time(stamp)).transform.translation.x;
  }
  ros::Time newest(const std::string& child) const { return buffer_.lookup("world", child, ros::Time()).header.stamp; }

  FrameBuffer buffer_;
};

TEST_F(FrameBufferTest, AStaticFrameMovesFromItsFirstTransformThatMovesOn) {
  rest("base", "world", 1.0);
  EXPECT_EQ(x("base", 100.0), 1.0);
  EXPECT_EQ(newest("base"), ros::Time());
  EXPECT_FALSE(buffer_.moves("base"));
  move("base", "world", 100.0, 2.0);
  EXPECT_TRUE(buffer_.moves("base"));
  EXPECT_EQ(newest("base"), ros::Time(100.0));
  move("base", "world", 100.5, 4.0);
  EXPECT_EQ(x("base", 100.25), 3.0);
  EXPECT_THROW(x("base", 101.0), tf2::TransformException);
}

TEST_F(FrameBufferTest, UntilThenItWasWhereItWas) {
  rest("base", "world", 1.0);
  for (const double stamp : {100.0, 100.5, 101.5}) move("base", "world", stamp, 2.0);
  for (const double stamp : {93.0, 98.25, 99.99}) EXPECT_EQ(x("base", stamp), 1.0) << stamp;
  EXPECT_EQ(x("base", 100.0), 2.0);
}

TEST_F(FrameBufferTest, WhatStandsOnItMovesWithIt) {
  rest("base", "world", 1.0);
  rest("tool", "base", 0.1);
  rest("tip", "tool", 0.01);
  move("camera", "base", 99.0, 0.5);
  move("base", "world", 100.0, 2.0);
  move("base", "world", 101.0, 3.0);
  move("camera", "base", 101.0, 0.6);
  EXPECT_EQ(newest("tip"), ros::Time(101.0));
  EXPECT_NEAR(x("tip", 100.5), 2.61, 1e-12);
  EXPECT_NEAR(x("camera", 101.0), 3.6, 1e-12);
  EXPECT_NEAR(x("world", 100.0, "base"), -2.0, 1e-12);
  rest("tool", "base", 0.2);
  EXPECT_NEAR(x("tool", 101.0), 3.2, 1e-12);
}

// The camera was sampled before its base began to move, meanwhile, and long after: none of these samples comes again.
TEST_F(FrameBufferTest, WhatWasSampledOnItMovesWithIt) {
  rest("base", "world", 1.0);
  rest("mount", "base", 0.1);
  for (const double stamp : {99.0, 105.0}) {
    move("camera", "mount", stamp, 0.5);
    move("lens", "camera", stamp, 0.01);
  }
  for (const double stamp : {100.0, 101.0, 102.0}) move("base", "world", stamp, stamp - 98.0);
  EXPECT_NEAR(x("camera", 99.5), 1.6, 1e-12) << "before";
  for (const double stamp : {100.0, 100.5, 101.75}) {
    EXPECT_NEAR(x("camera", stamp), stamp - 98.0 + 0.6, 1e-9) << stamp;
    EXPECT_NEAR(x("lens", stamp), stamp - 98.0 + 0.61, 1e-9) << stamp;
    EXPECT_NEAR(x("world", stamp, "lens"), -(stamp - 98.0 + 0.61), 1e-9) << stamp;
  }
  EXPECT_EQ(newest("lens"), ros::Time(102.0));
}

TEST_F(FrameBufferTest, TellsWhatItTakes) {
  const auto take = [&](const std::string& parent, double stamp, bool is_static) {
    return buffer_.set(transformAlongX("base", parent, stamp, 1.0), "/driver", is_static);
  };
  EXPECT_TRUE(take("world", 0.0, /*is_static=*/true));
  EXPECT_TRUE(take("cart", 0.0, /*is_static=*/true));
  EXPECT_TRUE(take("world", 100.0, /*is_static=*/false));
  EXPECT_TRUE(take("world", 101.0, /*is_static=*/false));
  for (const double stamp : {100.0, 101.0}) EXPECT_FALSE(take("cart", stamp, /*is_static=*/false)) << stamp;
  EXPECT_FALSE(take("cart", 99.0, /*is_static=*/false)) << "it was at rest";
  EXPECT_FALSE(take("cart", 0.0, /*is_static=*/true)) << "it moves";
}

TEST_F(FrameBufferTest, AStaticTransformOfAFrameThatMovesIsPassedOver) {
  rest("base", "world", 1.0);
  move("base", "world", 100.0, 2.0);
  rest("base", "world", 7.0);
  move("arm", "world", 100.0, 3.0);
  rest("arm", "world", 7.0);
  EXPECT_EQ(x("base", 100.0), 2.0);
  EXPECT_EQ(x("arm", 100.0), 3.0);
  buffer_.clear();
  rest("base", "world", 7.0);
  EXPECT_THROW(x("base", 100.0), tf2::TransformException);
  move("base", "world", 50.0, 4.0);
  EXPECT_EQ(x("base", 50.0), 4.0);
}

TEST_F(FrameBufferTest, ErrorsHaveTheNamesOfTheFrames) {
  rest("base", "world", 1.0);
  rest("tool", "base", 0.1);
  move("base", "world", 100.0, 2.0);
  for (const auto& [child, stamp] : {std::pair{"base", 200.0}, {"tool", 50.0}, {"camera", 100.0}}) {
    try {
      x(child, stamp);
      FAIL() << child << " is not known there";
    } catch (const tf2::TransformException& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(child), std::string::npos) << text;
      EXPECT_EQ(text.find('\1'), std::string::npos) << text;
    }
  }
}

TEST_F(FrameBufferTest, Tf2LogsNoTransformThatItDoesNotTake) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (int i = 0; i < 200; ++i) move("arm", "world", 100.0 + 0.1 * i, 1.0);
  for (const int i : {190, 120, 199}) move("arm", "world", 100.0 + 0.1 * i, 2.0);
  EXPECT_THROW(move("arm", "world", 105.0, 2.0), sweep_guard_core::InvalidInput);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NEAR(x("arm", 112.0), 1.0, 1e-12) << "the first counts";
}

TEST_F(FrameBufferTest, ATransformFarBehindTheNewestIsRefusedInWords) {
  move("arm", "world", 100.0, 1.0);
  try {
    move("arm", "world", 87.5, 2.0);
    FAIL() << "is taken";
  } catch (const sweep_guard_core::InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()), "its stamp is 12.50 s older than the newest of its frame, more than 10 s");
  }
  move("arm", "world", 90.0, 3.0);
  EXPECT_EQ(x("arm", 90.0), 3.0);
}

TEST_F(FrameBufferTest, TimeThatBeginsAtZeroIsLongEnough) {
  rest("base", "world", 1.0);
  move("base", "world", 0.5, 2.0);
  EXPECT_EQ(x("base", 0.25), 1.0);
  EXPECT_EQ(x("base", 0.5), 2.0);
}

}  // namespace
}  // namespace sweep_guard_ros
