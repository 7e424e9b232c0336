#include "guard/body_prediction.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "guard/united_bodies.h"

namespace sweep_guard_core {
namespace {

// Of all that counts as the mesh.
double radiusAboutFrame(const TriangleMesh& mesh_M) {
  return mesh_M.origin().norm() + mesh_M.radius() + mesh_M.margin();
}

}  // namespace

void BodyPrediction::begin(const BodyPredictionRequest& request, Prediction& prediction) {
  request_.emplace(request);
  prediction_ = &prediction;
  const PredictedMotion& motion = request.motion;
  prediction.stamp = motion.from.stamp;
  prediction.path = motion.path;
  prediction.body_paths = motion.body_paths;
  prediction.source = motion.source;
  prediction.reflex_sweeps = motion.reflex_sweeps;
  prediction.sweeps_asked = motion.path.size();
  prediction.sweeps_made = request.plan.sweepCount(motion.path);
  prediction.unplaced.clear();
  prediction.failures.clear();
  X_WB_ = motion.from.bodies[request.body].X_WB;
  orderByPadding();
  next_ = tested_ = 0;
  checker_.giveUp();
  checker_.forgetPath();
  finish();
}

const Workpieces& BodyPrediction::workpieces() const {
  static const Workpieces kNone;
  return request_->motion.path.empty() ? kNone : request_->workpieces;
}

// Workpieces of one padding share the volumes of a path.
void BodyPrediction::orderByPadding() {
  const Workpieces& all = request_->workpieces;
  order_.resize(all.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](size_t one, size_t other) {
    return std::pair(all[one]->mesh_M.padding(), one) < std::pair(all[other]->mesh_M.padding(), other);
  });
}

bool BodyPrediction::done() const { return checker_.done() && next_ == workpieces().size(); }

void BodyPrediction::step(Detector& detector) {
  try {
    if (!checker_.done()) {
      checker_.step(detector);
    } else if (!beginNext()) {
      return finish();
    }
    if (checker_.done()) ++tested_;
  } catch (const std::exception& error) {  // of the detector, or no memory: the other workpieces are tested
    checker_.giveUp();
    prediction_->failures.push_back({inOrder(next_ - 1), error.what()});
  }
  finish();
}

void BodyPrediction::giveUp(const std::string& reason) {
  if (!checker_.done()) prediction_->failures.push_back({inOrder(next_ - 1), reason});
  checker_.giveUp();
  while (next_ < workpieces().size()) prediction_->failures.push_back({inOrder(next_++), reason});
  finish();
}

// Returns false if the frame of the next workpiece is unknown.
bool BodyPrediction::beginNext() {
  const std::shared_ptr<const Workpiece>& workpiece = inOrder(next_++);
  const BodyPredictionRequest& of = *request_;
  if (!place(*workpiece)) {
    prediction_->unplaced.push_back(workpiece);
    return false;
  }
  if (tested_ == prediction_->objects.size()) prediction_->objects.emplace_back();
  checker_.begin({of.tool, X_WB_, of.motion.pathOf(of.body), of.motion.reflex_sweeps, X_WM_, workpiece, of.plan,
                  of.allowed, of.intentions, of.touches, frame_ ? &*frame_ : nullptr, of.closest},
                 prediction_->objects[tested_]);
  return true;
}

// Returns whether the frame of a workpiece is known along the path.
bool BodyPrediction::place(const Workpiece& workpiece) {
  const PredictedMotion& motion = request_->motion;
  frame_.reset();
  if (motion.frames) {
    const auto moving = motion.frames->find(workpiece.frame);
    if (moving != motion.frames->end()) {
      frame_ = framePath(*moving->second, motion.from.stamp, motion.pathOf(request_->body),
                         radiusAboutFrame(workpiece.mesh_M));
      return frame_.has_value();
    }
  }
  const auto resting = motion.from.X_WM.find(workpiece.frame);
  if (resting == motion.from.X_WM.end()) return false;
  X_WM_ = resting->second;
  return true;
}

void BodyPrediction::finish() {
  if (done()) prediction_->objects.resize(tested_);
}

Prediction predictContacts(Detector& detector, const std::vector<Tool>& bodies, const PredictedMotion& motion,
                           const Workpieces& workpieces, const GuardOptions& options,
                           const std::function<bool()>& out_of_time) {
  Prediction all;
  ClosestApproaches closest;
  const SweepPlan plan{{}, out_of_time};
  size_t first_piece = 0;
  for (size_t i = 0; i < bodies.size(); ++i) {
    BodyPrediction body(options);
    Prediction prediction;
    body.begin({bodies[i], motion, workpieces, plan, i, &options.allowed, nullptr, nullptr,
                bodies.size() > 1 ? &closest : nullptr},
               prediction);
    while (!body.done()) body.step(detector);
    if (i == 0) {
      all = std::move(prediction);
    } else {
      unite(all, prediction, first_piece);
    }
    first_piece += bodies[i].pieces().size();
  }
  return all;
}

}  // namespace sweep_guard_core
