#include "sweep_guard/detection/detector.h"

#include "detection/halfspace_detector.h"
#include "detection/reference_detector.h"
#include "detection/select_detector.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {
namespace {

std::unique_ptr<Detector> selectOn(const std::string& gl_context, const DetectorOptions& options) {
  return std::make_unique<SelectDetector>(options, [gl_context] { return makeOffscreenContext(gl_context); });
}

// Names in the choice the first context that works, and why those before it do not. Returns null if none works.
std::unique_ptr<Detector> selectOnAny(DetectorChoice& choice) {
  for (const std::string& gl_context : offscreenContextNames()) {
    try {
      auto detector = selectOn(gl_context, choice.options);
      choice.options.gl_context = gl_context;
      return detector;
    } catch (const DeviceError& error) {
      choice.missing += (choice.missing.empty() ? "" : "; ") + gl_context + ": " + error.what();
    }
  }
  return nullptr;
}

std::unique_ptr<Detector> selectOrAdvice(const DetectorOptions& options) {
  try {
    return selectOn(options.gl_context, options);
  } catch (const DeviceError& error) {
    throw DeviceError(std::string(error.what()) + "; or set gl_context to auto");
  }
}

std::unique_ptr<Detector> makeSelect(const DetectorOptions& options) {
  if (options.gl_context != kAnyGlContext) return selectOrAdvice(options);
  DetectorChoice choice{"select", options, ""};
  auto detector = selectOnAny(choice);
  if (!detector) throw DeviceError(choice.missing + "; or set detector to halfspace");
  return detector;
}

}  // namespace

std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options) {
  if (name == "select") return makeSelect(options);
  if (name == "halfspace") return std::make_unique<HalfspaceDetector>();
  if (name == "reference") return std::make_unique<ReferenceDetector>();
  throw InvalidInput("detector '" + name + "' is unknown: use one of select, halfspace, reference");
}

std::string describe(const DetectorChoice& detector) {
  if (detector.name == "select") return detector.name + " on " + detector.options.gl_context;
  if (detector.name == "halfspace") return detector.name + " on " + simd::kernels().name;
  return detector.name;
}

DetectorChoice availableDetector(const std::string& name, const DetectorOptions& options) {
  DetectorChoice choice{name, options, ""};
  if (name == "select" && options.gl_context == kAnyGlContext && !selectOnAny(choice)) choice.name = "halfspace";
  return choice;
}

const std::vector<std::string>& detectorNames() {
  static const std::vector<std::string> names = {"select", "halfspace", "reference"};
  return names;
}

}  // namespace sweep_guard_core
