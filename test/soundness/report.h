#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <ostream>
#include <string>

namespace sweep_guard_core::soundness {

/// What came of the cases of one family with one detector.
struct Tally {
  std::uint64_t cases = 0;        ///< pairs, constructed positives, relations or sweeps
  std::uint64_t positives = 0;    ///< of them, those that are known to be met
  std::uint64_t misses = 0;       ///< of the positives, those that were not named
  std::uint64_t extras = 0;       ///< named though they are not met
  std::uint64_t unexplained = 0;  ///< of the extras, those farther away than margin and inflation allow
};

/// Adds up what the families find, and writes down the first few failures for a replay.
class Report {
 public:
  explicit Report(std::ostream& out) : out_(out) {}

  /// By family and detector.
  Tally& of(const std::string& detector, const std::string& family) { return tallies_[family][detector]; }
  const std::map<std::string, Tally>& ofFamily(const std::string& family) { return tallies_[family]; }

  /// A case that failed.
  /// @param text  gives the case as text that can be replayed; asked for the first few only
  void fail(const std::string& what, const std::function<std::string()>& text);

  std::uint64_t failures() const { return failures_; }

  /// One line for each detector and family.
  void summarize() const;

 private:
  std::ostream& out_;
  std::map<std::string, std::map<std::string, Tally>> tallies_;
  std::uint64_t failures_ = 0;
};

}  // namespace sweep_guard_core::soundness
