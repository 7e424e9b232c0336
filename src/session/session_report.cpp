#include "session/session_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "evaluation/csv.h"
#include "evaluation/format.h"
#include "evaluation/gnuplot.h"
#include "session/contact_table.h"

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_core::WarningLevel;
using sweep_guard_evaluation::csvLine;
using sweep_guard_evaluation::csvNumber;
using sweep_guard_evaluation::format;
using sweep_guard_evaluation::gnuplotText;

namespace {

constexpr std::size_t kMaxContactsPrinted = 20;
constexpr std::size_t kMaxContactsDrawn = 40;
constexpr std::array<WarningLevel, 5> kLevels = {WarningLevel::kUnknown, WarningLevel::kClear,
                                                 WarningLevel::kConsidered, WarningLevel::kReflex,
                                                 WarningLevel::kContact};

const char* colourOf(WarningLevel level) {
  switch (level) {
    case WarningLevel::kClear:
      return "#009E73";
    case WarningLevel::kConsidered:
      return "#E69F00";
    case WarningLevel::kReflex:
      return "#D00000";
    case WarningLevel::kContact:
      return "#7B0099";
    default:
      return "#888888";
  }
}

double seconds(Time time, Time begin) { return toSeconds(time - begin); }

std::string fixed(double value) { return std::isnan(value) ? "nan" : format("%.4f", value); }

Duration median(std::vector<Duration> durations) {
  const auto middle = durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2);
  std::nth_element(durations.begin(), middle, durations.end());
  return *middle;
}

// REFLEX     12 of 12, 0.21 s in the median, 0.12 s at the least
std::string leadLine(const std::vector<Contact>& contacts, WarningLevel level, Duration Contact::*lead) {
  std::vector<Duration> leads;
  leads.reserve(contacts.size());
  for (const Contact& contact : contacts) leads.push_back(contact.*lead);
  const auto ahead = std::count_if(leads.begin(), leads.end(), [](Duration d) { return d > Duration(0); });
  return format("  %-10s ahead of %td of %zu, by %.2f s in the median, %.2f s at the least\n",
                sweep_guard_core::styleOf(level).name, ahead, leads.size(), toSeconds(median(leads)),
                toSeconds(*std::min_element(leads.begin(), leads.end())));
}

std::string levelTable(const SessionLog& log) {
  const std::vector<Segment> segments = log.segments();
  const double whole = segments.empty() ? 1.0 : toSeconds(segments.back().end - segments.front().begin);
  std::string table = "levels\n";
  for (const WarningLevel level : kLevels) {
    const double lasted = toSeconds(log.duration(level));
    table +=
        format("  %-10s %8.1f s %5.1f %%\n", sweep_guard_core::styleOf(level).name, lasted, 100.0 * lasted / whole);
  }
  return table;
}

// A backlog is swept at once, through all of its poses.
std::string sweptLine(const SessionLog& log, const SessionBag& bag) {
  const sweep_guard_recording::SweptIntervals& swept = log.swept();
  if (swept.size() == 0) return "swept      NOTHING WAS SWEPT; what was UNKNOWN tells why\n";
  std::string line = format("swept      %zu times, ", swept.size());
  line += swept.holes() > Duration(0) ? format("%.3f s between two poses NOT SWEPT", toSeconds(swept.holes()))
                                      : std::string("without a gap");
  const auto covered = static_cast<std::size_t>(
      std::count_if(bag.poses.begin(), bag.poses.end(), [&swept](Time pose) { return swept.cover(pose); }));
  if (covered > swept.size()) {
    line += format("; %zu poses waited for the next, or were refused: rate:=0.5 gives this machine more time",
                   covered - swept.size());
  }
  if (covered < bag.poses.size()) line += format("\n           %zu poses NOT SWEPT", bag.poses.size() - covered);
  if (!bag.poses.empty() && *swept.last() < bag.poses.back()) {
    line += format(", all of the last %.3f s", toSeconds(bag.poses.back() - *swept.last()));
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
  return format("  longest UNKNOWN: %.1f s, from %.1f s on: %s\n", toSeconds(longest->end - longest->begin),
                seconds(longest->begin, begin), longest->text.c_str());
}

// A box from tic to tic for each segment: middle, row, half width, half height, colour.
std::string levelPanel(const SessionLog& log, Time begin) {
  std::ostringstream panel;
  panel << "$levels << EOD\n";
  for (const Segment& segment : log.segments()) {
    const double from = seconds(segment.begin, begin);
    const double to = seconds(segment.end, begin);
    panel << 0.5 * (from + to) << ' ' << static_cast<int>(segment.level) << ' ' << 0.5 * (to - from) << " 0.4 \""
          << colourOf(segment.level) << "\"\n";
  }
  panel << "EOD\nset ylabel ''\nset yrange [-0.6:4.6]\nset format x ''\nset ytics font ',11' (";
  for (const WarningLevel level : kLevels) {
    panel << (level == WarningLevel::kUnknown ? "" : ", ") << "'" << sweep_guard_core::styleOf(level).name << "' "
          << static_cast<int>(level);
  }
  panel << ")\nset style fill solid 1.0 noborder\n"
        << "rgb(text) = int(sprintf('0x%s', substr(text, 2, 7)))\n"
        << "plot -1 notitle, $levels using 1:2:3:4:(rgb(strcol(5))) with boxxyerror lc rgb variable notitle";
  return panel.str();
}

// Where none is expected, the line is interrupted.
std::string collisionPanel(const SessionLog& log, Time begin) {
  std::ostringstream panel;
  double highest = 1.0;
  panel << "$collision << EOD\n";
  for (const Told& told : log.told()) {
    if (told.time_to_collision) {
      highest = std::max(highest, toSeconds(*told.time_to_collision));
      panel << seconds(told.at, begin) << ' ' << toSeconds(*told.time_to_collision);
    }
    panel << '\n';
  }
  panel << "EOD\nset title 'Time until the predicted path meets a workpiece (0: in contact; no line: it meets none)'\n"
        << "set ytics auto font ',14'\nset ylabel '[s]'\nset yrange [-0.05:" << 1.05 * highest << "]\n"
        << "plot -1 notitle, $collision using 1:2 with linespoints pt 7 ps 0.3 lw 2 lc rgb '#0072B2' notitle";
  return panel.str();
}

std::string leadPanel(const std::vector<Contact>& contacts, Time begin) {
  std::ostringstream panel;
  panel << "set title 'How long before each contact the warnings came on (numbers: contacts.png; no bar: not before "
           "it)'\n"
        << "set format x '%g'\nset ylabel '[s]'\nset yrange [0:0.2<*]\nset xlabel 'time since the begin of the session "
           "[s]'\n";
  if (contacts.empty())
    return panel.str() + "set yrange [0:1]\nset label 'no contact' at graph 0.5, 0.5 center\nplot -1 notitle";
  panel << "$leads << EOD\n";
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    panel << seconds(contacts[i].begin, begin) << ' ' << toSeconds(contacts[i].considered_lead) << ' '
          << toSeconds(contacts[i].reflex_lead) << ' ' << i + 1 << '\n';
  }
  panel << "EOD\nset offsets 0, 0, graph 0.15, 0\n"
        << "plot $leads using 1:2 with impulses lw 6 lc rgb '" << colourOf(WarningLevel::kConsidered) << "' notitle, "
        << "$leads using 1:3 with impulses lw 6 lc rgb '" << colourOf(WarningLevel::kReflex) << "' notitle, "
        << "$leads using 1:2:4 with labels offset 0, 0.7 notitle";
  return panel.str();
}

}  // namespace

