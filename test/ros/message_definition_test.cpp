// The types of a message are read from its definition, and a hostile definition is refused before it costs anything.
#include "ros/scene/message_definition.h"

#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include "refusal.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using Kind = ValueType::Kind;

template <typename Msg>
MessageDefinition definitionOf() {
  return {ros::message_traits::datatype<Msg>(), ros::message_traits::definition<Msg>()};
}

const ValueType& fieldOf(const ValueType& type, const std::string& name) {
  for (const auto& field : type.fields) {
    if (field.name == name) return *field.type;
  }
  throw std::out_of_range(name);
}

std::string problemOf(const std::string& text) {
  const std::string message = refusal([&] { MessageDefinition("a/A", text); });
  const std::string prefix = "message definition is not usable: ";
  EXPECT_EQ(message.substr(0, prefix.size()), prefix.substr(0, message.size()));
  return message.empty() ? "" : message.substr(prefix.size());
}

std::string section(const std::string& name, const std::string& lines) {
  return std::string(80, '=') + "\nMSG: " + name + "\n" + lines;
}

TEST(MessageDefinitionTest, ReadsTheFieldsOfAMarker) {
  const MessageDefinition definition = definitionOf<visualization_msgs::Marker>();
  std::string fields;
  for (const auto& [name, type] : definition.type().fields) fields += type->name + " " + name + "\n";
  EXPECT_EQ(definition.type().name, "visualization_msgs/Marker");
  const std::string expected =
      "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
      "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nduration lifetime\nbool frame_locked\n"
      "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\n";
  EXPECT_EQ(fields.substr(0, expected.size()), expected);
}

TEST(MessageDefinitionTest, KnowsWhichTypesHaveAFixedSize) {
  const MessageDefinition definition = definitionOf<visualization_msgs::MarkerArray>();
  const ValueType& marker = *fieldOf(definition.type(), "markers").element;
  EXPECT_FALSE(marker.fixed);
  const ValueType& pose = fieldOf(marker, "pose");
  EXPECT_TRUE(pose.fixed);
  EXPECT_EQ(pose.min_size, 7 * sizeof(double));
  const ValueType& header = fieldOf(marker, "header");
  EXPECT_FALSE(header.fixed);
  EXPECT_EQ(header.min_size, 4U + 8U + 4U);
  EXPECT_EQ(fieldOf(marker, "points").element->min_size, 3 * sizeof(double));
  EXPECT_EQ(fieldOf(marker, "points").min_size, 4U);
}

// The length that a message without contents is given by its generated serializer is the smallest.
template <typename Msg>
void expectSmallestSize() {
  EXPECT_EQ(definitionOf<Msg>().type().min_size, ros::serialization::serializationLength(Msg()));
}

TEST(MessageDefinitionTest, AgreesWithGeneratedCodeOnTheSmallestSize) {
  expectSmallestSize<visualization_msgs::Marker>();
  expectSmallestSize<visualization_msgs::MarkerArray>();
  expectSmallestSize<sensor_msgs::PointCloud2>();
  expectSmallestSize<sweep_guard::DeformableMesh>();
}

TEST(MessageDefinitionTest, KnowsAllBuiltinTypes) {
  const MessageDefinition definition(
      "a/A",
      "bool a\nbyte b\nchar c\nint8 d\nuint8 e\nint16 f\nuint16 g\nint32 h\nuint32 i\nint64 j\nuint64 k\n"
      "float32 l\nfloat64 m\nstring n\ntime o\nduration p");
  std::vector<Kind> kinds;
  std::vector<size_t> sizes;
  for (const auto& field : definition.type().fields) {
    kinds.push_back(field.type->kind);
    sizes.push_back(field.type->min_size);
  }
  EXPECT_EQ(kinds, (std::vector<Kind>{Kind::kBool, Kind::kSigned, Kind::kUnsigned, Kind::kSigned, Kind::kUnsigned,
                                      Kind::kSigned, Kind::kUnsigned, Kind::kSigned, Kind::kUnsigned, Kind::kSigned,
                                      Kind::kUnsigned, Kind::kFloat, Kind::kFloat, Kind::kString, Kind::kTime,
                                      Kind::kDuration}));
  EXPECT_EQ(sizes, (std::vector<size_t>{1, 1, 1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 4, 8, 8}));
}

