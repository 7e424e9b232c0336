#include "evaluation/sessions_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/csv.h"
#include "common/number_text.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::InvalidInput;

namespace {

constexpr const char* kAll = "all";

struct Figure {
  const char* column;
  const char* title;  // in the table
  double (*of)(const SessionCount&);
};

constexpr Figure kFigures[] = {
    {"warned_0.1", "warned 0.1 s", [](const auto& f) { return f.warnedShare(0); }},
    {"warned_0.3", "warned 0.3 s", [](const auto& f) { return f.warnedShare(1); }},
    {"warned_0.5", "warned 0.5 s", [](const auto& f) { return f.warnedShare(2); }},
    {"warned_1.0", "warned 1.0 s", [](const auto& f) { return f.warnedShare(3); }},
    {"unjustified_per_min", "unjustified/min", [](const auto& f) { return f.unjustifiedPerMinute(); }},
    {"precision", "precision", [](const auto& f) { return f.precision(); }},
    {"precision_10mm", "within 10 mm", [](const auto& f) { return f.precisionWithin(0); }},
    {"precision_20mm", "within 20 mm", [](const auto& f) { return f.precisionWithin(1); }},
    {"precision_50mm", "within 50 mm", [](const auto& f) { return f.precisionWithin(2); }},
    {"false_on_share", "false on-time", [](const auto& f) { return f.falseOnShare(); }}};

std::vector<double> valuesOf(const SessionCount& figures) {
  std::vector<double> values;
  for (const Figure& figure : kFigures) values.push_back(figure.of(figures));
  return values;
}

std::string csvRow(const std::string& recording, const SessionCount& figures) {
  std::vector<std::string> fields = {recording, csvNumber(figures.minutes), std::to_string(figures.contacts)};
  for (const double value : valuesOf(figures)) fields.push_back(csvNumber(value));
  return csvLine(fields);
}

std::string tableRows(const std::string& recording, const std::vector<RecordingSessions>& recordings) {
  const SessionCount figures = sumOf(recordings);
  const auto intervals = bootstrap([&](size_t draw) { return valuesOf(sumOf(resampled(recordings, draw))); });
  std::string rows = fmt::format("{}: {:.1f} min, {} contacts, {} without REFLEX, {} alarms\n", recording,
                                 figures.minutes, figures.contacts, figures.late, figures.alarms);
  for (size_t i = 0; i < intervals.size(); ++i) {
    const Figure& figure = kFigures[i];
    rows += fmt::format("  {:<16} {:6.3f}  [{:.3f}, {:.3f}]\n", figure.title, figure.of(figures), intervals[i].lower,
                        intervals[i].upper);
  }
  return rows;
}

// Names of the columns and the counts in them, in the same order.
template <typename Function>
void forEachCount(SessionCount& count, const Function& function) {
  function("contacts", count.contacts);
  const char* const warned[] = {"warned_0.1", "warned_0.3", "warned_0.5", "warned_1.0"};
  for (size_t i = 0; i < std::size(warned); ++i) function(warned[i], count.warned[i]);
  function("late", count.late);
  function("alarms", count.alarms);
  function("unjustified", count.unjustified);
  const char* const near[] = {"near_10mm", "near_20mm", "near_50mm"};
  for (size_t i = 0; i < std::size(near); ++i) function(near[i], count.near_misses[i]);
}

std::string objectsHeader() {
  std::vector<std::string> columns = {"recording", "session", "object", "minutes"};
  SessionCount none;
  forEachCount(none, [&](const char* column, size_t /*count*/) { columns.emplace_back(column); });
  return csvLine(columns);
}

template <typename Number>
Number numberAt(std::vector<std::string>& words, size_t index, size_t line) {
  if (const auto number = sweep_guard_core::parseNumber<Number>(words[index])) return *number;
  throw InvalidInput(fmt::format("line {}: '{}' is not a number", line, words[index]));
}

bool sameSessions(const RecordingSessions& a, const RecordingSessions& b) {
  const auto same_objects = [](const auto& x, const auto& y) { return x.size() == y.size(); };
  return a.recording == b.recording &&
         std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(), same_objects) &&
         sumOf(a).contacts == sumOf(b).contacts;
}

