#include "soundness/families.h"

#include <algorithm>

#include "soundness/pairs.h"
#include "soundness/positives.h"

namespace sweep_guard::soundness {
namespace {

template <PairCase (*make)(std::uint64_t)>
void runPairs(const Context& context, std::uint64_t seed) {
  checkPair(context, make(seed));
}

void runPositives(const Context& context, std::uint64_t seed) { checkPositives(context, constructedPositives(seed)); }

// Every seed of every family is the start of a sequence of its own (splitmix64, Steele et al. 2014).
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
      {"random", "triangles of every kind around a volume, against exact arithmetic", runPairs<randomPairs>},
      {"grazing", "triangles that only just touch a volume, against exact arithmetic", runPairs<grazingPairs>},
      {"adversarial", "what is hardest for float32 and for clipping, against exact arithmetic",
       runPairs<adversarialPairs>},
      {"positives", "triangles through known points of a moving tool", runPositives},
  };
  return all;
}

void run(const Family& family, const Extent& extent, std::vector<Suspect>& suspects, Report& report) {
  const std::uint64_t share = extent.cases / extent.parts + (extent.part < extent.cases % extent.parts ? 1 : 0);
  for (std::uint64_t index = extent.part; casesOf(report, family.name) < share; index += extent.parts) {
    const std::string about = "seed " + std::to_string(extent.seed) + " index " + std::to_string(index);
    family.run({family.name, about, suspects, report}, mixed(extent.seed, index));
  }
}

void replay(const AnyCase& any, std::vector<Suspect>& suspects, Report& report) {
  const Context context{"replay", any.about, suspects, report};
  if (any.pair) checkPair(context, *any.pair);
  if (any.sweep) checkPositives(context, *any.sweep);
}

}  // namespace sweep_guard::soundness
