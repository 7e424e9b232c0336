#include "sweep_guard/guard/guard.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "guard/displacements.h"
#include "guard/intended_contact.h"
#include "guard/measured_sweeps.h"
#include "guard/path_checker.h"
#include "guard/predict_contacts.h"
#include "guard/time_budget.h"
#include "guard/united_bodies.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

// One rigid body of the guarded tool, and what Guard keeps for it.
struct GuardedBody {
  GuardedBody(Tool tool_B, const PathChecker::Options& options) : tool(std::move(tool_B)), checker(options) {}

  Tool tool;  ///< in the frame of the body
  MeasuredSweeps sweeps;
  IntendedTouches touches;
  PathChecker checker;
  // Of a body but the first, until they are united with those of the first:
  SweepReport report;
  Prediction prediction;
};

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
  to.bodies = from.bodies;
  to.state = from.state;
  to.jump = from.jump;
  to.anew = from.anew;
  to.drifts = from.drifts;
  auto next = from.X_WM.begin();
  for (auto& [frame, X_WM] : to.X_WM) X_WM = next++->second;
}

std::vector<std::unique_ptr<GuardedBody>> guarded(std::vector<Tool> bodies, const GuardOptions& options) {
  std::vector<std::unique_ptr<GuardedBody>> all;
  for (Tool& body : bodies)
    all.push_back(std::make_unique<GuardedBody>(std::move(body), PathChecker::optionsOf(options)));
  return all;
}

// Does something for each body, in this order, and adds the results to that of the first body.
template <typename Result, typename Work>
void forEachBody(const std::vector<std::unique_ptr<GuardedBody>>& bodies, const std::vector<size_t>& order,
                 Result GuardedBody::*own, Result& all, const Work& work) {
  for (const size_t i : order) work(i, *bodies[i], i == 0 ? all : (*bodies[i]).*own);
  size_t first_piece = bodies[0]->tool.pieces().size();
  for (size_t i = 1; i < bodies.size(); ++i) {
    unite(all, (*bodies[i]).*own, first_piece);
    first_piece += bodies[i]->tool.pieces().size();
  }
}

