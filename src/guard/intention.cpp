#include "sweep_guard/guard/intention.h"

#include <algorithm>

namespace sweep_guard_core {

bool Intention::allows(const std::string& link) const {
  return tool_links.empty() || std::find(tool_links.begin(), tool_links.end(), link) != tool_links.end();
}

}  // namespace sweep_guard_core
