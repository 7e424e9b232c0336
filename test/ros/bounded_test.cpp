#include "ros/connection/bounded.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Empty.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Acknowledge.h>
#include <sweep_guard/Attach.h>
#include <sweep_guard/CheckSweep.h>
#include <sweep_guard/CheckTrajectory.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/Predict.h>
#include <sweep_guard/Proximity.h>
#include <sweep_guard/SetIntent.h>
#include <sweep_guard/ToolBalls.h>
#include <sweep_guard/ToolBodies.h>
#include <sweep_guard/ToolSurface.h>
#include <sweep_guard/Warning.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>

#include "allocations.h"
#include "refusal.h"

namespace sweep_guard_ros {

struct Pings {
  std::vector<std_msgs::Empty> pings;
};

}  // namespace sweep_guard_ros

template <>
struct ros::serialization::Serializer<sweep_guard_ros::Pings> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.pings);
  }
};

namespace sweep_guard_ros {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kForged[] = {0x40000001, 0x20000001, 0x15555556, 0x7fffffff, 0x80000000, 0xffffffff};
constexpr size_t kMaxSize = 1U << 20;

// Fills a message: its strings and arrays get one, two, three and no elements in turn.
class Filler {
 public:
  // @param begin  size of the first
  explicit Filler(size_t begin) : size_(begin) {}

  template <typename Field>
  void next(Field& field) {
    if constexpr (ros::message_traits::IsSimple<Field>::value) {
      std::memset(static_cast<void*>(&field), 0x5a, sizeof field);
    } else {
      ros::serialization::Serializer<Field>::template allInOne<Filler, Field&>(*this, field);
    }
  }
  void next(std::string& text) { text.assign(nextSize(), 'x'); }
  template <typename Element>
  void next(std::vector<Element>& array) {
    array.resize(nextSize());
    for (Element& element : array) next(element);
  }
  template <typename Element, size_t kSize>
  void next(boost::array<Element, kSize>& array) {
    for (Element& element : array) next(element);
  }

 private:
  size_t nextSize() { return size_++ % 4; }

  size_t size_;
};

// The n-th of kExamples different messages.
template <typename Msg>
Msg example(size_t n = 1) {
  Msg message;
  Filler(n).next(message);
  return message;
}
constexpr size_t kExamples = 4;

// Finds where the lengths of strings and arrays are in the bytes of a message.
class LengthFinder {
 public:
  template <typename Field>
  void next(const Field& field) {
    if constexpr (ros::message_traits::IsSimple<Field>::value) {
      position_ += sizeof field;
    } else {
      ros::serialization::Serializer<Field>::template allInOne<LengthFinder, const Field&>(*this, field);
    }
  }
  void next(const std::string& text) {
    addLength();
    position_ += text.size();
  }
  template <typename Element>
  void next(const std::vector<Element>& array) {
    addLength();
    for (const Element& element : array) next(element);
  }
  template <typename Element, size_t kSize>
  void next(const boost::array<Element, kSize>& array) {
    for (const Element& element : array) next(element);
  }

  [[nodiscard]] const std::vector<size_t>& found() const { return found_; }

 private:
  void addLength() {
    found_.push_back(position_);
    position_ += sizeof(std::uint32_t);
  }

