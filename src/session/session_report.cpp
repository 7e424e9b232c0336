#include "session/session_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/csv.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_session {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_core::WarningLevel;

namespace {

constexpr std::size_t kMaxContactsPrinted = 20;
constexpr std::array<WarningLevel, 5> kLevels = {WarningLevel::kUnknown, WarningLevel::kClear,
                                                 WarningLevel::kConsidered, WarningLevel::kReflex,
                                                 WarningLevel::kContact};

const char* nameOf(WarningLevel level) { return sweep_guard_core::styleOf(level).name; }

double seconds(Time time, Time begin) { return toSeconds(time - begin); }

std::string fixed(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.4f}", value); }

// REFLEX     ahead of 12 of 12, by 0.21 s in the median, 0.12 s at the least
std::string leadLine(const std::vector<Contact>& contacts, WarningLevel level, Duration Contact::*lead) {
  std::vector<double> leads;
  leads.reserve(contacts.size());
  for (const Contact& contact : contacts) leads.push_back(toSeconds(contact.*lead));
  const auto ahead = std::count_if(leads.begin(), leads.end(), [](double seconds) { return seconds > 0.0; });
  return fmt::format("  {:<10} ahead of {} of {}, by {:.2f} s in the median, {:.2f} s at the least\n", nameOf(level),
                     ahead, leads.size(), sweep_guard_core::quantile(leads, 0.5),
                     *std::min_element(leads.begin(), leads.end()));
}

std::string levelTable(const SessionLog& log) {
  const std::vector<Segment> segments = log.segments();
  const double whole = segments.empty() ? 1.0 : toSeconds(segments.back().end - segments.front().begin);
  std::string table = "levels\n";
  for (const WarningLevel level : kLevels) {
    const double lasted = toSeconds(log.duration(level));
    table += fmt::format("  {:<10} {:8.1f} s {:5.1f} %\n", nameOf(level), lasted, 100.0 * lasted / whole);
  }
  return table;
}

std::string startOf(const SessionBag& bag) {
  return bag.start > bag.begin ? fmt::format(" (played from {:.1f} s on)", seconds(bag.start, bag.begin)) : "";
}

// Poses that waited are swept at once.
std::string sweptLine(const SessionLog& log, const SessionBag& bag) {
  const sweep_guard_recording::SweptIntervals& swept = log.swept();
  if (swept.size() == 0) return "swept      NOTHING WAS SWEPT; see the reasons for UNKNOWN\n";
  std::string line = fmt::format("swept      {} times, ", swept.size());
  line += swept.gaps() > Duration(0) ? fmt::format("{:.3f} s between two poses NOT SWEPT", toSeconds(swept.gaps()))
                                     : "without a gap";
  const auto covered = static_cast<std::size_t>(
      std::count_if(bag.poses.begin(), bag.poses.end(), [&swept](Time pose) { return swept.covers(pose); }));
  if (covered > swept.size()) {
    line += fmt::format(
        "; {} poses waited for the next, up to {:.3f} s were swept at once, or were refused: rate:=0.5 gives this "
        "machine more time",
        covered - swept.size(), toSeconds(swept.longest()));
  }
  if (covered < bag.poses.size()) line += fmt::format("\n           {} poses NOT SWEPT", bag.poses.size() - covered);
  if (!bag.poses.empty() && *swept.last() < bag.poses.back()) {
    line += fmt::format(", including the last {:.3f} s", toSeconds(bag.poses.back() - *swept.last()));
  }
  return line + '\n';
}

std::string longestUnknown(const SessionLog& log, Time begin) {
  const std::vector<Segment> segments = log.segments();
  const Segment* longest = nullptr;
  for (const Segment& segment : segments) {
    if (segment.level != WarningLevel::kUnknown) continue;
    if (longest == nullptr || segment.end - segment.begin > longest->end - longest->begin) longest = &segment;
  }
  if (longest == nullptr) return "";
  return fmt::format("  longest UNKNOWN: {:.1f} s, from {:.1f} s on: {}\n", toSeconds(longest->end - longest->begin),
                     seconds(longest->begin, begin), longest->text);
}

constexpr std::size_t kMaxName = 24;  // of characters in a cell

struct TableColumn {
  const char* heading;
  int width;  // [characters]
  bool left;  // alignment
};

constexpr std::array<TableColumn, 9> kColumns = {{{"#", 3, false},
                                                  {"begin [s]", 9, false},
                                                  {"lasts [s]", 9, false},
                                                  {"workpiece", 12, true},
                                                  {"link of the tool", 16, true},
                                                  {"triangles", 9, false},
                                                  {"depth [mm]", 10, false},
                                                  {"CONSIDERED", 12, false},
                                                  {"REFLEX", 8, false}}};

// Replaces control characters, and cuts no UTF-8 character.
std::string printable(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  if (name.size() <= kMaxName) return name;
  std::size_t end = kMaxName;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return name.substr(0, end) + "...";
}

std::string ahead(Duration lead) { return lead > Duration(0) ? fmt::format("{:.2f} s", toSeconds(lead)) : "none"; }

std::vector<std::string> cells(const Contact& contact, std::size_t number, Time begin) {
  return {std::to_string(number),
          fmt::format("{:.2f}", toSeconds(contact.begin - begin)),
          fmt::format("{:.2f}", toSeconds(contact.end - contact.begin)),
          printable(contact.mesh_id),
          printable(contact.tool_link),
          std::to_string(contact.triangles.size()),
          std::isnan(contact.depth) ? "-" : fmt::format("{:.1f}", 1e3 * contact.depth),
          ahead(contact.considered_lead),
          ahead(contact.reflex_lead)};
}

std::vector<std::string> headings() {
  std::vector<std::string> headings;
  headings.reserve(std::size(kColumns));
  for (const TableColumn& column : kColumns) headings.emplace_back(column.heading);
  return headings;
}

std::string textLine(const std::vector<std::string>& cells) {
  std::string line = " ";
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const int width = kColumns[i].width;
    line += kColumns[i].left ? fmt::format(" {:<{}}", cells[i], width) : fmt::format(" {:>{}}", cells[i], width);
  }
  return line + '\n';
}

}  // namespace

