#include "sweep_guard/kinematics/joint_trajectory.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/unwound.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kMaxLength = std::chrono::minutes(10);
constexpr Duration kMaxLag = std::chrono::milliseconds(200);
constexpr double kOffsetTime = 0.1;       // [s], in which an offset falls to 1/e
constexpr double kTurnTolerance = 0.05;   // [rad]
constexpr double kSlideTolerance = 0.02;  // [m]
constexpr double kLeastDeviation = 1e-3;  // [rad or m]

void checkNumbers(const std::vector<double>& numbers, size_t count, const std::string& of_point) {
  if (numbers.size() != count) {
    throw InvalidInput(of_point + " has " + std::to_string(numbers.size()) + " numbers for " + std::to_string(count) +
                       " joints");
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
    throw InvalidInput(of_point + " has a number that is not finite");
}

void check(const TrajectoryPlan& plan) {
  if (plan.points.empty()) throw InvalidInput("trajectory has no points");
  Duration before{-1};
  for (size_t i = 0; i < plan.points.size(); ++i) {
    const TrajectoryPoint& point = plan.points[i];
    const std::string name = "point " + std::to_string(i) + " of the trajectory";
    checkNumbers(point.positions, plan.joints.size(), name);
    if (!point.velocities.empty()) checkNumbers(point.velocities, plan.joints.size(), name);
    if (!point.accelerations.empty()) checkNumbers(point.accelerations, plan.joints.size(), name);
    if (point.from_start <= before) throw InvalidInput(name + " is not later than the one before");
    before = point.from_start;
  }
  if (before > kMaxLength) throw InvalidInput("trajectory lasts longer than 10 minutes");
}

// Between two points that are `length` seconds apart, in Hermite's form.
double between(const TrajectoryPoint& from, const TrajectoryPoint& to, size_t joint, double length, double share) {
  const double s = share;
  const double travel = to.positions[joint] - from.positions[joint];
  if (from.velocities.empty() || to.velocities.empty()) return from.positions[joint] + s * travel;
  const double v0 = length * from.velocities[joint];
  const double v1 = length * to.velocities[joint];
  const double s3 = s * s * s;
  if (from.accelerations.empty() || to.accelerations.empty())
    return from.positions[joint] + (3 * s * s - 2 * s3) * travel + (s - 2 * s * s + s3) * v0 + (s3 - s * s) * v1;
  const double a0 = length * length * from.accelerations[joint];
  const double a1 = length * length * to.accelerations[joint];
  const double s4 = s3 * s;
  const double s5 = s4 * s;
  return from.positions[joint] + (10 * s3 - 15 * s4 + 6 * s5) * travel + (s - 6 * s3 + 8 * s4 - 3 * s5) * v0 +
         (7 * s4 - 4 * s3 - 3 * s5) * v1 + 0.5 * (s * s - 3 * s3 + 3 * s4 - s5) * a0 + 0.5 * (s3 - 2 * s4 + s5) * a1;
}

void sampleSegment(const TrajectoryPoint& from, const TrajectoryPoint& to, SampledPositions& samples) {
  const Duration length = to.from_start - from.from_start;
  const Duration::rep parts = (length - Duration(1)) / kTrajectoryStep + 1;
  for (Duration::rep part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / static_cast<double>(parts);
    std::vector<double> positions;
    for (size_t joint = 0; joint < from.positions.size(); ++joint)
      positions.push_back(between(from, to, joint, toSeconds(length), share));
    samples.times.push_back(from.from_start + length * part / parts);
    samples.positions.push_back(std::move(positions));
  }
}

// Where the joints of a plan are measured, at rest; those that move nothing of the tree are where the plan begins.
TrajectoryPoint restingPoint(const KinematicTree& tree, const TrajectoryPlan& plan,
                             const std::vector<double>& measured) {
  TrajectoryPoint point{{}, plan.points.front().positions};
  point.velocities = point.accelerations = std::vector<double>(plan.joints.size(), 0.0);
  std::map<std::string, double> known = tree.jointPositions(measured);
  std::set<std::string> continuous;
  for (size_t i = 0; i < measured.size(); ++i) {
    const JointVariable& variable = tree.variables()[i];
    known[variable.name] = measured[i];
    if (variable.continuous) continuous.insert(variable.name);
  }
  for (size_t i = 0; i < plan.joints.size(); ++i) {
    double& position = point.positions[i];
    const auto found = known.find(plan.joints[i]);
    if (found == known.end()) continue;
    position = continuous.count(plan.joints[i]) != 0 ? unwound(found->second, position) : found->second;
  }
  return point;
}

// Keeps the ends, and what lies more than a tolerance off the straight lines between those kept.
SampledPositions thinned(const SampledPositions& all, double tolerance) {
  using Slopes =
      std::pair<double, double>;  // the lowest and the highest [1/s] of a line that passes all since the last kept
  SampledPositions kept;
  std::vector<Slopes> slopes;
  const auto keep = [&](size_t i) {
    kept.times.push_back(all.times[i]);
    kept.positions.push_back(all.positions[i]);
    slopes.assign(all.positions[i].size(), {-HUGE_VAL, HUGE_VAL});
  };
  const auto slope = [&](size_t i, size_t joint) {
    return (all.positions[i][joint] - kept.positions.back()[joint]) / toSeconds(all.times[i] - kept.times.back());
  };
  keep(0);
  for (size_t i = 1; i < all.times.size(); ++i) {
    bool fits = true;
    for (size_t joint = 0; joint < slopes.size(); ++joint)
      fits = fits && slope(i, joint) >= slopes[joint].first && slope(i, joint) <= slopes[joint].second;
    if (!fits) keep(i - 1);
    const double spread = tolerance / toSeconds(all.times[i] - kept.times.back());
    for (size_t joint = 0; joint < slopes.size(); ++joint) {
      auto& [lowest, highest] = slopes[joint];
      lowest = std::max(lowest, slope(i, joint) - spread);
      highest = std::min(highest, slope(i, joint) + spread);
    }
  }
  if (all.times.size() > 1) keep(all.times.size() - 1);
  return kept;
}

}  // namespace

