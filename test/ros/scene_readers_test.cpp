// Which workpieces the messages of each type describe, and where.
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <shape_msgs/Mesh.h>
#include <shape_msgs/Plane.h>
#include <shape_msgs/SolidPrimitive.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "refusal.h"
#include "ros/collision_object.h"
#include "ros/scene/scene_reader.h"
#include "ros/sent_message.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::SceneChange;
using sweep_guard_core::SceneUpdate;
using sweep_guard_core::Time;
using visualization_msgs::Marker;

constexpr double kDeviation = 0.02;  // [m] of round shapes of these sizes

Eigen::AlignedBox3d boundsOf(const SceneChange& change) {
  EXPECT_EQ(change.refused, "");
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : change.object.surface_M.vertices) box.extend(vertex);
  return box;
}

testing::AssertionResult isBox(const SceneChange& change, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                               double deviation = 1e-6) {
  const Eigen::AlignedBox3d box = boundsOf(change);
  if ((box.min() - low).norm() <= deviation && (box.max() - high).norm() <= deviation)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << box.min().transpose() << " to " << box.max().transpose();
}

bool isGone(const SceneChange& change) { return change.refused.empty() && change.object.surface_M.triangles.empty(); }

SceneChange only(const SceneUpdate& update) {
  EXPECT_EQ(update.changes.size(), 1U);
  return update.changes.empty() ? SceneChange() : update.changes.front();
}

geometry_msgs::Pose pose(double x = 0.0, double y = 0.0, double z = 0.0) {
  return sweep_guard_ros::toMsg(Eigen::Isometry3d(Eigen::Translation3d(x, y, z)));
}

class MarkerReaderTest : public testing::Test {
 protected:
  static Marker marker(int type, int id = 0) {
    Marker marker;
    marker.header.frame_id = "camera";
    marker.ns = "wall";
    marker.id = id;
    marker.type = type;
    marker.pose = pose();
    marker.scale.x = 2.0;
    marker.scale.y = marker.scale.z = 1.0;
    return marker;
  }

  static Marker deleteAll() {
    Marker all;
    all.action = Marker::DELETEALL;
    return all;
  }

  static Marker fileOf(const std::string& name) {
    Marker file = marker(Marker::MESH_RESOURCE);
    file.mesh_resource = "file://" SWEEP_GUARD_SOURCE_DIR "/test/ros/" + name;
    file.scale.x = 1.0;
    return file;
  }

  SceneUpdate read(const Marker& marker, milliseconds at = {}) {
    const Sent message = sent(marker);
    return reader_->read(message.value(), Time(at));
  }

  std::string refusedAt(const geometry_msgs::Pose& pose) {
    Marker cube = marker(Marker::CUBE);
    cube.pose = pose;
    return only(read(cube)).refused;
  }

  EnvironmentTopic topic_{"/markers", "/markers"};
  std::unique_ptr<SceneReader> reader_ = makeSceneReader("visualization_msgs/Marker", topic_);
};

TEST_F(MarkerReaderTest, ShapesHaveTheSizeOfTheirScale) {
  for (const int type : {Marker::CUBE, Marker::SPHERE, Marker::CYLINDER})
    EXPECT_TRUE(isBox(only(read(marker(type))), {-1.0, -0.5, -0.5}, {1.0, 0.5, 0.5}, kDeviation)) << type;
}

TEST_F(MarkerReaderTest, TheScaleIsAlongTheAxesOfTheMarker) {
  Marker cube = marker(Marker::CUBE);
  cube.pose = pose(5.0);
  cube.pose.orientation.z = cube.pose.orientation.w = std::sqrt(0.5);
  EXPECT_TRUE(isBox(only(read(cube)), {4.5, -1.0, -0.5}, {5.5, 1.0, 0.5}));
}

TEST_F(MarkerReaderTest, EachMessageBeginsTheLifetimeAnew) {
  Marker cube = marker(Marker::CUBE);
  cube.lifetime = ros::Duration(1.0);
  read(cube, milliseconds(10000));
  read(cube, milliseconds(10900));
  EXPECT_TRUE(reader_->expire(Time(milliseconds(11899))).changes.empty());
  EXPECT_TRUE(isGone(only(reader_->expire(Time(milliseconds(11900))))));
  EXPECT_TRUE(reader_->expire(Time(milliseconds(20000))).changes.empty());
}