  size_t position_ = 0;
  std::vector<size_t> found_;
};

template <typename Msg>
std::vector<size_t> lengths(const Msg& message) {
  LengthFinder finder;
  finder.next(message);
  return finder.found();
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
  EXPECT_NO_THROW(check<TypeParam>(serialized(TypeParam())));
  for (size_t n = 0; n < kExamples; ++n) EXPECT_NO_THROW(check<TypeParam>(serialized(example<TypeParam>(n)))) << n;
}

TYPED_TEST(WireTest, TakesNoMemory) {
  const Bytes bytes = serialized(example<TypeParam>());
  checkLengths<TypeParam>({bytes.data(), bytes.size()});
  const sweep_guard_core::Allocations allocations;
  checkLengths<TypeParam>({bytes.data(), bytes.size()});
  EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
}

TYPED_TEST(WireTest, RefusesEveryTruncation) {
  for (size_t n = 0; n < kExamples; ++n) {
    const Bytes bytes = serialized(example<TypeParam>(n));
    for (size_t size = 0; size < bytes.size(); ++size) {
      const auto cut = bytes.begin() + static_cast<std::ptrdiff_t>(size);
      EXPECT_THROW(check<TypeParam>(Bytes(bytes.begin(), cut)), sweep_guard_core::InvalidInput) << size << " of " << n;
    }
  }
}

TYPED_TEST(WireTest, RefusesBytesThatAreLeftOver) {
  for (size_t n = 0; n < kExamples; ++n) {
    Bytes bytes = serialized(example<TypeParam>(n));
    bytes.push_back(0);
    EXPECT_THROW(check<TypeParam>(bytes), sweep_guard_core::InvalidInput) << n;
  }
}

// 0x40000001 floats are 4 bytes in 32 bits, 0x20000001 doubles 8, 0x15555556 triangles 8.
TYPED_TEST(WireTest, RefusesForgedLengths) {
  for (size_t n = 0; n < kExamples; ++n) {
    const auto message = example<TypeParam>(n);
    const Bytes bytes = serialized(message);
    for (const size_t position : lengths(message)) {
      ASSERT_LE(lengthAt(bytes, position), 3U) << "no length at " << position;
      for (const std::uint32_t forged : kForged) {
        EXPECT_THROW(check<TypeParam>(withLength(bytes, position, forged)), sweep_guard_core::InvalidInput)
            << forged << " at " << position << " of " << n;
      }
      const std::uint32_t one_more = lengthAt(bytes, position) + 1;
      EXPECT_THROW(check<TypeParam>(withLength(bytes, position, one_more)), sweep_guard_core::InvalidInput)
          << position << " of " << n;
    }
  }
}

template <typename Msg>
std::string refusalOf(const Bytes& bytes) {
  return refusal([&] { check<Msg>(bytes); });
}

TEST(WireRefusalTest, NamesBothCounts) {
  Bytes twist = serialized(geometry_msgs::Twist());
  twist.pop_back();
  EXPECT_EQ(refusalOf<geometry_msgs::Twist>(twist), "message is cut off: it takes 48 bytes and holds 47 bytes");
  Bytes names = serialized(sensor_msgs::JointState());
  ASSERT_EQ(names.size(), 32U);
  names.pop_back();
  EXPECT_EQ(refusalOf<sensor_msgs::JointState>(names),
            "message is cut off: it takes at least 32 bytes and holds 31 bytes");
  EXPECT_EQ(refusalOf<sensor_msgs::JointState>(withLength(names, 20, 1)),
            "message announces 1 elements and holds 7 bytes");
  names.resize(33);
  EXPECT_EQ(refusalOf<sensor_msgs::JointState>(names),
            "message is too long for its type: it takes 32 bytes and holds 33 bytes");
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
  const size_t triangles = positions + 1 + 4;  // `open` and the length of `refused`
  for (const size_t position : {triangles, triangles + 4 + 12}) {
    EXPECT_NO_THROW(check<sweep_guard::DeformableMesh>(withLength(serialized(mesh), position, 1)));
    for (const std::uint32_t forged : {0x40000001U, 0x20000001U}) {
      EXPECT_THROW(check<sweep_guard::DeformableMesh>(withLength(serialized(mesh), position, forged)),
                   sweep_guard_core::InvalidInput);
    }
  }
}

// An element without fields takes no byte of the message, and one of the memory.
TEST(EmptyElementsTest, AreNoMoreThanTheBytesThatFollow) {
  EXPECT_EQ(refusalOf<Pings>({0, 0, 0, 0}), "");
  EXPECT_EQ(refusalOf<Pings>({0xff, 0xff, 0xff, 0xff}), "message announces 4294967295 elements and holds 0 bytes");
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
  const auto example_message = example<TypeParam>();
  const std::vector<size_t> positions = lengths(example_message);
  for (const size_t position : positions) {
    for (const std::uint32_t forged : kForged) {
      const Bytes message = withLength(serialized(example_message), position, forged);
      const sweep_guard_core::Allocations allocations;
      EXPECT_FALSE(this->deserialize(message));
      EXPECT_LT(allocations.largest(), 10000U) << allocations.stacks();
    }
  }
  EXPECT_EQ(this->refusals_.size(), positions.size() * std::size(kForged));
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
  const auto message = example<sweep_guard::CheckSweepRequest>();
  const Bytes request = serialized(message);
  for (const size_t position : lengths(message)) {
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
