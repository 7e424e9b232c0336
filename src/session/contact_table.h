#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "session/session_log.h"

namespace sweep_guard_session {

/// Formats the contacts of a session as a table. A last line says how many contacts were omitted.
class ContactTable {
 public:
  /// @param begin         of the session; times count from here
  /// @param max_contacts  number of contacts in the table; later ones are omitted
  ContactTable(const std::vector<Contact>& contacts, sweep_guard_core::Time begin, std::size_t max_contacts);

  /// Returns the table for a terminal, indented, with a line feed at the end.
  std::string text() const;

  /// Returns a gnuplot script that draws the table.
  /// @param path  of the PNG file
  std::string plot(const std::string& title, const std::string& path) const;

 private:
  std::string omittedText() const;

  std::vector<std::vector<std::string>> rows_;  // by column
  std::size_t omitted_;
};

}  // namespace sweep_guard_session
