#include "sweep_guard/detection/detector.h"

#include "detection/halfspace_detector.h"
#include "detection/reference_detector.h"
#include "detection/select_detector.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

std::unique_ptr<Detector> selectOn(const std::string& gl_context, const DetectorOptions& options) {
  return std::make_unique<SelectDetector>(SelectDetector::Options{options.cull, options.triangles_per_name},
                                          [gl_context] { return makeOffscreenContext(gl_context); });
}

struct AvailableSelect {
  std::unique_ptr<Detector> detector;  // null: there is none
  std::string gl_context;
  std::string missing;
};

AvailableSelect selectOnAny(const DetectorOptions& options) {
  std::string missing;
  for (const std::string& gl_context : offscreenContextNames()) {
    try {
      return {selectOn(gl_context, options), gl_context, missing};
    } catch (const DeviceError& error) {
      missing += (missing.empty() ? "" : "; ") + gl_context + ": " + error.what();
    }
  }
  return {nullptr, "", missing};
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
  AvailableSelect select = selectOnAny(options);
  if (!select.detector) throw DeviceError(select.missing + "; or set detector to halfspace");
  return std::move(select.detector);
}

}  // namespace

std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options) {
  if (name == "select") return makeSelect(options);
  if (name == "halfspace") return std::make_unique<HalfspaceDetector>();
  if (name == "reference") return std::make_unique<ReferenceDetector>();
  throw InvalidInput("detector '" + name + "' is unknown: use select, halfspace or reference");
}

DetectorChoice availableDetector(const std::string& name, const DetectorOptions& options) {
  DetectorChoice choice{name, options, ""};
  if (name != "select" || options.gl_context != kAnyGlContext) return choice;
  const AvailableSelect select = selectOnAny(options);
  choice.missing = select.missing;
  if (select.detector) {
    choice.options.gl_context = select.gl_context;
  } else {
    choice.name = "halfspace";
  }
  return choice;
}

const std::vector<std::string>& detectorNames() {
  static const std::vector<std::string> names = {"select", "halfspace", "reference"};
  return names;
}

}  // namespace sweep_guard_core
