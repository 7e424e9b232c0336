#pragma once

#include <map>
#include <string>

#include "input.h"

namespace sweep_guard_fuzz {

using RunTarget = void (*)(Input input);

/// Those that this program has: one with libFuzzer, all of them for replay.
inline std::map<std::string, RunTarget>& targets() {
  static std::map<std::string, RunTarget> all;
  return all;
}

/// A variable of this type adds a target.
struct Target {
  Target(const char* name, RunTarget run) { targets()[name] = run; }
};

}  // namespace sweep_guard_fuzz
