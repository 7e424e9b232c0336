#include "guard/swept_path.h"

#include "common/stage_clock.h"
#include "guard/contact_probability.h"

namespace sweep_guard_core {

void SweptPath::follow(const PredictedPathRequest& request, double margin) {
  const bool rests = request.frame == nullptr;
  if (rests && X_WM_ && X_WM_->matrix() == request.X_WM.matrix() && margin_ == margin) return;
  forget();
  if (rests) {
    path_M_.follow(request.tool, request.X_WT, request.path, request.X_WM);
  } else {
    path_M_.follow(request.tool, request.X_WT, request.path, *request.frame);
  }
  margin_ = margin;
  reach_M_ = path_M_.reach_M(path_M_.whole(), max_deviations_, margin);
  count_ = 0;
  tool_ = &request.tool.whole();
  for (size_t i = 0; i < request.plan.sweepCount(request.path); ++i) {
    sweep(path_M_.between(request.plan.beginOf(i), request.plan.endOf(i)));
  }
  if (rests) X_WM_ = request.X_WM;
}

size_t SweptPath::sweep(const PathSegment& segment) {
  if (count_ == segments_.size()) segments_.emplace_back();
  SweptSegment& swept = segments_[count_];
  swept.segment = segment;
  swept.reach_M = path_M_.reach_M(segment, max_deviations_, margin_);
  swept.bodies.clear();
  swept.deviations.clear();
  swept.halves = {};
  path_M_.motions_M(segment, options_.max_rotation, motions_M_);
  for (const Motion& motion_M : motions_M_)
    swept.bodies.push_back(sweptBody(*tool_, motion_M, options_.volume, margin_));
  return count_++;
}

const SweptSegment& SweptPath::measure(size_t number) {
  SweptSegment& swept = segments_[number];
  if (!swept.deviations.empty()) return swept;
  const InStage stage(Stage::kProbability);
  swept.end_M = path_M_.end_M(swept.segment);
  const auto& [X_MT, covariance_M] = swept.end_M;
  for (const SweptBody& body : swept.bodies)
    swept.deviations.push_back(planeDeviations(*tool_, X_MT, covariance_M, body.volume_M));
  return swept;
}

std::array<size_t, 2> SweptPath::halve(size_t number) {
  SweptSegment& swept = segments_[number];
  if (swept.halves[1] == 0) {
    const auto [first, second] = path_M_.halves(swept.segment);
    swept.halves = {sweep(first), sweep(second)};
  }
  return swept.halves;
}

std::optional<UncertainStep> SweptPath::uncertainStep(const PathSegment& segment) const {
  if (segment.last - segment.first > 1) return std::nullopt;
  return path_M_.uncertainStep(segment, margin_);
}

}  // namespace sweep_guard_core