std::vector<size_t> inOrder(size_t bodies) {
  std::vector<size_t> order(bodies);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// Returns about how many standard deviations there are between the end of a path and the nearest workpiece.
double deviationsAtEnd(const Tool& tool, const PredictedPose& end, const PoseWithFrames& pose,
                       const Workpieces& workpieces) {
  const Eigen::Vector3d center_W = end.X_WT * tool.bounds_T().center();
  const double lever = tool.bounds_T().center().norm();
  const double sigma = std::sqrt(end.covariance.topLeftCorner<3, 3>().trace()) +
                       lever * std::sqrt(end.covariance.bottomRightCorner<3, 3>().trace());
  double nearest = std::numeric_limits<double>::infinity();
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

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : Guard(std::vector<Tool>{std::move(tool)}, nullptr, std::move(detector), options) {}

Guard::Guard(std::shared_ptr<const Robot> robot, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : Guard(robot->tools, robot, std::move(detector), options) {}

Guard::Guard(std::vector<Tool> bodies, std::shared_ptr<const Robot> robot, std::unique_ptr<Detector> detector,
             const GuardOptions& options)
    : bodies_(guarded(std::move(bodies), options)),
      detector_(std::move(detector)),
      displacements_(std::make_unique<DisplacementCache>()),
      options_(options),
      predictor_(options.predictor, std::move(robot)),
      budget_(std::make_unique<TimeBudget>(options.horizon, options.cycle)),
      plan_(std::make_unique<SweepPlan>()),
      closest_(std::make_unique<ClosestApproaches>()),
      swept_order_(inOrder(bodies_.size())),
      predicted_order_(swept_order_),
      nearness_(bodies_.size()),
      no_intentions_(std::make_shared<const Intentions>()),
      intentions_(no_intentions_) {}

Guard::~Guard() = default;

const Tool& Guard::tool(size_t body) const { return bodies_[body]->tool; }

void Guard::sweep(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report) {
  observe(pose);
  sweepBodies(pose, report, [&](size_t i, GuardedBody& body, const SweepSetup& setup, SweepReport& swept) {
    body.sweeps.sweep(setup, pose, pose.body(i), workpieces, swept);
  });
  if (!newest_) newest_.emplace();
  assign(*newest_, pose);
}

void Guard::sweepOn(const Workpieces& workpieces, SweepReport& report) {
  assert(newest_);
  placeFollowed(*frames_, *newest_);
  sweepBodies(*newest_, report, [&](size_t, GuardedBody& body, const SweepSetup& setup, SweepReport& swept) {
    body.sweeps.sweepOn(setup, *newest_, workpieces, swept);
  });
}

template <typename Sweep>
void Guard::sweepBodies(const PoseWithFrames& pose, SweepReport& report, const Sweep& sweep) {
  const SteadyTime begin = options_.clock();
  displacements_->forgetUnused();
  forEachBody(bodies_, swept_order_, &GuardedBody::report, report,
              [&](size_t i, GuardedBody& body, SweepReport& swept) {
                const SweepSetup setup{body.tool,
                                       *detector_,
                                       options_.sweep,
                                       *displacements_,
                                       [this] { throwIfStopping(); },
                                       *intentions(),
                                       options_.allowed,
                                       *frames_,
                                       bodies_.size() > 1,
                                       {options_.predictor.max_speed, options_.predictor.max_turn_rate}};
                sweep(i, body, setup, swept);
                body.touches.update(swept, pose, pose.body(i).X_WB, body.tool, *intentions());
              });
  report.jump = std::exchange(jump_, {});
  budget_->spentOnMeasured(options_.clock() - begin);
}

// What is placed anew goes back to the pose before: nothing that moves is observed there. What jumps does not go on as it jumped.
void Guard::observe(const PoseWithFrames& pose) {
  if (pose.anew && pose.anew->tool) predictor_.restartTool();
  if (!pose.jump.empty()) {
    predictor_.restart();
    jump_ = pose.jump;
  }
  if (!pose.anew) predictor_.observe(pose);
}

void Guard::takeBack() noexcept {
  for (const auto& body : bodies_) body->sweeps.takeBack();
}

void Guard::pass(const PoseWithFrames& pose) {
  observe(pose);
  for (size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->sweeps.pass(pose, pose.body(i), *frames_);
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
  predictor_.predict(horizon_, motion_);
  motion_.frames = frames_;
  beginPlan(begin, between);
  const size_t considered = motion_.path.empty() ? 0 : consideredSweeps();
  const std::shared_ptr<const Intentions> intended = intentions();  // sweeps between may change them
  const auto predict = [&](size_t i, GuardedBody& body, Prediction& predicted) {
    const PredictedPath& path = motion_.pathOf(i);
    plan_->sweep_ends.clear();
    if (!path.empty())
      findSweepEnds(motion_.from.body(i).X_WB, path, motion_.reflex_sweeps, considered, plan_->sweep_ends);
    const PredictionRequest request{
        body.tool, motion_, workpieces, *intended, body.touches, i, bodies_.size() > 1 ? closest_.get() : nullptr};
    body.checker.predict(*detector_, request, *plan_, predicted);
  };
  closest_->clear();
  orderBodies(workpieces);
  forEachBody(bodies_, predicted_order_, &GuardedBody::prediction, prediction, predict);
  size_t volumes = 0;
  for (const PredictedObject& object : prediction.objects) volumes = std::max(volumes, object.volumes_tested);
  budget_->spentOnPredicted(options_.clock() - begin - interrupted_, volumes);
}

// What comes nearest leaves the least to measure for the others.
void Guard::orderBodies(const Workpieces& workpieces) {
  if (motion_.path.empty()) return;
  for (size_t i = 0; i < bodies_.size(); ++i) {
    nearness_[i] = deviationsAtEnd(bodies_[i]->tool, motion_.pathOf(i).back(), motion_.from, workpieces);
  }
  predicted_order_ = swept_order_;
  std::sort(predicted_order_.begin(), predicted_order_.end(), [&](size_t one, size_t other) {
    return std::pair(nearness_[one], one) < std::pair(nearness_[other], other);
  });
}

void Guard::beginPlan(SteadyTime begin, const std::function<void()>& between) {
  interrupted_ = {};
  plan_->out_of_time = [this, end = begin + budget_->forPrediction()] {
    return options_.clock() >= end + interrupted_;
  };
  plan_->before_sweep = [this, &between] { interrupt(between); };
}

// Of each body: there are volumes enough for all of them. In time, no steps are joined that MotionPredictor has cut.
size_t Guard::consideredSweeps() const {
  size_t volumes[] = {0, 0};
  for (size_t body = 0; body < bodies_.size(); ++body) {
    const PredictedPath& path = motion_.pathOf(body);
    for (size_t i = 0; i < path.size(); ++i) {
      const Motion step{i == 0 ? motion_.from.body(body).X_WB : path[i - 1].X_WT, path[i].X_WT};
      volumes[i < motion_.reflex_sweeps ? 0 : 1] += subMotionCount(step.angle(), options_.sweep.max_rotation);
    }
  }
  const size_t in_time = budget_->consideredSweeps(volumes[0], volumes[1], bodies_.size());
  const bool all = in_time == sweep_guard_core::consideredSweeps(options_.horizon);
  return all ? motion_.path.size() - motion_.reflex_sweeps : in_time;
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
  PredictedMotion motion{*newest_, {}};
  motion.frames = frames_;
  predictor_.predict(horizon, motion);
  return motion;
}

bool Guard::isWithin(double distance, const Workpiece& workpiece) {
  if (!newest_) return false;
  const auto X_WM = newest_->X_WM.find(workpiece.frame);
  if (X_WM == newest_->X_WM.end()) return false;
  SweepOptions options = options_.sweep;
  options.margin += distance;
  options.fine = true;  // a volume has corners that the tool has not
  const auto is_within = [&](size_t i) {
    const std::vector<Eigen::Isometry3d> path_M = {X_WM->second.inverse() * newest_->body(i).X_WB};
    const AllowedPieces allowed(tool(i), options_.allowed, workpiece.id);
    const PathRequest request{tool(i), path_M, workpiece.mesh_M, options, [this] { throwIfStopping(); }, {}, allowed};
    return checkPath(*detector_, request).all.contact();
  };
  for (size_t i = 0; i < bodies_.size(); ++i) {
    if (is_within(i)) return true;
  }
  return false;
}

void Guard::intend(std::shared_ptr<const Intentions> intentions) { intentions_ = std::move(intentions); }

const std::shared_ptr<const Intentions>& Guard::intentions() const {
  return options_.sweep.fine ? intentions_ : no_intentions_;
}

void Guard::reset() {
  for (const auto& body : bodies_) {
    body->sweeps.reset();
    body->touches.clear();
  }
  predictor_.restart();
  newest_.reset();
  jump_.clear();
}

void Guard::exchange(GuardChange& change) {
  assert(change.bodies.empty() || change.bodies.size() == bodies_.size());
  const TimeBudget budget(change.options.horizon, change.options.cycle);
  change.options.clock = options_.clock;
  const bool others_allowed = !(change.options.allowed == options_.allowed);
  std::swap(options_, change.options);
  if (change.detector) std::swap(detector_, change.detector);
  for (size_t i = 0; i < bodies_.size(); ++i) {
    GuardedBody& body = *bodies_[i];
    if (change.detector || !change.bodies.empty() || others_allowed) body.sweeps.forgetContacts();
    if (!change.bodies.empty()) std::swap(body.tool, change.bodies[i]);
    if (!change.bodies.empty()) body.touches.clear();
    body.checker = PathChecker(PathChecker::optionsOf(options_));
  }
  if (change.predictor) {
    std::swap(predictor_, *change.predictor);
    if (newest_) predictor_.observe(*newest_);
  } else if (change.robot) {
    predictor_.exchange(change.robot);
  }
  *budget_ = budget;
}

}  // namespace sweep_guard_core
