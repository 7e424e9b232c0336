#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "session/session_log.h"

namespace sweep_guard_session {

/// The contacts of a session for people: a line each, and a last one that says how many were left out.
class ContactTable {
 public:
  /// @param begin  of the session, from which the times count
  /// @param most   contacts that are listed, the first ones
  ContactTable(const std::vector<Contact>& contacts, sweep_guard_core::Time begin, std::size_t most);

  /// For a terminal, indented; ends with a line feed.
  std::string text() const;

  /// A script of gnuplot.
  /// @param title  of the picture
  /// @param path   of the PNG file
  std::string plot(const std::string& title, const std::string& path) const;

 private:
  std::string leftOut() const;

  std::vector<std::vector<std::string>> rows_;  // by column
  std::size_t left_out_;
};

}  // namespace sweep_guard_session
