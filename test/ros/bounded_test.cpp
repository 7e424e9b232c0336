#include "ros/bounded.h"

#include <gtest/gtest.h>

#include <cstring>

#include "allocations.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kForged[] = {0x40000001, 0x20000001, 0x15555556, 0x7fffffff, 0x80000000, 0xffffffff};
constexpr size_t kMaxSize = 1U << 20;

std_msgs::Header header() {
  std_msgs::Header header;
  header.seq = 7;
  header.stamp = ros::Time(1.5);
  header.frame_id = "table";
  return header;
}

geometry_msgs::PoseStamped poseStamped() {
  geometry_msgs::PoseStamped pose;
  pose.header = header();
  return pose;
}

template <typename Msg>
Msg example();

template <>
geometry_msgs::PoseStamped example() {
  return poseStamped();
}

template <>
sensor_msgs::JointState example() {
  sensor_msgs::JointState message;
  message.header = header();
  message.name = {"elbow", "", "wrist"};
  message.position = {0.1, 0.2, 0.3};
  message.effort = {1.0};
  return message;
}

template <>
tf2_msgs::TFMessage example() {
  tf2_msgs::TFMessage message;
  message.transforms.resize(3);
  message.transforms[0].header = header();
  message.transforms[1].child_frame_id = "tool";
  return message;
}

template <typename Msg>
Msg ofLiver() {
  Msg message;
  message.header = header();
  message.id = "liver";
  return message;
}

template <>
sweep_guard::DeformableMesh example() {
  auto message = ofLiver<sweep_guard::DeformableMesh>();
  message.mesh.triangles.resize(2);
  message.mesh.vertices.resize(4);
  return message;
}

template <>
sweep_guard::MeshVertices example() {
  auto message = ofLiver<sweep_guard::MeshVertices>();
  message.positions.resize(12);
  return message;
}

template <>
geometry_msgs::Twist example() {
  return {};
}

template <>
geometry_msgs::TwistStamped example() {
  geometry_msgs::TwistStamped message;
  message.header = header();
  return message;
}

template <>
geometry_msgs::WrenchStamped example() {
  geometry_msgs::WrenchStamped message;
  message.header = header();
  return message;
}

template <>
sweep_guard::Proximity example() {
  sweep_guard::Proximity message;
  message.header = header();
  message.tool = "drill";
  message.planes.resize(2);
  message.planes[0].tool_link = "tip";
  message.planes[1].mesh_id = "liver";
  return message;
}

template <>
sweep_guard::ToolBalls example() {
  sweep_guard::ToolBalls message;
  message.header = header();
  message.tool = "drill";
  message.pieces.resize(2);
  message.pieces[0].link = "tip";
  message.pieces[1].balls.resize(3);
  return message;
}

template <>
sweep_guard::ToolBodies example() {
  sweep_guard::ToolBodies message;
  message.header = header();
  message.run_id = "run";
  message.bodies.resize(2);
  message.bodies[1].predicted.resize(3);
  message.bodies[1].predicted_deviation_bounds.resize(3);
  return message;
}

template <>
sweep_guard::ToolSurface example() {
  sweep_guard::ToolSurface message;
  message.header = header();
  message.tool = "drill";
  message.run_id = "run";
  message.links.resize(2);
  message.links[0].link = "tip";
  message.links[0].mesh.triangles.resize(2);
  message.links[0].mesh.vertices.resize(3);
  return message;
}

template <>
sweep_guard::Warning example() {
  sweep_guard::Warning message;
  message.header = header();
  message.tool = "drill";
  message.mesh_id = "liver";
  message.tool_link = "tip";
  message.triangles = {1, 2, 3};
  message.text = "CONTACT";
  message.run_id = "run";
  return message;
}

template <>
sweep_guard::CheckSweepRequest example() {
  sweep_guard::CheckSweepRequest message;
  message.path = {poseStamped(), geometry_msgs::PoseStamped(), poseStamped()};
  message.mesh_ids = {"liver", "", "spleen"};
  message.volume = "hull";
  message.detector = "select";
  return message;
}

