#include "guard/late_deformations.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxDeformations = 512;  // as a 1 kHz mesh has within kMaxUpdateInterval
constexpr size_t kMaxImages = 17;         // of a camera, each some megabytes: 16 and the one before them

}  // namespace

bool forgetLateDeformations(const Workpiece& newest, Workpieces& deformations) {
  bool forgotten = false;
  const size_t most = newest.of_camera ? kMaxImages : kMaxDeformations;
  while (deformations.size() > 1 &&
         (newest.stamp - deformations[1]->stamp > kMaxUpdateInterval || deformations.size() > most)) {
    deformations.erase(deformations.begin());
    forgotten = true;
  }
  return forgotten;
}

}  // namespace sweep_guard_core
