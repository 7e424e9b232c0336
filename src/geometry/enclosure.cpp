#include "sweep_guard/geometry/enclosure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

#include "geometry/crossing.h"
#include "geometry/crossing_parts.h"
#include "geometry/edge_groups.h"
#include "geometry/patches.h"
#include "geometry/weld.h"

namespace sweep_guard_core {
namespace {

constexpr int kMaxRounds = 16;              // of leaving out what hangs on the rest of the surface
constexpr std::uint32_t kMaxShells = 1000;  // closed parts among which cavities and overlaps are looked for
constexpr double kMaxTests = 2e6;           // triangles looked at from the corners of one cavity
constexpr size_t kCornersOfMost = 7;        // by which a part lies in another that it does not cross
constexpr size_t kMaxCaps = 1024;           // or a quarter of the triangles

using Group = EdgeGroups::Group;

// The surface after welding.
struct Surface {
  const std::vector<float>& positions;
  std::vector<Triangle> triangles;  // welded
  std::vector<bool> left_out;
  std::vector<bool> both_ways;  // sent in both directions

  size_t vertexCount() const { return positions.size() / 3; }
  Eigen::Vector3d at(std::uint32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3f>(&positions[3 * size_t{vertex}]).cast<double>();
  }
  EdgeGroups edges() const { return {triangles, left_out, vertexCount()}; }
};

bool isDegenerate(const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return a == b || b == c || c == a;
}

void replaceCorners(Surface& surface, const std::vector<std::uint32_t>& first) {
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    for (std::uint32_t& corner : surface.triangles[i]) corner = first[corner];
    if (isDegenerate(surface.triangles[i])) surface.left_out[i] = true;
  }
}

std::uint32_t third(const Triangle& triangle, const Group& edge) {
  return triangle[0] ^ triangle[1] ^ triangle[2] ^ edge.low ^ edge.first->high;
}

// Leaves out the later ones of triangles with the same corners. Each is looked for at its edge with the lowest vertices.
bool leaveOutDoubles(Surface& surface, const EdgeGroups& edges) {
  bool any = false;
  std::vector<std::pair<std::uint32_t, HalfEdge>> by_third;
  edges.forEach([&](const Group& group) {
    if (group.size() < 2) return;
    by_third.clear();
    for (const HalfEdge& edge : group) {
      const std::uint32_t corner = third(surface.triangles[edge.triangle()], group);
      if (corner > edge.high) by_third.emplace_back(corner, edge);
    }
    if (by_third.size() < 2) return;
    std::stable_sort(by_third.begin(), by_third.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 1, kept = 0; i < by_third.size(); ++i) {
      if (by_third[i].first != by_third[kept].first) {
        kept = i;
        continue;
      }
      any = true;
      const HalfEdge& edge = by_third[kept].second;
      surface.left_out[by_third[i].second.triangle()] = true;
      if (by_third[i].second.upwards() != edge.upwards()) surface.both_ways[edge.triangle()] = true;
    }
  });
  return any;
}

void sortOut(std::vector<std::uint32_t>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

std::vector<std::uint32_t> verticesAtBorders(const EdgeGroups& edges) {
  std::vector<std::uint32_t> vertices;
  edges.forEach([&](const Group& group) {
    if (group.size() == 1) vertices.insert(vertices.end(), {group.low, group.first->high});
  });
  sortOut(vertices);
  return vertices;
}

bool branches(const EdgeGroups& edges) {
  bool found = false;
  edges.forEach([&](const Group& group) { found = found || group.size() > 2; });
  return found;
}

double diagonal(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = 0; i < surface.vertexCount(); ++i) box.extend(surface.at(i));
  return box.sizes().norm();
}

EdgeGroups edgesWithoutDoubles(Surface& surface, const std::vector<std::uint32_t>& first) {
  replaceCorners(surface, first);
  EdgeGroups edges = surface.edges();
  if (leaveOutDoubles(surface, edges)) edges = surface.edges();
  return edges;
}

// Corners that are not exactly at one place are searched for at borders first. Where some are found, or the surface branches,
// it may be doubled: then everywhere.
EdgeGroups joinEdges(Surface& surface) {
  std::vector<std::uint32_t> first = firstAtPositions(surface.positions);
  EdgeGroups edges = edgesWithoutDoubles(surface, first);
  const double distance = Enclosure::kWeld * diagonal(surface);
  const std::vector<std::uint32_t> at_borders = verticesAtBorders(edges);
  const bool welded = weldNear(surface.positions, at_borders, distance, first);
  if (welded) edges = edgesWithoutDoubles(surface, first);
  if (!welded && !branches(edges)) return edges;
  std::vector<std::uint32_t> all = first;
  sortOut(all);
  if (weldNear(surface.positions, all, distance, first)) edges = edgesWithoutDoubles(surface, first);
  return edges;
}

double area(const Surface& surface, std::uint32_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  return 0.5 * (surface.at(b) - surface.at(a)).cross(surface.at(c) - surface.at(a)).norm();
}

// Calls a function with each patch (or part) at an edge, and how often its triangles pass the edge upwards, less downwards, and
// in all.
template <typename Sorted, typename Function>
void forEachPatchAt(const Group& group, const Sorted& patches, const Function& function) {
  std::vector<std::pair<std::uint32_t, int>> uses;
  for (const HalfEdge& edge : group) uses.emplace_back(patches.of(edge.triangle()), patches.direction(edge));
  std::sort(uses.begin(), uses.end());
  for (auto first = uses.begin(); first != uses.end();) {
    int sum = 0;
    auto next = first;
    for (; next != uses.end() && next->first == first->first; ++next) sum += next->second;
    function(first->first, sum, next - first);
    first = next;
  }
}

// Finds the patches that may be left out without a new border: those with triangles at an edge where the number of all is
// odd and above 2, and that everywhere. Of several at such an edge the smallest one is left out.
class Appendages {
 public:
  Appendages(const Surface& surface, const Patches& patches)
      : patches_(patches), areas_(patches.count()), hang_(patches.count()), stay_(patches.count()) {
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
      if (!surface.left_out[i]) areas_[patches.of(i)] += area(surface, i);
    }
    for (const Group& group : patches.irregular()) {
      std::vector<bool>& patches_there = group.size() % 2 == 0 ? stay_ : hang_;
      if (group.size() > 1) forEachOddAt(group, [&](std::uint32_t patch) { patches_there[patch] = true; });
    }
    for (const Group& group : patches.irregular()) {
      if (group.size() % 2 != 0 && group.size() > 1) keepAllButSmallest(group);
    }
  }