template <>
sweep_guard::CheckTrajectoryRequest example() {
  sweep_guard::CheckTrajectoryRequest message;
  message.trajectory.header.frame_id = "world";
  message.trajectory.joint_names = {"elbow", ""};
  message.trajectory.points.resize(2);
  message.trajectory.points[0].positions = {1.0, 2.0};
  message.trajectory.points[1].velocities = {3.0};
  message.tool_pose = poseStamped();
  message.mesh_ids = {"liver"};
  message.volume = "hull";
  message.detector = "select";
  return message;
}

template <>
sweep_guard::Intend example() {
  sweep_guard::Intend message;
  message.mesh_id = "liver";
  message.triangles = {1, 2, 3};
  message.frame_id = "world";
  message.tool_links = {"bit", ""};
  return message;
}

template <>
sweep_guard::SetIntentRequest example() {
  sweep_guard::SetIntentRequest message;
  message.intends = {example<sweep_guard::Intend>(), sweep_guard::Intend()};
  return message;
}

template <>
sweep_guard::AcknowledgeRequest example() {
  sweep_guard::AcknowledgeRequest message;
  message.mesh_id = "liver";
  return message;
}

template <>
sweep_guard::AttachRequest example() {
  sweep_guard::AttachRequest message;
  message.mesh_id = "payload";
  message.link = "finger";
  message.attach = 1;
  return message;
}

template <>
sweep_guard::PredictRequest example() {
  return {};
}

template <>
std_srvs::SetBoolRequest example() {
  return {};
}

template <>
std_srvs::TriggerRequest example() {
  return {};
}

template <>
dynamic_reconfigure::ReconfigureRequest example() {
  dynamic_reconfigure::ReconfigureRequest message;
  message.config.bools.resize(2);
  message.config.bools[0].name = "fine";
  message.config.ints.resize(1);
  message.config.ints[0].name = "degree";
  message.config.strs.resize(2);
  message.config.strs[0].name = "detector";
  message.config.strs[0].value = "select";
  message.config.doubles.resize(3);
  message.config.doubles[2].name = "margin";
  message.config.groups.resize(1);
  message.config.groups[0].name = "Default";
  return message;
}

// Positions of the lengths of strings and arrays in the example, by the definitions of the messages.
template <typename Msg>
std::vector<size_t> lengths();

constexpr size_t kHeader = 4 + 8 + 4 + 5;  // with "table"
constexpr size_t kPose = 56;

template <>
std::vector<size_t> lengths<geometry_msgs::PoseStamped>() {
  return {12};
}

template <>
std::vector<size_t> lengths<sensor_msgs::JointState>() {
  const size_t positions = kHeader + 4 + 9 + 4 + 9;
  return {12, kHeader, kHeader + 4, kHeader + 13, kHeader + 17, positions, positions + 28, positions + 32};
}

template <>
std::vector<size_t> lengths<tf2_msgs::TFMessage>() {
  const size_t second = 4 + kHeader + 4 + kPose;
  const size_t third = second + 16 + 4 + 4 + kPose;
  return {0, 4 + 12, 4 + kHeader, second + 12, second + 16, third + 12, third + 16};
}

template <>
std::vector<size_t> lengths<sweep_guard::DeformableMesh>() {
  const size_t triangles = kHeader + 4 + 5 + 4;
  return {12, kHeader, triangles, triangles + 4 + size_t{2} * 12};
}

template <>
std::vector<size_t> lengths<sweep_guard::MeshVertices>() {
  return {12, kHeader, kHeader + 4 + 5 + 4};
}

template <>
std::vector<size_t> lengths<geometry_msgs::Twist>() {
  return {};
}

template <>
std::vector<size_t> lengths<geometry_msgs::TwistStamped>() {
  return {12};
}

template <>
std::vector<size_t> lengths<geometry_msgs::WrenchStamped>() {
  return {12};
}

template <>
std::vector<size_t> lengths<sweep_guard::Proximity>() {
  const size_t planes = kHeader + 4 + 5 + 56 + 4 + 8 + 1;
  const size_t first = planes + 4;
  const size_t second = first + 4 + 3 + 4 + 4 + 4 + 64;
  return {12, kHeader, planes, first, first + 4 + 3 + 4, second, second + 4 + 4};
}

