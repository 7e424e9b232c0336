#include "session/contact_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "evaluation/format.h"
#include "evaluation/gnuplot.h"

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_evaluation::format;
using sweep_guard_evaluation::gnuplotText;

namespace {

constexpr std::size_t kMaxName = 24;  // of characters in a cell
constexpr double kWidth = 1300.0;     // of the picture, all in [pixel]
constexpr double kTop = 60.0;         // above the headings
constexpr double kRow = 30.0;
constexpr double kBottom = 20.0;

struct Column {
  const char* heading;
  int width;  // [characters]; negative: the text is at its left
  double at;  // [pixel] of the side that the text is at
};

constexpr std::array<Column, 9> kColumns = {{{"#", 3, 70.0},
                                             {"begin [s]", 9, 190.0},
                                             {"lasts [s]", 9, 310.0},
                                             {"workpiece", -12, 350.0},
                                             {"link of the tool", -16, 600.0},
                                             {"triangles", 9, 895.0},
                                             {"depth [mm]", 10, 1015.0},
                                             {"CONSIDERED", 12, 1160.0},
                                             {"REFLEX", 8, 1260.0}}};

// What is no text for one line is replaced, and no character of several bytes is cut.
std::string shown(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  if (name.size() <= kMaxName) return name;
  std::size_t end = kMaxName;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return name.substr(0, end) + "...";
}

std::string ahead(Duration lead) { return lead > Duration(0) ? format("%.2f s", toSeconds(lead)) : "none"; }

std::vector<std::string> cells(const Contact& contact, std::size_t number, Time begin) {
  return {std::to_string(number),
          format("%.2f", toSeconds(contact.begin - begin)),
          format("%.2f", toSeconds(contact.end - contact.begin)),
          shown(contact.mesh_id),
          shown(contact.tool_link),
          std::to_string(contact.triangles.size()),
          std::isnan(contact.depth) ? "-" : format("%.1f", 1e3 * contact.depth),
          ahead(contact.considered_lead),
          ahead(contact.reflex_lead)};
}

std::vector<std::string> headings() {
  std::vector<std::string> headings;
  for (const Column& column : kColumns) headings.emplace_back(column.heading);
  return headings;
}

std::string textLine(const std::vector<std::string>& cells) {
  std::string line = " ";
  for (std::size_t i = 0; i < kColumns.size(); ++i) line += format(" %*s", kColumns[i].width, cells[i].c_str());
  return line + '\n';
}

std::string label(const std::string& text, double x, double y, const std::string& side, const std::string& font) {
  return format("set label %s at %g,%g %s font '%s' noenhanced\n", gnuplotText(text).c_str(), x, y, side.c_str(),
                font.c_str());
}

std::string plotLine(const std::vector<std::string>& cells, double y, const std::string& font) {
  std::string line;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    line += label(cells[i], kColumns[i].at, y, kColumns[i].width < 0 ? "left" : "right", font);
  }
  return line;
}

}  // namespace

ContactTable::ContactTable(const std::vector<Contact>& contacts, Time begin, std::size_t most)
    : left_out_(contacts.size() - std::min(contacts.size(), most)) {
  for (std::size_t i = 0; i < contacts.size() - left_out_; ++i) rows_.push_back(cells(contacts[i], i + 1, begin));
}

std::string ContactTable::leftOut() const { return format("... and %zu more in contacts.csv", left_out_); }

std::string ContactTable::text() const {
  std::string text = textLine(headings());
  for (const auto& row : rows_) text += textLine(row);
  if (left_out_ > 0) text += "  " + leftOut() + '\n';
  return text;
}

// One unit of the axes is one pixel, y counts down.
std::string ContactTable::plot(const std::string& title, const std::string& path) const {
  const std::size_t lines = 1 + std::max<std::size_t>(rows_.size(), 1) + (left_out_ > 0 ? 1 : 0);
  const double height = kTop + static_cast<double>(lines) * kRow + kBottom;
  std::ostringstream script;
  script << "set terminal pngcairo size " << kWidth << ',' << height << " font 'sans,12'\n"
         << "set output " << gnuplotText(path) << "\nset margins 0, 0, 0, 0\nunset tics\nunset border\nunset key\n"
         << "set xrange [0:" << kWidth << "]\nset yrange [" << height << ":0]\n"
         << label(title, 0.5 * kWidth, 0.5 * kTop, "center", "sans,14");
  double y = kTop + 0.5 * kRow;
  script << plotLine(headings(), y, "sans:Bold,12") << "set arrow from 30," << y + 0.5 * kRow << " to " << kWidth - 30.0
         << ',' << y + 0.5 * kRow << " nohead lw 1.5\n";
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    y += kRow;
    if (i % 2 == 1) {
      script << "set object rectangle from 30," << y - 0.5 * kRow << " to " << kWidth - 30.0 << ',' << y + 0.5 * kRow
             << " behind fs solid noborder fc rgb '#eeeeee'\n";
    }
    script << plotLine(rows_[i], y, "sans,12");
  }
  if (rows_.empty()) script << label("no contact", 0.5 * kWidth, y + kRow, "center", "sans,12");
  if (left_out_ > 0) script << label(leftOut(), kColumns[3].at, y + kRow, "left", "sans:Italic,12");
  script << "plot -1 notitle\n";
  return script.str();
}

}  // namespace sweep_guard_session
