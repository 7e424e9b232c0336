#include "session/contact_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "recording/gnuplot.h"

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_recording::gnuplotText;

namespace {

constexpr std::size_t kMaxName = 24;  // of characters in a cell
constexpr double kWidth = 1300.0;     // of the picture, all in [pixel]
constexpr double kTop = 60.0;         // above the headings
constexpr double kRow = 30.0;
constexpr double kBottom = 20.0;

struct Column {
  const char* heading;
  int width;  // [characters]
  bool left;  // alignment
  double at;  // position of the aligned side [pixel]
};

constexpr std::array<Column, 9> kColumns = {{{"#", 3, false, 70.0},
                                             {"begin [s]", 9, false, 190.0},
                                             {"lasts [s]", 9, false, 310.0},
                                             {"workpiece", 12, true, 350.0},
                                             {"link of the tool", 16, true, 600.0},
                                             {"triangles", 9, false, 895.0},
                                             {"depth [mm]", 10, false, 1015.0},
                                             {"CONSIDERED", 12, false, 1160.0},
                                             {"REFLEX", 8, false, 1260.0}}};

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
  for (const Column& column : kColumns) headings.emplace_back(column.heading);
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

std::string label(const std::string& text, double x, double y, const std::string& side, const std::string& font) {
  return fmt::format("set label {} at {:g},{:g} {} font '{}' noenhanced\n", gnuplotText(text), x, y, side, font);
}

std::string plotLine(const std::vector<std::string>& cells, double y, const std::string& font) {
  std::string line;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    line += label(cells[i], kColumns[i].at, y, kColumns[i].left ? "left" : "right", font);
  }
  return line;
}

}  // namespace

ContactTable::ContactTable(const std::vector<Contact>& contacts, Time begin, std::size_t max_contacts)
    : omitted_(contacts.size() - std::min(contacts.size(), max_contacts)) {
  for (std::size_t i = 0; i < contacts.size() - omitted_; ++i) rows_.push_back(cells(contacts[i], i + 1, begin));
}

std::string ContactTable::omittedText() const { return fmt::format("... and {} more in contacts.csv", omitted_); }

std::string ContactTable::text() const {
  std::string text = textLine(headings());
  for (const auto& row : rows_) text += textLine(row);
  if (omitted_ > 0) text += "  " + omittedText() + '\n';
  return text;
}

// The axes are in pixels; y points down.
std::string ContactTable::plot(const std::string& title, const std::string& path) const {
  const std::size_t lines = 1 + std::max<std::size_t>(rows_.size(), 1) + (omitted_ > 0 ? 1 : 0);
  const double height = kTop + static_cast<double>(lines) * kRow + kBottom;
  std::string script = fmt::format(
      "set terminal pngcairo size {0},{1} font 'sans,12'\nset output {2}\nset margins 0, 0, 0, 0\n"
      "unset tics\nunset border\nunset key\nset xrange [0:{0}]\nset yrange [{1}:0]\n",
      kWidth, height, gnuplotText(path));
  script += label(title, 0.5 * kWidth, 0.5 * kTop, "center", "sans,14");
  double y = kTop + 0.5 * kRow;
  script += plotLine(headings(), y, "sans:Bold,12") +
            fmt::format("set arrow from 30,{0} to {1},{0} nohead lw 1.5\n", y + 0.5 * kRow, kWidth - 30.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    y += kRow;
    if (i % 2 == 1) {
      script += fmt::format("set object rectangle from 30,{} to {},{} behind fs solid noborder fc rgb '#eeeeee'\n",
                            y - 0.5 * kRow, kWidth - 30.0, y + 0.5 * kRow);
    }
    script += plotLine(rows_[i], y, "sans,12");
  }
  if (rows_.empty()) script += label("no contact", 0.5 * kWidth, y + kRow, "center", "sans,12");
  if (omitted_ > 0) script += label(omittedText(), kColumns[3].at, y + kRow, "left", "sans:Italic,12");
  return script + "plot -1 notitle\n";
}

}  // namespace sweep_guard_session
