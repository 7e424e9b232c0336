#include "ros/parameters/workpiece_parameters.h"

#include "common/floating_point.h"
#include "ros/parameters/duration.h"
#include "sweep_guard/common/rules.h"

namespace sweep_guard_ros {
namespace {

template <typename Value>
void addRule(const std::string& id, const Value& value, sweep_guard_core::Rules<Value>& rules) {
  rules.by_id.insert({{id, value}, {"/" + id, value}});  // YAML's key of an id with a slash at its front has none
}

}  // namespace

void readWorkpieces(ParameterReader& read, Parameters& parameters) {
  const auto rules =
      read.groupsByName("workpieces",
                        {{"open"},
                         {"padding", ParameterRange{0.0, 1.0, "m"}},
                         {"timeout", ParameterRange{0.01, sweep_guard_core::kInfinity, "s"}}},
                        "Rules by id, `'*'` for all others: `{curtain: {open: true}, '*': {timeout: 1.0}}`. open: the "
                        "surface has no inside. padding: it counts as nearer by this; the depth of "
                        "an intention counts from there. timeout: replaces timing/mesh_timeout.");
  for (const auto& [id, rule] : rules) {
    if (id != "*") parameters.ruled_ids.insert(id);
    if (const auto open = rule.find("open"); open != rule.end()) addRule(id, open->second != 0.0, parameters.sheets);
    if (const auto padding = rule.find("padding"); padding != rule.end())
      addRule(id, padding->second, parameters.paddings);
    if (const auto timeout = rule.find("timeout"); timeout != rule.end())
      addRule(id, toDuration(timeout->second), parameters.limits.mesh_timeouts);
  }
  parameters.cameras = readCameras(read);
  for (const CameraParameters& camera : parameters.cameras) {
    for (const std::string& id : {camera.id, "/" + camera.id})
      parameters.limits.mesh_timeouts.by_id.insert_or_assign(id, camera.timeout);
  }
}

}  // namespace sweep_guard_ros
