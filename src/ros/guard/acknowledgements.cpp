#include "ros/guard/acknowledgements.h"

#include <algorithm>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Error;

void throwIf(const std::string& refusal) {
  if (!refusal.empty()) throw Error(refusal);
}

}  // namespace

std::string Acknowledgements::add(const std::string& id, const sweep_guard_core::Workpieces& workpieces,
                                  const sweep_guard_core::QueryOrigin& origin) {
  std::string warned = id.empty() ? warnedOf() : id;
  throwIf(monitor_.whyNotAcknowledged(warned, now()));
  if (!isNear(warned, workpieces, origin)) {
    throw Error("the tool is farther from '" + warned + "' than warning/acknowledge_distance");
  }
  throwIf(monitor_.acknowledge(warned, now()));
  return warned;
}

std::string Acknowledgements::warnedOf() const {
  sweep_guard_core::Warning warning;
  monitor_.warning(now(), warning);
  if (warning.mesh_id.empty()) throw Error("there is no warning: " + warning.text);
  return warning.mesh_id;
}

bool Acknowledgements::endWhereFar(const sweep_guard_core::Workpieces& workpieces,
                                   const sweep_guard_core::QueryOrigin& origin) {
  bool ended = false;
  for (const std::string& id : monitor_.acknowledged(std::chrono::steady_clock::now())) {
    if (isKnownNear(id, workpieces, origin)) continue;
    monitor_.endAcknowledgement(id);
    ended = true;
  }
  return ended;
}

// A workpiece that cannot be tested is not acknowledged any longer.
bool Acknowledgements::isKnownNear(const std::string& id, const sweep_guard_core::Workpieces& workpieces,
                                   const sweep_guard_core::QueryOrigin& origin) {
  try {
    return isNear(id, workpieces, origin);
  } catch (const Error& error) {
    log_.error(id, "testing whether the tool is near '" + id + "' failed: " + error.what());
    return false;
  }
}

bool Acknowledgements::isNear(const std::string& id, const sweep_guard_core::Workpieces& workpieces,
                              const sweep_guard_core::QueryOrigin& origin) {
  const auto same = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto workpiece = std::find_if(workpieces.begin(), workpieces.end(), same);
  if (workpiece == workpieces.end()) return false;
  sampler_.setWorkpieces(workpieces, origin);
  return guard_.isWithin(parameters_.get()->acknowledge_distance, **workpiece);
}

}  // namespace sweep_guard_ros