template <>
std::vector<size_t> lengths<sweep_guard::ToolBalls>() {
  const size_t pieces = kHeader + 4 + 5 + 4;
  const size_t second = pieces + 4 + 4 + 3 + 4;
  return {12, kHeader, pieces, pieces + 4, pieces + 4 + 4 + 3, second, second + 4};
}

template <>
std::vector<size_t> lengths<sweep_guard::ToolBodies>() {
  const size_t bodies = kHeader + 4 + 3 + 4 + 4 + 8;
  const size_t first = bodies + 4 + kPose + 8;
  const size_t second = first + 8 + kPose + 8;
  constexpr size_t kPredicted = 8 + kPose + 36 * 8;
  return {12, kHeader, bodies, first, first + 4, second, second + 4 + 3 * kPredicted};
}

template <>
std::vector<size_t> lengths<sweep_guard::ToolSurface>() {
  const size_t links = kHeader + 4 + 5 + 4 + 3 + 4;
  const size_t triangles = links + 4 + 4 + 3 + 4;
  const size_t vertices = triangles + 4 + 2 * 12;
  const size_t second = vertices + 4 + 3 * 24;
  return {12, kHeader, kHeader + 4 + 5, links, links + 4, triangles, vertices, second, second + 8, second + 12};
}

template <>
std::vector<size_t> lengths<sweep_guard::Warning>() {
  const size_t mesh_id = kHeader + 4 + 5 + 5 + 8;
  const size_t link = mesh_id + 4 + 5;
  const size_t triangles = link + 4 + 3;
  const size_t text = triangles + 4 + 12 + 4;
  const size_t run_id = text + 4 + 7 + 4 + 20 + 16;
  return {12, kHeader, mesh_id, link, triangles, text, run_id};
}

template <>
std::vector<size_t> lengths<sweep_guard::CheckSweepRequest>() {
  const size_t second = 4 + kHeader + kPose;
  const size_t third = second + 16 + kPose;
  const size_t ids = third + kHeader + kPose;
  const size_t volume = ids + 4 + (4 + 5) + 4 + (4 + 6);
  return {0, 4 + 12, second + 12, third + 12, ids, ids + 4, ids + 13, ids + 17, volume, volume + 4 + 4};
}

template <>
std::vector<size_t> lengths<sweep_guard::CheckTrajectoryRequest>() {
  const size_t names = kHeader;
  const size_t points = names + 4 + (4 + 5) + 4;
  const size_t first = points + 4;
  const size_t second = first + 4 * 4 + 16 + 8;
  const size_t tool_pose = second + 4 * 4 + 8 + 8;
  const size_t ids = tool_pose + kHeader + kPose;
  const size_t volume = ids + 4 + (4 + 5);
  return {12,     names,      names + 4,   names + 13,  points,         first, first + 20, first + 24, first + 28,
          second, second + 4, second + 16, second + 20, tool_pose + 12, ids,   ids + 4,    volume,     volume + 8};
}

template <>
std::vector<size_t> lengths<sweep_guard::Intend>() {
  const size_t triangles = 4 + 5;
  const size_t frame = triangles + 4 + 12;
  const size_t links = frame + (4 + 5) + 24 + 8 + 8;
  return {0, triangles, frame, links, links + 4, links + 4 + (4 + 3)};
}

template <>
std::vector<size_t> lengths<sweep_guard::SetIntentRequest>() {
  std::vector<size_t> all = {0};
  for (const size_t position : lengths<sweep_guard::Intend>()) all.push_back(4 + position);
  const size_t second = all.back() + 4 + 8;
  for (const size_t position : {0, 4, 8, 12 + 24 + 8 + 8}) all.push_back(second + position);
  return all;
}

template <>
std::vector<size_t> lengths<sweep_guard::AcknowledgeRequest>() {
  return {0};
}

template <>
std::vector<size_t> lengths<sweep_guard::AttachRequest>() {
  return {0, 4 + 7};
}

template <>
std::vector<size_t> lengths<sweep_guard::PredictRequest>() {
  return {};
}

template <>
std::vector<size_t> lengths<std_srvs::SetBoolRequest>() {
  return {};
}

