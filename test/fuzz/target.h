#pragma once

#include <map>
#include <string>

#include "input.h"
#include "require.h"

namespace sweep_guard_fuzz {

using RunTarget = void (*)(Input input);

/// Returns the targets of this program by their names: one in a fuzzer, all in replay_inputs.
inline std::map<std::string, RunTarget>& targets() {
  static std::map<std::string, RunTarget> all;
  return all;
}

/// A variable of this type adds a target.
struct Target {
  Target(const char* name, RunTarget run) {
    require(targets().emplace(name, run).second, "each target has a name of its own");
  }
};

}  // namespace sweep_guard_fuzz
