// A guard whose only workpiece is what a depth camera above it sees: a table at z = 0, and what is put on it.
#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "connected_publisher.h"
#include "guard_probe.h"
#include "refusal.h"
#include "transform_message.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

constexpr std::uint32_t kColumns = 64;
constexpr std::uint32_t kRows = 48;
constexpr double kFocalLength = 60.0;  // [pixels]
const Eigen::Vector3d kOverTable(0.0, 0.0, 0.3);

// What stands on the table: height [m] at a place of the table [m].
using Scene = std::function<double(double x, double y)>;

double table(double /*x*/, double /*y*/) { return 0.0; }

// A hand of 0.2 m that covers the middle, as high as this [m].
Scene handUpTo(double height) {
  return [height](double x, double y) { return std::abs(x) < 0.1 && std::abs(y) < 0.1 ? height : 0.0; };
}

sensor_msgs::Image imageOf(const Scene& scene, ros::Time stamp) {
  sensor_msgs::Image image;
  image.header.stamp = stamp;
  image.header.frame_id = "front_optical";
  image.encoding = "32FC1";
  image.width = kColumns;
  image.height = kRows;
  image.step = 4 * kColumns;
  image.data.resize(size_t{image.step} * kRows);
  for (std::uint32_t v = 0; v < kRows; ++v) {
    for (std::uint32_t u = 0; u < kColumns; ++u) {
      const double x = (u - 31.5) / kFocalLength;  // on the ray, at depth 1
      const double y = (v - 23.5) / kFocalLength;
      double depth = 1.0;
      for (int i = 0; i < 20; ++i) depth = 1.0 - scene(x * depth, -y * depth);
      const auto value = static_cast<float>(depth);
      std::memcpy(&image.data[image.step * v + 4 * u], &value, 4);
    }
  }
  return image;
}

class CameraTest : public ::testing::Test {
 protected:
  explicit CameraTest(bool publishes_info = true) {
    info_.header.frame_id = "front_optical";
    info_.width = kColumns;
    info_.height = kRows;
    info_.P = {kFocalLength, 0.0, 31.5, 0.0, 0.0, kFocalLength, 23.5, 0.0, 0.0, 0.0, 1.0, 0.0};
    info_publisher_ = node_.advertise<sensor_msgs::CameraInfo>("/front/depth/camera_info", 1, /*latch=*/true);
    if (publishes_info) info_publisher_.publish(info_);
    static_transforms_.publish(mount());
  }

  // One meter above the origin, it looks down.
  static tf2_msgs::TFMessage mount() {
    tf2_msgs::TFMessage mount;
    const Eigen::Quaterniond half_turn(0.0, 1.0, 0.0, 0.0);
    mount.transforms = {transformMsg("world", "front_optical", Eigen::Translation3d(0.0, 0.0, 1.0) * half_turn)};
    return mount;
  }

  // One step of 10 ms: what the camera sees, and where the tool is.
  void step(const sensor_msgs::Image& image, const Eigen::Vector3d& tip) {
    probe().tick(0.01);
    (*images_).publish(image);
    moveTo(tip);
  }

  // Returns the first warning after that.
  Warning moveTo(const Eigen::Vector3d& tip) {
    probe().skipWarnings();
    probe().publish(poseAt(tip, probe().time()));
    return probe().awaitWarning([](const Warning&) { return true; });
  }

  // Moves the tip up or down between two heights [mm] over the middle, at 0.5 m/s.
  void move(const Scene& scene, int from, int to) {
    for (int mm = from; mm != to; mm += from < to ? 5 : -5)
      step(imageOf(scene, probe().time()), {0.0, 0.0, 0.001 * mm});
  }

  Warning stepUntil(const Scene& scene, const Eigen::Vector3d& tip, const std::function<bool(const Warning&)>& fits) {
    return stepUntil([&] { return imageOf(scene, probe().time()); }, tip, fits);
  }

  Warning stepUntil(const std::function<sensor_msgs::Image()>& image, const Eigen::Vector3d& tip,
                    const std::function<bool(const Warning&)>& fits) {
    for (int i = 0; i < 1000; ++i) {
      step(image(), tip);
      const auto warnings = probe().warnings();
      if (!warnings.empty() && fits(warnings.back())) return warnings.back();
    }
    ADD_FAILURE() << "no such warning; the last: " << probe().warnings().back().text;
    return {};
  }

