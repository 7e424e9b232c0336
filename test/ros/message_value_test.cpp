// Values are found in the bytes of messages of any type, and nothing is read outside of the bytes.
#include "ros/scene/message_value.h"

#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <shape_msgs/Mesh.h>
#include <shape_msgs/Plane.h>
#include <shape_msgs/SolidPrimitive.h>
#include <visualization_msgs/MarkerArray.h>

#include <random>

#include "refusal.h"
#include "ros/collision_object.h"
#include "ros/sent_message.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Triangle;

geometry_msgs::Point point(double x, double y, double z) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = z;
  return point;
}

visualization_msgs::Marker marker(int id) {
  visualization_msgs::Marker marker;
  marker.header.seq = 7;
  marker.header.stamp = {1'600'000'000, 5};
  marker.header.frame_id = "world";
  marker.ns = "table";
  marker.id = id;
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.pose.position = point(1, 2, 3);
  marker.pose.orientation.w = 1.0;
  marker.color.a = 0.5F;
  marker.lifetime = ros::Duration(-1, 500'000'000);
  marker.frame_locked = 1;
  for (int i = 0; i < 3 * id; ++i) marker.points.push_back(point(i, 0.5 * i, -i));
  marker.colors.resize(marker.points.size());
  marker.text = "a text";
  marker.mesh_resource = "package://a/b.stl";
  return marker;
}

visualization_msgs::MarkerArray markers() {
  visualization_msgs::MarkerArray array;
  for (const int id : {-1, 0, 1, 2}) array.markers.push_back(marker(id));
  return array;
}

TEST(MessageValueTest, ReadsTheFieldsOfAMarker) {
  const Sent message = sent(marker(2));
  const MessageValue value = message.value();
  EXPECT_EQ(value["header"]["stamp"].time(), sweep_guard_core::Time(Duration(1'600'000'000'000'000'005)));
  EXPECT_EQ(value["header"]["frame_id"].text(), "world");
  EXPECT_EQ(value["header"]["seq"].integer(), 7);
  EXPECT_EQ(value["type"].integer(), 11);
  EXPECT_EQ(value["pose"]["position"]["z"].number(), 3.0);
  EXPECT_EQ(value["color"]["a"].number(), 0.5);
  EXPECT_EQ(value["lifetime"].duration(), std::chrono::milliseconds(-500));
  EXPECT_TRUE(value["frame_locked"].flag());
  EXPECT_EQ(value["points"].size(), 6U);
  EXPECT_EQ(value["text"].text(), "a text");
  EXPECT_EQ(value["text"].size(), 6U);
  EXPECT_EQ(value["mesh_resource"].text(), "package://a/b.stl");
  EXPECT_FALSE(value["mesh_use_embedded_materials"].flag());
}

TEST(MessageValueTest, ReadsTheElementsOfAnArray) {
  const Sent message = sent(markers());
  const std::vector<MessageValue> elements = message.value()["markers"].elements();
  ASSERT_EQ(elements.size(), 4U);
  for (size_t i = 0; i < elements.size(); ++i) {
    EXPECT_EQ(elements[i]["id"].integer(), static_cast<int>(i) - 1);
    EXPECT_EQ(elements[i]["points"].size(), i < 2 ? 0 : 3 * (i - 1));
    EXPECT_EQ(elements[i]["mesh_resource"].text(), "package://a/b.stl");
  }
}

TEST(MessageValueTest, ReadsArraysOfStringsAndNumbers) {
  sensor_msgs::JointState state;
  state.name = {"a", "", "long name"};
  state.position = {0.1, -0.2};
  const Sent message = sent(state);
  const std::vector<MessageValue> names = message.value()["name"].elements();
  ASSERT_EQ(names.size(), 3U);
  EXPECT_EQ(names[0].text(), "a");
  EXPECT_EQ(names[1].text(), "");
  EXPECT_EQ(names[2].text(), "long name");
  EXPECT_EQ(message.value()["position"].elements().at(1).number(), -0.2);
}

TEST(MessageValueTest, ReadsNumbersOfEachType) {
  const Sent message = sent("int8 a\nuint8 b\nint16 c\nuint16 d\nint32 e\nuint32 f\nint64 g\nfloat32 h\nfloat64 i",
                            std::int8_t{-2}, std::uint8_t{254}, std::int16_t{-3}, std::uint16_t{65533},
                            std::int32_t{-4}, std::uint32_t{4294967292}, std::int64_t{-5000000000}, 0.25F, 0.1);
  std::vector<double> numbers;
  for (const char* const name : {"a", "b", "c", "d", "e", "f", "g", "h", "i"}) {
    numbers.push_back(message.value()[name].number());
  }
  EXPECT_EQ(numbers, (std::vector<double>{-2, 254, -3, 65533, -4, 4294967292, -5e9, 0.25, 0.1}));
  EXPECT_EQ(message.value()["a"].integer(), -2);
  EXPECT_EQ(message.value()["f"].integer(), 4294967292);
  EXPECT_EQ(message.value()["g"].integer(), -5000000000);
}

TEST(MessageValueTest, ReadsArraysOfAFixedLength) {
  const Sent message = sent("uint16[2] numbers\nstring[2] names\nint8 last", std::uint16_t{7}, std::uint16_t{8},
                            std::string("a"), std::string("bc"), std::int8_t{9});
  EXPECT_EQ(message.value()["numbers"].elements().at(1).integer(), 8);
  EXPECT_EQ(message.value()["numbers"].bytes().size, 4U);
  EXPECT_EQ(message.value()["names"].elements().at(1).text(), "bc");
  EXPECT_EQ(message.value()["last"].integer(), 9);
}

TEST(MessageValueTest, ReadsPositionsOfPoints) {
  const Sent message = sent(marker(2));
  const std::vector<Eigen::Vector3d> positions = message.value()["points"].positions();
  ASSERT_EQ(positions.size(), 6U);
  EXPECT_EQ(positions[5], Eigen::Vector3d(5, 2.5, -5));
}

TEST(MessageValueTest, ReadsPositionsFromRecordsInAnyOrder) {
  const Sent message = sent("Point[2] points\nMSG: a/Point\nuint8 kind\nfloat32 z\nfloat32 y\ntime t\nfloat32 x\n",
                            std::uint8_t{1}, 3.0F, 2.0F, ros::Time(), 1.0F,  //
                            std::uint8_t{1}, 6.0F, 5.0F, ros::Time(), 4.0F);
  EXPECT_EQ(message.value()["points"].positions(), (std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(MessageValueTest, RefusesPositionsWithoutThreeCoordinatesOfOneType) {
  for (const std::string fields :
       {"float64 x\nfloat64 y\n", "float64 x\nfloat64 y\nfloat32 z\n", "int32 x\nint32 y\nint32 z\n"}) {
    const Sent message = sent("P[] points\nMSG: a/P\n" + fields, std::uint32_t{0});
    EXPECT_EQ(refusal([&] { message.value()["points"].positions(); }),
              "field 'points' is a/P[], not an array of positions x, y and z: this version is not known");
  }
}

TEST(MessageValueTest, ReadsTheTrianglesOfAMesh) {
  shape_msgs::Mesh mesh;
  mesh.triangles.resize(2);
  mesh.triangles[0].vertex_indices = {0, 1, 2};
  mesh.triangles[1].vertex_indices = {2, 1, 4294967295};
  const Sent message = sent(mesh);
  EXPECT_EQ(message.value()["triangles"].triangles(), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 4294967295}}));
  EXPECT_TRUE(message.value()["vertices"].positions().empty());
}

TEST(MessageValueTest, ReadsTrianglesOfPlainIndices) {
  const Sent message = sent("uint32[] i\nuint32[4] k", std::vector<std::uint32_t>{5, 6, 7, 8, 9, 10}, std::uint32_t{0},
                            std::uint32_t{0}, std::uint32_t{0}, std::uint32_t{0});
  EXPECT_EQ(message.value()["i"].triangles(), (std::vector<Triangle>{{5, 6, 7}, {8, 9, 10}}));
  EXPECT_EQ(refusal([&] { message.value()["k"].triangles(); }),
            "field 'k' has a number of indices that is not a multiple of 3");
}

TEST(MessageValueTest, PolygonsBecomeFans) {
  using Polygon = std::vector<std::uint32_t>;
  const std::string definition = "Vertices[] polygons\nMSG: a/Vertices\nuint32[] vertices\n";
  const Sent message = sent(definition, std::uint32_t{3}, Polygon{1, 2, 3}, Polygon{4, 5, 6, 7, 8}, Polygon{9, 10, 11});
  EXPECT_EQ(message.value()["polygons"].triangles(),
            (std::vector<Triangle>{{1, 2, 3}, {4, 5, 6}, {4, 6, 7}, {4, 7, 8}, {9, 10, 11}}));
  const Sent line = sent(definition, std::uint32_t{2}, Polygon{1, 2, 3}, Polygon{4, 5});
  EXPECT_EQ(refusal([&] { line.value()["polygons"].triangles(); }),
            "field 'polygons' has a polygon of less than 3 corners");
}

TEST(MessageValueTest, GivesTheBytesOfACloud) {
  sensor_msgs::PointCloud2 cloud;
  cloud.data = {1, 2, 250};
  const Sent message = sent(cloud);
  const Wire data = message.value()["data"].bytes();
  EXPECT_EQ(Bytes(data.bytes, data.bytes + data.size), (Bytes{1, 2, 250}));
}

// Before 2020 a collision object had no pose and no frames.
struct CollisionObject {
  Sent with_pose;
  Sent without_pose;
};

CollisionObject collisionObject() {
  std_msgs::Header header;
  header.frame_id = "base";
  geometry_msgs::Pose pose;
  pose.position = point(4, 5, 6);
  shape_msgs::SolidPrimitive cone;
  cone.dimensions = {2.0, 0.5};
  shape_msgs::Mesh mesh;
  mesh.vertices = {point(1, 2, 3)};
  mesh.triangles.resize(1);
  const auto shapes =
      fieldBytes(std::string("mug"), std::string("{}"), std::string("db"),
                 std::vector<shape_msgs::SolidPrimitive>{cone}, std::vector<geometry_msgs::Pose>{pose},
                 std::vector<shape_msgs::Mesh>{mesh, mesh}, std::vector<geometry_msgs::Pose>{pose, pose},
                 std::vector<shape_msgs::Plane>(), std::vector<geometry_msgs::Pose>());
  const auto joined = [](Bytes bytes, const Bytes& more, const Bytes& last) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    bytes.insert(bytes.end(), last.begin(), last.end());
    return bytes;
  };
  const Bytes names =
      fieldBytes(std::vector<std::string>{"handle"}, std::vector<geometry_msgs::Pose>{pose}, std::int8_t{2});
  return {{{"moveit_msgs/CollisionObject",
            objectDefinition("geometry_msgs/Pose pose\n",
                             "string[] subframe_names\ngeometry_msgs/Pose[] subframe_poses\n")},
           joined(fieldBytes(header, pose), shapes, names)},
          {{"moveit_msgs/CollisionObject", objectDefinition("", "")},
           joined(fieldBytes(header), shapes, fieldBytes(std::int8_t{1}))}};
}

