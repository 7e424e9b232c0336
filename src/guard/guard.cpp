#include "sweep_guard/guard/guard.h"

#include <algorithm>

#include "guard/intended_touches.h"
#include "guard/measured_sweeps.h"
#include "guard/path_checker.h"
#include "guard/time_budget.h"
#include "prediction/profile.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// Copies the pose, reusing map nodes when the frames are equal.
void assign(PoseWithFrames& to, const PoseWithFrames& from) {
  const auto same_frame = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (!std::equal(to.X_WM.begin(), to.X_WM.end(), from.X_WM.begin(), from.X_WM.end(), same_frame)) {
    to = from;
    return;
  }
  to.stamp = from.stamp;
  to.received = from.received;
  to.X_WT = from.X_WT;
  to.deviation_bound = from.deviation_bound;
  auto next = from.X_WM.begin();
  for (auto& [frame, X_WM] : to.X_WM) X_WM = next++->second;
}

}  // namespace

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : tool_(std::move(tool)),
      detector_(std::move(detector)),
      options_(options),
      predictor_(options.predictor),
      measured_sweeps_(std::make_unique<MeasuredSweeps>()),
      budget_(std::make_unique<TimeBudget>(options.horizon, options.cycle)),
      plan_(std::make_unique<SweepPlan>()),
      no_intentions_(std::make_shared<const Intentions>()),
      intentions_(no_intentions_),
      touches_(std::make_unique<IntendedTouches>()),
      path_checker_(std::make_unique<PathChecker>(PathChecker::optionsOf(options))) {}

Guard::~Guard() = default;

void Guard::sweep(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report) {
  const SteadyTime begin = options_.clock();
  predictor_.observe({pose.stamp, pose.X_WT});
  const SweepSetup setup{tool_, *detector_, options_.sweep, [this] { throwIfStopping(); }, *intentions()};
  measured_sweeps_->sweep(setup, pose, workpieces, report);
  touches_->update(report, pose, tool_, *intentions());
  if (!newest_) newest_.emplace();
  assign(*newest_, pose);
  budget_->spentOnMeasured(options_.clock() - begin);
}

void Guard::takeBack() noexcept { measured_sweeps_->takeBack(); }

void Guard::pass(const PoseWithFrames& pose) {
  predictor_.observe({pose.stamp, pose.X_WT});
  measured_sweeps_->pass(pose);
}

void Guard::predict(Duration age, const Workpieces& workpieces, Prediction& prediction,
                    const std::function<void()>& between) {
  if (!newest_ || age > options_.horizon.reserve) {
    prediction = {};
    return;
  }
  const SteadyTime begin = options_.clock();
  computeHorizon(options_.horizon, age, horizon_);
  assign(motion_.from, *newest_);
  predictor_.predict(horizon_.ends, motion_.path);
  motion_.reflex_sweeps = horizon_.reflex_sweeps;
  chooseSweepPlan(begin, between);
  const std::shared_ptr<const Intentions> intended = intentions();  // sweeps between may change them
  path_checker_->predict(*detector_, {tool_, motion_, workpieces, *intended, *touches_}, *plan_, prediction);
  size_t volumes = 0;
  for (const PredictedObject& object : prediction.objects) volumes = std::max(volumes, object.volumes_tested);
  budget_->spentOnPredicted(options_.clock() - begin - interrupted_, volumes);
}

void Guard::chooseSweepPlan(SteadyTime begin, const std::function<void()>& between) {
  interrupted_ = {};
  plan_->sweep_ends.clear();
  plan_->out_of_time = [this, end = begin + budget_->forPrediction()] {
    return options_.clock() >= end + interrupted_;
  };
  plan_->before_sweep = [this, &between] { interrupt(between); };
  const auto& [from, path, reflex_sweeps] = motion_;
  if (path.empty()) return;
  size_t volumes[] = {0, 0};
  for (size_t i = 0; i < path.size(); ++i) {
    const Motion step{i == 0 ? from.X_WT : path[i - 1].X_WT, path[i].X_WT};
    volumes[i < reflex_sweeps ? 0 : 1] += subMotionCount(step.angle(), options_.sweep.max_rotation);
  }
  findSweepEnds(motion_, budget_->consideredSweeps(volumes[0], volumes[1]), plan_->sweep_ends);
}

void Guard::interrupt(const std::function<void()>& between) {
  throwIfStopping();
  if (!between) return;
  const SteadyTime begin = options_.clock();
  between();
  interrupted_ += options_.clock() - begin;
}

void Guard::throwIfStopping() const {
  if (stopping_) throw Error("the guard is shutting down");
}

PredictedMotion Guard::predictMotion(Duration age, Duration end) const {
  if (!newest_) return {};
  const Horizon horizon = horizonUpTo(end, options_.horizon, age);
  PredictedMotion motion{*newest_, {}, horizon.reflex_sweeps};
  predictor_.predict(horizon.ends, motion.path);
  return motion;
}

bool Guard::isWithin(double distance, const Workpiece& workpiece) {
  if (!newest_) return false;
  const auto X_WM = newest_->X_WM.find(workpiece.frame);
  if (X_WM == newest_->X_WM.end()) return false;
  SweepOptions options = options_.sweep;
  options.margin += distance;
  options.fine = true;  // a volume has corners that the tool has not
  const std::vector<Eigen::Isometry3d> path_M = {X_WM->second.inverse() * newest_->X_WT};
  return checkPath(*detector_, {tool_, path_M, workpiece.mesh_M, options, [this] { throwIfStopping(); }}).all.contact();
}

void Guard::intend(std::shared_ptr<const Intentions> intentions) { intentions_ = std::move(intentions); }

const std::shared_ptr<const Intentions>& Guard::intentions() const {
  return options_.sweep.fine ? intentions_ : no_intentions_;
}

std::unique_ptr<Profile> Guard::profile() const { return predictor_.profile(); }

void Guard::reset() {
  measured_sweeps_->reset();
  touches_->clear();
  predictor_.restart();
  newest_.reset();
}

void Guard::exchange(GuardChange& change) {
  const TimeBudget budget(change.options.horizon, change.options.cycle);
  change.options.clock = options_.clock;
  std::swap(options_, change.options);
  if (change.detector || change.tool) measured_sweeps_->forgetContacts();
  if (change.detector) std::swap(detector_, change.detector);
  if (change.tool) std::swap(tool_, *change.tool);
  if (change.tool) touches_->clear();
  if (change.predictor) {
    std::swap(predictor_, *change.predictor);
    if (newest_) predictor_.observe({newest_->stamp, newest_->X_WT});
  }
  *budget_ = budget;
  *path_checker_ = PathChecker(PathChecker::optionsOf(options_));
}

}  // namespace sweep_guard_core
