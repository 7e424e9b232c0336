#pragma once

#include <optional>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_simulation {

/// How long before each contact the guard warned of it.
class WarningLeads {
 public:
  /// A contact that began, and how long before a warning was in force without a break; 0 where it came with the
  /// contact.
  struct Contact {
    sweep_guard_core::Duration considered;  ///< that one or a stronger one
    sweep_guard_core::Duration reflex;      ///< that one
  };

  /// @param at  not before that of the level before
  void add(sweep_guard_core::Time at, sweep_guard_core::WarningLevel level);

  const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  std::optional<sweep_guard_core::Time> considered_since_;  // considered, reflex or contact
  std::optional<sweep_guard_core::Time> reflex_since_;      // reflex or contact
  bool in_contact_ = false;
  std::vector<Contact> contacts_;
};

}  // namespace sweep_guard_simulation
