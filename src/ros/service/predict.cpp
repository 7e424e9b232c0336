#include "ros/service/predict.h"

#include <limits>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Predict;
using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;

constexpr Duration kMaxDistance = std::chrono::seconds(5);
constexpr auto kPatience = std::chrono::seconds(1);  // with a guard that is stuck in a sweep
constexpr auto kEffort = std::chrono::seconds(1);    // after which what comes late is tested coarsely

Duration checked(const ros::Duration& horizon, Duration configured) {
  const Duration asked(horizon.toNSec());
  if (asked == Duration::zero()) return configured;
  if (asked < Duration::zero() || asked > kMaxDistance) {
    throw InvalidInput("the horizon is " + std::to_string(horizon.toSec()) +
                       " s, but must be from 0 (as configured) to 5 s");
  }
  return asked;
}

}  // namespace

sweep_guard::Prediction predictionMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                                      const Parameters& parameters) {
  sweep_guard::Prediction msg = toMsg(prediction, age, parameters.limits);
  msg.header.frame_id = parameters.fixed_frame;
  msg.tool = parameters.tool_frame;
  msg.predictor = parameters.guard.predictor.predictor;
  return msg;
}

PredictService::PredictService(const ros::NodeHandle& private_node, const LiveParameters& live,
                               const WorkpieceStore& workpieces, Ask ask)
    : live_(live),
      workpieces_(workpieces),
      ask_(std::move(ask)),
      server_(thread_.on(private_node).advertiseService("predict", &PredictService::onCall, this)) {}

// What cannot be predicted is answered, not thrown away: a failed ROS call tells the caller nothing.
bool PredictService::onCall(Predict::Request& request, Predict::Response& response) {
  try {
    refreshParameters();
    response.prediction = predict(checked(request.horizon, parameters_->guard.horizon.considered));
    response.success = true;
  } catch (const std::exception& error) {
    response = Predict::Response();
    response.message = error.what();
    response.prediction.time_to_collision = ros::Duration(-1.0);
    response.prediction.probability = std::numeric_limits<double>::quiet_NaN();
  }
  return true;
}

void PredictService::refreshParameters() {
  const auto current = live_.get();
  if (current == parameters_) return;
  if (!detector_ || detectorsDiffer(*parameters_, *current)) {
    detector_ = sweep_guard_core::makeDetector(current->detector, current->detector_options);
  }
  checker_.emplace(sweep_guard_core::PathChecker::optionsOf(current->guard));
  parameters_ = current;
}

sweep_guard::Prediction PredictService::predict(Duration horizon) {
  std::future<Answer> asked = ask_(horizon);
  if (asked.wait_for(kPatience) != std::future_status::ready)
    throw sweep_guard_core::Error("the guard is busy: ask again");
  const Answer answer = asked.get();
  sweep_guard_core::Prediction prediction;
  checker_->predict(*detector_, {*parameters_->tool, answer.motion, workpieces_.snapshot(), plan()}, prediction);
  return predictionMsg(prediction, answer.age, *parameters_);
}

sweep_guard_core::SweepPlan PredictService::plan() const {
  const auto end = std::chrono::steady_clock::now() + kEffort;
  return {{}, [this, end] { return stopping_ || std::chrono::steady_clock::now() >= end; }};
}

}  // namespace sweep_guard_ros
