#include "ros/guard/detector_test.h"

#include "guard/self_test.h"

namespace sweep_guard_ros {

std::string testFailure(const Parameters& parameters, const std::string& name, sweep_guard_core::Detector& detector) {
  if (parameters.self_test == SelfTest::kNone) return {};
  const std::string wrong = sweep_guard_core::selfTest(detector);
  return wrong.empty() ? "" : "detector " + name + " failed its self-test: " + wrong;
}

}  // namespace sweep_guard_ros
