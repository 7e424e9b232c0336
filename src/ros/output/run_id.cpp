#include "ros/output/run_id.h"

#include <array>
#include <cstdio>
#include <random>

namespace sweep_guard_ros {

std::string randomRunId() {
  std::random_device random;
  std::array<char, 17> id{};
  std::snprintf(id.data(), id.size(), "%08x%08x", random(), random());
  return id.data();
}

}  // namespace sweep_guard_ros