TEST(MessageValueTest, ReadsTwoVersionsOfACollisionObject) {
  const CollisionObject object = collisionObject();
  for (const Sent* const version : {&object.with_pose, &object.without_pose}) {
    const MessageValue value = version->value();
    EXPECT_EQ(value["id"].text(), "mug");
    EXPECT_EQ(value["primitives"].elements().at(0)["dimensions"].elements().at(1).number(), 0.5);
    const MessageValue mesh = value["meshes"].elements().at(1);
    EXPECT_EQ(mesh["vertices"].positions(), (std::vector<Eigen::Vector3d>{{1, 2, 3}}));
    EXPECT_EQ(mesh["triangles"].triangles(), (std::vector<Triangle>{{0, 0, 0}}));
    EXPECT_EQ(value["mesh_poses"].elements().at(1)["position"]["y"].number(), 5.0);
  }
  EXPECT_EQ(object.with_pose.value()["operation"].integer(), 2);
  EXPECT_EQ(object.without_pose.value()["operation"].integer(), 1);
  EXPECT_TRUE(object.with_pose.value().has("pose"));
  EXPECT_FALSE(object.without_pose.value().has("pose"));
}

TEST(MessageValueTest, NamesAFieldThatIsMissing) {
  const CollisionObject object = collisionObject();
  EXPECT_EQ(refusal([&] { object.without_pose.value()["subframe_names"]; }),
            "moveit_msgs/CollisionObject has no field 'subframe_names': this version is not known");
  EXPECT_EQ(refusal([&] { object.without_pose.value()["id"]["length"]; }),
            "string has no field 'length': this version is not known");
}