  // At half a meter per second. At its height the picture ends 0.37 m beside the middle.
  // Returns the first warning with NOT_SEEN, and where that was [mm].
  std::pair<Warning, int> leavePicture() {
    Warning warning;
    int mm = 0;
    for (; mm < 400 && (warning.reasons & Warning::NOT_SEEN) == 0; mm += 5) {
      step(imageOf(table, probe().time()), {0.001 * mm, 0.0, kOverTable.z()});
      warning = probe().warnings().back();
    }
    return {warning, mm};
  }

  static GuardProbe& probe() {
    static GuardProbe probe(/*drives_clock=*/true);
    return probe;
  }
  static bool isClear(const Warning& warning) { return warning.level == Warning::CLEAR; }
  static bool isContact(const Warning& warning) { return warning.level == Warning::CONTACT; }

  ros::NodeHandle node_;
  sensor_msgs::CameraInfo info_;
  ros::Publisher info_publisher_;
  ConnectedPublisher<sensor_msgs::Image> images_{"/front/depth/image_rect"};
  ros::Publisher static_transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 10, /*latch=*/true);
};

// Before the tests that publish camera_info: the guard keeps it.
class CameraWithoutInfoTest : public CameraTest {
 protected:
  CameraWithoutInfoTest() : CameraTest(/*publishes_info=*/false) {}
};

TEST_F(CameraWithoutInfoTest, NothingIsClearBeforeTheFirstImage) {
  Warning last;
  for (int i = 0; i < 20; ++i) {
    probe().tick(0.01);
    last = moveTo(kOverTable);
  }
  EXPECT_EQ(last.level, Warning::UNKNOWN);
  EXPECT_NE(last.reasons & Warning::NO_MESH, 0U) << last.text;
  EXPECT_TRUE(has(last.text, "'front' has not arrived")) << last.text;
}

// The topics of a camera connect one after the other.
TEST_F(CameraWithoutInfoTest, ImagesOfTheFirstSecondAreLeftOutAndTheNextRefused) {
  const std::string why = "no camera_info has come on /front/depth/camera_info";
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::steady_clock::now() - begin; };
  step(imageOf(table, probe().time()), kOverTable);
  probe().awaitStatus("camera front", [&](const GuardProbe::Status& next) { return has(next.message, why); });
  Warning warning = moveTo(kOverTable);
  EXPECT_EQ(warning.reasons & Warning::MESH_INVALID, 0U) << warning.text;
  while ((warning.reasons & Warning::MESH_INVALID) == 0U && elapsed() < std::chrono::seconds(30)) {
    step(imageOf(table, probe().time()), kOverTable);
    warning = probe().warnings().back();
    EXPECT_EQ(warning.level, Warning::UNKNOWN) << warning.text;
    EXPECT_NE(warning.reasons & Warning::NO_MESH, 0U) << warning.text;
  }
  EXPECT_GE(elapsed(), std::chrono::seconds(1));
  EXPECT_TRUE(has(warning.text, why)) << warning.text;
}

TEST_F(CameraTest, WhatTheCameraSeesIsMetAndWhatHasLeftIsNot) {
  stepUntil(table, kOverTable, isClear);
  const Scene hand = handUpTo(0.2);
  for (int i = 0; i < 10; ++i) step(imageOf(hand, probe().time()), kOverTable);
  move(hand, 300, 195);
  const Warning contact = stepUntil(hand, {0.0, 0.0, 0.195}, isContact);
  EXPECT_EQ(contact.mesh_id, "front");
  move(hand, 195, 300);
  stepUntil(table, kOverTable, isClear);
  move(table, 300, 195);
  const Warning last = probe().warnings().back();
  EXPECT_FALSE(last.contact) << last.text;
}

TEST_F(CameraTest, TheToolTouchesTheTableItself) {
  stepUntil(table, kOverTable, isClear);
  move(table, 300, 0);
  stepUntil(table, {0.0, 0.0, -0.001}, isContact);
  move(table, 0, 300);
  stepUntil(table, kOverTable, isClear);
}

