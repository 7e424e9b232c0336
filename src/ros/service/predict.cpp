#include "ros/service/predict.h"

#include <algorithm>
#include <limits>

#include "common/number_text.h"
#include "ros/guard/detector_test.h"
#include "ros/parameters/parameter_changes.h"
#include "ros/service/left_out.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Predict;
using sweep_guard_core::Duration;
using sweep_guard_core::PredictionInterval;

constexpr Duration kMaxHorizon = std::chrono::seconds(5);
constexpr auto kTestTime = std::chrono::seconds(1);  // the rest of the path is tested coarsely

std::vector<std::string> linksOf(const sweep_guard_core::Tool& body) {
  std::vector<std::string> links;
  for (const sweep_guard_core::ConvexPiece& piece : body.pieces()) {
    if (std::find(links.begin(), links.end(), piece.link) == links.end()) links.push_back(piece.link);
  }
  return links;
}

Duration checkedHorizon(const ros::Duration& horizon, Duration configured) {
  const Duration asked(horizon.toNSec());
  if (asked == Duration::zero()) return configured;
  if (asked < Duration::zero() || asked > kMaxHorizon) {
    throw sweep_guard_core::InvalidInput("horizon is " + sweep_guard_core::shortText(horizon.toSec()) +
                                         " s, but must be from 0 (as configured) to 5 s");
  }
  return asked;
}

// By a message: a failed ROS call gives the caller none.
bool refuse(const std::string& reason, Predict::Response& response) {
  response = Predict::Response();
  response.message = reason;
  response.prediction.time_to_collision = ros::Duration(-1.0);
  response.prediction.probability = std::numeric_limits<double>::quiet_NaN();
  return true;
}

}  // namespace

sweep_guard::Prediction predictionMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                                      const Parameters& parameters) {
  sweep_guard::Prediction msg = toMsg(prediction, age, parameters.limits);
  msg.header.frame_id = parameters.fixed_frame;
  msg.tool = parameters.tool_frame;
  msg.predictor = parameters.guard.predictor.predictor;
  for (size_t i = 0; i < msg.bodies.size(); ++i) msg.bodies[i].links = linksOf((*parameters.bodies)[i]);
  return msg;
}

PredictService::PredictService(const ros::NodeHandle& private_node, ServiceThreads& threads, const LiveParameters& live,
                               const sweep_guard_core::WorkpieceStore& workpieces, PredictMotion predict_motion)
    : live_(live),
      workpieces_(workpieces),
      predict_motion_(std::move(predict_motion)),
      calls_(threads.lasting, threads.refusals),
      server_(calls_.advertise<ros::ServiceSpec<Predict::Request, Predict::Response>>(
          private_node, "predict", kMaxRequest,
          [this](auto& request, auto& response) { return onCall(request, response); }, refuse)) {}

bool PredictService::onCall(Predict::Request& request, Predict::Response& response) {
  try {
    refreshParameters();
    predict(checkedHorizon(request.horizon, parameters_->guard.horizon.considered), response);
    response.success = true;
    return true;
  } catch (const std::exception& error) {
    return refuse(error.what(), response);
  }
}

void PredictService::refreshParameters() {
  const auto current = live_.get();
  if (current == parameters_) return;
  if (!detector_ || detectorsDiffer(*parameters_, *current)) {
    auto detector = makeDetector(current->detector.name, current->detector.options);
    const std::string failure = testFailure(*current, describe(current->detector), *detector);
    if (!failure.empty()) throw sweep_guard_core::DeviceError(failure);
    detector_ = std::move(detector);
  }
  parameters_ = current;
}

void PredictService::predict(Duration horizon, Predict::Response& response) {
  std::future<Motion> future = predict_motion_(horizon);
  if (future.wait_for(kGuardTimeout) != std::future_status::ready)
    throw sweep_guard_core::Error("the guard is busy: ask again");
  const Motion motion = future.get();
  const sweep_guard_core::Workpieces workpieces = workpieces_.snapshotBeside(parameters_->attached);
  const auto end = std::chrono::steady_clock::now() + kTestTime;
  const auto prediction = sweep_guard_core::predictContacts(
      *detector_, *parameters_->bodies, motion.predicted, workpieces, parameters_->guard,
      [this, end] { return stopping_ || std::chrono::steady_clock::now() >= end; });
  sweep_guard::Prediction& msg = response.prediction;
  msg = predictionMsg(prediction, motion.age, *parameters_);
  if (msg.valid) msg.probability = prediction.probability(PredictionInterval::kConsidered, motion.age + horizon);
  response.message = describeLeftOut(parameters_->guard.allowed, workpieces);
}

}  // namespace sweep_guard_ros
