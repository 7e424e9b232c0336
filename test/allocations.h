#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sweep_guard_core {

/// Counts the allocations of this thread by operator new during its own lifetime; at most one object at a time.
/// Replaces the operators of the program that links it.
class Allocations {
 public:
  Allocations();
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;

  size_t count() const;        ///< since the construction
  size_t largest() const;      ///< [bytes]
  std::string stacks() const;  ///< call stacks of the first thousand, each once, with its count
};

/// Counts the allocations of all threads by operator new during its own lifetime; at most one object at a time. Replaces
/// the operators as Allocations does.
class AllocationsOfAllThreads {
 public:
  AllocationsOfAllThreads();
  ~AllocationsOfAllThreads();
  AllocationsOfAllThreads(const AllocationsOfAllThreads&) = delete;
  AllocationsOfAllThreads& operator=(const AllocationsOfAllThreads&) = delete;

  struct Place {
    std::string thread;  ///< its name
    std::string stack;   ///< from the inside out
    size_t count;
  };
  std::vector<Place> places() const;  ///< the most frequent first
};

/// Lets one allocation of this thread fail during its own lifetime; at most one object at a time. Replaces the operators
/// as Allocations does.
class FailingAllocation {
 public:
  explicit FailingAllocation(size_t number);  ///< 1: the next one
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  bool reached() const;  ///< it has failed
};

}  // namespace sweep_guard_core
