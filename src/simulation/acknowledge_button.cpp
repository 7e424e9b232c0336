#include "simulation/acknowledge_button.h"

#include <sweep_guard/Acknowledge.h>

#include <chrono>
#include <cstddef>
#include <utility>

namespace sweep_guard_simulation {

using sweep_guard::Acknowledge;

AcknowledgeButton::AcknowledgeButton(ros::NodeHandle node, int button)
    : node_(node), button_(button), subscriber_(node.subscribe("warning", 1, &AcknowledgeButton::onWarning, this)) {}

void AcknowledgeButton::update(const std::vector<int>& buttons) {
  const auto index = static_cast<std::size_t>(button_);
  const bool down = button_ >= 0 && index < buttons.size() && buttons[index] != 0;
  const bool pressed = down && !std::exchange(down_, down);
  down_ = down;
  if (pressed && warning_ && !warning_->mesh_id.empty() && idle()) call();
}

bool AcknowledgeButton::idle() const {
  return !call_.valid() || call_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// The operator means the workpiece that he was warned of, not one that is warned of by the time the call arrives.
void AcknowledgeButton::call() {
  const std::string guard = ros::names::parentNamespace(subscriber_.getTopic());
  auto client = node_.serviceClient<Acknowledge>(ros::names::append(guard, "acknowledge"));
  Acknowledge acknowledge;
  acknowledge.request.mesh_id = warning_->mesh_id;
  call_ = std::async(std::launch::async, [client, acknowledge]() mutable {
    const bool answered = client.call(acknowledge);
    ROS_INFO("%s: %s", client.getService().c_str(), answered ? acknowledge.response.message.c_str() : "no answer");
  });
}

}  // namespace sweep_guard_simulation
