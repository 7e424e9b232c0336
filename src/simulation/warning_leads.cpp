#include "simulation/warning_leads.h"

namespace sweep_guard_simulation {

using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

namespace {

void follow(std::optional<Time>& since, bool in_force, Time at) {
  if (!in_force) since.reset();
  if (in_force && !since) since = at;
}

}  // namespace

// What is left of a warning after a contact does not warn of the next.
void WarningLeads::add(Time at, WarningLevel level) {
  const bool contact = level == WarningLevel::kContact;
  if (in_contact_ && !contact) {
    considered_since_.reset();
    reflex_since_.reset();
  }
  follow(considered_since_, level == WarningLevel::kConsidered || level == WarningLevel::kReflex || contact, at);
  follow(reflex_since_, level == WarningLevel::kReflex || contact, at);
  if (contact && !in_contact_) contacts_.push_back({at - *considered_since_, at - *reflex_since_});
  in_contact_ = contact;
}

}  // namespace sweep_guard_simulation
