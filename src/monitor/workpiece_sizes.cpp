#include "monitor/workpiece_sizes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxShown = 20;
constexpr double kLong = 10.0;     // [m]
constexpr double kEverNear = 5.0;  // [m]

using Distance = ToolDistances::Distance;

struct Placed {
  const Workpiece* workpiece;
  Eigen::Vector3d size;  // [m]
  Distance distance;
};

std::vector<Placed> withDistances(const Workpieces& workpieces, const std::map<std::string, Distance>& distances) {
  std::vector<Placed> all;
  for (const auto& workpiece : workpieces) {
    const auto distance = distances.find(workpiece->id);
    all.push_back({workpiece.get(), workpiece->mesh_M.bounds_M().sizes(),
                   distance == distances.end() ? Distance{} : distance->second});
  }
  return all;
}

std::string shortText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

std::string sizeInWords(const Placed& placed) {
  const auto& [workpiece, size, distance] = placed;
  const std::string box = shortText(size.x()) + " x " + shortText(size.y()) + " x " + shortText(size.z()) + " m, ";
  const std::string text = box + (distance.now ? "at least " + shortText(*distance.now) + " m from the tool"
                                               : std::string("distance from the tool not known"));
  return distance.least ? text + ", nearest so far " + shortText(*distance.least) + " m" : text;
}

std::string andMore(std::ptrdiff_t count) {
  return count > 1 ? " (and " + std::to_string(count - 1) + " more)" : std::string();
}

// Names the longest.
std::string tooLong(const std::vector<Placed>& all) {
  const auto length = [](const Placed& placed) { return placed.size.maxCoeff(); };
  const auto count = std::count_if(all.begin(), all.end(), [&](const Placed& one) { return length(one) > kLong; });
  if (count == 0) return {};
  const Placed& longest = *std::max_element(
      all.begin(), all.end(), [&](const Placed& one, const Placed& other) { return length(one) < length(other); });
  return "'" + longest.workpiece->id + "' is " + shortText(length(longest)) + " m long: is its mesh in millimeters?" +
         andMore(count);
}

// Names the one that the tool came nearest to.
std::string tooFar(const std::vector<Placed>& all) {
  const auto is_far = [](const Placed& placed) { return placed.distance.least.value_or(0.0) > kEverNear; };
  const auto count = std::count_if(all.begin(), all.end(), is_far);
  if (count == 0) return {};
  const auto nearer = [&](const Placed& one, const Placed& other) {
    return is_far(one) != is_far(other) ? is_far(one) : one.distance.least < other.distance.least;
  };
  const Placed& nearest = *std::min_element(all.begin(), all.end(), nearer);
  return "the tool was never nearer to '" + nearest.workpiece->id + "' than " + shortText(*nearest.distance.least) +
         " m: is its pose, the mesh or a transform between them in millimeters?" + andMore(count);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> workpieceSizes(const Workpieces& workpieces,
                                                                const std::map<std::string, Distance>& distances) {
  std::vector<Placed> all = withDistances(workpieces, distances);
  const auto at = [](const Placed& one) { return one.distance.now.value_or(std::numeric_limits<double>::infinity()); };
  const auto nearer = [&](const Placed& one, const Placed& other) { return at(one) < at(other); };
  std::stable_sort(all.begin(), all.end(), nearer);
  if (all.size() > kMaxShown) all.resize(kMaxShown);
  std::vector<std::pair<std::string, std::string>> nearest;
  nearest.reserve(all.size());
  for (const Placed& one : all) nearest.emplace_back(one.workpiece->id, sizeInWords(one));
  return nearest;
}

std::string doubtfulSizes(const Workpieces& workpieces, const std::map<std::string, Distance>& distances) {
  const std::vector<Placed> all = withDistances(workpieces, distances);
  const std::string length = tooLong(all);
  const std::string gap = tooFar(all);
  return length + (length.empty() || gap.empty() ? "" : "; ") + gap;
}

}  // namespace sweep_guard_core
