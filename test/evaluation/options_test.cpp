#include "evaluation/options.h"

#include <gtest/gtest.h>

#include "refusal.h"

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;

Options parse(std::vector<const char*> words) {
  words.insert(words.begin(), "evaluate_prediction");
  return parseOptions(static_cast<int>(words.size()), words.data());
}

std::string refusal(const std::vector<const char*>& words) {
  return ::refusal([&] { parse(words); });
}

TEST(OptionsTest, DefaultToAllPredictorsAndTheirOwnDefaults) {
  const Options options = parse({"a.txt", "b.bag"});
  EXPECT_EQ(options.files, (std::vector<std::string>{"a.txt", "b.bag"}));
  EXPECT_EQ(options.predictors, sweep_guard_core::predictorNames());
  EXPECT_EQ(options.horizons, (std::vector<sweep_guard_core::Duration>{milliseconds(100), milliseconds(200),
                                                                       milliseconds(500), milliseconds(1000)}));
  const sweep_guard_core::PredictorOptions defaults;
  EXPECT_EQ(options.predictor.degree, defaults.degree);
  EXPECT_EQ(options.predictor.window, defaults.window);
  EXPECT_EQ(options.predictor.forgetting_factor, defaults.forgetting_factor);
}

TEST(OptionsTest, TakeListsInAnyOrderAndOnce) {
  const Options options = parse({"--horizons", "0.5,0.1,0.5", "--predictors=hold,direct,hold", "a.txt"});
  EXPECT_EQ(options.horizons, (std::vector<sweep_guard_core::Duration>{milliseconds(100), milliseconds(500)}));
  EXPECT_EQ(options.predictors, (std::vector<std::string>{"hold", "direct"}));
}

TEST(OptionsTest, TakeADegreeForAllAxesOrForEach) {
  EXPECT_EQ(parse({"--degree", "2", "a.txt"}).predictor.degree, (std::array<int, 6>{2, 2, 2, 2, 2, 2}));
  EXPECT_EQ(parse({"--degree", "0,1,2,3,4,5", "a.txt"}).predictor.degree, (std::array<int, 6>{0, 1, 2, 3, 4, 5}));
}

TEST(OptionsTest, CommandsAddThePredictorThatIsToldOfThem) {
  const Options options = parse({"--plant", "0.07,0.03", "a.txt"});
  EXPECT_EQ(options.plant->dead_time, milliseconds(70));
  EXPECT_EQ(options.plant->lag, milliseconds(30));
  EXPECT_EQ(options.predictors.back(), kCommandPredictor);
  EXPECT_EQ(options.session_predictor, kCommandPredictor);
  EXPECT_EQ(parse({"--command", "/servo_cp", "a.bag"}).session_predictor, kCommandPredictor);
  EXPECT_EQ(parse({"--plant", "0,0", "--predictors", "direct,command", "a.txt"}).session_predictor, "direct");
  EXPECT_TRUE(has(refusal({"--predictors", "command", "a.txt"}), "'command' must be one of"));
  EXPECT_TRUE(has(refusal({"--plant", "0.07", "a.txt"}), "--plant"));
  EXPECT_TRUE(has(refusal({"--plant", "0.07,-1", "a.txt"}), "--plant"));
}

TEST(OptionsTest, NameWhatIsWrong) {
  EXPECT_TRUE(has(refusal({}), "no recording"));
  EXPECT_TRUE(has(refusal({"--color", "a.txt"}), "--color"));
  EXPECT_TRUE(has(refusal({"--placement", "9", "a.txt"}), "--placement"));  // no guessing
  EXPECT_TRUE(has(refusal({"a.txt", "--csv"}), "--csv"));
  EXPECT_TRUE(has(refusal({"--predictors", "direct,psychic", "a.txt"}), "'psychic' must be one of"));
  EXPECT_TRUE(has(refusal({"--predictors", "", "a.txt"}), "'' must be one of"));
  for (const char* const horizons : {"0", "-1", "nan", "1e9", "0.1,", "0.1 0.2", "1s"}) {
    EXPECT_TRUE(has(refusal({"--horizons", horizons, "a.txt"}), "--horizons")) << horizons;
  }
  for (const char* const degree : {"6", "-1", "1.5", "1,2", "x"}) {
    EXPECT_TRUE(has(refusal({"--degree", degree, "a.txt"}), "--degree")) << degree;
  }
  for (const char* const option :
       {"--placements", "--seed", "--tool-radius", "--tool-length", "--min-probability", "--hold-time", "--up-to"}) {
    EXPECT_TRUE(has(refusal({option, "-1", "a.txt"}), option));
    EXPECT_TRUE(has(refusal({option, "x", "a.txt"}), option));
  }
  EXPECT_TRUE(has(refusal({"--min-probability", "0", "a.txt"}), "--min-probability"));
  EXPECT_TRUE(has(refusal({"--window", "0", "a.txt"}), "--window"));
  EXPECT_TRUE(has(refusal({"--forgetting-factor", "1.01", "a.txt"}), "--forgetting-factor"));
}