TEST_F(MarkerReaderTest, AThousandMarkersAreWorkpiecesAndEachSurplusIsRefusedUntilAllAreDeleted) {
  for (int round = 0; round < 2; ++round) {
    for (int id = 0; id < 1000; ++id) EXPECT_EQ(only(read(marker(Marker::CUBE, id))).refused, "");
    EXPECT_TRUE(has(only(read(marker(Marker::CUBE, 1000))).refused, "more than 1000 markers")) << round;
    EXPECT_EQ(only(read(marker(Marker::CUBE, 7))).refused, "") << "one that is there already";
    EXPECT_EQ(read(deleteAll()).changes.size(), 1001U);
  }
}

TEST_F(MarkerReaderTest, AMarkerWithoutANamespaceHasTheIdOfTheTopic) {
  Marker cube = marker(Marker::CUBE, 3);
  cube.ns = "";
  EXPECT_EQ(only(read(cube)).object.id, "/markers/3");
}

TEST_F(MarkerReaderTest, AMarkerThatBecomesATextIsNoWorkpieceAnyMore) {
  read(marker(Marker::CUBE));
  EXPECT_EQ(reader_->leftOut(), "");
  EXPECT_TRUE(isGone(only(read(marker(Marker::TEXT_VIEW_FACING)))));
  EXPECT_TRUE(has(reader_->leftOut(), "1 markers of other types are left out"));
}

TEST_F(MarkerReaderTest, AnotherFileIsRead) {
  EXPECT_TRUE(isBox(only(read(fileOf("block.stl"))), {0.0, 0.0, 0.0}, {100.0, 100.0, 100.0}));
  EXPECT_TRUE(has(only(read(fileOf("none.stl"))).refused, "no such file"));
  EXPECT_TRUE(isBox(only(read(fileOf("brick.ply"))), {0.0, 0.0, 0.0}, {100.0, 200.0, 300.0}));
}

TEST_F(MarkerReaderTest, AQuaternionOfZerosDoesNotTurnAndOneOfAnotherNormIsRefused) {
  Marker cube = marker(Marker::CUBE);
  cube.pose.orientation.w = 0.0;
  EXPECT_TRUE(isBox(only(read(cube)), {-1.0, -0.5, -0.5}, {1.0, 0.5, 0.5}));
  for (const double w : {0.8, 2.0, std::nan("")}) {
    cube.pose.orientation.w = w;
    EXPECT_TRUE(has(refusedAt(cube.pose), "a quaternion has the norm ")) << w;
  }
}