std::vector<double> ratiosOf(const SessionCount& now, const SessionCount& before) {
  return {now.unjustifiedPerMinute() / before.unjustifiedPerMinute(), now.precision() - before.precision(),
          now.warnedShare(2) - before.warnedShare(2), now.warnedShare(3) - before.warnedShare(3)};
}

}  // namespace

std::string sessionsCsv(const std::vector<RecordingSessions>& recordings) {
  std::vector<std::string> columns = {"recording", "minutes", "contacts"};
  for (const Figure& figure : kFigures) columns.emplace_back(figure.column);
  std::string csv = csvLine(columns);
  for (const RecordingSessions& recording : recordings) csv += csvRow(recording.recording, sumOf(recording));
  return csv + csvRow(kAll, sumOf(recordings));
}

std::string sessionsTable(const std::vector<RecordingSessions>& recordings) {
  std::string table;
  for (const RecordingSessions& recording : recordings) table += tableRows(recording.recording, {recording});
  return table + tableRows(kAll, recordings);
}

std::string sessionObjectsCsv(const std::vector<RecordingSessions>& recordings) {
  std::string csv = objectsHeader();
  for (const RecordingSessions& recording : recordings) {
    for (size_t session = 0; session < recording.objects.size(); ++session) {
      for (size_t object = 0; object < recording.objects[session].size(); ++object) {
        std::vector<std::string> fields = {recording.recording, std::to_string(session), std::to_string(object),
                                           csvNumber(recording.minutes)};
        SessionCount count = recording.objects[session][object];
        forEachCount(count, [&](const char*, size_t number) { fields.push_back(std::to_string(number)); });
        csv += csvLine(fields);
      }
    }
  }
  return csv;
}

std::vector<RecordingSessions> readSessionObjects(const std::string& csv) {
  std::istringstream stream(csv);
  std::string line;
  std::getline(stream, line);
  if (line + '\n' != objectsHeader()) throw InvalidInput("line 1: not that of a --sessions-objects-csv");
  std::vector<RecordingSessions> recordings;
  for (size_t number = 2; std::getline(stream, line); ++number) {
    std::vector<std::string> words = sweep_guard_core::csvFields(line);
    SessionCount count;
    size_t columns = 4;
    forEachCount(count, [&](const char*, size_t) { ++columns; });
    if (words.size() != columns) throw InvalidInput(fmt::format("line {}: has {} fields", number, words.size()));
    if (recordings.empty() || recordings.back().recording != words[0]) recordings.push_back({words[0], 0.0, {}});
    RecordingSessions& recording = recordings.back();
    recording.minutes = numberAt<double>(words, 3, number);
    if (numberAt<size_t>(words, 1, number) == recording.objects.size()) recording.objects.emplace_back();
    size_t column = 4;
    forEachCount(count, [&](const char*, size_t& value) { value = numberAt<size_t>(words, column++, number); });
    recording.objects.back().push_back(count);
  }
  return recordings;
}

std::string sessionsComparison(const std::vector<RecordingSessions>& recordings,
                               const std::vector<RecordingSessions>& before) {
  if (!std::equal(recordings.begin(), recordings.end(), before.begin(), before.end(), sameSessions)) {
    throw InvalidInput("the runs to compare differ in recordings, sessions, objects or contacts");
  }
  const SessionCount now = sumOf(recordings);
  const std::vector<double> ratios = ratiosOf(now, sumOf(before));
  const auto intervals = bootstrap(
      [&](size_t draw) { return ratiosOf(sumOf(resampled(recordings, draw)), sumOf(resampled(before, draw))); });
  const char* const names[] = {"unjustified alarms per minute, ratio", "precision, difference",
                               "warned 0.5 s ahead, difference", "warned 1.0 s ahead, difference"};
  std::string text = "compared with the other run:\n";
  for (size_t i = 0; i < ratios.size(); ++i) {
    text += fmt::format("  {:<38} {:6.3f}  [{:.3f}, {:.3f}]\n", names[i], ratios[i], intervals[i].lower,
                        intervals[i].upper);
  }
  return text + fmt::format("  {:<38} {} (before: {})\n", "contacts without REFLEX", now.late, sumOf(before).late);
}

}  // namespace sweep_guard_evaluation