// The drill is 0.1 m long, with its tip below, and has a radius of 5 mm: the camera sees its upper end.
TEST_F(CameraTest, TheToolInThePictureIsNoWorkpiece) {
  const Scene with_tool = [](double x, double y) { return std::hypot(x, y) < 0.02 ? 0.4 : 0.0; };
  stepUntil(with_tool, kOverTable, isClear);
  for (int i = 0; i < 50; ++i) step(imageOf(with_tool, probe().time()), kOverTable);
  EXPECT_TRUE(isClear(probe().warnings().back())) << probe().warnings().back().text;
  const auto status = probe().awaitStatus("camera front", [](const GuardProbe::Status& next) {
    return std::atof(valueOf(next, "pixels of the robot itself [%]").c_str()) > 0.0;
  });
  EXPECT_EQ(valueOf(status, "detector"), "halfspace, whatever `detector` says");
}

TEST_F(CameraTest, WhereTheCameraDoesNotSeeTheToolGoingItIsUnknownAndNotReflex) {
  EXPECT_EQ(stepUntil(table, kOverTable, isClear).seen, 1.0);
  const auto [warning, mm] = leavePicture();
  EXPECT_LT(mm, 370) << "it has left before anything was said: " << warning.text;
  EXPECT_EQ(warning.level, Warning::UNKNOWN) << warning.text;
  EXPECT_FALSE(warning.reflex) << warning.text;
  EXPECT_TRUE(warning.considered);
  EXPECT_TRUE(has(warning.text, "cameras see only")) << warning.text;
  stepUntil(table, kOverTable, isClear);
}

TEST_F(CameraTest, ALargerShareThatMustBeSeenIsMissedSooner) {
  stepUntil(table, kOverTable, isClear);
  const int before = leavePicture().second;
  dynamic_reconfigure::Config change;
  change.doubles.resize(1);
  change.doubles[0].name = "min_seen";
  change.doubles[0].value = 0.9;
  ASSERT_TRUE(probe().configure(change));
  stepUntil(table, kOverTable, isClear);
  EXPECT_LT(leavePicture().second, before);
  change.doubles[0].value = 0.09;
  ASSERT_TRUE(probe().configure(change));
  stepUntil(table, kOverTable, isClear);
}

// The colors of doc/warnings.md.
constexpr std::uint32_t kSeen = 0xD6CCBD;
constexpr std::uint32_t kRemembered = 0x339999;
constexpr std::uint32_t kSelf = 0x5980E6;

// The newest points that rviz would draw.
class CloudListener {
 public:
  using Points = std::map<std::uint32_t, std::vector<Eigen::Vector3f>>;  // by color

  std_msgs::Header header() const {
    const std::lock_guard lock(mutex_);
    return newest_.header;
  }

  Points points() const {
    const std::lock_guard lock(mutex_);
    Points points;
    for (size_t i = 0; i + 16 <= newest_.data.size(); i += newest_.point_step) {
      std::array<float, 3> p;
      std::uint32_t rgb = 0;
      std::memcpy(p.data(), &newest_.data[i + newest_.fields.at(0).offset], sizeof(p));
      std::memcpy(&rgb, &newest_.data[i + newest_.fields.at(3).offset], sizeof(rgb));
      points[rgb].emplace_back(p[0], p[1], p[2]);
    }
    return points;
  }

 private:
  void take(const sensor_msgs::PointCloud2& cloud) {
    const std::lock_guard lock(mutex_);
    newest_ = cloud;
  }

  mutable std::mutex mutex_;
  sensor_msgs::PointCloud2 newest_;
  ros::Subscriber subscriber_ = ros::NodeHandle().subscribe<sensor_msgs::PointCloud2>(
      "/sweep_guard/cameras/front", 1, [this](const auto& cloud) { take(*cloud); });
};

