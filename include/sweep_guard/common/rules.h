#pragma once

#include <map>
#include <string>

namespace sweep_guard_core {

/// Holds a value for some ids; that of '*' is for all others.
template <typename Value>
struct Rules {
  std::map<std::string, Value> by_id = {};

  /// Returns the value for an id; null: there is none.
  const Value* of(const std::string& id) const {
    auto found = by_id.find(id);
    if (found == by_id.end()) found = by_id.find("*");
    return found == by_id.end() ? nullptr : &found->second;
  }
};

}  // namespace sweep_guard_core
