#include "ros/service/path_tester.h"

#include "ros/guard/detector_test.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

std::vector<sweep_guard_core::PathResult> PathTester::test(const PathQuestion& question) {
  setParameters(question.parameters);
  sweep_guard_core::Detector& used = detector(question.detector);
  std::vector<sweep_guard_core::PathResult> results;
  for (const auto& [workpiece, tool, path_M, deviation_bounds] : question.paths) {
    const auto before_sweep = [&, id = workpiece->id, sweep = size_t{0}]() mutable {
      question.go_on("sweep " + std::to_string(sweep++) + " of the path, on '" + id + "'");
    };
    const sweep_guard_core::ContactPolicy contact(*tool, *workpiece, &question.parameters->guard.allowed);
    results.push_back(sweep_guard_core::checkPath(
        used, {*tool, path_M, workpiece->mesh_M, question.options, before_sweep, deviation_bounds, contact}));
  }
  return results;
}

void PathTester::setParameters(const std::shared_ptr<const Parameters>& current) {
  if (current == parameters_) return;
  if (parameters_ && detectorsDiffer(*parameters_, *current)) detectors_.clear();
  parameters_ = current;
}

sweep_guard_core::Detector& PathTester::detector(const std::string& name) {
  const auto made = detectors_.find(name);
  if (made != detectors_.end()) return *made->second;
  auto detector = make_detector_(name, parameters_->detector.options);
  const std::string failure = testFailure(*parameters_, name, *detector);
  if (!failure.empty()) throw sweep_guard_core::DeviceError(failure);
  return *detectors_.emplace(name, std::move(detector)).first->second;
}

}  // namespace sweep_guard_ros