std::string contactsCsv(const SessionLog& log, Time begin) {
  std::string csv = csvLine({"contact", "begin_s", "end_s", "stamp_s", "mesh", "tool_link", "triangles", "depth_mm",
                             "considered_lead_s", "reflex_lead_s"});
  std::size_t number = 0;
  for (const Contact& contact : log.contacts()) {
    csv += csvLine({std::to_string(++number), fixed(seconds(contact.begin, begin)), fixed(seconds(contact.end, begin)),
                    fmt::format("{:.6f}", toSeconds(contact.begin.time_since_epoch())), contact.mesh_id,
                    contact.tool_link, std::to_string(contact.triangles.size()), csvNumber(1e3 * contact.depth),
                    fixed(toSeconds(contact.considered_lead)), fixed(toSeconds(contact.reflex_lead))});
  }
  return csv;
}

std::string levelsCsv(const SessionLog& log, Time begin) {
  std::string csv = csvLine({"begin_s", "end_s", "level", "text"});
  for (const Segment& segment : log.segments()) {
    csv += csvLine({fixed(seconds(segment.begin, begin)), fixed(seconds(segment.end, begin)), nameOf(segment.level),
                    segment.text});
  }
  return csv;
}

std::string collisionsCsv(const SessionLog& log, Time begin) {
  std::string csv = csvLine({"received_s", "time_to_collision_s"});
  for (const LoggedWarning& warning : log.warnings()) {
    const auto& time = warning.time_to_collision;
    csv += csvLine({fixed(seconds(warning.received, begin)), time ? fixed(toSeconds(*time)) : ""});
  }
  return csv;
}

std::string summary(const SessionLog& log, const SessionBag& bag) {
  const std::vector<Contact> contacts = log.contacts();
  std::string text =
      fmt::format("session    {:.1f} s{}, {} poses, {} meshes, {} updates of vertices\n",
                  toSeconds(bag.end - bag.begin), startOf(bag), bag.poses.size(), bag.meshes, bag.vertices);
  for (const std::string& camera : bag.cameras) text += "camera     " + camera + '\n';
  for (const std::string& line : bag.config) text += "config     " + line + '\n';
  for (const std::string& missing : bag.missing) text += "missing    " + missing + '\n';
  text += sweptLine(log, bag);
  text += levelTable(log) + longestUnknown(log, bag.begin);
  text += fmt::format("contacts   {}\n", contacts.size());
  if (contacts.empty()) return text;
  text += leadLine(contacts, WarningLevel::kConsidered, &Contact::considered_lead);
  text += leadLine(contacts, WarningLevel::kReflex, &Contact::reflex_lead);
  return text + contactTable(contacts, bag.begin, kMaxContactsPrinted);
}

std::string contactTable(const std::vector<Contact>& contacts, Time begin, std::size_t max_contacts) {
  std::string table = textLine(headings());
  const std::size_t shown = std::min(contacts.size(), max_contacts);
  for (std::size_t i = 0; i < shown; ++i) table += textLine(cells(contacts[i], i + 1, begin));
  if (shown < contacts.size()) table += fmt::format("  ... and {} more in contacts.csv\n", contacts.size() - shown);
  return table;
}

}  // namespace sweep_guard_session
