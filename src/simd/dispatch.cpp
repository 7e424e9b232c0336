#include <cstdlib>
#include <string>

#include "sweep_guard/common/error.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core::simd {

#ifdef __x86_64__
namespace avx512 {
extern const Kernels kKernels;
}
namespace avx2 {
extern const Kernels kKernels;
}
#endif
namespace baseline {
extern const Kernels kKernels;
}

namespace {

Kernels named(const char* name, Kernels kernels) {
  kernels.name = name;
  return kernels;
}

std::vector<Kernels> findKernels() {
  std::vector<Kernels> found;
#ifdef __x86_64__
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx2 && avx512) found.push_back(named("avx512", avx512::kKernels));
  if (avx2) found.push_back(named("avx2", avx2::kKernels));
#endif
  found.push_back(named("baseline", baseline::kKernels));
  return found;
}

const Kernels& chooseKernels() {
  const char* requested = std::getenv("SWEEP_GUARD_SIMD");
  if (requested == nullptr || *requested == '\0') return availableKernels().front();
  std::string names;
  for (const Kernels& kernels : availableKernels()) {
    if (std::string(requested) == kernels.name) return kernels;
    names += std::string(names.empty() ? "" : " or ") + kernels.name;
  }
  throw InvalidInput("SWEEP_GUARD_SIMD=" + std::string(requested) + " is not available on this machine: use " + names);
}

}  // namespace

const std::vector<Kernels>& availableKernels() {
  static const std::vector<Kernels> available = findKernels();
  return available;
}

const Kernels& kernels() {
  static const Kernels& chosen = chooseKernels();
  return chosen;
}

}  // namespace sweep_guard_core::simd
