#include "evaluation/joint_errors.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/csv.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/guard/motion_predictor.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;

namespace {

constexpr Duration kGap = std::chrono::milliseconds(250);
constexpr Duration kHistoryOfJoints = std::chrono::seconds(3);
constexpr double kFloor = 1e-3;        // [m]
constexpr double kNineTenths = 6.251;  // of chi^2 with 3 degrees of freedom

// Returns the first index whose stamp is not earlier.
size_t indexOf(const std::vector<StampedPositions>& states, Time stamp) {
  const auto earlier = [](const StampedPositions& state, Time time) { return state.stamp < time; };
  return static_cast<size_t>(std::lower_bound(states.begin(), states.end(), stamp, earlier) - states.begin());
}

std::vector<double> positionsAt(const std::vector<StampedPositions>& states, Time stamp) {
  const size_t i = indexOf(states, stamp);
  std::vector<double> positions = states[i].positions;
  if (states[i].stamp == stamp) return positions;
  const double rest = sweep_guard_core::toSeconds(states[i].stamp - stamp) /
                      sweep_guard_core::toSeconds(states[i].stamp - states[i - 1].stamp);
  for (size_t k = 0; k < positions.size(); ++k) positions[k] += rest * (states[i - 1].positions[k] - positions[k]);
  return positions;
}

class JointComparison {
 public:
  explicit JointComparison(const JointErrorRequest& request)
      : request_(request),
        robot_(std::make_shared<const sweep_guard_core::Robot>(robotOf(request))),
        joints_(request.predictor, robot_),
        joint_errors_(request.links.size() * request.horizons.size()),
        pose_errors_(joint_errors_.size()) {
    for (size_t i = 0; i < request.links.size(); ++i) poses_.emplace_back(request.predictor);
    horizon_.ends = request.horizons;
  }

  void run() {
    Time begin = request_.states.front().stamp;
    for (size_t i = 0; i < request_.states.size(); ++i) {
      const Time stamp = request_.states[i].stamp;
      if (i > 0 && stamp - request_.states[i - 1].stamp > kGap) begin = stamp;
      observe(request_.states[i]);
      if (stamp - begin >= kHistoryOfJoints && isContinuousAfter(i)) compare(stamp);
    }
  }

  std::vector<JointErrorReport> reports() const {
    std::vector<JointErrorReport> reports;
    for (size_t link = 0; link < request_.links.size(); ++link) {
      for (size_t i = 0; i < request_.horizons.size(); ++i) {
        const size_t k = link * request_.horizons.size() + i;
        reports.push_back({request_.tree.links()[request_.links[link]].name, request_.horizons[i], joint_errors_[k],
                           pose_errors_[k]});
      }
    }
    return reports;
  }

 private:
  static sweep_guard_core::Robot robotOf(const JointErrorRequest& request) {
    sweep_guard_core::Robot robot{request.tree, {}, {}};
    for (const size_t link : request.links) robot.bodies.push_back({link, 0.1});
    return robot;
  }

  void observe(const StampedPositions& joints) {
    motion_.from.stamp = joints.stamp;
    motion_.from.state.positions = joints.positions;
    bodyPoses(robot_->tree, robot_->bodies, motion_.from.state, X_WB_);
    motion_.from.bodies.clear();
    for (const Eigen::Isometry3d& X : X_WB_) motion_.from.bodies.push_back({X});
    joints_.observe(motion_.from);
    for (size_t link = 0; link < poses_.size(); ++link) poses_[link].observe({joints.stamp, X_WB_[link]});
  }

  bool isContinuousAfter(size_t i) const {
    const Time end = request_.states[i].stamp + request_.horizons.back();
    while (i + 1 < request_.states.size() && request_.states[i].stamp < end) {
      if (request_.states[i + 1].stamp - request_.states[i].stamp > kGap) return false;
      ++i;
    }
    return request_.states[i].stamp >= end;
  }

  void compare(Time stamp) {
    joints_.predict(horizon_, motion_);
    std::vector<sweep_guard_core::PredictedPath> by_pose(poses_.size());
    bool known = !motion_.path.empty();
    for (size_t link = 0; link < poses_.size(); ++link) {
      poses_[link].predict(request_.horizons, by_pose[link]);
      known = known && !by_pose[link].empty();
    }
    if (!known) return;
    for (size_t i = 0; i < request_.horizons.size(); ++i) {
      const Duration ahead = request_.horizons[i];
      bodyPoses(robot_->tree, robot_->bodies,
                {Eigen::Isometry3d::Identity(), positionsAt(request_.states, stamp + ahead)}, X_WB_);
      for (size_t link = 0; link < poses_.size(); ++link) {
        const auto& path = motion_.body_paths[link];  // with steps in between
        const auto then = std::find_if(path.begin(), path.end(), [&](const auto& pose) { return pose.ahead == ahead; });
        const size_t k = link * request_.horizons.size() + i;
        joint_errors_[k].add(*then, X_WB_[link].translation());
        pose_errors_[k].add(by_pose[link][i], X_WB_[link].translation());
      }
    }
  }

  const JointErrorRequest& request_;
  const std::shared_ptr<const sweep_guard_core::Robot> robot_;
  sweep_guard_core::MotionPredictor joints_;
  std::vector<sweep_guard_core::PosePredictor> poses_;  // of each link
  sweep_guard_core::Horizon horizon_;
  sweep_guard_core::PredictedMotion motion_;
  std::vector<Eigen::Isometry3d> X_WB_;
  std::vector<LinkErrors> joint_errors_;  // by link, then by horizon
  std::vector<LinkErrors> pose_errors_;
};

}  // namespace

void LinkErrors::add(const sweep_guard_core::PredictedPose& predicted, const Eigen::Vector3d& found) {
  const Eigen::Vector3d error = found - predicted.X_WT.translation();
  Eigen::Matrix3d covariance = predicted.covariance.topLeftCorner<3, 3>();
  covariance.diagonal().array() += kFloor * kFloor;
  distances_.push_back(error.norm());
  log_determinants_ += std::log(covariance.determinant());
  squares_.push_back(error.dot(covariance.llt().solve(error)));
}

double LinkErrors::distance(double share) const { return sweep_guard_core::quantile(distances_, share); }

double LinkErrors::width() const { return std::exp(log_determinants_ / static_cast<double>(samples()) / 6.0); }

double LinkErrors::calibratedWidth() const {
  return width() * std::sqrt(sweep_guard_core::quantile(squares_, 0.9) / kNineTenths);
}

std::vector<JointErrorReport> compareJointPrediction(const JointErrorRequest& request) {
  JointComparison comparison(request);
  comparison.run();
  return comparison.reports();
}

std::string jointErrorCsv(const std::string& name, const std::string& predictor,
                          const std::vector<JointErrorReport>& reports, bool header) {
  std::string csv;
  if (header) {
    csv = csvLine({"recording", "predictor", "link", "horizon_s", "by", "median_m", "p90_m", "width_m",
                   "calibrated_width_m", "samples"});
  }
  for (const JointErrorReport& report : reports) {
    for (const auto& [by, errors] : {std::pair("joints", &report.by_joints), std::pair("pose", &report.by_pose)}) {
      csv += csvLine({name, predictor, report.link, csvNumber(sweep_guard_core::toSeconds(report.horizon)), by,
                      csvNumber(errors->distance(0.5)), csvNumber(errors->distance(0.9)), csvNumber(errors->width()),
                      csvNumber(errors->calibratedWidth()), std::to_string(errors->samples())});
    }
  }
  return csv;
}

}  // namespace sweep_guard_evaluation
