#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "soundness/checks.h"

namespace sweep_guard_core::soundness {

/// A kind of case and its check. One call makes and checks a few cases from a seed.
struct Family {
  std::string name;
  std::string meaning;
  void (*run)(const Context& context, std::uint64_t seed);
  void (*replay)(const Context& context, const AnyCase& any);
};

const std::vector<Family>& families();

/// The cases to run.
struct Extent {
  std::uint64_t cases = 1000;  ///< minimum for each detector
  std::uint64_t seed = 1;
  std::uint64_t part = 0;   ///< index among `parts` processes; each takes every parts-th seed
  std::uint64_t parts = 1;  ///< >= 1
};

/// Runs one family; the same extent gives the same cases on every machine.
void run(const Family& family, const Extent& extent, std::vector<TestedDetector>& detectors, Report& report);

/// Checks a case that was written before.
void replay(const AnyCase& any, std::vector<TestedDetector>& detectors, Report& report);

}  // namespace sweep_guard_core::soundness
