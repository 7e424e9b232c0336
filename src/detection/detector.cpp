#include "sweep_guard/detection/detector.h"

#include "detection/halfspace_detector.h"
#include "detection/reference_detector.h"
#include "detection/select_detector.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options) {
  if (name == "select") {
    return std::make_unique<SelectDetector>(SelectDetector::Options{options.cull, options.triangles_per_name},
                                            [name = options.gl_context] { return makeOffscreenContext(name); });
  }
  if (name == "halfspace") return std::make_unique<HalfspaceDetector>();
  if (name == "reference") return std::make_unique<ReferenceDetector>();
  throw InvalidInput("detector '" + name + "' is unknown: use select, halfspace or reference");
}

const std::vector<std::string>& detectorNames() {
  static const std::vector<std::string> names = {"select", "halfspace", "reference"};
  return names;
}

}  // namespace sweep_guard_core
