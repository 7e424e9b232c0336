#include "guard/predict_contacts.h"

#include "guard/path_checker.h"
#include "guard/united_bodies.h"

namespace sweep_guard_core {

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
