#include "guard/predict_contacts.h"

#include "guard/path_checker.h"

namespace sweep_guard_core {

Prediction predictContacts(Detector& detector, const PredictionRequest& request, const GuardOptions& options,
                           const std::function<bool()>& out_of_time) {
  Prediction prediction;
  PathChecker(PathChecker::optionsOf(options)).predict(detector, request, {{}, out_of_time}, prediction);
  return prediction;
}

}  // namespace sweep_guard_core