  bool contains(std::uint32_t patch) const { return mayGo(patch) && !waits_[patch]; }

 private:
  bool mayGo(std::uint32_t patch) const { return hang_[patch] && !stay_[patch]; }

  template <typename Function>
  void forEachOddAt(const Group& group, const Function& function) const {
    forEachPatchAt(group, patches_, [&](std::uint32_t patch, int, std::ptrdiff_t count) {
      if (count % 2 != 0) function(patch);
    });
  }

  void keepAllButSmallest(const Group& group) {
    std::optional<std::uint32_t> smallest;
    forEachOddAt(group, [&](std::uint32_t patch) {
      if (mayGo(patch) && (!smallest || areas_[patch] < areas_[*smallest])) smallest = patch;
    });
    forEachOddAt(group, [&](std::uint32_t patch) {
      if (patch != smallest) waits_[patch] = true;
    });
  }

  const Patches& patches_;
  std::vector<double> areas_;
  std::vector<bool> hang_;
  std::vector<bool> stay_;
  std::vector<bool> waits_ = std::vector<bool>(patches_.count());
};

bool leaveOutAppendages(Surface& surface, const Patches& patches) {
  const auto hangs = [](const Group& group) { return group.size() > 2 && group.size() % 2 != 0; };
  if (std::none_of(patches.irregular().begin(), patches.irregular().end(), hangs)) return false;
  const Appendages appendages(surface, patches);
  bool any = false;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.left_out[i] || !appendages.contains(patches.of(i))) continue;
    surface.left_out[i] = true;
    any = true;
  }
  return any;
}

