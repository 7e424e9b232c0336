#pragma once

#include <cstdlib>
#include <iostream>
#include <string>

namespace sweep_guard_fuzz {

/// Ends the process with a message: an invariant does not hold. A fuzzer saves its input then.
[[noreturn]] inline void broken(const std::string& what) {
  std::cerr << "broken: " << what << std::endl;
  std::abort();
}

inline void require(bool holds, const char* what) {
  if (!holds) broken(what);
}

}  // namespace sweep_guard_fuzz