TEST(MessageDefinitionTest, LeavesOutConstantsAndComments) {
  const MessageDefinition definition("a/A",
                                     "# int8 no\n  \t\nint32 X=1\nint32 Y = 2 # two\nstring S=a # b\nstring T=#\n"
                                     "int8 a # = 3\r\n \tint8\t b#c\n#=\n");
  ASSERT_EQ(definition.type().fields.size(), 2U);
  EXPECT_EQ(definition.type().fields[0].name, "a");
  EXPECT_EQ(definition.type().fields[1].name, "b");
  EXPECT_EQ(definition.type().min_size, 2U);
}

TEST(MessageDefinitionTest, ReadsArrays) {
  const MessageDefinition definition(
      "a/A", "float64[] open\nuint32[3] corners\nstring[2] names\nB[2] b\n" + section("a/B", "int16 x\nuint8[5] y\n"));
  const ValueType& open = fieldOf(definition.type(), "open");
  EXPECT_EQ(open.kind, Kind::kArray);
  EXPECT_EQ(open.element->name, "float64");
  EXPECT_EQ(open.length, 0U);
  EXPECT_FALSE(open.fixed);
  const ValueType& corners = fieldOf(definition.type(), "corners");
  EXPECT_EQ(corners.length, 3U);
  EXPECT_TRUE(corners.fixed);
  EXPECT_EQ(corners.min_size, 12U);
  EXPECT_FALSE(fieldOf(definition.type(), "names").fixed);
  EXPECT_EQ(fieldOf(definition.type(), "names").min_size, 8U);
  EXPECT_EQ(fieldOf(definition.type(), "b").min_size, 14U);
}

TEST(MessageDefinitionTest, TakesNamesWithoutPackageFromThatOfTheirType) {
  const MessageDefinition definition("a/A", "b/B one\nB two\nHeader header\n" + section("b/B", "C[] c\n") +
                                                section("a/B", "int8 x\n") + section("b/C", "int16 x\n") +
                                                section("std_msgs/Header", "uint32 seq\n"));
  EXPECT_EQ(fieldOf(fieldOf(definition.type(), "one"), "c").name, "b/C[]");
  EXPECT_EQ(fieldOf(definition.type(), "two").name, "a/B");
  EXPECT_EQ(fieldOf(definition.type(), "header").name, "std_msgs/Header");
}

TEST(MessageDefinitionTest, KeepsItsTypesWhereTheyAreWhenMoved) {
  MessageDefinition from("a/A", "B b\n" + section("a/B", "int8 x\n"));
  const ValueType* const type = &from.type();
  const MessageDefinition to = std::move(from);
  EXPECT_EQ(&to.type(), type);
  EXPECT_EQ(fieldOf(*type, "b").name, "a/B");
}

TEST(MessageDefinitionTest, NamesTheTypeThatIsMissing) {
  EXPECT_EQ(problemOf("int8 x\nb/B y\n"), "b/B is missing");
  EXPECT_EQ(problemOf("float99[] x\n"), "a/float99 is missing");
  EXPECT_EQ(problemOf("b/B\x1b[2]x y\n"), "b/B? is missing");
  EXPECT_EQ(refusal([] { MessageDefinition("", "b/B y"); }), "message definition is not usable: b/B is missing");
}

TEST(MessageDefinitionTest, RefusesATypeThatIsPartOfItself) {
  EXPECT_EQ(problemOf("A a\n"), "a/A is part of itself");
  EXPECT_EQ(problemOf("int8 x\nB[] b\n" + section("a/B", "C c\n") + section("a/C", "B[] b\n")),
            "a/B[] is part of itself");
}

TEST(MessageDefinitionTest, RefusesLinesThatAreNoField) {
  EXPECT_EQ(problemOf("int8\n"), "'int8' is not a field");
  EXPECT_EQ(problemOf("int8 a b\n"), "'int8 a b' is not a field");
}

