#pragma once

#include <cstddef>
#include <string>

namespace sweep_guard_core {

/// Counts what this thread allocates by operator new while it lives; one at a time. Replaces the operators of the
/// program that is linked to it.
class Allocations {
 public:
  Allocations();
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;

  size_t count() const;        ///< so far
  std::string stacks() const;  ///< of where they were made, each once, with how many; the first thousand
};

}  // namespace sweep_guard_core