TEST_F(MarkerReaderTest, APositionThatIsNotFiniteIsRefused) {
  for (const double z : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(refusedAt(pose(0.0, 0.0, z)), "a position is NaN or infinite");
}

TEST_F(MarkerReaderTest, TheFrameIsThatOfTheMessageThenThatOfTheTopic) {
  Marker cube = marker(Marker::CUBE);
  cube.header.frame_id = "";
  EXPECT_TRUE(has(only(read(cube)).refused, "header.frame_id is empty"));
  topic_.frame = "table";
  reader_ = makeSceneReader("visualization_msgs/Marker", topic_);
  EXPECT_EQ(only(read(cube)).object.frame, "table");
  EXPECT_EQ(only(read(marker(Marker::CUBE))).object.frame, "camera");
}

TEST_F(MarkerReaderTest, TheStampIsThatOfTheMessage) {
  Marker cube = marker(Marker::CUBE);
  cube.header.stamp = ros::Time(7.5);
  EXPECT_EQ(only(read(cube, milliseconds(9000))).object.stamp, Time(milliseconds(7500)));
}

class PolygonMeshReaderTest : public testing::Test {
 protected:
  // Two rows of two points.
  PolygonMeshReaderTest() {
    cloud_.height = cloud_.width = 2;
    cloud_.point_step = 16;
    cloud_.row_step = 40;
    cloud_.data.resize(80);
    for (const char* const axis : {"x", "y", "z"}) {
      cloud_.fields.emplace_back().name = axis;
      cloud_.fields.back().offset = 4 * static_cast<std::uint32_t>(cloud_.fields.size() - 1);
      cloud_.fields.back().datatype = sensor_msgs::PointField::FLOAT32;
    }
    for (const size_t i : {0U, 1U, 2U, 3U}) {
      const float xyz[] = {static_cast<float>(i % 2), static_cast<float>(i / 2), 5.0F};
      std::memcpy(&cloud_.data[40 * (i / 2) + 16 * (i % 2)], &xyz, sizeof xyz);
    }
  }

  sweep_guard_core::SceneObject read() const {
    const std::string definition =
        "std_msgs/Header header\nsensor_msgs/PointCloud2 cloud\nVertices[] polygons\n"
        "MSG: pcl_msgs/Vertices\nuint32[] vertices\nMSG: sensor_msgs/PointCloud2\n" +
        std::string(ros::message_traits::definition<sensor_msgs::PointCloud2>());
    std_msgs::Header header;
    header.frame_id = "camera";
    const Sent message{{"pcl_msgs/PolygonMesh", definition},
                       fieldBytes(header, cloud_, std::uint32_t{1}, std::vector<std::uint32_t>{0, 1, 3, 2})};
    const auto reader = makeSceneReader("pcl_msgs/PolygonMesh", {"/polygons", "polygons"});
    return only(reader->read(message.value(), {})).object;
  }

  std::string refused() const {
    return refusal([&] { read(); });
  }

  sensor_msgs::PointCloud2 cloud_;
};

TEST_F(PolygonMeshReaderTest, RowsOfTheCloudMayHaveBytesBehindTheirPoints) {
  EXPECT_EQ(read().surface_M.vertices, (std::vector<Eigen::Vector3d>{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}}));
  EXPECT_EQ(read().surface_M.triangles, (std::vector<sweep_guard_core::Triangle>{{0, 1, 3}, {0, 3, 2}}));
}

TEST_F(PolygonMeshReaderTest, NumbersOfOtherKindsAreRefused) {
  cloud_.is_bigendian = 1;
  EXPECT_TRUE(has(refused(), "the cloud is big-endian"));
  cloud_.is_bigendian = 0;
  cloud_.fields[2].datatype = sensor_msgs::PointField::INT32;
  EXPECT_EQ(refused(), "the points of the cloud have another type than float32 in 'z'");
  cloud_.fields.pop_back();
  EXPECT_EQ(refused(), "the points of the cloud have no field 'z'");
}

TEST_F(PolygonMeshReaderTest, WhatIsOutsideOfTheDataIsRefused) {
  const auto rest = cloud_;
  for (const std::uint32_t offset : {5U, 4294967295U}) {
    cloud_.fields[2].offset = offset;
    cloud_.point_step = 8;
    EXPECT_TRUE(has(refused(), "its sizes do not fit its data"));
  }
  cloud_ = rest;
  cloud_.row_step = 41;
  EXPECT_TRUE(has(refused(), "its sizes do not fit its data"));
  cloud_ = rest;
  cloud_.row_step = 31;
  EXPECT_TRUE(has(refused(), "its sizes do not fit its data"));
}

class CollisionObjectReaderTest : public testing::Test {
 protected:
  SceneUpdate read() const {
    std_msgs::Header header;
    header.frame_id = "base";
    const Sent message{{"moveit_msgs/CollisionObject",
                        objectDefinition("geometry_msgs/Pose pose\n",
                                         "string[] subframe_names\ngeometry_msgs/Pose[] subframe_poses\n")},
                       fieldBytes(header, pose(), std::string("mug"), std::string(), std::string(), primitives_,
                                  std::vector<geometry_msgs::Pose>(primitives_.size(), pose()), meshes_,
                                  std::vector<geometry_msgs::Pose>(meshes_.size(), pose()), planes_,
                                  std::vector<geometry_msgs::Pose>(planes_.size(), pose()), std::vector<std::string>(),
                                  std::vector<geometry_msgs::Pose>(), operation_)};
    return reader_->read(message.value(), {});
  }

