#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <ostream>
#include <string>

namespace sweep_guard_core::soundness {

/// Counts of one family with one detector.
struct Tally {
  std::uint64_t cases = 0;        ///< pairs, constructed positives, relations or sweeps
  std::uint64_t positives = 0;    ///< cases known to be met
  std::uint64_t misses = 0;       ///< positives that were not named
  std::uint64_t extras = 0;       ///< triangles named and not met
  std::uint64_t unexplained = 0;  ///< extras beyond margin and inflation
};

/// Counts the results of the families and writes the first failures for a replay.
class Report {
 public:
  explicit Report(std::ostream& out) : out_(out) {}

  Tally& of(const std::string& detector, const std::string& family) { return tallies_[family][detector]; }
  const std::map<std::string, Tally>& ofFamily(const std::string& family) { return tallies_[family]; }

  /// Reports a failed case.
  /// @param text  returns the case as text; called for the first failures only
  void fail(const std::string& what, const std::function<std::string()>& text);

  std::uint64_t failures() const { return failures_; }

  /// Prints one line for each detector and family.
  void summarize() const;

 private:
  std::ostream& out_;
  std::map<std::string, std::map<std::string, Tally>> tallies_;
  std::uint64_t failures_ = 0;
};

}  // namespace sweep_guard_core::soundness