TEST(MessageDefinitionTest, RefusesWrongArrays) {
  for (const std::string array : {"int8[3", "int8[-1]", "int8[x]", "int8[1]2", "int8[][]", "int8[2][2]", "int8[ 2]",
                                  "int8[99999999999999999999]", "int8[2000000000]", "int8["}) {
    EXPECT_NE(problemOf(array + " x\n"), "") << array;
  }
}

TEST(MessageDefinitionTest, RefusesATypeThatIsDefinedTwice) {
  EXPECT_EQ(problemOf("int8 x\n" + section("a/B", "int8 x\n") + section("a/B", "int8 x\n")), "a/B is defined twice");
  EXPECT_EQ(problemOf("int8 x\n" + section("a/A", "int8 x\n")), "a/A is defined twice");
}

// An element without bytes would make an array of any length possible in a short message.
TEST(MessageDefinitionTest, RefusesTypesWithoutBytes) {
  EXPECT_EQ(problemOf(""), "a/A is empty");
  EXPECT_EQ(problemOf("std_msgs/Empty[] x\n" + section("std_msgs/Empty", "")), "std_msgs/Empty is empty");
  EXPECT_EQ(problemOf("int8[0] x\n"), "int8[0] is empty");
}

TEST(MessageDefinitionTest, RefusesTypesOfMoreThanAGibibyte) {
  EXPECT_EQ(problemOf("float64[134217728] x\n"), "");
  EXPECT_EQ(problemOf("float64[134217729] x\n"), "float64[134217729] takes more than 1 GiB");
  const std::string nested =
      section("a/B", "C[1000] c\n") + section("a/C", "D[1000] d\n") + section("a/D", "string s\n");
  EXPECT_EQ(problemOf("B[268] b\n" + nested), "");
  EXPECT_EQ(problemOf("B[269] b\n" + nested), "a/B[269] takes more than 1 GiB");
}

TEST(MessageDefinitionTest, RefusesTenThousandNestedTypes) {
  std::string text = "T0 t\n";
  for (int i = 0; i < 10'000; ++i) text.append("MSG: a/T" + std::to_string(i) + "\nT" + std::to_string(i + 1) + " t\n");
  EXPECT_EQ(problemOf(text), "a/T32 is more than 32 levels deep");
}

// Each array type keeps its name.
TEST(MessageDefinitionTest, RefusesLongNames) {
  const std::string name = "a/" + std::string(sweep_guard_core::kMaxNameLength - 2, 'B');
  EXPECT_EQ(problemOf(name + " b\n" + section(name, "int8 x\n")), "");
  EXPECT_EQ(problemOf(name + "[] b\n" + section(name, "int8 x\n")), name + "... is too long");
}

// Each level has the next one twice: read by and by, they would be 2^31 types.
TEST(MessageDefinitionTest, ReadsEachTypeOnce) {
  std::string text = "T0 a\nT0 b\n";
  for (int i = 0; i < 24; ++i) {
    const std::string next = "T" + std::to_string(i + 1);
    text.append("MSG: a/T" + std::to_string(i) + "\n").append(next + " a\n").append(next + " b\n");
  }
  EXPECT_EQ(MessageDefinition("a/A", text + "MSG: a/T24\nint8 x\n").type().min_size, size_t{1} << 25U);
}

TEST(MessageDefinitionTest, RefusesATextOfMoreThan256KiB) {
  EXPECT_EQ(problemOf("int8 x\n" + std::string(262'144 - 7, '#')), "");
  EXPECT_EQ(problemOf("int8 x\n" + std::string(262'144 - 6, '#')), "a/A has a text of more than 256 KiB");
}

// Whatever a part of a definition says, it is read or refused.
TEST(MessageDefinitionTest, ReadsOrRefusesEachBeginning) {
  const std::string text = ros::message_traits::definition<visualization_msgs::MarkerArray>();
  int read = 0;
  for (size_t size = 0; size < text.size(); ++size) {
    const std::string problem =
        refusal([&] { MessageDefinition("visualization_msgs/MarkerArray", text.substr(0, size)); });
    read += problem.empty() ? 1 : 0;
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 200);
}

}  // namespace
}  // namespace sweep_guard_ros
