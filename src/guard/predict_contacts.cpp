#include "guard/predict_contacts.h"

#include <algorithm>
#include <limits>

#include "guard/path_checker.h"
#include "guard/united_bodies.h"

namespace sweep_guard_core {

void ClosestApproach::add(Duration from, double deviations) {
  if (deviations >= upTo(from)) return;
  const auto first = std::lower_bound(falls_.begin(), falls_.end(), from,
                                      [](const auto& fall, Duration time) { return fall.first < time; });
  const auto last = std::find_if(first, falls_.end(), [=](const auto& fall) { return fall.second < deviations; });
  falls_.insert(falls_.erase(first, last), {from, deviations});
}

double ClosestApproach::upTo(Duration from) const {
  const auto next = std::upper_bound(falls_.begin(), falls_.end(), from,
                                     [](Duration time, const auto& fall) { return time < fall.first; });
  return next == falls_.begin() ? std::numeric_limits<double>::infinity() : std::prev(next)->second;
}

ClosestApproach& ClosestApproaches::to(const Workpiece& workpiece) {
  const auto end = approaches_.begin() + static_cast<std::ptrdiff_t>(used_);
  const auto known = std::find_if(approaches_.begin(), end, [&](const auto& one) { return one.first == &workpiece; });
  if (known != end) return known->second;
  if (used_ == approaches_.size()) approaches_.emplace_back();
  auto& [whose, approach] = approaches_[used_++];
  whose = &workpiece;
  approach.clear();
  return approach;
}

Prediction predictContacts(Detector& detector, const std::vector<Tool>& bodies, const PredictedMotion& motion,
                           const Workpieces& workpieces, const GuardOptions& options,
                           const std::function<bool()>& out_of_time) {
  Prediction all;
  ClosestApproaches closest;
  size_t first_piece = 0;
  for (size_t i = 0; i < bodies.size(); ++i) {
    const PredictionRequest request{
        bodies[i], motion, workpieces, kNoIntentions, kNoTouches, i, bodies.size() > 1 ? &closest : nullptr};
    Prediction prediction;
    PathChecker(PathChecker::optionsOf(options)).predict(detector, request, {{}, out_of_time}, prediction);
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