SampledPositions sampled(const TrajectoryPlan& plan) {
  check(plan);
  SampledPositions samples{{plan.points.front().from_start}, {plan.points.front().positions}};
  for (size_t i = 1; i < plan.points.size(); ++i) sampleSegment(plan.points[i - 1], plan.points[i], samples);
  return samples;
}

JointTrajectory::JointTrajectory(const KinematicTree& tree, const JointsBesideTree& beside, TrajectoryPlan plan,
                                 Time begin, const std::vector<double>& measured)
    : begin_(begin) {
  check(plan);
  if (plan.points.front().from_start > Duration::zero())
    plan.points.insert(plan.points.begin(), restingPoint(tree, plan, measured));
  samples_ = sampled(plan);
  samples_.positions = planned(tree, beside, measured, {plan.joints, std::move(samples_.positions)}).positions;
  for (size_t i = 0; i < tree.variables().size(); ++i) {
    const JointVariable& variable = tree.variables()[i];
    if (std::count(plan.joints.begin(), plan.joints.end(), variable.name) == 0) continue;
    joints_.push_back({i, variable.continuous, variable.turns ? kTurnTolerance : kSlideTolerance});
  }
}

double JointTrajectory::at(Time time, size_t variable) const {
  const auto& [times, positions] = samples_;
  const auto after = std::upper_bound(times.begin(), times.end(), time - begin_);
  const auto next = static_cast<size_t>(after - times.begin());
  if (after == times.begin() || after == times.end())
    return (after == times.end() ? positions.back() : positions.front())[variable];
  const double share = toSeconds(time - begin_ - times[next - 1]) / toSeconds(times[next] - times[next - 1]);
  return (1.0 - share) * positions[next - 1][variable] + share * positions[next][variable];
}

double JointTrajectory::offset(Time now, const std::vector<double>& measured, const Joint& joint) const {
  const double there = at(now, joint.variable);
  return (joint.continuous ? unwound(measured[joint.variable], there) : measured[joint.variable]) - there;
}

bool JointTrajectory::isFollowed(Time now, const std::vector<double>& measured) const {
  return std::all_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    const double there = at(now, joint.variable);
    double lowest = 0.0;
    double highest = 0.0;
    for (Duration lag = kTrajectoryStep; lag <= kMaxLag; lag += kTrajectoryStep) {
      const double before = at(now - lag, joint.variable) - there;
      lowest = std::min(lowest, before);
      highest = std::max(highest, before);
    }
    const double off = offset(now, measured, joint);
    return off >= lowest - joint.tolerance && off <= highest + joint.tolerance;
  });
}

void JointTrajectory::predict(Time now, const std::vector<double>& measured, Duration ahead,
                              std::vector<double>& positions, std::vector<double>& variances) const {
  const double gone = -std::expm1(-toSeconds(ahead) / kOffsetTime);
  for (const Joint& joint : joints_) {
    const size_t i = joint.variable;
    const double correction = gone * offset(now, measured, joint);
    positions[i] = measured[i] + at(now + ahead, i) - at(now, i) - correction;
    variances[i] = correction * correction + kLeastDeviation * kLeastDeviation;
  }
}

SampledPositions JointTrajectory::rest(Time now, const std::vector<double>& measured) const {
  SampledPositions rest{{Duration::zero()}, {measured}};
  std::vector<double> variances(measured.size());
  for (const Duration time : samples_.times) {
    const Duration ahead = begin_ + time - now;
    if (ahead <= Duration::zero()) continue;
    rest.times.push_back(ahead);
    predict(now, measured, ahead, rest.positions.emplace_back(measured), variances);
  }
  return thinned(rest, kLeastDeviation);
}

}  // namespace sweep_guard_core