TEST(MessageValueTest, NamesAFieldOfAnotherType) {
  const Sent message = sent(marker(1));
  const MessageValue value = message.value();
  const auto problem = [](const char* name, const char* type, const char* wanted) {
    return std::string("field '") + name + "' is " + type + ", not " + wanted + ": this version is not known";
  };
  EXPECT_EQ(refusal([&] { value["ns"].number(); }), problem("ns", "string", "an integer up to int64"));
  EXPECT_EQ(refusal([&] { value["scale"]["x"].integer(); }), problem("x", "float64", "an integer up to int64"));
  EXPECT_EQ(refusal([&] { value["id"].flag(); }), problem("id", "int32", "a bool"));
  EXPECT_EQ(refusal([&] { value["points"].text(); }), problem("points", "geometry_msgs/Point[]", "a string"));
  EXPECT_EQ(refusal([&] { value["lifetime"].time(); }), problem("lifetime", "duration", "a time"));
  EXPECT_EQ(refusal([&] { value["header"]["stamp"].duration(); }), problem("stamp", "time", "a duration"));
  EXPECT_EQ(refusal([&] { value["pose"].size(); }), problem("pose", "geometry_msgs/Pose", "an array"));
  EXPECT_EQ(refusal([&] { value["text"].elements(); }), problem("text", "string", "an array"));
  EXPECT_EQ(refusal([&] { value["text"].positions(); }), problem("text", "string", "an array of positions x, y and z"));
  EXPECT_EQ(refusal([&] { value["points"].triangles(); }),
            problem("points", "geometry_msgs/Point[]", "an array of triangles"));
  EXPECT_EQ(refusal([&] { value["text"].triangles(); }), problem("text", "string", "an array of triangles"));
  const Sent array = sent(markers());
  EXPECT_EQ(refusal([&] { array.value()["markers"].bytes(); }),
            problem("markers", "visualization_msgs/Marker[]", "an array of values of a fixed size"));
}