std::string contactsCsv(const SessionLog& log, Time begin) {
  std::string csv = csvLine({"contact", "begin_s", "end_s", "stamp_s", "mesh", "tool_link", "triangles", "depth_mm",
                             "considered_lead_s", "reflex_lead_s"});
  std::size_t number = 0;
  for (const Contact& contact : log.contacts()) {
    csv += csvLine({std::to_string(++number), fixed(seconds(contact.begin, begin)), fixed(seconds(contact.end, begin)),
                    format("%.6f", toSeconds(contact.begin.time_since_epoch())), contact.mesh_id, contact.tool_link,
                    std::to_string(contact.triangles.size()), csvNumber(1e3 * contact.depth),
                    fixed(toSeconds(contact.considered_lead)), fixed(toSeconds(contact.reflex_lead))});
  }
  return csv;
}

std::string levelsCsv(const SessionLog& log, Time begin) {
  std::string csv = csvLine({"begin_s", "end_s", "level", "text"});
  for (const Segment& segment : log.segments()) {
    csv += csvLine({fixed(seconds(segment.begin, begin)), fixed(seconds(segment.end, begin)),
                    sweep_guard_core::styleOf(segment.level).name, segment.text});
  }
  return csv;
}

std::string summary(const SessionLog& log, const SessionBag& bag) {
  const std::vector<Contact> contacts = log.contacts();
  std::string text = format("session    %.1f s, %zu poses, %zu meshes, %zu updates of vertices\n",
                            toSeconds(bag.end - bag.begin), bag.poses.size(), bag.meshes, bag.vertices);
  text += sweptLine(log, bag);
  text += levelTable(log) + longestUnknown(log, bag.begin);
  text += format("contacts   %zu\n", contacts.size());
  if (contacts.empty()) return text;
  text += leadLine(contacts, WarningLevel::kConsidered, &Contact::considered_lead);
  text += leadLine(contacts, WarningLevel::kReflex, &Contact::reflex_lead);
  return text + ContactTable(contacts, bag.begin, kMaxContactsPrinted).text();
}

std::string timelinePlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path) {
  sweep_guard_evaluation::PlotPage page(path, /*rows=*/3, /*columns=*/1);
  std::vector<std::string> key;
  key.reserve(kLevels.size());
  for (const WarningLevel level : kLevels) {
    key.push_back(
        format("with lines lw 8 lc rgb '%s' title '%s'", colourOf(level), sweep_guard_core::styleOf(level).name));
  }
  page.addKey({}, key);
  const std::string frame = format("set xrange [0:%g]\n", std::max(toSeconds(bag.end - bag.begin), 0.01)) +
                            "set title " + gnuplotText("What the guard told: " + title) + " noenhanced\n";
  page.addPanel(0, 0, frame + levelPanel(log, bag.begin));
  page.addPanel(1, 0, collisionPanel(log, bag.begin));
  page.addPanel(2, 0, leadPanel(log.contacts(), bag.begin));
  return page.script();
}

std::string contactsPlot(const SessionLog& log, const SessionBag& bag, const std::string& title,
                         const std::string& path) {
  return ContactTable(log.contacts(), bag.begin, kMaxContactsDrawn)
      .plot("Contacts of " + title + ", and how long before them CONSIDERED and REFLEX came on", path);
}

}  // namespace sweep_guard_session
