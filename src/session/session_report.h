#pragma once

#include <string>

#include "session/session_bag.h"
#include "session/session_log.h"

namespace sweep_guard_session {

/// Returns a CSV file with one line for each contact, numbered from 1; times count from the begin of the session. The
/// columns are contact,begin_s,end_s,stamp_s,mesh,tool_link,triangles,depth_mm,considered_lead_s,reflex_lead_s.
std::string contactsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// Returns a CSV file with one line for each segment. The columns are begin_s,end_s,level,text.
std::string levelsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// Returns a summary for a terminal: the bag, the duration of each level, the contacts and their leads. Ends with a
/// line feed.
std::string summary(const SessionLog& log, const SessionBag& bag);

/// Returns a gnuplot script that plots levels, time to collision and leads over time.
/// @param path  of the PNG file
std::string timelinePlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path);

/// Returns a gnuplot script that draws a table of the first 40 contacts.
/// @param path  of the PNG file
std::string contactsPlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path);

}  // namespace sweep_guard_session
