#pragma once

#include <map>
#include <string>
#include <vector>

#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Keeps the workpieces of which a message of one kind was refused, until a good one comes.
class Refusals {
 public:
  /// Keeps the refusals of 1024 ids: more than there may be workpieces. Of any more only the newest message is kept, and
  /// nothing ends it, because nobody knows any more which of them came well.
  void add(const std::string& id, const WarningInputs::Event& refusal);
  /// Ends the refusals of this id that were received no later.
  void accept(const std::string& id, SteadyTime received);

  /// Returns the message about the last of these ids that is refused, or of those beyond the 1024; empty: none is.
  /// @param ids  empty: all
  std::string message(const std::vector<std::string>& ids = {}) const;

 private:
  std::map<std::string, WarningInputs::Event> refused_;  // by id
  std::string of_others_;                                // newest message; empty: none
};

}  // namespace sweep_guard_core
