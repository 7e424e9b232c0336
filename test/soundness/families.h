#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "soundness/checks.h"

namespace sweep_guard_core::soundness {

/// A kind of case, and its check. One call makes and checks a handful of cases from a seed.
struct Family {
  std::string name;
  std::string meaning;
  void (*run)(const Context& context, std::uint64_t seed);
  void (*replay)(const Context& context, const AnyCase& any);
};

const std::vector<Family>& families();

/// Which cases to run.
struct Extent {
  std::uint64_t cases = 1000;  ///< at least so many for each detector
  std::uint64_t seed = 1;
  std::uint64_t part = 0;   ///< of `parts` that share the work: each takes every parts-th seed
  std::uint64_t parts = 1;  ///< >= 1
};

/// Runs one family; the same extent gives the same cases everywhere.
void run(const Family& family, const Extent& extent, std::vector<Suspect>& suspects, Report& report);

/// Checks one written case again.
void replay(const AnyCase& any, std::vector<Suspect>& suspects, Report& report);

}  // namespace sweep_guard_core::soundness
