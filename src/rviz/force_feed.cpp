#include "rviz/force_feed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sweep_guard_rviz {
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

void ForceFeed::listen(const std::string& topic) {
  if (topic == topic_) return;
  topic_ = topic;
  text_.clear();
  subscriber_.shutdown();
  if (topic.empty()) return;
  subscriber_ = node_.subscribe<sweep_guard::Interaction>(
      topic, 1, [this](const sweep_guard::Interaction::ConstPtr& interaction) {
        text_ = describe(*interaction);
        received_ = std::chrono::steady_clock::now();
      });
}

std::string ForceFeed::text() {
  queue_.callAvailable();
  return std::chrono::steady_clock::now() - received_ > kSilent ? "" : text_;
}

}  // namespace sweep_guard_rviz
