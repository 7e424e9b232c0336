#include "soundness/families.h"

#include <algorithm>
#include <array>

#include "soundness/camera_sessions.h"
#include "soundness/enclosed.h"
#include "soundness/joint_positives.h"
#include "soundness/late.h"
#include "soundness/metamorphic.h"
#include "soundness/pairs.h"
#include "soundness/positives.h"
#include "soundness/sampled_sweep.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

template <PairCase (*make)(std::uint64_t)>
void runPairs(const Context& context, std::uint64_t seed) {
  checkPair(context, make(seed));
}

void replayPair(const Context& context, const AnyCase& any) { checkPair(context, any.pair.value()); }

void runPositives(const Context& context, std::uint64_t seed) { checkPositives(context, constructedPositives(seed)); }

void replayPositives(const Context& context, const AnyCase& any) { checkPositives(context, any.sweep.value()); }

void runJoints(const Context& context, std::uint64_t seed) {
  const SweepCase sweep = jointPositives(seed);
  checkPositives(context, sweep);
  checkImpacts(context, sweep);
}

void replayJoints(const Context& context, const AnyCase& any) {
  checkPositives(context, any.sweep.value());
  checkImpacts(context, any.sweep.value());
}

void runImpacts(const Context& context, std::uint64_t seed) { checkImpacts(context, constructedPositives(seed)); }

void replayImpacts(const Context& context, const AnyCase& any) { checkImpacts(context, any.sweep.value()); }

void runRelations(const Context& context, std::uint64_t seed) {
  constexpr std::array<PairCase (*)(std::uint64_t), 3> kPairs = {randomPairs, grazingPairs, adversarialPairs};
  checkRelations(context, kPairs[seed % 3](seed));
  checkRelations(context, constructedPositives(seed));
}

void replayRelations(const Context& context, const AnyCase& any) {
  if (any.pair) checkRelations(context, *any.pair);
  if (any.sweep) checkRelations(context, *any.sweep);
}

void runWholeSweep(const Context& context, std::uint64_t seed) { checkWholeSweep(context, randomWholeSweep(seed)); }

void replayWholeSweep(const Context& context, const AnyCase& any) { checkWholeSweep(context, any.sweep.value()); }

void refuseReplay(const Context& context, const AnyCase& /*any*/) {
  throw InvalidInput("soundness case: family '" + context.family + "' is made from its seed: run it with that --seed");
}

// Gives each case a sequence of its own (splitmix64, Steele et al. 2014).
std::uint64_t mixed(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15U + index * 0xbf58476d1ce4e5b9U + 0x94d049bb133111ebU;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

std::uint64_t casesOf(Report& report, const std::string& family) {
  std::uint64_t fewest = 0;
  bool first = true;
  for (const auto& [detector, tally] : report.ofFamily(family)) {
    fewest = first ? tally.cases : std::min(fewest, tally.cases);
    first = false;
  }
  return fewest;
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"random", "triangles of every kind around a volume, against exact arithmetic", runPairs<randomPairs>,
       replayPair},
      {"grazing", "triangles that only just touch a volume, against exact arithmetic", runPairs<grazingPairs>,
       replayPair},
      {"adversarial", "volumes and triangles that are hard for float32 and clipping, against exact arithmetic",
       runPairs<adversarialPairs>, replayPair},
      {"positives", "triangles through known points of a moving tool", runPositives, replayPositives},
      {"joints", "triangles through known points of a body that joints move", runJoints, replayJoints},
      {"impacts", "time of impact on the same triangles: none is missed or late", runImpacts, replayImpacts},
      {"metamorphic", "triangles that must still be named in another description of the scene", runRelations,
       replayRelations},
      {"inside", "points inside and outside of solids, however their surfaces are sent", checkEnclosed, refuseReplay},
      {"late", "sessions whose transforms come late, seldom and changed, against known contacts", checkLate,
       refuseReplay},
      {"cameras", "images of a depth camera, in a guard whose tool moves, against rays", checkCamera, refuseReplay},
      {"sweeps", "a tool about a workpiece of 1 600 triangles, against densely sampled exact poses", runWholeSweep,
       replayWholeSweep},
  };
  return all;
}

void run(const Family& family, const Extent& extent, std::vector<TestedDetector>& detectors, Report& report) {
  const std::uint64_t share = extent.cases / extent.parts + (extent.part < extent.cases % extent.parts ? 1 : 0);
  for (std::uint64_t index = extent.part; casesOf(report, family.name) < share; index += extent.parts) {
    const std::string about = "seed " + std::to_string(extent.seed) + " index " + std::to_string(index);
    family.run({family.name, about, detectors, report}, mixed(extent.seed, index));
  }
}

void replay(const AnyCase& any, std::vector<TestedDetector>& detectors, Report& report) {
  const std::string name = any.about.substr(0, any.about.find(' '));
  for (const Family& family : families()) {
    if (family.name != name) continue;
    family.replay({name, any.about.substr(std::min(any.about.size(), name.size() + 1)), detectors, report}, any);
    return;
  }
  throw InvalidInput("soundness case: family '" + name + "' is unknown");
}

}  // namespace sweep_guard_core::soundness
