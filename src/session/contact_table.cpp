#include "session/contact_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;

namespace {

constexpr std::size_t kMaxName = 24;  // of characters in a cell

struct Column {
  const char* heading;
  int width;  // [characters]
  bool left;  // alignment
};

constexpr std::array<Column, 9> kColumns = {{{"#", 3, false},
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

}  // namespace

std::string contactTable(const std::vector<Contact>& contacts, Time begin, std::size_t max_contacts) {
  std::string table = textLine(headings());
  const std::size_t shown = std::min(contacts.size(), max_contacts);
  for (std::size_t i = 0; i < shown; ++i) table += textLine(cells(contacts[i], i + 1, begin));
  if (shown < contacts.size()) table += fmt::format("  ... and {} more in contacts.csv\n", contacts.size() - shown);
  return table;
}

}  // namespace sweep_guard_session
