#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/ObjectContacts.h"

namespace sweep_guard_recording {

/// Returns whether the tool is in contact with the workpiece: a triangle was not ruled out, or the tool is inside.
inline bool isInContact(const sweep_guard::ObjectContacts& object) {
  return !object.impacts.empty() || object.inside != 0 || object.fine == 0;
}

/// Returns the triangles in contact. Without a narrow phase these are all triangles that the swept volume meets.
inline std::vector<std::uint32_t> trianglesInContact(const sweep_guard::ObjectContacts& object) {
  if (object.fine == 0) return object.triangles;
  std::vector<std::uint32_t> triangles;
  triangles.reserve(object.impacts.size());
  for (const sweep_guard::TriangleContact& impact : object.impacts) triangles.push_back(impact.triangle);
  return triangles;
}

/// Returns the links of the tool that are in contact; none without a narrow phase, or for a tool without a robot description.
inline std::set<std::string> linksInContact(const sweep_guard::ObjectContacts& object) {
  std::set<std::string> links;
  for (const sweep_guard::TriangleContact& impact : object.impacts) links.insert(impact.tool_link);
  links.erase("");
  return links;
}

}  // namespace sweep_guard_recording