template <>
std::vector<size_t> lengths<std_srvs::TriggerRequest>() {
  return {};
}

template <>
std::vector<size_t> lengths<dynamic_reconfigure::ReconfigureRequest>() {
  const size_t ints = 4 + (4 + 4 + 1) + (4 + 1);
  const size_t strs = ints + 4 + (4 + 6 + 4);
  const size_t doubles = strs + 4 + (4 + 8 + 4 + 6) + (4 + 4);
  const size_t groups = doubles + 4 + size_t{2} * (4 + 8) + (4 + 6 + 8);
  return {0, 4, 13, ints, ints + 4, strs, strs + 4, strs + 16, doubles, doubles + 4, groups, groups + 4};
}

template <typename Msg>
Bytes serialized(const Msg& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

std::uint32_t lengthAt(const Bytes& bytes, size_t position) {
  std::uint32_t length = 0;
  std::memcpy(&length, &bytes[position], sizeof length);
  return length;
}

Bytes withLength(Bytes bytes, size_t position, std::uint32_t length) {
  for (size_t i = 0; i < sizeof length; ++i) bytes.at(position + i) = static_cast<std::uint8_t>(length >> 8 * i);
  return bytes;
}

// In a block of exactly this size: a sanitizer sees what is read beyond it.
template <typename Msg>
void check(const Bytes& bytes) {
  const Bytes exact(bytes.begin(), bytes.end());
  checkLengths<Msg>({exact.data(), exact.size()});
}

template <typename Msg>
class WireTest : public testing::Test {};

using Messages =
    testing::Types<geometry_msgs::PoseStamped, sensor_msgs::JointState, geometry_msgs::Twist,
                   geometry_msgs::TwistStamped, geometry_msgs::WrenchStamped, tf2_msgs::TFMessage,
                   sweep_guard::DeformableMesh, sweep_guard::MeshVertices, sweep_guard::Proximity,
                   sweep_guard::ToolBalls, sweep_guard::ToolBodies, sweep_guard::ToolSurface, sweep_guard::Warning,
                   sweep_guard::CheckSweepRequest, sweep_guard::CheckTrajectoryRequest, sweep_guard::PredictRequest,
                   sweep_guard::AcknowledgeRequest, sweep_guard::AttachRequest, sweep_guard::Intend,
                   sweep_guard::SetIntentRequest, std_srvs::SetBoolRequest, std_srvs::TriggerRequest,
                   dynamic_reconfigure::ReconfigureRequest>;
TYPED_TEST_SUITE(WireTest, Messages, );  // ISO C++17 wants an argument for `...`, even an empty one

TYPED_TEST(WireTest, PassesRealMessages) {
  EXPECT_NO_THROW(check<TypeParam>(serialized(example<TypeParam>())));
  EXPECT_NO_THROW(check<TypeParam>(serialized(TypeParam())));
}

TYPED_TEST(WireTest, RefusesEveryTruncation) {
  const Bytes bytes = serialized(example<TypeParam>());
  for (size_t size = 0; size < bytes.size(); ++size) {
    const auto cut = bytes.begin() + static_cast<std::ptrdiff_t>(size);
    EXPECT_THROW(check<TypeParam>(Bytes(bytes.begin(), cut)), sweep_guard_core::InvalidInput) << size;
  }
}

TYPED_TEST(WireTest, RefusesBytesThatAreLeftOver) {
  Bytes bytes = serialized(example<TypeParam>());
  bytes.push_back(0);
  EXPECT_THROW(check<TypeParam>(bytes), sweep_guard_core::InvalidInput);
}

// 0x40000001 floats are 4 bytes in 32 bits, 0x20000001 doubles 8, 0x15555556 triangles 8.
TYPED_TEST(WireTest, RefusesForgedLengths) {
  const Bytes bytes = serialized(example<TypeParam>());
  for (const size_t position : lengths<TypeParam>()) {
    ASSERT_LE(lengthAt(bytes, position), 12U) << "no length at " << position;
    for (const std::uint32_t forged : kForged) {
      EXPECT_THROW(check<TypeParam>(withLength(bytes, position, forged)), sweep_guard_core::InvalidInput)
          << forged << " at " << position;
    }
    const std::uint32_t one_more = lengthAt(bytes, position) + 1;
    EXPECT_THROW(check<TypeParam>(withLength(bytes, position, one_more)), sweep_guard_core::InvalidInput) << position;
  }
}

// roscpp multiplies in 32 bits: 0x40000001 floats then take as many bytes as one.
TEST(WrappedLengthTest, IsRefusedThoughItsBytesAreThere) {
  sweep_guard::MeshVertices vertices;
  vertices.positions.resize(1);
  const size_t positions = 16 + 4 + 4;
  EXPECT_NO_THROW(check<sweep_guard::MeshVertices>(withLength(serialized(vertices), positions, 1)));
  EXPECT_THROW(check<sweep_guard::MeshVertices>(withLength(serialized(vertices), positions, 0x40000001)),
               sweep_guard_core::InvalidInput);
  sweep_guard::DeformableMesh mesh;
  mesh.mesh.triangles.resize(1);
  mesh.mesh.vertices.resize(1);
  for (const size_t position : {positions, positions + 4 + 12}) {
    EXPECT_NO_THROW(check<sweep_guard::DeformableMesh>(withLength(serialized(mesh), position, 1)));
    for (const std::uint32_t forged : {0x40000001U, 0x20000001U}) {
      EXPECT_THROW(check<sweep_guard::DeformableMesh>(withLength(serialized(mesh), position, forged)),
                   sweep_guard_core::InvalidInput);
    }
  }
}

template <typename Msg>
class BoundedMessagesTest : public testing::Test {
 protected:
  // Returns the message, or null for a refused one.
  boost::shared_ptr<const Msg> deserialize(const Bytes& bytes) {
    ros::SubscriptionCallbackHelperDeserializeParams params;
    Bytes copy(bytes);
    params.buffer = copy.data();
    params.length = static_cast<std::uint32_t>(copy.size());
    params.connection_header = boost::make_shared<ros::M_string>();
    return boost::static_pointer_cast<const Msg>(helper_->deserialize(params));
  }

  std::vector<std::string> refusals_;
  static boost::shared_ptr<BoundedMessages<Msg>> helper(const std::string& topic, std::vector<std::string>& refusals) {
    return boost::make_shared<BoundedMessages<Msg>>(
        topic, [](const auto& /*event*/) {}, [&](const std::string& reason) { refusals.push_back(reason); }, kMaxSize);
  }

  const boost::shared_ptr<BoundedMessages<Msg>> helper_ = helper("/topic", refusals_);
};

using Topics = testing::Types<geometry_msgs::PoseStamped, sensor_msgs::JointState, tf2_msgs::TFMessage,
                              sweep_guard::DeformableMesh, sweep_guard::MeshVertices>;
TYPED_TEST_SUITE(BoundedMessagesTest, Topics, );

TYPED_TEST(BoundedMessagesTest, ReadsWhatWasSent) {
  const Bytes bytes = serialized(example<TypeParam>());
  const auto message = this->deserialize(bytes);
  ASSERT_TRUE(message);
  EXPECT_EQ(serialized(*message), bytes);
  EXPECT_TRUE(this->refusals_.empty());
}

// Zero copy within a process depends on it.
TYPED_TEST(BoundedMessagesTest, HasTheTypeOfTheMessage) { EXPECT_EQ(this->helper_->getTypeInfo(), typeid(TypeParam)); }

TYPED_TEST(BoundedMessagesTest, ForgedLengthsTakeNoMemory) {
  const Bytes bytes = serialized(example<TypeParam>());
  for (const size_t position : lengths<TypeParam>()) {
    for (const std::uint32_t forged : kForged) {
      const Bytes message = withLength(bytes, position, forged);
      const sweep_guard_core::Allocations allocations;
      EXPECT_FALSE(this->deserialize(message));
      EXPECT_LT(allocations.largest(), 10000U) << allocations.stacks();
    }
  }
  EXPECT_EQ(this->refusals_.size(), lengths<TypeParam>().size() * std::size(kForged));
}

class MessageSizeTest : public BoundedMessagesTest<sweep_guard::MeshVertices> {};

TEST_F(MessageSizeTest, RefusesAMessageThatIsTooLong) {
  sweep_guard::MeshVertices message;
  const size_t empty = serialized(message).size();
  message.positions.resize((kMaxSize - empty) / sizeof(float));
  EXPECT_TRUE(deserialize(serialized(message)));
  message.positions.resize(message.positions.size() + 1);
  EXPECT_FALSE(deserialize(serialized(message)));
  ASSERT_EQ(refusals_.size(), 1U);
  EXPECT_TRUE(has(refusals_[0], "exceeds the limit of "));
}

// roscpp keeps the helper for as long as another subscriber holds a message.
TEST_F(MessageSizeTest, ReportsNothingOnceItIsClosed) {
  helper_->close();
  EXPECT_FALSE(deserialize({}));
  EXPECT_TRUE(refusals_.empty());
}

// roscpp has the helper of one subscription read for all of the topic, also if that was closed.
TEST_F(MessageSizeTest, ARefusalIsReportedToEverySubscriptionToTheTopic) {
  std::vector<std::string> of_another;
  std::vector<std::string> of_another_topic;
  const auto another = helper("/topic", of_another);
  const auto another_topic = helper("/another", of_another_topic);
  EXPECT_FALSE(deserialize({}));
  EXPECT_EQ(refusals_.size(), 1U);
  EXPECT_EQ(of_another, refusals_);
  helper_->close();
  EXPECT_FALSE(deserialize({}));
  EXPECT_EQ(refusals_.size(), 1U);
  EXPECT_EQ(of_another.size(), 2U);
  EXPECT_TRUE(of_another_topic.empty());
}

using CheckSweepSpec = ros::ServiceSpec<sweep_guard::CheckSweepRequest, sweep_guard::CheckSweepResponse>;

struct Answer {
  bool sent;
  bool called;
  std::string refusal;
};

Answer call(
    const Bytes& request, size_t max_size = kMaxSize, const std::function<void()>& admit = [] {}) {
  Answer answer{};
  const auto refuse = [&](const std::string& reason, sweep_guard::CheckSweepResponse& response) {
    answer.refusal = reason;
    response.message = reason;
    return true;
  };
  const auto check_sweep = [&](sweep_guard::CheckSweepRequest& /*request*/, auto& /*response*/) {
    return answer.called = true;
  };
  BoundedCalls<CheckSweepSpec> calls(check_sweep, refuse, max_size, admit);
  ros::ServiceCallbackHelperCallParams params;
  const boost::shared_array<std::uint8_t> buffer(new std::uint8_t[request.size() + 1]);
  std::copy(request.begin(), request.end(), buffer.get());
  params.request = ros::SerializedMessage(buffer, request.size());
  params.request.message_start = buffer.get();
  answer.sent = calls.call(params);
  return answer;
}

TEST(BoundedCallsTest, CallsTheServiceWithAGoodRequest) {
  const Answer answer = call(serialized(example<sweep_guard::CheckSweepRequest>()));
  EXPECT_TRUE(answer.called);
  EXPECT_TRUE(answer.sent);
}

TEST(BoundedCallsTest, AnswersAForgedRequestWithTheReason) {
  const Bytes request = serialized(example<sweep_guard::CheckSweepRequest>());
  for (const size_t position : lengths<sweep_guard::CheckSweepRequest>()) {
    const Answer answer = call(withLength(request, position, 0x40000001));
    EXPECT_FALSE(answer.called);
    EXPECT_TRUE(answer.sent);
    EXPECT_TRUE(has(answer.refusal, "announces 1073741825 elements"));
  }
  EXPECT_TRUE(has(call(request, request.size() - 1).refusal, "exceeds the limit of "));
}

TEST(BoundedCallsTest, ReadsNoRequestThatIsNotAdmitted) {
  const auto busy = [] { throw sweep_guard_core::Error("busy"); };
  const Answer answer = call(serialized(example<sweep_guard::CheckSweepRequest>()), /*max_size=*/0, busy);
  EXPECT_FALSE(answer.called);
  EXPECT_TRUE(answer.sent);
  EXPECT_EQ(answer.refusal, "busy");
}

}  // namespace
}  // namespace sweep_guard_ros
