#include "rviz/force_text.h"

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

}  // namespace sweep_guard_rviz
