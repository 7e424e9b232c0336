#include "machine.h"

#include <array>
#include <cstdlib>
#include <fstream>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_benchmark {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

std::string machineText() {
  return "processor: " + processor() + ", instruction set: " + sweep_guard_core::simd::kernels().name +
         "\ncompiler: " SWEEP_GUARD_COMPILER "; peers except FCL, and the clipping: also -march=native\n";
}

double load() {
  std::array<double, 1> averages = {};
  getloadavg(averages.data(), 1);
  return averages[0];
}

}  // namespace sweep_guard_benchmark
