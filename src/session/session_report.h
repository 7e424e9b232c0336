#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "session/session_bag.h"
#include "session/session_log.h"

namespace sweep_guard_session {

/// Returns a CSV file with one line for each contact, numbered from 1; times count from the begin of the session. The
/// columns are contact,begin_s,end_s,stamp_s,mesh,tool_link,triangles,depth_mm,considered_lead_s,reflex_lead_s.
std::string contactsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// Returns a CSV file with one line for each segment. The columns are begin_s,end_s,level,text.
std::string levelsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// Returns a CSV file with one line for each warning. The columns are received_s,time_to_collision_s; the time is empty if no
/// collision is predicted, or not known.
std::string collisionsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// Returns a summary for a terminal: the bag, the duration of each level, the contacts and their leads. Ends with a
/// line feed.
std::string summary(const SessionLog& log, const SessionBag& bag);

/// Returns the contacts of a session as a table for a terminal, indented, with a line feed at the end. A last line says how
/// many contacts were omitted.
/// @param begin         of the session; times count from here
/// @param max_contacts  number of contacts in the table; later ones are omitted
std::string contactTable(const std::vector<Contact>& contacts, sweep_guard_core::Time begin, std::size_t max_contacts);

}  // namespace sweep_guard_session