// The upper end of the drill is at 0.4 m. The table counts as 1 mm nearer to the camera.
TEST_F(CameraTest, RvizIsShownTheSurfaceWhatTheToolHidesOfItAndTheTool) {
  const CloudListener cloud;
  const Scene with_tool = [](double x, double y) { return std::hypot(x, y) < 0.02 ? 0.4 : 0.0; };
  stepUntil(table, kOverTable, isClear);
  stepUntil(with_tool, kOverTable, [&](const Warning&) { return cloud.points().size() == 3; });
  const auto expectAt = [points = cloud.points()](std::uint32_t kind, double height, double nearest, double farthest) {
    ASSERT_EQ(points.count(kind), 1U) << kind;
    for (const Eigen::Vector3f& p : points.at(kind)) {
      EXPECT_NEAR(p.z(), height, 3e-4) << kind;
      EXPECT_GE(p.head<2>().norm(), nearest) << kind;
      EXPECT_LE(p.head<2>().norm(), farthest) << kind;
    }
  };
  expectAt(kSelf, 0.4, 0.0, 0.012);
  expectAt(kRemembered, 0.001, 0.0, 0.02);
  expectAt(kSeen, 0.001, 0.0199, 1.0);
  EXPECT_EQ(cloud.points().at(kSeen).size() + cloud.points().at(kRemembered).size(), kColumns * kRows);
  EXPECT_EQ(cloud.header().frame_id, "world");
  EXPECT_LE(cloud.header().stamp, probe().time());
  const auto status = probe().awaitStatus("camera front", [](const GuardProbe::Status& next) {
    return std::atof(valueOf(next, "pixels remembered behind it [%]").c_str()) > 0.0;
  });
  EXPECT_EQ(valueOf(status, "pixels remembered behind it [%]"), valueOf(status, "pixels of the robot itself [%]"));
  EXPECT_EQ(valueOf(status, "pixels with a surface [%]"), "100.0");
  EXPECT_NE(valueOf(status, "delay until taken [s]"), "");
}

TEST_F(CameraTest, AnImageThatCannotBeReadIsUnknownInWordsUntilTheNext) {
  const auto refused = [&](const std::string& words, const std::function<void(sensor_msgs::Image&)>& spoil) {
    stepUntil(table, kOverTable, isClear);
    const auto spoilt = [&] {
      sensor_msgs::Image image = imageOf(table, probe().time());
      spoil(image);
      return image;
    };
    const Warning warning = stepUntil(spoilt, kOverTable, [&](const Warning& next) {
      return next.level == Warning::UNKNOWN && has(next.text, words);
    });
    EXPECT_FALSE(warning.clear);
  };
  refused("rgb8", [](sensor_msgs::Image& image) { image.encoding = "rgb8"; });
  refused("covered", [](sensor_msgs::Image& image) { std::fill(image.data.begin(), image.data.end(), 0U); });
  refused("step", [](sensor_msgs::Image& image) { image.step = 3; });
  refused("future", [](sensor_msgs::Image& image) { image.header.stamp += ros::Duration(3600.0); });
  refused("nowhere", [](sensor_msgs::Image& image) { image.header.frame_id = "nowhere"; });
  refused("camera_info", [](sensor_msgs::Image& image) { image.height /= 2; });
  stepUntil(table, kOverTable, isClear);
}

TEST_F(CameraTest, AMeshByTheNameOfACameraIsRefused) {
  stepUntil(table, kOverTable, isClear);
  probe().publish(squareAt("front", {0.0, 0.0, -1.0}, probe().time()));
  const Warning warning =
      stepUntil(table, kOverTable, [](const Warning& next) { return next.level == Warning::UNKNOWN; });
  EXPECT_NE(warning.reasons & Warning::MESH_INVALID, 0U) << warning.text;
  EXPECT_TRUE(has(warning.text, "'front' is that of a camera")) << warning.text;
  stepUntil(table, kOverTable, isClear);
}

// Otherwise a camera that is unplugged would leave the guard with what it has seen last.
TEST_F(CameraTest, ACameraThatFallsSilentIsUnknown) {
  stepUntil(table, kOverTable, isClear);
  Warning warning;
  for (int i = 0; i < 1000 && (warning.reasons & Warning::MESH_STALE) == 0; ++i) {
    probe().tick(0.01);
    warning = moveTo(kOverTable);
  }
  EXPECT_EQ(warning.level, Warning::UNKNOWN) << warning.text;
  EXPECT_NE(warning.reasons & Warning::MESH_STALE, 0U) << warning.text;
  stepUntil(table, kOverTable, isClear);
}

}  // namespace
}  // namespace sweep_guard_ros
