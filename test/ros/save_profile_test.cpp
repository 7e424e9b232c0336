// What a guard has learned of its operator is saved, and another guard begins with it. The test is the clock.
#include <signal.h>
#include <sweep_guard/SaveProfile.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "child_process.h"
#include "guard_probe.h"
#include "guard_process.h"
#include "refusal.h"
#include "ros/profile_file.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::SaveProfile;

constexpr double kStep = 0.01;   // [s]
constexpr double kRate = 6.0;    // of the swing [1/s]
constexpr double kWidth = 0.05;  // [m]

size_t filesIn(const std::filesystem::path& folder) {
  return static_cast<size_t>(std::distance(std::filesystem::recursive_directory_iterator(folder), {}));
}

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A guard in a process of its own, above a square that it never meets.
class GuardWithOperator {
 public:
  GuardWithOperator(const std::vector<std::string>& arguments, const std::filesystem::path& home)
      : guard_(commandLine(arguments), {"ROS_HOME=" + home.string()}) {
    probe_.place(squareAt("square", {0, 0, -5}, probe_.time()));
  }

  // Swings up and down from the middle. Returns the height predicted a second ahead, above the newest one.
  double swing(double seconds) {
    double predicted = 0.0;
    for (double t = 0.0; t <= seconds; t += kStep) {
      probe_.tick(kStep);
      const double height = kWidth * std::sin(kRate * t);
      probe_.publish(poseAt({0, 0, height}, probe_.time()));
      const sweep_guard::Prediction prediction = probe_.awaitPrediction(probe_.time());
      if (prediction.valid) predicted = prediction.poses.back().pose.position.z - height;
    }
    return predicted;
  }

  SaveProfile::Response save(const std::string& name) {
    SaveProfile call;
    call.request.name = name;
    EXPECT_TRUE(ros::service::call("/sweep_guard/save_profile", call));
    return call.response;
  }

  void reset() { EXPECT_TRUE(probe_.reset().success); }

  ~GuardWithOperator() {
    guard_.signal(SIGINT);
    EXPECT_EQ(guard_.wait(), 0) << guard_.output();
  }

 private:
  static std::vector<std::string> commandLine(std::vector<std::string> arguments) {
    for (const char* const patient :
         {"_timing/mesh_timeout:=inf", "_timing/pose_timeout:=1.0", "_timing/min_rate:=1.0", "_detector:=halfspace"}) {
      arguments.emplace_back(patient);
    }
    return guardWith(arguments);
  }

  ChildProcess guard_;
  GuardProbe probe_{/*drives_clock=*/true};
};

class SaveProfileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(home_);
    std::filesystem::create_directories(home_);
  }
  void TearDown() override {
    ros::param::del("/sweep_guard");
    std::filesystem::remove_all(home_);
  }

  const std::filesystem::path home_ =
      std::filesystem::path(testing::TempDir()) / ("save_profile_" + std::to_string(getpid()));
};

// A quick swing: at its middle the velocity does not carry far, and only who has learned that knows it.
TEST_F(SaveProfileTest, WhatOneGuardHasLearnedIsWhereTheNextOneAndAResetBegin) {
  const double kBegin = 0.05;  // [s]
  double at_constant_velocity = 0.0;
  SaveProfile::Response saved;
  {
    GuardWithOperator guard({}, home_);
    at_constant_velocity = guard.swing(kBegin);
    EXPECT_TRUE(has(guard.save("anna").message, "too little motion yet"));
    guard.swing(10.0);
    saved = guard.save("anna");
    ASSERT_TRUE(saved.success) << saved.message;
    EXPECT_EQ(saved.path, (home_ / "sweep_guard" / "anna.profile").string());
    EXPECT_EQ(filesIn(home_ / "sweep_guard"), 1U);
  }
  ros::param::del("/sweep_guard");
  EXPECT_GT(at_constant_velocity, 0.2);
  GuardWithOperator guard({"_prediction/profile:=" + saved.path}, home_);
  EXPECT_LT(std::abs(guard.swing(kBegin)), 0.5 * at_constant_velocity);
  guard.swing(3.0);
  guard.reset();
  EXPECT_LT(std::abs(guard.swing(kBegin)), 0.5 * at_constant_velocity);

  const std::string before = contentOf(saved.path);
  guard.swing(3.0);
  EXPECT_EQ(guard.save("").path, saved.path);
  EXPECT_NE(contentOf(saved.path), before);
  EXPECT_EQ(filesIn(home_ / "sweep_guard"), 1U);
}

