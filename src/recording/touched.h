#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/ObjectContacts.h"

namespace sweep_guard_recording {

/// Whether the tool has touched the workpiece: what only the volume met, and the fine phase has ruled out, is no
/// contact.
inline bool isTouched(const sweep_guard::ObjectContacts& object) {
  return !object.impacts.empty() || object.inside != 0 || object.fine == 0;
}

/// The triangles touched; where the fine phase has not run, those that the volume met.
inline std::vector<std::uint32_t> trianglesTouched(const sweep_guard::ObjectContacts& object) {
  if (object.fine == 0) return object.triangles;
  std::vector<std::uint32_t> triangles;
  triangles.reserve(object.impacts.size());
  for (const sweep_guard::TriangleContact& impact : object.impacts) triangles.push_back(impact.triangle);
  return triangles;
}

}  // namespace sweep_guard_recording
