#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "evaluation/motions.h"
#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

struct Outcome {
  int status;
  std::string out;  ///< stdout and stderr
};

/// The program itself, in a folder of its own.
class EvaluatePredictionTest : public testing::Test {
 protected:
  EvaluatePredictionTest()
      : folder_(std::filesystem::path(testing::TempDir()) /
                (std::string("evaluate_prediction_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
  ~EvaluatePredictionTest() override { std::filesystem::remove_all(folder_); }

  Outcome run(const std::string& arguments) const { return runProgram(EVALUATE_PREDICTION, arguments); }

  Outcome runProgram(const std::string& program, const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && " + program + " " + arguments + " 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    Outcome outcome{};
    std::array<char, 4096> part;
    for (size_t count = 0; (count = std::fread(part.data(), 1, part.size(), pipe)) > 0;) {
      outcome.out.append(part.data(), count);
    }
    const int status = pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// To and fro along x, 0.2 m wide, for 20 s at 50 Hz.
  void writeMotion(const std::string& name) const {
    std::ofstream file(folder_ / name);
    for (int i = 0; i <= 1000; ++i) {
      file << 0.02 * i << ' ' << 0.1 * std::sin(0.03 * i) << " 0 0 0 0.7071 0 0.7071\n";
    }
  }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  void expectOneLine(const std::string& arguments, const std::string& expected) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
    EXPECT_EQ(outcome.out.find("evaluate_prediction: "), 0U) << outcome.out;
    EXPECT_TRUE(has(outcome.out, expected));
  }

  std::filesystem::path folder_;
};

TEST_F(EvaluatePredictionTest, SaysWhatItDoes) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out.find("Usage: evaluate_prediction"), 0U);
}

TEST_F(EvaluatePredictionTest, RefusesBadInputInOneLine) {
  write("empty.txt", "");
  write("words.txt", "this is no motion\n");
  write("back.txt", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n");
  write("broken.bag", "#ROSBAG V2.0\nnothing of that kind");
  write("old.bag", "#ROSBAG V1.0\n");
  writeMotion("good.txt");
  expectOneLine("", "no recording");
  expectOneLine("--no-such-option good.txt", "--no-such-option");
  expectOneLine("nowhere.txt", "nowhere.txt: no such file");
  expectOneLine(".", "not a regular file");
  expectOneLine("/dev/zero", "not a regular file");
  expectOneLine("empty.txt", "no pose in the file");
  expectOneLine("good.txt words.txt", "words.txt:1: ");
  expectOneLine("back.txt", "back.txt:2: stamp is earlier");
  expectOneLine("broken.bag", "broken.bag: the bag ");
  expectOneLine("old.bag", "old.bag: the bag ");
  expectOneLine("--csv nowhere/errors.csv good.txt", "nowhere/errors.csv: cannot be written");
  expectOneLine("--predictors psychic good.txt", "psychic");
}

TEST_F(EvaluatePredictionTest, PrintsATableOfEveryPredictor) {
  writeMotion("hand.txt");
  const Outcome outcome = run("--placements 4 hand.txt");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  for (const char* const word :
       {"hand", "hold", "constant_velocity", "polynomial", "direct", "position", "rotation", "reflex", "considered"}) {
    EXPECT_TRUE(has(outcome.out, word));
  }
}

TEST_F(EvaluatePredictionTest, WritesTheSameErrorsEveryTime) {
  writeMotion("hand.txt");
  writeMotion("arm.txt");
  ASSERT_EQ(run("--csv first.csv hand.txt arm.txt").status, 0);
  ASSERT_EQ(run("--csv again.csv hand.txt arm.txt").status, 0);
  const std::string csv = read("first.csv");
  EXPECT_EQ(csv, read("again.csv"));
  EXPECT_EQ(csv.find("recording,predictor,horizon_s,position_median_m,position_p95_m,rotation_median_rad,"
                     "rotation_p95_rad,samples\nhand,"),
            0U);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 4 * 4);
  EXPECT_TRUE(has(csv, "\narm,hold,0.5,"));
}

TEST_F(EvaluatePredictionTest, WritesTheSameWarningsForTheSameSeed) {
  writeMotion("hand.txt");
  ASSERT_EQ(
      run("--predictors hold,direct --placements 6 --warnings-csv first.csv --tradeoff-csv curve.csv hand.txt").status,
      0);
  ASSERT_EQ(run("--predictors hold,direct --placements 6 --warnings-csv again.csv --seed 1 hand.txt").status, 0);
  ASSERT_EQ(run("--predictors hold,direct --placements 6 --warnings-csv other.csv --seed 2 hand.txt").status, 0);
  const std::string csv = read("first.csv");
  EXPECT_EQ(csv, read("again.csv"));
  EXPECT_NE(csv, read("other.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2);
  EXPECT_TRUE(has(csv, "\nhand,direct,reflex,3,3,"));
  EXPECT_TRUE(has(read("curve.csv"), "\nhand,direct,0.001,"));
}

TEST_F(EvaluatePredictionTest, CountsTheSameSessionsEveryTimeAndComparesThem) {
  writeMotion("hand.txt");
  const std::string sessions = "--session-count 2 --sheets 4 hand.txt ";
  ASSERT_EQ(run(sessions + "--sessions-csv first.csv --sessions-objects-csv objects.csv").status, 0);
  const Outcome again = run(sessions + "--sessions-csv again.csv --compare-sessions objects.csv");
  EXPECT_EQ(again.status, 0) << again.out;
  const std::string csv = read("first.csv");
  EXPECT_EQ(csv, read("again.csv"));
  EXPECT_EQ(csv.find("recording,minutes,contacts,warned_0.1,warned_0.3,warned_0.5,warned_1.0,unjustified_per_min,"
                     "precision,precision_10mm,precision_20mm,precision_50mm,false_on_share\nhand,2.66667,"),
            0U);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_TRUE(has(again.out, "ratio    1.000  [1.000, 1.000]"));
  expectOneLine("--compare-sessions first.csv hand.txt", "first.csv: line 1");
}

TEST_F(EvaluatePredictionTest, FindsThresholdsForAWantedRate) {
  writeMotion("hand.txt");
  const Outcome outcome = run("--session-count 1 --sheets 4 --tune 100 --tune-csv curve.csv hand.txt");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "\nwarning:\n  considered_on: 0.002\n  considered_off: 0.002\n"));
  EXPECT_EQ(read("curve.csv").find("considered_on,considered_off,reflex_probability,unjustified_per_min,"), 0U);
}

TEST_F(EvaluatePredictionTest, ShowsHowHonestTheProbabilitiesAre) {
  writeMotion("hand.txt");
  writeMotion("arm.txt");
  const Outcome outcome = run("--session-count 1 --sheets 4 --calibration hand.txt arm.txt");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "probability of a contact within 0.1 s"));
  EXPECT_TRUE(has(outcome.out, "probability of a contact within 1 s"));
}

