#include "evaluation/calibration.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;

namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(50);
constexpr double kLeastFall = 0.001;
constexpr int kIterations = 20000;
using KnotVector = Eigen::Matrix<double, kKnots.size(), 1>;
using KnotMatrix = Eigen::Matrix<double, kKnots.size(), kKnots.size()>;

double nearestWithin(const ObjectFindings& object, size_t found, Duration interval) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = object.sweepsBegin(found); i < object.poses[found].sweeps_end; ++i) {
    if (object.sweeps[i].from < interval) nearest = std::min(nearest, object.sweeps[i].deviations);
  }
  return nearest;
}

// The first pose of every period, wherever it is: not the one right after a touch, for example.
bool isSampled(const std::vector<Time>& stamps, size_t pose) {
  const auto period = [&](size_t i) { return stamps[i].time_since_epoch() / kPeriod; };
  return pose == 0 || period(pose) != period(pose - 1);
}

// The share of each knot in the probability at some deviations.
KnotVector sharesAt(double deviations) {
  KnotVector shares = KnotVector::Zero();
  const auto next = std::upper_bound(kKnots.begin(), kKnots.end(), deviations);
  const auto index = next - kKnots.begin();
  if (next == kKnots.begin()) {
    shares[0] = 1.0;
  } else if (next == kKnots.end()) {
    shares[index - 1] = 1.0;
  } else {
    const double before = *std::prev(next);
    shares[index] = (deviations - before) / (*next - before);
    shares[index - 1] = 1.0 - shares[index];
  }
  return shares;
}

// The falls add up, from the last knot to the first: the fall at knot k counts for every knot up to it.
KnotVector sumsUpTo(const KnotVector& shares) {
  KnotVector sums = shares;
  for (Eigen::Index k = 1; k < sums.size(); ++k) sums[k] += sums[k - 1];
  return sums;
}

// Minimizes x'Ax/2 - b'x for x >= kLeastFall, one coordinate after the other.
KnotVector minimize(const KnotMatrix& A, const KnotVector& b) {
  KnotVector x = KnotVector::Constant(kLeastFall);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      if (A(k, k) > 0.0) x[k] = std::max(kLeastFall, x[k] + (b[k] - A.row(k).dot(x)) / A(k, k));
    }
  }
  return x;
}

ReliabilityBin binOf(const PredictionOutcome* begin, const PredictionOutcome* end) {
  ReliabilityBin bin;
  bin.count = static_cast<size_t>(end - begin);
  for (const PredictionOutcome* one = begin; one != end; ++one) {
    bin.probability += one->probability / static_cast<double>(bin.count);
    bin.frequency += (one->met ? 1.0 : 0.0) / static_cast<double>(bin.count);
  }
  return bin;
}

}  // namespace

std::vector<PredictionOutcome> outcomesOf(const RecordedMotion& motion, const GuardFindings& findings, size_t object,
                                          const std::vector<TimeInterval>& touches, Duration interval) {
  const ObjectFindings& found_of = findings.objects[object];
  std::vector<PredictionOutcome> outcomes;
  auto touch = touches.begin();
  for (size_t found = 0; found < found_of.poses.size(); ++found) {
    const Time stamp = findings.stamps[found_of.poses[found].pose];
    const double nearest = nearestWithin(found_of, found, interval);
    while (touch != touches.end() && touch->end < stamp) ++touch;
    const bool to_come = touch != touches.end();
    const bool touching = to_come && touch->begin <= stamp;
    const bool recorded = motion.isContinuous(stamp, stamp + interval);
    if (!isSampled(findings.stamps, found_of.poses[found].pose) || touching || !recorded || nearest > kMaxDeviations)
      continue;
    outcomes.push_back({nearest, to_come && touch->begin <= stamp + interval});
  }
  return outcomes;
}

size_t Calibration::count() const {
  size_t sum = 0;
  for (const ReliabilityBin& bin : bins) sum += bin.count;
  return sum;
}

Calibration calibrationOf(std::vector<PredictionOutcome> forecasts) {
  const auto low = [](const PredictionOutcome& one) { return one.probability < kMinForecast; };
  forecasts.erase(std::remove_if(forecasts.begin(), forecasts.end(), low), forecasts.end());
  std::stable_sort(forecasts.begin(), forecasts.end(), [](const PredictionOutcome& a, const PredictionOutcome& b) {
    return a.probability < b.probability;
  });
  Calibration calibration;
  const PredictionOutcome* const begin = forecasts.data();
  const size_t count = forecasts.size();
  for (size_t i = 0; i < kBins && count >= kBins; ++i) {
    calibration.bins.push_back(binOf(begin + i * count / kBins, begin + (i + 1) * count / kBins));
    const ReliabilityBin& bin = calibration.bins.back();
    calibration.error +=
        std::abs(bin.probability - bin.frequency) * static_cast<double>(bin.count) / static_cast<double>(count);
  }
  for (const PredictionOutcome& one : forecasts) {
    calibration.brier += std::pow(one.probability - (one.met ? 1.0 : 0.0), 2.0) / static_cast<double>(count);
  }
  const ReliabilityBin all = binOf(begin, begin + count);
  calibration.skill = 1.0 - calibration.brier / (all.frequency * (1.0 - all.frequency));
  calibration.ratio = all.probability / all.frequency;
  return calibration;
}

std::vector<double> fitProbability(const std::vector<PredictionOutcome>& outcomes) {
  KnotMatrix A = KnotMatrix::Zero();
  KnotVector b = KnotVector::Zero();
  for (const PredictionOutcome& outcome : outcomes) {
    const KnotVector sums = sumsUpTo(sharesAt(outcome.deviations));
    A += sums * sums.transpose();
    if (outcome.met) b += sums;
  }
  const KnotVector falls = minimize(A, b);
  std::vector<double> at_knots(kKnots.size());
  double sum = 0.0;
  for (size_t k = kKnots.size(); k-- > 0;) {
    sum += falls[static_cast<Eigen::Index>(k)];
    at_knots[k] = std::min(sum, 1.0);
  }
  return at_knots;
}

double probabilityAt(const std::vector<double>& at_knots, double deviations) {
  if (deviations > kMaxDeviations) return 0.0;
  const KnotVector shares = sharesAt(deviations);
  double sum = 0.0;
  for (size_t k = 0; k < at_knots.size(); ++k) sum += shares[static_cast<Eigen::Index>(k)] * at_knots[k];
  return sum;
}

}  // namespace sweep_guard_evaluation
