#include "ros/sound/rumble.h"

#include <sensor_msgs/JoyFeedbackArray.h>

#include <cmath>

#include "ros/output/flush.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kRumblePeriod = std::chrono::milliseconds(250);
constexpr double kLeastChange = 0.05;  // that a hand feels

}  // namespace

Rumble::Rumble(ros::NodeHandle private_node, int id, double intensity)
    : id_(id),
      intensity_(intensity),
      publisher_(private_node.advertise<sensor_msgs::JoyFeedbackArray>("feedback", 10)) {}

Rumble::~Rumble() {
  if (sent_ == 0.0) return;
  update(0.0, {});
  flush();
}

void Rumble::update(double share, sweep_guard_core::SteadyTime now) {
  const double intensity = intensity_ * share;
  const bool begins_or_ends = (intensity > 0.0) != (sent_ > 0.0);
  const bool repeats = intensity > 0.0 && now - sent_at_ >= kRumblePeriod;
  if (!begins_or_ends && !repeats && std::abs(intensity - sent_) < kLeastChange) return;
  sensor_msgs::JoyFeedbackArray feedback;
  sensor_msgs::JoyFeedback& motor = feedback.array.emplace_back();
  motor.type = sensor_msgs::JoyFeedback::TYPE_RUMBLE;
  motor.id = static_cast<std::uint8_t>(id_);
  motor.intensity = static_cast<float>(intensity);
  publisher_.publish(feedback);
  sent_ = intensity;
  sent_at_ = now;
}

}  // namespace sweep_guard_ros
