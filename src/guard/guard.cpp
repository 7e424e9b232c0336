#include "sweep_guard/guard/guard.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "guard/detectors.h"
#include "guard/displacements.h"
#include "guard/guard_run.h"
#include "guard/guarded_body.h"
#include "guard/time_budget.h"
#include "guard/united_bodies.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

namespace {

std::vector<std::unique_ptr<GuardedBody>> guarded(std::vector<Tool> bodies, const GuardOptions& options) {
  std::vector<std::unique_ptr<GuardedBody>> all;
  all.reserve(bodies.size());
  const size_t points = pointsPerBody(bodies.size());
  for (Tool& body : bodies) all.push_back(std::make_unique<GuardedBody>(std::move(body), options, points));
  return all;
}

}  // namespace

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : Guard(std::vector<Tool>{std::move(tool)}, nullptr, std::move(detector), options) {}

Guard::Guard(const std::shared_ptr<const Robot>& robot, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : Guard(robot->tools, robot, std::move(detector), options) {}

Guard::Guard(std::vector<Tool> bodies, std::shared_ptr<const Robot> robot, std::unique_ptr<Detector> detector,
             const GuardOptions& options)
    : bodies_(guarded(std::move(bodies), options)),
      detectors_(std::make_unique<Detectors>()),
      displacements_(std::make_unique<DisplacementCache>()),
      options_(options),
      predictor_(options.predictor, std::move(robot)),
      budget_(std::make_unique<TimeBudget>(options.horizon, options.cycle)),
      run_(std::make_unique<Run>(*this)),
      no_intentions_(std::make_shared<const Intentions>()),
      intentions_(no_intentions_) {
  detectors_->chosen = std::move(detector);
}

Guard::~Guard() = default;

const Tool& Guard::tool(size_t body) const { return bodies_[body]->tool; }

void Guard::sweep(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report, bool arrived) {
  assert(arrived || (newest_ && pose.stamp == newest_->stamp));
  if (arrived) observe(pose);
  const SteadyTime begin = options_.clock();
  displacements_->forgetUnused();
  for (size_t i = 0; i < bodies_.size(); ++i) {
    GuardedBody& body = *bodies_[i];
    SweepReport& swept = i == 0 ? report : body.report;
    const BodyPose& at = pose.bodies[i];
    body.sweeps.sweep(sweepSetup(body), pose, arrived ? std::optional(at) : std::nullopt, workpieces, swept);
    body.touches.update(swept, pose, at.X_WB, body.tool, *intentions());
  }
  uniteResults(bodies_, &GuardedBody::report, report);
  report.jump = std::exchange(jump_, {});
  budget_->spentOnMeasured(options_.clock() - begin);
  if (!newest_) newest_.emplace();
  assign(*newest_, pose);
}

SweepSetup Guard::sweepSetup(const GuardedBody& body) const {
  return {body.tool,          *detectors_,
          options_.sweep,     *displacements_,
          options_.allowed,   *intentions(),
          *frames_,           {options_.predictor.max_speed, options_.predictor.max_turn_rate},
          bodies_.size() > 1, [this] { throwIfStopping(); }};
}

// What is placed anew goes back to the pose before: nothing that moves is observed there. What jumps does not go on as it jumped.
void Guard::observe(const PoseWithFrames& pose) {
  assert(pose.bodies.size() == bodies_.size());
  assert(!predictor_.isRigid() || pose.bodies.front().X_WB.isApprox(pose.X_WT));
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
  for (size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->sweeps.pass(pose, pose.bodies[i], *frames_);
}

void Guard::throwIfStopping() const {
  if (stopping_) throw Error(kShuttingDown);
}

bool Guard::isWithin(double distance, const Workpiece& workpiece) {
  if (!newest_) return false;
  const auto X_WM = newest_->X_WM.find(workpiece.frame);
  if (X_WM == newest_->X_WM.end()) return false;
  SweepOptions options = options_.sweep;
  options.margin += distance;
  options.fine = true;  // a volume has corners that the tool has not
  const auto is_within = [&](size_t i) {
    const std::vector<Eigen::Isometry3d> path_M = {X_WM->second.inverse() * newest_->bodies[i].X_WB};
    const ContactPolicy contact(tool(i), workpiece, &options_.allowed);
    const PathRequest request{tool(i), path_M, workpiece.mesh_M, options, [this] { throwIfStopping(); }, {}, contact};
    return checkPath(detectors_->of(workpiece), request).all.contact();
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
  std::swap(options_, change.options);
  if (change.detector) std::swap(detectors_->chosen, change.detector);
  for (size_t i = 0; i < bodies_.size(); ++i) {
    GuardedBody& body = *bodies_[i];
    if (change.detector || !change.bodies.empty()) body.sweeps.forgetContacts();
    if (!change.bodies.empty()) {
      std::swap(body.tool, change.bodies[i]);
      body.boxes = BodyBoxes(body.tool, pointsPerBody(bodies_.size()));
      body.touches.clear();
    }
    body.running = std::make_unique<BodyPrediction>(options_);
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
