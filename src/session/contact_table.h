#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "session/session_log.h"

namespace sweep_guard_session {

/// Returns the contacts of a session as a table for a terminal, indented, with a line feed at the end. A last line says how
/// many contacts were omitted.
/// @param begin         of the session; times count from here
/// @param max_contacts  number of contacts in the table; later ones are omitted
std::string contactTable(const std::vector<Contact>& contacts, sweep_guard_core::Time begin, std::size_t max_contacts);

}  // namespace sweep_guard_session
