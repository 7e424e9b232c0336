#include "prediction/profile.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>

#include "prediction/motion_space.h"
#include "refusal.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {
namespace {

using PoseAt = std::function<Eigen::Isometry3d(double)>;

constexpr double kPeriod = 0.01;

Time at(double seconds) { return Time(fromSeconds(1000.0 + seconds)); }

// To and fro, and a turn of the same rhythm.
PoseAt swing(double rate, double width) {
  return [=](double t) {
    return Eigen::Translation3d(width * std::sin(rate * t), 0.5 * width * std::sin(0.7 * rate * t), 0.0) *
           Eigen::AngleAxisd(5.0 * width * std::sin(rate * t), Eigen::Vector3d::UnitZ());
  };
}
const PoseAt kQuick = swing(6.0, 0.05);
const PoseAt kSlow = swing(1.0, 0.05);

PosePredictor predictorOf(const std::string& name, std::shared_ptr<const Profile> profile = nullptr) {
  PredictorOptions options;
  options.predictor = name;
  options.profile = std::move(profile);
  return PosePredictor(options);
}

void follow(PosePredictor& predictor, const PoseAt& truth, double from, double until) {
  for (double t = from; t <= until; t += kPeriod) predictor.observe({at(t), truth(t)});
}

std::shared_ptr<const Profile> learned(const PoseAt& truth) {
  PosePredictor predictor = predictorOf("direct");
  follow(predictor, truth, 0.0, 40.0);
  return predictor.profile();
}

PredictedPose ahead(const PosePredictor& predictor, double seconds) {
  PredictedPath path;
  predictor.predict({fromSeconds(seconds)}, path);
  return path.at(0);
}

// Root mean square error of the positions 0.5 s ahead.
double error(PosePredictor predictor, const PoseAt& truth, double from, double until) {
  double sum = 0.0;
  int count = 0;
  for (double t = 0.0; t <= until; t += kPeriod) {
    predictor.observe({at(t), truth(t)});
    if (t < from) continue;
    sum += (ahead(predictor, 0.5).X_WT.translation() - truth(t + 0.5).translation()).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(ProfileTest, ComesBackFromItsTextExactly) {
  for (const PoseAt& truth : {kQuick, kSlow}) {
    const auto profile = learned(truth);
    const Profile again = profileFromText(toText(*profile));
    EXPECT_EQ(toText(again), toText(*profile));
    for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
      EXPECT_EQ(again.translation[i].information, profile->translation[i].information);
      EXPECT_EQ(again.rotation[i].projection, profile->rotation[i].projection);
      EXPECT_TRUE((again.errors[i] == profile->errors[i]).all());
    }
  }
}

TEST(ProfileTest, APredictorBeginsWithIt) {
  for (const PoseAt& truth : {kQuick, kSlow}) {
    const double none = error(predictorOf("direct"), truth, 0.2, 1.0);
    EXPECT_LT(error(predictorOf("direct", learned(truth)), truth, 0.2, 1.0), 0.7 * none);
  }
}

TEST(ProfileTest, AnotherOperatorsIsOutgrownWithinTheAveragingTime) {
  for (const auto& [truth, other] : {std::pair{kQuick, kSlow}, {kSlow, kQuick}, {kSlow, swing(6.0, 0.5)}}) {
    const double none = error(predictorOf("direct"), truth, 20.0, 30.0);
    EXPECT_LT(error(predictorOf("direct", learned(other)), truth, 20.0, 30.0), 1.6 * none + 1e-3);
  }
}

TEST(ProfileTest, NeverMakesTheFirstPredictionsSurer) {
  for (const PoseAt& teacher : {kQuick, kSlow}) {
    PosePredictor without = predictorOf("direct");
    PosePredictor with = predictorOf("direct", learned(teacher));
    follow(without, kQuick, 0.0, kPeriod);
    follow(with, kQuick, 0.0, kPeriod);
    for (const double seconds : {0.01, 0.1, 0.3, 1.0}) {
      const Matrix6d more = ahead(with, seconds).covariance - ahead(without, seconds).covariance;
      EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix6d>(more).eigenvalues().minCoeff(), -1e-12) << seconds;
    }
  }
}

TEST(ProfileTest, IsKeptThroughAGapAndSavedAgain) {
  const auto profile = learned(kQuick);
  PosePredictor predictor = predictorOf("direct", profile);
  follow(predictor, kQuick, 0.0, 0.05);
  const auto again = predictor.profile();
  for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
    const auto weights = [](const DisplacementRegression<3>::Learned& of) {
      DisplacementRegression<3> regression(1.0, 0.02);
      regression.begin(of, DisplacementRegression<3>::Weights::Zero());
      return regression.weights();
    };
    EXPECT_LT((weights(again->translation[i]) - weights(profile->translation[i])).norm(), 0.05) << i;
  }
  follow(predictor, kQuick, 3.0, 3.2);
  PosePredictor fresh = predictorOf("direct");
  follow(fresh, kQuick, 3.0, 3.2);
  const auto away = [&](const PosePredictor& of) {
    return std::abs(ahead(of, 0.5).X_WT.translation().x() - kQuick(3.7).translation().x());
  };
  EXPECT_LT(away(predictor), 0.7 * away(fresh));
}