  void setPrimitive(int type, const std::vector<double>& dimensions) {
    primitives_.resize(1);
    primitives_[0].type = static_cast<std::uint8_t>(type);
    primitives_[0].dimensions = dimensions;
  }

  std::vector<shape_msgs::SolidPrimitive> primitives_;
  std::vector<shape_msgs::Mesh> meshes_;
  std::vector<shape_msgs::Plane> planes_;
  std::int8_t operation_ = 0;
  const std::unique_ptr<SceneReader> reader_ = makeSceneReader("moveit_msgs/CollisionObject", {"/objects"});
};

TEST_F(CollisionObjectReaderTest, PrimitivesHaveTheirDimensionsInTheOrderOfShapeMsgs) {
  using shape_msgs::SolidPrimitive;
  setPrimitive(SolidPrimitive::BOX, {2.0, 4.0, 6.0});
  EXPECT_TRUE(isBox(only(read()), {-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}));
  setPrimitive(SolidPrimitive::SPHERE, {0.5});
  EXPECT_TRUE(isBox(only(read()), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, kDeviation));
  for (const int type : {SolidPrimitive::CYLINDER, SolidPrimitive::CONE}) {
    setPrimitive(type, {4.0, 0.5});
    EXPECT_TRUE(isBox(only(read()), {-0.5, -0.5, -2.0}, {0.5, 0.5, 2.0}, kDeviation)) << type;
  }
  setPrimitive(SolidPrimitive::CONE, {4.0});
  EXPECT_EQ(only(read()).refused, "a primitive has 1 dimensions, too few for its type");
  setPrimitive(7, {4.0});
  EXPECT_TRUE(has(only(read()).refused, "a primitive is neither a box"));
}

TEST_F(CollisionObjectReaderTest, APlaneIsTheTopOfAFloorWhereverItLooks) {
  planes_.resize(1);
  planes_[0].coef = {2.0, 0.0, 0.0, -6.0};
  EXPECT_TRUE(isBox(only(read()), {2.0, -10.0, -10.0}, {3.0, 10.0, 10.0}));
  planes_[0].coef = {0.0, 0.0, -2.0, -6.0};
  EXPECT_TRUE(isBox(only(read()), {-10.0, -10.0, -3.0}, {10.0, 10.0, -2.0}));
  planes_[0].coef = {0.0, 0.0, 0.0, 1.0};
  EXPECT_TRUE(has(only(read()).refused, "a plane has no normal"));
}

TEST_F(CollisionObjectReaderTest, AMeshNamesItsOwnVerticesOnly) {
  meshes_.resize(2);
  for (auto& mesh : meshes_) {
    mesh.vertices.resize(3);
    mesh.vertices[1].x = mesh.vertices[2].y = 1.0;
    mesh.triangles.emplace_back().vertex_indices = {0, 1, 2};
  }
  EXPECT_EQ(only(read()).refused, "");
  meshes_[0].triangles[0].vertex_indices = {0, 1, 3};
  EXPECT_EQ(only(read()).refused, "a triangle of a mesh names a vertex that it has not");
}

TEST_F(CollisionObjectReaderTest, AnOperationThatIsNoneIsRefused) {
  setPrimitive(shape_msgs::SolidPrimitive::SPHERE, {0.5});
  for (const int operation : {-1, 4}) {
    operation_ = static_cast<std::int8_t>(operation);
    EXPECT_EQ(only(read()).refused, "its operation is none of ADD, REMOVE, APPEND, MOVE");
  }
}

// One object is not all of them.
TEST_F(CollisionObjectReaderTest, NoMessageMakesUpForOneThatWasLost) {
  setPrimitive(shape_msgs::SolidPrimitive::SPHERE, {0.5});
  read();
  EXPECT_FALSE(reader_->isComplete());
  EXPECT_FALSE(makeSceneReader("visualization_msgs/Marker", {"/markers"})->isComplete());
  EXPECT_FALSE(makeSceneReader("visualization_msgs/MarkerArray", {"/markers"})->isComplete());
  EXPECT_TRUE(makeSceneReader("shape_msgs/Mesh", {"/mesh"})->isComplete());
}

}  // namespace
}  // namespace sweep_guard_ros
