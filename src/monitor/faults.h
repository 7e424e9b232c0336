#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Keeps faults until they end: `faults` and `failure` of the inputs.
class Faults {
 public:
  /// @param inputs  must outlive this
  explicit Faults(WarningInputs& inputs) : inputs_(inputs) {}

  /// Adds a fault that ends with a pose received later. Not of a reason that set() is called with.
  void add(Reason reason, const std::string& message);
  /// Adds an exception. It replaces the one before, and is lasting if that one was.
  void addFailure(Reason reason, const char* message, SteadyTime now, bool lasting) noexcept;
  std::uint64_t count() const { return count_; }  ///< faults and failures added so far
  /// Ends what was added before a pose was received. A failure is shown for 0.1 s at least.
  /// @param count  count() at that time
  void endBefore(std::uint64_t count, SteadyTime now);
  /// Ends all but lasting failures and what was set.
  void restart();

  /// Sets a fault that lasts until it is set again.
  /// @param message  empty: none
  void set(Reason reason, const std::string& message);
  std::string get(Reason reason) const;  ///< what was set; empty: none

 private:
  void endFailure(SteadyTime now);

  WarningInputs& inputs_;
  std::uint64_t count_ = 0;
  std::map<Reason, std::uint64_t> numbers_;  // of the faults that were added
  std::uint64_t failure_number_ = 0;
  std::map<Reason, std::string> lasting_;
};

/// Keeps the ids of workpieces whose messages of one kind were refused, until a valid one comes.
class Refusals {
 public:
  /// Keeps the refusals of 1024 ids: more than there may be workpieces. Beyond these, only the newest message is kept,
  /// and nothing ends it, because it is no longer known which of these ids a valid message came for.
  void add(const std::string& id, const WarningInputs::Event& refusal);
  /// Ends the refusals of this id that were received no later.
  /// @returns whether there were any
  bool accept(const std::string& id, SteadyTime received);

  /// Returns the message about the last of these ids that is refused, or of those beyond the 1024; empty: none is.
  /// @param ids  empty: all
  std::string message(const std::vector<std::string>& ids = {}) const;

 private:
  std::map<std::string, WarningInputs::Event> refused_;  // by id
  std::string of_others_;                                // newest message; empty: none
};

}  // namespace sweep_guard_core
