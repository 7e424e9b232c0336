#include "ros/black_box/bag_file.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <signal.h>
#include <std_msgs/String.h>
#include <sweep_guard/MeshVertices.h>
#include <sys/resource.h>
#include <unistd.h>

#include <boost/make_shared.hpp>
#include <iterator>

#include "ros/black_box/guard_config.h"
#include "ros/black_box/message_key.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr std::size_t kMessages = 200;
constexpr std::size_t kLength = 10000;  // [bytes]

template <typename Msg>
std::vector<std::uint8_t> bytesOf(const Msg& msg) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(msg));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, msg);
  return bytes;
}

HeardMessages heard() {
  std_msgs::String text;
  text.data = std::string(kLength, 'x');
  std::vector<std::uint8_t> bytes = bytesOf(text);
  const auto header =
      boost::make_shared<ros::M_string>(ros::M_string{{"callerid", "/camera"}, {"topic", "/liver"}, {"latching", "1"}});
  HeardMessages messages;
  for (std::size_t i = 0; i < kMessages; ++i) {
    const auto message = boost::make_shared<topic_tools::ShapeShifter>();
    message->morph(ros::message_traits::md5sum(text), ros::message_traits::datatype(text),
                   ros::message_traits::definition(text), "1");
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    message->read(stream);
    const auto time = sweep_guard_core::Time(std::chrono::seconds(1000) + i * std::chrono::nanoseconds(1));
    messages.push_back({time, kLength, "", {"/mesh", message, header}});
  }
  return messages;
}

class BagFileTest : public ::testing::Test {
 protected:
  ~BagFileTest() override { std::filesystem::remove(file_); }
  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("bag_file_test_" + std::to_string(getpid()) + ".bag.active");
};

TEST_F(BagFileTest, HasAllMessagesInTheirOrderWithTheirTimesAndSenders) {
  const HeardMessages messages = heard();
  writeBag(file_, messages);
  const rosbag::Bag bag(file_.string());
  std::uint32_t next = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    EXPECT_EQ(message.getTime(), ros::Time(1000, next++));
    EXPECT_EQ(message.getTopic(), "/mesh");
    EXPECT_EQ(message.getCallerId(), "/camera");
    EXPECT_TRUE(message.isLatching());
    EXPECT_EQ(message.getConnectionHeader()->at("original_topic"), "/liver");
    EXPECT_EQ(message.instantiate<std_msgs::String>()->data.size(), kLength);
  }
  EXPECT_EQ(next, kMessages);
  EXPECT_LE(std::filesystem::file_size(file_), bagSize(messages));
}

std::ptrdiff_t openFiles() {
  const std::filesystem::directory_iterator descriptors("/proc/self/fd");
  return std::distance(begin(descriptors), end(descriptors));
}

// Wherever the disk becomes full, that is an error: none is taken for a whole bag, and none stays open. The folder is reached
// by a symbolic link, as a home may be.
TEST_F(BagFileTest, ADiskThatBecomesFullIsAnErrorWhereverThatHappens) {
  const HeardMessages messages = heard();
  const std::filesystem::path link = file_.string() + ".folder";
  std::filesystem::create_directory_symlink(file_.parent_path(), link);
  const std::filesystem::path file = link / file_.filename();
  writeBag(file, messages);
  const std::uintmax_t size = std::filesystem::file_size(file);
  const std::ptrdiff_t open = openFiles();
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  for (const std::uintmax_t limit : {std::uintmax_t(1), size / 3, size - 1}) {
    rlimit small = before;
    small.rlim_cur = limit;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(writeBag(file, messages), sweep_guard_core::DeviceError) << limit << " of " << size;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  }
  signal(SIGXFSZ, handler);
  EXPECT_EQ(openFiles(), open);
  std::filesystem::remove(link);
}

TEST(MessageKeyTest, VerticesDependOnTheMeshOfTheirWorkpiece) {
  sweep_guard::MeshVertices vertices;
  vertices.header.seq = 7;
  vertices.header.frame_id = "table";
  vertices.id = "liver";
  vertices.positions.assign(30, 1.0F);
  const std::vector<std::uint8_t> bytes = bytesOf(vertices);
  const auto keyOf = [&](KeptMessages kept, std::size_t size) {
    return messageKey({"/v", "/mesh_vertices", kept}, "/camera", {bytes.data(), size});
  };
  EXPECT_EQ(keyOf(KeptMessages::kEachMesh, bytes.size()), "workpiece liver");
  EXPECT_EQ(keyOf(KeptMessages::kEachVertices, bytes.size()), "workpiece liver\nvertices");
  EXPECT_EQ(keyOf(KeptMessages::kNewest, bytes.size()), "/mesh_vertices /camera");
  vertices.positions.clear();  // as they were: it replaces no positions
  const std::vector<std::uint8_t> unchanged = bytesOf(vertices);
  EXPECT_EQ(messageKey({"/v", "/mesh_vertices", KeptMessages::kEachVertices}, "/camera",
                       {unchanged.data(), unchanged.size()}),
            "");
  for (std::size_t size = 0; size < 30; ++size) EXPECT_EQ(keyOf(KeptMessages::kEachMesh, size), "") << size;
  for (std::size_t size = 0; size < 30; ++size) EXPECT_EQ(keyOf(KeptMessages::kEachTransform, size), "") << size;
}

TEST(GuardConfigTest, NumbersAndTextsAreReadAsTheyWere) {
  XmlRpc::XmlRpcValue value;
  value["rate"] = 1e-5;
  value["whole"] = 2.0;
  value["count"] = 3;
  value["forever"] = std::numeric_limits<double>::infinity();
  value["tool"]["text"] = "a \"b\"\n: # c\\";
  value["tool"]["links"][0] = "hand";
  EXPECT_EQ(toYaml(value),
            "\"count\": 3\n\"forever\": .inf\n\"rate\": 1.0e-05\n\"tool\":\n  \"links\": [\"hand\"]\n"
            "  \"text\": \"a \\\"b\\\"\\n: # c\\\\\"\n\"whole\": 2.0\n");
}

}  // namespace
}  // namespace sweep_guard_ros