// Joins patches into parts where one alone has a border: two solids that share a face. Each patch is turned as most of its
// triangles were sent.
class Parts {
 public:
  Parts(const Surface& surface, const Patches& patches)
      : patches_(patches), flipped_(patches.count()), parents_(patches.count()), parts_(patches.count()) {
    std::vector<std::int64_t> majority(patches.count());
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
      if (!surface.left_out[i]) majority[patches.of(i)] += patches.turned(i) ? -1 : 1;
    }
    std::transform(majority.begin(), majority.end(), flipped_.begin(), [](std::int64_t sum) { return sum < 0; });
    std::iota(parents_.begin(), parents_.end(), 0U);
    for (const Group& group : patches.irregular()) uniteBordersAt(group);
    for (std::uint32_t i = 0; i < parents_.size(); ++i) parts_[i] = parents_[i] == i ? count_++ : parts_[root(i)];
  }

  std::uint32_t count() const { return count_; }
  std::uint32_t of(std::uint32_t triangle) const { return parts_[patches_.of(triangle)]; }
  bool turned(std::uint32_t triangle) const { return patches_.turned(triangle) != flipped_[patches_.of(triangle)]; }
  const std::vector<Group>& irregular() const { return patches_.irregular(); }
  int direction(const HalfEdge& edge) const { return edge.upwards() != turned(edge.triangle()) ? 1 : -1; }

 private:
  std::uint32_t root(std::uint32_t patch) {
    while (parents_[patch] != patch) patch = parents_[patch] = parents_[parents_[patch]];
    return patch;
  }

  void uniteBordersAt(const Group& group) {
    std::optional<std::uint32_t> first;
    forEachPatchAt(group, patches_, [&](std::uint32_t patch, int sum, std::ptrdiff_t) {
      if (sum == 0) return;
      const std::uint32_t one = root(patch);
      const std::uint32_t other = first ? root(*first) : one;
      parents_[std::max(one, other)] = std::min(one, other);
      first = std::min(one, other);
    });
  }

  const Patches& patches_;
  std::vector<bool> flipped_;
  std::vector<std::uint32_t> parents_;  // a patch of the same part that comes before, or the patch itself
  std::vector<std::uint32_t> parts_;
  std::uint32_t count_ = 0;
};

struct Border {
  std::uint32_t part;
  std::uint32_t from;  // as its triangles pass it
  std::uint32_t to;
};

struct Borders {
  std::vector<Border> all;  // by part; several times where directions clash
  size_t edges = 0;
};

Borders bordersOf(const Parts& parts) {
  Borders borders;
  for (const Group& group : parts.irregular()) {
    forEachPatchAt(group, parts, [&](std::uint32_t part, int sum, std::ptrdiff_t) {
      if (sum != 0) ++borders.edges;
      const std::uint32_t high = group.first->high;
      for (; sum > 0; --sum) borders.all.push_back({part, group.low, high});
      for (; sum < 0; ++sum) borders.all.push_back({part, high, group.low});
    });
  }
  std::stable_sort(borders.all.begin(), borders.all.end(),
                   [](const Border& a, const Border& b) { return a.part < b.part; });
  return borders;
}

// What is summed up over the triangles of a part.
struct Shell {
  bool closed = true;
  bool both_ways = false;  // a triangle was there in both directions
  std::uint32_t count = 0;
  std::uint32_t turned = 0;  // triangles that the part has turned
  double six_volumes = 0.0;  // signed [m^3], as the part is turned
  Eigen::AlignedBox3d box = {};

  /// Returns whether the part is turned outwards by turning it once more.
  bool isInsideOut() const { return six_volumes < 0.0; }
  /// Returns whether the sender's direction is known, and the same for all triangles.
  bool isSentInOneDirection() const { return !both_ways && (turned == 0 || turned == count); }
  bool isSentInsideOut() const { return (turned == 0) == isInsideOut(); }
};

std::vector<Shell> shellsOf(const Surface& surface, const Parts& parts, const Borders& borders) {
  std::vector<Shell> shells(parts.count());
  for (const Border& border : borders.all) shells[border.part].closed = false;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.left_out[i]) continue;
    Shell& shell = shells[parts.of(i)];
    const auto& [a, b, c] = surface.triangles[i];
    const double six_volumes = surface.at(a).dot(surface.at(b).cross(surface.at(c)));
    shell.six_volumes += parts.turned(i) ? -six_volumes : six_volumes;
    shell.turned += parts.turned(i) ? 1 : 0;
    shell.both_ways = shell.both_ways || surface.both_ways[i];
    ++shell.count;
    for (const std::uint32_t corner : surface.triangles[i]) shell.box.extend(surface.at(corner));
  }
  return shells;
}

Triangle turnedIf(bool turn, const Triangle& triangle) {
  return turn ? Triangle{triangle[0], triangle[2], triangle[1]} : triangle;
}

