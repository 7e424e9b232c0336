#include "sweep_guard/detection/detector.h"

#include <algorithm>
#include <functional>

#include "detection/halfspace_detector.h"
#include "detection/reference_detector.h"
#include "detection/select_detector.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/simd/kernels.h"

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

struct Kind {
  std::string name;
  std::function<std::unique_ptr<Detector>(const DetectorOptions&)> make;
  std::function<std::string(const DetectorOptions&)> platform;  // what it runs on; null: nothing of its own
};

// The last one shares no code with the others.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kinds = {
      {"select", makeSelect, [](const DetectorOptions& options) { return options.gl_context; }},
      {"halfspace", [](const DetectorOptions&) { return std::make_unique<HalfspaceDetector>(); },
       [](const DetectorOptions&) { return simd::kernels().name; }},
      {"reference", [](const DetectorOptions&) { return std::make_unique<ReferenceDetector>(); }, nullptr}};
  return kinds;
}

const Kind& kind(const std::string& name) {
  const auto same = [&](const Kind& one) { return one.name == name; };
  const auto found = std::find_if(kinds().begin(), kinds().end(), same);
  if (found != kinds().end()) return *found;
  std::string known;
  for (const Kind& one : kinds()) known += (known.empty() ? "" : ", ") + one.name;
  throw InvalidInput("detector '" + name + "' is unknown: use one of " + known);
}

std::vector<std::string> namesOf(const std::vector<Kind>& kinds) {
  std::vector<std::string> names;
  for (const Kind& one : kinds) names.push_back(one.name);
  return names;
}

}  // namespace

std::unique_ptr<Detector> makeDetector(const std::string& name, const DetectorOptions& options) {
  return kind(name).make(options);
}

std::string describe(const DetectorChoice& detector) {
  const auto& platform = kind(detector.name).platform;
  return platform ? detector.name + " on " + platform(detector.options) : detector.name;
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
  static const std::vector<std::string> names = namesOf(kinds());
  return names;
}

}  // namespace sweep_guard_core
