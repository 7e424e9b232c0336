#pragma once

#include <map>
#include <string>
#include <vector>

#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Keeps the workpieces of which a message of one kind was refused, until a good one comes.
class Refusals {
 public:
  /// Keeps the refusals of at most 64 ids. That of another id is stored under the last of them, and replaces its refusal.
  void add(const std::string& id, const WarningInputs::Event& refusal);
  /// Ends the refusals of this id that were received no later.
  void accept(const std::string& id, SteadyTime received);

  /// Returns the message about the last of these ids that is refused; empty: none is.
  /// @param ids  empty: all
  std::string message(const std::vector<std::string>& ids = {}) const;

 private:
  std::map<std::string, WarningInputs::Event> refused_;  // by id
};

}  // namespace sweep_guard_core