// How closed parts lie to each other: which are cavities of others, and whether two of them overlap.
class ClosedParts {
 public:
  ClosedParts(const Surface& surface, const Parts& parts, const std::vector<Shell>& shells)
      : surface_(surface),
        parts_(parts),
        shells_(shells),
        cavities_(shells.size()),
        least_(4.0 * Enclosure::kWeld * diagonal(surface)) {
    for (std::uint32_t i = 0; i < shells.size(); ++i) {
      if (shells[i].closed) closed_.push_back(i);
    }
    overlap_ = closed_.size() > kMaxShells;
    if (closed_.size() > kMaxShells || !anyBoxesMeet()) return;
    collectTriangles();
    const bool may_be_cavities = areSentInBothDirections();
    for (const std::uint32_t inner : closed_) cavities_[inner] = may_be_cavities && isReversedAgainstOutermost(inner);
    overlap_ = anyCrossOrLieInOthers();
  }

  bool isCavity(std::uint32_t part) const { return cavities_[part]; }
  bool overlap() const { return overlap_; }

 private:
  bool anyBoxesMeet() const {
    for (size_t i = 1; i < closed_.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        if (shells_[closed_[i]].box.intersects(shells_[closed_[k]].box)) return true;
      }
    }
    return false;
  }

  // Of parts that do not cross, one lies in solids and cavities by turns.
  bool anyCrossOrLieInOthers() const {
    std::vector<PartTriangle> triangles;
    for (const std::uint32_t part : closed_) {
      const bool turn = shells_[part].isInsideOut() != cavities_[part];
      for (const Triangle& triangle : triangles_[part]) triangles.push_back({turnedIf(turn, triangle), part});
    }
    const auto position = [this](std::uint32_t vertex) { return surface_.at(vertex); };
    if (partsCross(triangles, position, least_).value_or(true)) return true;
    return std::any_of(closed_.begin(), closed_.end(),
                       [&](std::uint32_t inner) { return turnsAround(inner) != (cavities_[inner] ? 1 : 0); });
  }

  int turnsAround(std::uint32_t inner) const {
    int turns = 0;
    for (const std::uint32_t outer : closed_) {
      if (outer != inner && enclosesMost(outer, inner)) turns += cavities_[outer] ? -1 : 1;
    }
    return turns;
  }

  bool areSentInBothDirections() const {
    const auto is_sent = [&](bool inside_out) {
      return std::any_of(closed_.begin(), closed_.end(), [&](std::uint32_t i) {
        return shells_[i].isSentInOneDirection() && shells_[i].isSentInsideOut() == inside_out;
      });
    };
    return is_sent(true) && is_sent(false);
  }

  void collectTriangles() {
    triangles_.resize(shells_.size());
    for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      if (surface_.left_out[i] || !shells_[parts_.of(i)].closed) continue;
      triangles_[parts_.of(i)].push_back(turnedIf(parts_.turned(i), surface_.triangles[i]));
    }
  }

  // The outermost part around it was sent in the other direction.
  bool isReversedAgainstOutermost(std::uint32_t inner) const {
    if (!shells_[inner].isSentInOneDirection()) return false;
    std::optional<std::uint32_t> outermost;
    for (const std::uint32_t outer : closed_) {
      const bool larger = !outermost || shells_[outer].box.volume() > shells_[*outermost].box.volume();
      if (larger && encloses(outer, inner)) outermost = outer;
    }
    return outermost && shells_[*outermost].isSentInOneDirection() &&
           shells_[*outermost].isSentInsideOut() != shells_[inner].isSentInsideOut();
  }

  // Tests corners of the inner part: all, unless there are too many.
  bool encloses(std::uint32_t outer, std::uint32_t inner) const {
    const Eigen::AlignedBox3d& box = shells_[inner].box;
    const Eigen::Vector3d gap = Eigen::Vector3d::Constant(least_);
    if (!shells_[outer].box.contains(Eigen::AlignedBox3d(box.min() - gap, box.max() + gap))) return false;
    const double tests = 3.0 * static_cast<double>(triangles_[inner].size() * triangles_[outer].size());
    const auto stride = static_cast<size_t>(std::ceil(tests / kMaxTests));
    for (size_t i = 0; i < 3 * triangles_[inner].size(); i += stride) {
      if (!enclosesPoint(outer, cornerOf(inner, i))) return false;
    }
    return true;
  }

  // Of parts that do not cross: where they touch, any corner may be outside.
  bool enclosesMost(std::uint32_t outer, std::uint32_t inner) const {
    const Eigen::Vector3d gap = Eigen::Vector3d::Constant(least_);
    const Eigen::AlignedBox3d& box = shells_[outer].box;
    if (!Eigen::AlignedBox3d(box.min() - gap, box.max() + gap).contains(shells_[inner].box)) return false;
    const size_t stride = std::max<size_t>(1, 3 * triangles_[inner].size() / kCornersOfMost);
    int more = 0;
    for (size_t i = 0; i < 3 * triangles_[inner].size(); i += stride)
      more += enclosesPoint(outer, cornerOf(inner, i)) ? 1 : -1;
    return more > 0;
  }

  Eigen::Vector3d cornerOf(std::uint32_t part, size_t i) const { return surface_.at(triangles_[part][i / 3][i % 3]); }

  bool enclosesPoint(std::uint32_t outer, const Eigen::Vector3d& p) const {
    const auto corner = [&](std::uint32_t vertex) -> Eigen::Vector3d { return surface_.at(vertex) - p; };
    const Triangle* const first = triangles_[outer].data();
    return View(corner).crossings(first, first + triangles_[outer].size()) != 0;
  }

  const Surface& surface_;
  const Parts& parts_;
  const std::vector<Shell>& shells_;
  std::vector<std::uint32_t> closed_;
  std::vector<std::vector<Triangle>> triangles_;  // of each closed part, in the direction of the part
  std::vector<bool> cavities_;
  double least_;  // distance that counts [m]
  bool overlap_ = false;
};

