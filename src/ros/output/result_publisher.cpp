#include "ros/output/result_publisher.h"

#include <std_msgs/Float64.h>

#include <boost/make_shared.hpp>

#include "common/stage_clock.h"
#include "ros/service/predict.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uint32_t kContactsQueue = 200;  // 0.2 s at 1 kHz; each message may name every triangle
constexpr std::uint32_t kPredictionsQueue = 100;

}  // namespace

ResultPublisher::ResultPublisher(ros::NodeHandle private_node, const LiveParameters& parameters)
    : parameters_(parameters),
      contacts_publisher_(private_node.advertise<sweep_guard::Contacts>("contacts", kContactsQueue)),
      prediction_publisher_(private_node.advertise<sweep_guard::Prediction>("prediction", kPredictionsQueue)),
      time_to_collision_publisher_(private_node.advertise<std_msgs::Float64>("time_to_collision", kPredictionsQueue)) {}

void ResultPublisher::publish(const sweep_guard_core::SweepReport& report) const {
  if (contacts_publisher_.getNumSubscribers() == 0) return;
  const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kPublish);
  const auto parameters = parameters_.get();
  const auto contacts = boost::make_shared<sweep_guard::Contacts>(toMsg(report, *parameters->tool));
  contacts->header.frame_id = parameters->fixed_frame;
  contacts->tool = parameters->tool_frame;
  contacts->volume = sweep_guard_core::nameOf(parameters->guard.sweep.volume);
  contacts_publisher_.publish(contacts);
}

void ResultPublisher::publish(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age) const {
  if (prediction_publisher_.getNumSubscribers() + time_to_collision_publisher_.getNumSubscribers() == 0) return;
  const sweep_guard_core::InStage stage(sweep_guard_core::Stage::kPublish);
  const auto message = boost::make_shared<sweep_guard::Prediction>(predictionMsg(prediction, age, *parameters_.get()));
  std_msgs::Float64 time_to_collision;
  time_to_collision.data = timeToCollision(*message);
  prediction_publisher_.publish(message);
  time_to_collision_publisher_.publish(time_to_collision);
}

}  // namespace sweep_guard_ros
