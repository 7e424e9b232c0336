#include "rviz/feeds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sweep_guard_rviz {
namespace {

constexpr std::uint32_t kQueued = 100;
constexpr size_t kKept = 10000;  // until they are taken

}  // namespace

WarningFeed::WarningFeed() : spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  spinner_.start();
}

WarningFeed::~WarningFeed() {
  subscriber_.shutdown();
  spinner_.stop();
}

void WarningFeed::listen(const std::string& topic) {
  subscriber_.shutdown();
  take();
  if (topic.empty()) return;
  subscriber_ = node_.subscribe<sweep_guard::Warning>(
      topic, kQueued, [this](const sweep_guard::Warning::ConstPtr& warning) { receive(*warning); });
}

std::vector<ReceivedWarning> WarningFeed::take() {
  const sweep_guard_core::Lock lock(mutex_);
  return std::exchange(received_, {});
}

void WarningFeed::receive(const sweep_guard::Warning& warning) {
  const sweep_guard_core::Lock lock(mutex_);
  if (received_.size() >= kKept) received_.erase(received_.begin(), received_.begin() + kKept / 2);
  received_.push_back({warning, currentInstant()});
}

std::string describe(const sweep_guard::ObjectInteraction& object) {
  const geometry_msgs::Vector3& force = object.wrench.force;
  char text[96];
  std::snprintf(text, sizeof text, "%.2f N, %.2f cm^3, %.1f mm", std::hypot(force.x, force.y, force.z),
                1e6 * object.volume, 1e3 * object.depth);
  return text;
}

std::string describe(const sweep_guard::Interaction& interaction) {
  if (interaction.objects.empty()) return "";
  sweep_guard::ObjectInteraction all;
  all.wrench = interaction.wrench;
  for (const sweep_guard::ObjectInteraction& object : interaction.objects) {
    all.volume += object.volume;
    all.depth = std::max(all.depth, object.depth);
  }
  return describe(all);
}

}  // namespace sweep_guard_rviz
