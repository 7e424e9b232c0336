#pragma once

#include <string>

#include "session/session_bag.h"
#include "session/session_log.h"

namespace sweep_guard_session {

/// One line for each contact, times from the begin of the session: `contact,begin_s,end_s,stamp_s,mesh,tool_link,
/// triangles,depth_mm,considered_lead_s,reflex_lead_s`. Contacts are counted from 1.
std::string contactsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// One line for each change of level: `begin_s,end_s,level,text`.
std::string levelsCsv(const SessionLog& log, sweep_guard_core::Time begin);

/// For a terminal: what was played, how long which level was shown, the contacts and their leads. Ends with a line
/// feed.
std::string summary(const SessionLog& log, const SessionBag& bag);

/// A script of gnuplot: levels, time to collision and leads over time.
/// @param title  of the page
/// @param path   of the PNG file
std::string timelinePlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path);

/// The same for a table of the contacts, of the first 40 where there are more.
std::string contactsPlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path);

}  // namespace sweep_guard_session