// Appends the open parts, each followed by the fan from a corner of its border over all others.
// @param borders  ends with those of the last part
void appendOpen(const Surface& surface, const Parts& parts, const std::vector<Shell>& shells,
                const std::vector<Border>& borders, std::vector<Triangle>& triangles,
                std::vector<Enclosure::OpenPart>& open) {
  std::vector<std::uint32_t> place(shells.size());
  auto border = borders.begin();
  for (std::uint32_t part = 0; part < shells.size(); ++part) {
    if (shells[part].closed) continue;
    place[part] = static_cast<std::uint32_t>(triangles.size());
    triangles.resize(triangles.size() + shells[part].count);
    const std::uint32_t apex = border->from;
    for (; border != borders.end() && border->part == part; ++border) {
      const Triangle cap = {apex, border->to, border->from};
      if (!isDegenerate(cap)) triangles.push_back(cap);
    }
    const auto caps = static_cast<std::uint32_t>(triangles.size()) - place[part] - shells[part].count;
    open.push_back({place[part], shells[part].count, caps});
  }
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.left_out[i] || shells[parts.of(i)].closed) continue;
    triangles[place[parts.of(i)]++] = turnedIf(parts.turned(i), surface.triangles[i]);
  }
}

}  // namespace

Enclosure::Enclosure(const std::vector<float>& positions, const std::vector<Triangle>& triangles) {
  Surface surface{positions, triangles, std::vector<bool>(triangles.size()), std::vector<bool>(triangles.size())};
  EdgeGroups edges = joinEdges(surface);
  Patches patches(edges, surface.left_out);
  for (int round = 0; round < kMaxRounds && leaveOutAppendages(surface, patches); ++round) {
    edges = surface.edges();
    patches = Patches(edges, surface.left_out);
  }
  const Parts parts(surface, patches);
  const Borders borders = bordersOf(parts);
  const std::vector<Shell> shells = shellsOf(surface, parts, borders);
  const ClosedParts closed_parts(surface, parts, shells);
  parts_overlap_ = closed_parts.overlap();
  size_t closed = 0;
  for (const Shell& shell : shells) closed += shell.closed ? shell.count : 0;
  closed_.reserve(closed);
  roles_.assign(triangles.size(), Role::kLeftOut);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (surface.left_out[i]) continue;
    const Shell& shell = shells[parts.of(i)];
    const bool turn = parts.turned(i) != (shell.isInsideOut() != closed_parts.isCavity(parts.of(i)));
    roles_[i] = !shell.closed ? Role::kOpen : turn ? Role::kReversed : Role::kOutward;
    if (shell.closed) closed_.push_back(turnedIf(turn, surface.triangles[i]));
  }
  open_edges_ = borders.edges;
  if (borders.all.size() > std::max(kMaxCaps, triangles.size() / 4)) return;
  open_.reserve(triangles.size() - closed + borders.all.size());
  appendOpen(surface, parts, shells, borders.all, open_, open_parts_);
  open_.shrink_to_fit();
}

}  // namespace sweep_guard_core
