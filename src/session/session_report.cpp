#include "session/session_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/csv.h"
#include "recording/gnuplot.h"
#include "session/contact_table.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_session {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_core::WarningLevel;
using sweep_guard_recording::gnuplotText;

namespace {

constexpr std::size_t kMaxContactsPrinted = 20;
constexpr std::size_t kMaxContactsDrawn = 40;
constexpr std::array<WarningLevel, 5> kLevels = {WarningLevel::kUnknown, WarningLevel::kClear,
                                                 WarningLevel::kConsidered, WarningLevel::kReflex,
                                                 WarningLevel::kContact};

std::string colorOf(WarningLevel level) {
  const auto& [red, green, blue] = sweep_guard_core::styleOf(level).rgb;
  return fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
}

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
    line += fmt::format("; {} poses waited for the next, or were refused: rate:=0.5 gives this machine more time",
                        covered - swept.size());
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

// One box per segment: middle, row, half width, half height, color.
std::string levelPanel(const SessionLog& log, Time begin) {
  std::string boxes;
  for (const Segment& segment : log.segments()) {
    const double from = seconds(segment.begin, begin);
    const double to = seconds(segment.end, begin);
    boxes += fmt::format("{:.6g} {} {:.6g} 0.4 \"{}\"\n", 0.5 * (from + to), static_cast<int>(segment.level),
                         0.5 * (to - from), colorOf(segment.level));
  }
  std::string tics;
  for (const WarningLevel level : kLevels) {
    tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", nameOf(level), static_cast<int>(level));
  }
  return fmt::format(
      "$levels << EOD\n{}EOD\nset ylabel ''\nset yrange [-0.6:4.6]\nset format x ''\nset ytics font ',11' ({})\n"
      "set style fill solid 1.0 noborder\nrgb(text) = int(sprintf('0x%s', substr(text, 2, 7)))\n"
      "plot -1 notitle, $levels using 1:2:3:4:(rgb(strcol(5))) with boxxyerror lc rgb variable notitle",
      boxes, tics);
}

// An empty line interrupts the curve.
std::string collisionPanel(const SessionLog& log, Time begin) {
  std::string points;
  double highest = 1.0;
  for (const ReceivedWarning& warning : log.warnings()) {
    if (warning.time_to_collision) {
      highest = std::max(highest, toSeconds(*warning.time_to_collision));
      points += fmt::format("{:.6g} {:.6g}", seconds(warning.received, begin), toSeconds(*warning.time_to_collision));
    }
    points += '\n';
  }
  return fmt::format(
      "$collision << EOD\n{}EOD\n"
      "set title 'Time until the predicted path meets a workpiece (0: in contact; no line: it meets none)'\n"
      "set ytics auto font ',14'\nset ylabel '[s]'\nset yrange [-0.05:{:g}]\n"
      "plot -1 notitle, $collision using 1:2 with linespoints pt 7 ps 0.3 lw 2 lc rgb '#0072B2' notitle",
      points, 1.05 * highest);
}

std::string leadPanel(const std::vector<Contact>& contacts, Time begin) {
  const std::string axes =
      "set title 'Lead of the warnings before each contact (numbers: contacts.png; no bar: no warning before it)'\n"
      "set format x '%g'\nset ylabel '[s]'\nset yrange [0:0.2<*]\nset xlabel 'time since the session began [s]'\n";
  if (contacts.empty()) {
    return axes + "set yrange [0:1]\nset label 'no contact' at graph 0.5, 0.5 center\nplot -1 notitle";
  }
  std::string bars;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    bars += fmt::format("{:.6g} {:.6g} {:.6g} {}\n", seconds(contacts[i].begin, begin),
                        toSeconds(contacts[i].considered_lead), toSeconds(contacts[i].reflex_lead), i + 1);
  }
  return fmt::format(
      "{}$leads << EOD\n{}EOD\nset offsets 0, 0, graph 0.15, 0\n"
      "plot $leads using 1:2 with impulses lw 6 lc rgb '{}' notitle, "
      "$leads using 1:3 with impulses lw 6 lc rgb '{}' notitle, $leads using 1:2:4 with labels offset 0, 0.7 notitle",
      axes, bars, colorOf(WarningLevel::kConsidered), colorOf(WarningLevel::kReflex));
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

std::string summary(const SessionLog& log, const SessionBag& bag) {
  const std::vector<Contact> contacts = log.contacts();
  std::string text = fmt::format("session    {:.1f} s, {} poses, {} meshes, {} updates of vertices\n",
                                 toSeconds(bag.end - bag.begin), bag.poses.size(), bag.meshes, bag.vertices);
  text += sweptLine(log, bag);
  text += levelTable(log) + longestUnknown(log, bag.begin);
  text += fmt::format("contacts   {}\n", contacts.size());
  if (contacts.empty()) return text;
  text += leadLine(contacts, WarningLevel::kConsidered, &Contact::considered_lead);
  text += leadLine(contacts, WarningLevel::kReflex, &Contact::reflex_lead);
  return text + ContactTable(contacts, bag.begin, kMaxContactsPrinted).text();
}

std::string timelinePlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path) {
  sweep_guard_recording::PlotPage page(path, /*rows=*/3, /*columns=*/1);
  std::vector<std::string> key;
  key.reserve(kLevels.size());
  for (const WarningLevel level : kLevels) {
    key.push_back(fmt::format("with lines lw 8 lc rgb '{}' title '{}'", colorOf(level), nameOf(level)));
  }
  page.addKey({}, key);
  const std::string frame =
      fmt::format("set xrange [0:{:g}]\nset title {} noenhanced\n", std::max(toSeconds(bag.end - bag.begin), 0.01),
                  gnuplotText("Level of the warning: " + title));
  page.addPanel(0, 0, frame + levelPanel(log, bag.begin));
  page.addPanel(1, 0, collisionPanel(log, bag.begin));
  page.addPanel(2, 0, leadPanel(log.contacts(), bag.begin));
  return page.script();
}

std::string contactsPlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path) {
  return ContactTable(log.contacts(), bag.begin, kMaxContactsDrawn)
      .plot("Contacts of " + title + " and leads of CONSIDERED and REFLEX", path);
}

}  // namespace sweep_guard_session