TEST(MessageValueTest, RefusesAUint64) {
  const Sent message = sent("uint64 x", std::uint64_t{1});
  EXPECT_EQ(refusal([&] { message.value()["x"].number(); }),
            "field 'x' is uint64, not an integer up to int64: this version is not known");
}

TEST(MessageValueTest, RefusesMoreThanAMillionElements) {
  const Sent message = sent("uint8[] data", std::vector<std::uint8_t>(1'000'001));
  EXPECT_EQ(refusal([&] { message.value()["data"].elements(); }), "field 'data' has more than a million elements");
  EXPECT_EQ(message.value()["data"].bytes().size, 1'000'001U);
}

// The bytes are copied, so that an address sanitizer sees what is read behind their end.
TEST(MessageValueTest, RefusesAMessageThatIsCutOffAnywhere) {
  const Sent message = sent(markers());
  for (size_t size = 0; size < message.bytes.size(); ++size) {
    const Bytes cut(message.bytes.begin(), message.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const std::string problem = refusal([&] { MessageValue(message.definition, wireOf(cut)); });
    EXPECT_TRUE(has(problem, "message is cut off: it takes at least "));
    EXPECT_TRUE(has(problem, " and holds " + std::to_string(size) + " bytes"));
  }
}

TEST(MessageValueTest, RefusesAMessageThatIsTooLong) {
  Sent message = sent("uint8[] data", std::vector<std::uint8_t>(2));
  message.bytes.push_back(0);
  EXPECT_EQ(refusal([&] { message.value(); }), "message is too long for its type: it takes 6 bytes and holds 7 bytes");
}

// Reads all that a message has.
size_t readAll(const MessageValue& value) {
  size_t points = 0;
  for (const MessageValue& marker : value["markers"].elements()) {
    points += marker["points"].positions().size() + marker["colors"].bytes().size + marker["text"].text().size() +
              marker["mesh_resource"].size();
  }
  return points;
}

TEST(MessageValueTest, RefusesOrReadsAnyLengthAnywhere) {
  const Sent message = sent(markers());
  int refused = 0;
  for (const std::uint32_t length : {4294967295U, 2147483648U, 178956971U, 5U}) {  // 178956971 * 24 exceeds 2^32
    for (size_t at = 0; at + sizeof length <= message.bytes.size(); ++at) {
      Bytes bytes = message.bytes;
      std::memcpy(&bytes[at], &length, sizeof length);
      refused += refusal([&] { readAll({message.definition, wireOf(bytes)}); }).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(MessageValueTest, RefusesOrReadsRandomChanges) {
  const Sent message = sent(markers());
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes = message.bytes;
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random() % 8);
    refusal([&] { readAll({message.definition, wireOf(bytes)}); });
  }
}

// The elements of an array of 2^32 - 1 strings take at least 16 GiB.
TEST(MessageValueTest, RefusesALengthBeforeItReadsTheElements) {
  const Sent message = sent("string[] names", std::uint32_t{4294967295}, std::uint32_t{0});
  EXPECT_EQ(refusal([&] { message.value(); }),
            "message is cut off: it takes at least 17179869184 bytes and holds 8 bytes");
}

}  // namespace
}  // namespace sweep_guard_ros