TEST(OptionsTest, RunTheGuardAsTheNodeDoes) {
  const Options options = parse({"a.txt"});
  EXPECT_EQ(options.simulation.limits.thresholds.reflex, sweep_guard_core::WarningThresholds{}.reflex);
  EXPECT_EQ(options.simulation.limits.hold_time, milliseconds(500));
  EXPECT_EQ(options.simulation.tool.radius(), 0.005);
  EXPECT_EQ(options.simulation.tool.length(), 0.1);
  EXPECT_EQ(options.placements, 80U);
}

TEST(OptionsTest, ComputeWhatIsToBeWrittenOrEverything) {
  const Options everything = parse({"a.txt"});
  EXPECT_TRUE(everything.wantsErrors() && everything.wantsWarnings() && !everything.wantsTradeoff());
  const Options errors = parse({"--csv", "e.csv", "a.txt"});
  EXPECT_TRUE(errors.wantsErrors() && !errors.wantsWarnings() && !errors.wantsTradeoff());
  const Options warnings = parse({"--warnings-csv", "w.csv", "a.txt"});
  EXPECT_TRUE(!warnings.wantsErrors() && warnings.wantsWarnings() && !warnings.wantsTradeoff());
  const Options tradeoff = parse({"--tradeoff-csv", "t.csv", "a.txt"});
  EXPECT_TRUE(!tradeoff.wantsErrors() && tradeoff.wantsWarnings() && tradeoff.wantsTradeoff());
}

TEST(OptionsTest, SessionsAreComputedWhenAskedFor) {
  const Options sessions = parse({"--sessions", "a.txt"});
  EXPECT_TRUE(sessions.wantsSessions() && !sessions.wantsErrors() && !sessions.wantsWarnings());
  EXPECT_EQ(sessions.session.sheets, 20U);
  EXPECT_EQ(sessions.session.sessions, 5U);
  EXPECT_EQ(sessions.session.seed, 1U);
  EXPECT_EQ(sessions.session_predictor, sweep_guard_core::PredictorOptions{}.predictor);
  EXPECT_TRUE(parse({"--sessions-csv", "s.csv", "a.txt"}).wantsSessions());
  EXPECT_FALSE(parse({"a.txt"}).wantsSessions());
  const Options meshes = parse({"--sessions", "--predictors", "hold", "--mesh", "a.stl", "--mesh", "b.stl", "a.txt"});
  EXPECT_EQ(meshes.meshes, (std::vector<std::string>{"a.stl", "b.stl"}));
  EXPECT_EQ(meshes.session_predictor, "hold");
  EXPECT_TRUE(has(refusal({"--sessions", "--sheets", "0", "a.txt"}), "--sheets"));
}

TEST(OptionsTest, SessionsHaveTheThresholdsOfTheGuardOrOneForAll) {
  const sweep_guard_core::WarningThresholds defaults;
  EXPECT_EQ(parse({"--sessions", "a.txt"}).session_thresholds.considered_on, defaults.considered_on);
  EXPECT_EQ(parse({"--sessions", "a.txt"}).session_thresholds.considered_off, defaults.considered_off);
  const double old = sweep_guard_core::WarningThresholds::ofMinProbability(0.2).considered_off;
  EXPECT_EQ(parse({"--sessions", "--min-probability", "0.2", "a.txt"}).session_thresholds.considered_off, old);
  EXPECT_EQ(parse({"--tune", "2.5", "a.txt"}).tune, 2.5);
  EXPECT_TRUE(parse({"--tune", "2.5", "a.txt"}).wantsSessions());
  EXPECT_TRUE(has(refusal({"--considered-on", "0.002", "a.txt"}), "--considered-off"));
  EXPECT_TRUE(has(refusal({"--tune-csv", "t.csv", "a.txt"}), "--tune"));
}

TEST(OptionsTest, TheCalibrationNeedsSessions) {
  for (const Options& options : {parse({"--calibration", "a.txt"}), parse({"--calibration-csv", "c.csv", "a.txt"})}) {
    EXPECT_TRUE(options.wantsCalibration() && options.wantsSessions() && !options.wantsErrors());
  }
  EXPECT_FALSE(parse({"--sessions", "a.txt"}).wantsCalibration());
}

TEST(OptionsTest, HelpNeedsNoFile) {
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(has(usage(), "--predictors"));
}

}  // namespace
}  // namespace sweep_guard_evaluation
