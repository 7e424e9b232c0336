#include "session/session_config.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "refusal.h"

namespace sweep_guard_session {
namespace {

namespace fs = std::filesystem;

class SessionConfigTest : public testing::Test {
 protected:
  SessionConfigTest() : folder_(fs::path(testing::TempDir()) / ("session config " + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~SessionConfigTest() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << "# The parameters\n" << text;
    return (folder_ / name).string();
  }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(SessionConfigTest, NamesTheFileThatIsUsed) {
  const std::string config = write("black_box_1.yaml", "\"fixed_frame\": \"world\"\n");
  EXPECT_EQ(describeConfig(config, {in("black_box_1.bag")}), std::vector<std::string>{config});
  EXPECT_EQ(describeConfig("/my/guard.yaml", {in("black_box_1.bag")}), std::vector<std::string>{"/my/guard.yaml"});
  EXPECT_EQ(describeConfig(config, {in("black_box_1.bag"), in("session.bag")}).size(), 1U);
}

TEST_F(SessionConfigTest, SaysWhatIsDifferentInTheOthers) {
  const std::string config =
      write("black_box_1.yaml", "\"warning\":\n  \"hold_time\": 0.5\n  \"reflex\": 1.0\n\"tool_frame\": \"tip\"\n");
  write("black_box_2.yaml", "\"warning\":\n  \"hold_time\": 0.5\n  \"reflex\": 1.0\n\"tool_frame\": \"tip\"\n");
  write("black_box_3.yaml", "\"tool_frame\": \"tip\"\n\"warning\":\n  \"hold_time\": 2.0\n  \"reflex\": 1.0\n");
  write("black_box_4.yaml", "\"tool\":\n  \"hold_time\": 0.5\n\"tool_frame\": \"tip\"\n");
  const std::vector<std::string> lines = describeConfig(
      config, {in("black_box_1.bag"), in("black_box_2.bag"), in("black_box_3.bag"), in("black_box_4.bag")});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(has(lines[1], in("black_box_3.bag") + ", which is played with warning/hold_time 0.5 instead of 2.0. "))
      << lines[1];
  EXPECT_TRUE(has(lines[2], "tool/hold_time not set instead of 0.5, ")) << lines[2];
  EXPECT_TRUE(has(lines[2], "warning/reflex 1.0 instead of not set")) << lines[2];
}

TEST_F(SessionConfigTest, AKeyMayHaveAColonAndNoQuotes) {
  const std::string config = write("black_box_1.yaml", "\"stiffness_of\":\n  \"left:drill\": 1.0\n");
  write("black_box_2.yaml", "stiffness_of:\n  \"left:drill\": 2.0\n");
  const std::vector<std::string> lines = describeConfig(config, {in("black_box_1.bag"), in("black_box_2.bag")});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(has(lines[1], "with stiffness_of/left:drill 1.0 instead of 2.0")) << lines[1];
}

TEST_F(SessionConfigTest, NamesOnlyTheFirstOfManyDifferencesAndCutsLongValues) {
  std::string text;
  for (int i = 0; i < 9; ++i) text += "\"p" + std::to_string(i) + "\": 1\n";
  const std::string config = write("black_box_1.yaml", text);
  write("black_box_2.yaml", "\"robot_description\": \"" + std::string(10000, 'x') + "\"\n");
  const std::vector<std::string> lines = describeConfig(config, {in("black_box_2.bag"), in("black_box_1.bag")});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(has(lines[1], "p4 1 instead of not set, and 5 more")) << lines[1];
  write("black_box_2.yaml", text + "\"robot_description\": \"" + std::string(10000, 'x') + "\"\n");
  EXPECT_LT(describeConfig(config, {in("black_box_2.bag"), in("black_box_1.bag")}).at(1).size(), 500U);
}

}  // namespace
}  // namespace sweep_guard_session
