#pragma once

#include <string>
#include <vector>

#include "evaluation/session_summary.h"

namespace sweep_guard_evaluation {

/// Returns a CSV file with a row for each recording, and the row `all` for all of them together, with the columns
/// recording,minutes,contacts,warned_0.1,warned_0.3,warned_0.5,warned_1.0,unjustified_per_min,precision,precision_10mm,
/// precision_20mm,precision_50mm,false_on_share.
std::string sessionsCsv(const std::vector<RecordingSessions>& recordings);

/// Returns the same as a table for the terminal, with the contacts that REFLEX missed and 95 % intervals.
std::string sessionsTable(const std::vector<RecordingSessions>& recordings);

/// Returns a CSV file with a row for each object of each session: what another run of the same sessions can be compared
/// with. Columns: recording,session,object,minutes,contacts,warned_0.1,warned_0.3,warned_0.5,warned_1.0,late,alarms,
/// unjustified,near_10mm,near_20mm,near_50mm.
std::string sessionObjectsCsv(const std::vector<RecordingSessions>& recordings);

/// Reads such a file. The times of the unjustified alarms are not in it.
/// @throws sweep_guard_core::InvalidInput naming the line that cannot be read
std::vector<RecordingSessions> readSessionObjects(const std::string& csv);

/// Returns the ratio of the unjustified alarms of all recordings to those of another run of the same sessions, with its
/// 95 % interval by paired bootstrap, as text for the terminal.
/// @throws sweep_guard_core::InvalidInput if the runs differ in recordings, sessions, objects or contacts
std::string sessionsComparison(const std::vector<RecordingSessions>& recordings,
                               const std::vector<RecordingSessions>& before);

}  // namespace sweep_guard_evaluation
