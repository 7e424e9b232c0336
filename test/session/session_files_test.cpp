#include "session/session_files.h"

#include <gtest/gtest.h>
#include <std_msgs/Header.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "refusal.h"

namespace sweep_guard_session {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using sweep_guard_core::Time;

class SessionFilesTest : public testing::Test {
 protected:
  SessionFilesTest() : folder_(fs::path(testing::TempDir()) / ("session files " + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~SessionFilesTest() override { fs::remove_all(folder_); }

  // Each message has its second as sequence number.
  std::string write(const std::string& name, const std::string& topic, const std::vector<int>& at) const {
    rosbag::Bag bag((folder_ / name).string(), rosbag::bagmode::Write);
    for (const int second : at) {
      std_msgs::Header message;
      message.seq = static_cast<std::uint32_t>(second);
      bag.write(topic, ros::Time(second), message);
    }
    return (folder_ / name).string();
  }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

std::vector<std::uint32_t> read(const SessionFiles& files, const std::vector<std::string>& topics, int from, int to) {
  std::vector<std::uint32_t> sequence;
  files.forEach(topics, Time(seconds(from)), Time(seconds(to)), [&sequence](const rosbag::MessageInstance& message) {
    sequence.push_back(message.instantiate<std_msgs::Header>()->seq);
  });
  return sequence;
}

TEST_F(SessionFilesTest, AListHasColonsBetweenItsFiles) {
  using Files = std::vector<std::string>;
  EXPECT_EQ(bagFiles("a.bag", "/x"), Files{"/x/a.bag"});
  EXPECT_EQ(bagFiles("/y/a.bag", "/x"), Files{"/y/a.bag"});
  EXPECT_EQ(bagFiles("/y/a b.bag:c d.bag:../e.bag", "/x"), (Files{"/y/a b.bag", "/x/c d.bag", "/x/../e.bag"}));
}

TEST_F(SessionFilesTest, AFileMayHaveAColonInItsName) {
  write("10:30.bag", "/a", {1});
  EXPECT_EQ(bagFiles("10:30.bag", folder_.string()), std::vector<std::string>{in("10:30.bag")});
  EXPECT_EQ(bagFiles("10:31.bag", folder_.string()).size(), 2U);
}

TEST_F(SessionFilesTest, PartsAreReadInTheOrderOfTheirMessages) {
  const std::string first = write("first.bag", "/a", {1, 2, 5});
  const std::string second = write("second.bag", "/b", {3, 4, 6});
  const std::string third = write("third.bag", "/a", {7, 8});
  const SessionFiles files({third, second, first});
  EXPECT_EQ(files.begin(), Time(seconds(1)));
  EXPECT_EQ(files.end(), Time(seconds(8)));
  EXPECT_EQ(files.types().size(), 2U);
  EXPECT_EQ(files.count("/a"), 5U);
  EXPECT_EQ(files.count("/c"), 0U);
  using Sequence = std::vector<std::uint32_t>;
  EXPECT_EQ(read(files, {"/a", "/b"}, 0, 9), (Sequence{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(read(files, {"/a"}, 2, 7), (Sequence{2, 5, 7}));
  EXPECT_EQ(read(files, {"/b"}, 4, 5), Sequence{4});
  EXPECT_EQ(files.name(), third + " and 2 more");
}

TEST_F(SessionFilesTest, NamesThePartThatCannotBeRead) {
  const std::string good = write("good.bag", "/a", {1});
  const std::string empty = write("empty.bag", "/a", {});
  std::ofstream(in("text.bag")) << "no bag";
  EXPECT_TRUE(has(refusal([&] { SessionFiles({good, in("none.bag")}); }), in("none.bag") + ": no such file"));
  EXPECT_TRUE(has(refusal([&] { SessionFiles({good, in("text.bag")}); }), in("text.bag") + ": not a rosbag"));
  EXPECT_TRUE(has(refusal([&] { SessionFiles({good, folder_.string()}); }), folder_.string() + ": not a regular file"));
  EXPECT_TRUE(has(refusal([&] { SessionFiles({empty}); }), empty + ": the bag is empty"));
  EXPECT_EQ(refusal([&] { SessionFiles({empty, good}); }), "");
}

}  // namespace
}  // namespace sweep_guard_session