TEST_F(EvaluatePredictionTest, CountsSessionsBesideMeshes) {
  writeMotion("hand.txt");
  write("roof.obj", "v -10 -30 80\nv -10 30 80\nv 70 0 80\nf 1 2 3\n");
  const std::string meshes = "--sheets 0 --session-count 1 --mesh-scale 0.001 --sessions-csv s.csv hand.txt ";
  ASSERT_EQ(run(meshes + "--mesh roof.obj --fixed-mesh roof.obj --fixed-mesh roof.obj").status, 0);
  EXPECT_TRUE(has(read("s.csv"), "\nhand,1,"));
  expectOneLine(meshes + "--mesh nowhere.stl", "nowhere.stl");
}

TEST_F(EvaluatePredictionTest, WritesWhatCanBeDrawn) {
  writeMotion("it's a hand.txt");
  const std::string files =
      "--csv errors.csv --tradeoff-csv tradeoff.csv --calibration-csv calibration.csv --sessions-csv sessions.csv "
      "--tune 2 "
      "--tune-csv tuning.csv ";
  const Outcome outcome = run("--predictors direct --placements 2 --sheets 2 --session-count 1 " + files + "*.txt");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  for (const std::string name : {"errors", "tradeoff", "calibration", "sessions", "tuning"}) {
    const Outcome drawn = runProgram(SWEEP_GUARD_SOURCE_DIR "/scripts/plot.py", name + ".csv " + name + ".png");
    EXPECT_EQ(drawn.status, 0) << drawn.out;
    EXPECT_EQ(read(name + ".png").substr(1, 3), "PNG");
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 11);
}

TEST_F(EvaluatePredictionTest, DoesNotOverwriteARecording) {
  writeMotion("hand.txt");
  const std::string before = read("hand.txt");
  expectOneLine("--csv hand.txt hand.txt", "hand.txt: is an input");
  EXPECT_EQ(read("hand.txt"), before);
}

}  // namespace
}  // namespace sweep_guard_evaluation