TEST(ProfileTest, OtherPredictorsHaveNoneAndTakeNone) {
  for (const std::string name : {"hold", "constant_velocity", "polynomial"}) {
    PosePredictor without = predictorOf(name);
    PosePredictor with = predictorOf(name, learned(kQuick));
    EXPECT_EQ(with.profile(), nullptr);
    follow(without, kSlow, 0.0, 1.0);
    follow(with, kSlow, 0.0, 1.0);
    EXPECT_TRUE(ahead(with, 0.5).X_WT.isApprox(ahead(without, 0.5).X_WT, 0.0)) << name;
    EXPECT_EQ(ahead(with, 0.5).covariance, ahead(without, 0.5).covariance) << name;
  }
}

// A tool that never turned has taught nothing about turns.
TEST(ProfileTest, OfAToolThatNeverTurnedPredictsTurnsAsWithout) {
  const auto profile =
      learned([](double t) { return Eigen::Isometry3d(Eigen::Translation3d(kQuick(t).translation())); });
  const Profile read = profileFromText(toText(*profile));
  PosePredictor without = predictorOf("direct");
  PosePredictor with = predictorOf("direct", std::make_shared<Profile>(read));
  follow(without, kQuick, 0.0, 0.1);
  follow(with, kQuick, 0.0, 0.1);
  EXPECT_TRUE(ahead(with, 0.5).X_WT.linear().isApprox(ahead(without, 0.5).X_WT.linear(), 1e-2));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(ProfileFromTextTest, RefusesWhatIsNoProfileOfThisPredictor) {
  const std::string good = toText(*learned(kQuick));
  const auto refused = [](const std::string& text) { return refusal([&] { profileFromText(text); }); };
  EXPECT_EQ(refused(good), "");
  EXPECT_TRUE(has(refused(replaced(good, "profile 1", "profile 2")), "line 1 of the profile: "));
  EXPECT_TRUE(has(refused(replaced(good, "profile 1", "profile 2")), "another version"));
  EXPECT_TRUE(has(refused(replaced(good, "direct", "psychic")), "not of 'predictor direct'"));
  EXPECT_TRUE(has(refused(replaced(good, "0.35", "0.4")), "other horizons or regressors"));
  EXPECT_TRUE(has(refused(replaced(good, "120ms", "100ms")), "other horizons or regressors"));
  EXPECT_TRUE(has(refused(replaced(good, "speeds ", "speeds nan ")), "number that cannot be"));
  EXPECT_TRUE(has(refused(replaced(good, "speeds ", "speeds 1e300 ")), "number that cannot be"));
  EXPECT_TRUE(has(refused(replaced(good, "speeds ", "speeds inf ")), "number that cannot be"));
  EXPECT_TRUE(has(refused(replaced(good, "speeds ", "speeds 1 ")), "too many numbers"));
  EXPECT_TRUE(has(refused(replaced(good, "speeds ", "pace ")), "does not begin with 'speeds'"));
  EXPECT_TRUE(has(refused(replaced(good, "speeds_time ", "speeds_time -")), "no operator has taught"));
  EXPECT_TRUE(has(refused(replaced(good, "_information ", "_information -")), "no operator has taught"));
  EXPECT_TRUE(has(refused(good + "more\n"), "not the last one"));
  EXPECT_TRUE(has(refused(std::string(kMaxProfileSize + 1, 'a')), "too long"));
  EXPECT_TRUE(has(refused(""), "not complete"));
}

TEST(ProfileFromTextTest, RefusesEveryTruncation) {
  const std::string good = toText(*learned(kQuick));
  for (size_t size = 0; size < good.size(); size += size < 400 ? 1 : 997) {
    EXPECT_NE(refusal([&] { profileFromText(good.substr(0, size)); }), "") << size;
  }
  EXPECT_NE(refusal([&] { profileFromText(good.substr(0, good.size() - 1)); }), "");
}

}  // namespace
}  // namespace sweep_guard_core