TEST_F(SaveProfileTest, ACallerChoosesAPlainNameAndNoPath) {
  GuardWithOperator guard({}, home_);
  guard.swing(3.0);
  EXPECT_TRUE(has(guard.save("").message, "prediction/profile is empty: send a name"));
  for (const std::string& name :
       {std::string("../anna"), std::string("/tmp/anna"), std::string("a/b"), std::string("."), std::string("a.b"),
        std::string("a b"), std::string("a\n"), std::string("a\0b", 3), std::string(65, 'a'), std::string(2000, 'a')}) {
    const SaveProfile::Response response = guard.save(name);
    EXPECT_FALSE(response.success) << name;
    EXPECT_EQ(response.path, "");
  }
  EXPECT_FALSE(std::filesystem::exists(home_ / "sweep_guard"));
}

TEST_F(SaveProfileTest, FilesOfMoreThanAHundredNamesAreRefused) {
  std::filesystem::create_directories(home_ / "sweep_guard");
  for (int i = 0; i < 100; ++i) std::ofstream(home_ / "sweep_guard" / ("p" + std::to_string(i) + ".profile")) << "old";
  GuardWithOperator guard({}, home_);
  guard.swing(3.0);
  EXPECT_TRUE(has(guard.save("anna").message, "has 100 files"));
  EXPECT_TRUE(guard.save("p7").success);
  EXPECT_NE(contentOf(home_ / "sweep_guard" / "p7.profile"), "old");
  EXPECT_EQ(filesIn(home_ / "sweep_guard"), 100U);
}

TEST_F(SaveProfileTest, APredictorThatLearnsNothingHasNoProfile) {
  GuardWithOperator guard({"_prediction/predictor:=hold"}, home_);
  guard.swing(0.1);
  EXPECT_TRUE(has(guard.save("anna").message, "set prediction/predictor to direct"));
}

TEST_F(SaveProfileTest, AFileThatIsNoProfileStopsTheNodeWithOneLineAndStatusTwo) {
  const std::string words = home_ / "words.profile";
  std::ofstream(words) << "this is no profile\n";
  const std::string huge = home_ / "huge.profile";
  std::ofstream(huge) << std::string(sweep_guard_core::kMaxProfileSize + 1, 'a');
  for (const auto& [file, expected] : {std::pair<std::string, std::string>{words, "line 1 of the profile"},
                                       {huge, "is larger than"},
                                       {home_, "is not a regular file"},
                                       {"/dev/zero", "is not a regular file"},
                                       {home_ / "nowhere.profile", "cannot be opened"},
                                       {"anna.profile", "is not an absolute path"}}) {
    ChildProcess guard(guardWith({"_prediction/profile:=" + file}));
    EXPECT_EQ(guard.wait(), 2) << file;
    const std::string output = guard.output();
    EXPECT_TRUE(has(output, file + ": "));
    EXPECT_TRUE(has(output, expected));
    EXPECT_TRUE(has(output, "or leave prediction/profile empty"));
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
  }
}

TEST_F(SaveProfileTest, AFileThatCannotBeWrittenStaysAndNothingElseRemains) {
  sweep_guard_core::PosePredictor predictor{sweep_guard_core::PredictorOptions()};
  std::filesystem::create_directories(home_ / "taken.profile" / "inside");
  const size_t before = filesIn(home_);
  EXPECT_TRUE(
      has(refusal<sweep_guard_core::Error>([&] { writeProfile(home_ / "taken.profile", *predictor.profile()); }),
          "taken.profile: cannot be written: "));
  EXPECT_EQ(filesIn(home_), before);
}

}  // namespace
}  // namespace sweep_guard_ros
