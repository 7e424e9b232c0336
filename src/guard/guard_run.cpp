#include "guard/guard_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "common/floating_point.h"
#include "guard/detectors.h"
#include "guard/guarded_body.h"
#include "guard/time_budget.h"

namespace sweep_guard_core {
namespace {

// Returns about how many standard deviations there are between the end of a path and the nearest workpiece.
double deviationsAtEnd(const Tool& tool, const PredictedPose& end, const PoseWithFrames& pose,
                       const Workpieces& workpieces) {
  const Eigen::Vector3d center_W = end.X_WT * tool.bounds_T().center();
  const double lever = tool.bounds_T().center().norm();
  const double sigma = std::sqrt(end.covariance.topLeftCorner<3, 3>().trace()) +
                       lever * std::sqrt(end.covariance.bottomRightCorner<3, 3>().trace());
  double nearest = kInfinity;
  for (const auto& workpiece : workpieces) {
    const auto X_WM = pose.X_WM.find(workpiece->frame);
    if (X_WM == pose.X_WM.end()) continue;
    const TriangleMesh& mesh_M = workpiece->mesh_M;
    const Eigen::Vector3d p = X_WM->second.inverse() * center_W - mesh_M.origin();
    nearest = std::min(nearest, mesh_M.blocks().bounds().exteriorDistance(p));
  }
  return nearest / std::max(sigma, 1e-9);
}

}  // namespace

bool PredictionRun::done() const { return run_.done(); }

void PredictionRun::step() { run_.step(); }

PredictionRun Guard::beginPrediction(Duration age, const Workpieces& workpieces, Prediction& prediction) {
  run_->begin(age, workpieces, prediction);
  return PredictionRun(*run_);
}

void Guard::predict(Duration age, const Workpieces& workpieces, Prediction& prediction) {
  for (PredictionRun run = beginPrediction(age, workpieces, prediction); !run.done();) run.step();
}

PredictedMotion Guard::predictMotion(Duration age, Duration end) const {
  if (!newest_) return {};
  const Horizon horizon = horizonUpTo(end, options_.horizon, age);
  PredictedMotion motion{*newest_, {}};
  motion.frames = frames_;
  motion.trajectory = trajectory_;
  predictor_.predict(horizon, motion);
  return motion;
}

Guard::Run::Run(Guard& guard) : guard_(guard), nearness_(guard.bodies_.size()), next_(guard.bodies_.size()) {
  order_.resize(guard.bodies_.size());
}

void Guard::Run::begin(Duration age, const Workpieces& workpieces, Prediction& prediction) {
  if (!guard_.newest_ || age > guard_.options_.horizon.reserve) {
    prediction = {};
    next_ = order_.size();
    return;
  }
  spent_ = {};
  step_begin_ = guard_.options_.clock();
  computeHorizon(guard_.options_.horizon, age, horizon_);
  assign(motion_.from, *guard_.newest_);
  motion_.trajectory = guard_.trajectory_;
  guard_.predictor_.predict(horizon_, motion_);
  motion_.frames = guard_.frames_;
  intentions_ = guard_.intentions();
  workpieces_ = &workpieces;
  prediction_ = &prediction;
  next_ = 0;
  beginPlan();
  closest_.clear();
  orderBodies();
  beginBody();
  goOn();
}

void Guard::Run::beginPlan() {
  plan_.out_of_time = [this, available = guard_.budget_->forPrediction()] { return spent() >= available; };
  considered_sweeps_ = motion_.path.empty() ? 0 : consideredSweeps();
}

// Of each body: there are volumes enough for all of them. In time, no steps are joined that MotionPredictor has cut.
size_t Guard::Run::consideredSweeps() const {
  size_t volumes[] = {0, 0};
  for (size_t body = 0; body < order_.size(); ++body) {
    const PredictedPath& path = motion_.pathOf(body);
    for (size_t i = 0; i < path.size(); ++i) {
      const Motion step{i == 0 ? motion_.from.bodies[body].X_WB : path[i - 1].X_WT, path[i].X_WT};
      volumes[i < motion_.reflex_sweeps ? 0 : 1] += subMotionCount(step.angle(), guard_.options_.sweep.max_rotation);
    }
  }
  const size_t in_time = guard_.budget_->consideredSweeps(volumes[0], volumes[1], order_.size());
  const bool all = in_time == sweep_guard_core::consideredSweeps(guard_.options_.horizon);
  return all ? motion_.path.size() - motion_.reflex_sweeps : in_time;
}

void Guard::Run::orderBodies() {
  std::iota(order_.begin(), order_.end(), 0);
  if (motion_.path.empty()) return;
  for (size_t i = 0; i < order_.size(); ++i)
    nearness_[i] = deviationsAtEnd(guard_.tool(i), motion_.pathOf(i).back(), motion_.from, *workpieces_);
  std::sort(order_.begin(), order_.end(), [&](size_t one, size_t other) {
    return std::pair(nearness_[one], one) < std::pair(nearness_[other], other);
  });
}

void Guard::Run::beginBody() {
  const size_t i = order_[next_];
  GuardedBody& body = *guard_.bodies_[i];
  const PredictedPath& path = motion_.pathOf(i);
  plan_.sweep_ends.clear();
  if (!path.empty())
    findSweepEnds(motion_.from.bodies[i].X_WB, path, motion_.reflex_sweeps, considered_sweeps_, plan_.sweep_ends);
  body.running->begin({body.tool, motion_, *workpieces_, plan_, i, &guard_.options_.allowed, intentions_.get(),
                       &body.touches, order_.size() > 1 ? &closest_ : nullptr},
                      i == 0 ? *prediction_ : body.prediction);
}

void Guard::Run::step() {
  assert(!done());
  step_begin_ = guard_.options_.clock();
  BodyPrediction& running = *guard_.bodies_[order_[next_]]->running;
  if (guard_.stopping_) {
    running.giveUp(kShuttingDown);
  } else {
    const Workpiece* const workpiece = running.underTest();
    running.step(workpiece == nullptr ? *guard_.detectors_->chosen : guard_.detectors_->of(*workpiece));
  }
  goOn();
}

// Goes on to the next body once one is tested.
void Guard::Run::goOn() {
  while (!done() && guard_.bodies_[order_[next_]]->running->done()) {
    if (++next_ < order_.size()) beginBody();
  }
  spent_ = spent();
  if (done()) finish();
}

Duration Guard::Run::spent() const { return spent_ + (guard_.options_.clock() - step_begin_); }

void Guard::Run::finish() {
  uniteResults(guard_.bodies_, &GuardedBody::prediction, *prediction_);
  size_t volumes = 0;
  for (const PredictedObject& object : prediction_->objects) volumes = std::max(volumes, object.volumes_tested);
  guard_.budget_->spentOnPredicted(spent_, volumes);
  prediction_->seen = seenShare();
}

std::optional<double> Guard::Run::seenShare() {
  if (motion_.path.empty() || !seen_.begin(*workpieces_, motion_.from)) return {};
  for (size_t i = 0; i < order_.size(); ++i) seen_.place(guard_.bodies_[i]->boxes, motion_.from.bodies[i].X_WB);
  for (size_t i = 0; i < order_.size(); ++i)
    seen_.add(guard_.bodies_[i]->boxes, motion_.from.bodies[i].X_WB, motion_.pathOf(i));
  return seen_.share();
}

}  // namespace sweep_guard_core
