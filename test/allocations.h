#pragma once

#include <cstddef>
#include <string>

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

}  // namespace sweep_guard_core
