#include "sweep_guard/geometry/enclosure.h"

#include <algorithm>

#include "geometry/appendages.h"
#include "geometry/closed_parts.h"
#include "geometry/patches.h"
#include "geometry/surface_parts.h"
#include "geometry/welded_surface.h"

namespace sweep_guard_core {
namespace {

constexpr int kMaxRounds = 16;     // of leaving out what hangs on the rest of the surface
constexpr size_t kMaxCaps = 1024;  // or a quarter of the triangles

// Appends the open parts, each followed by the fan from a corner of its border over all others.
// @param borders  ends with those of the last part
void appendOpen(const WeldedSurface& surface, const SurfaceParts& parts, const std::vector<Shell>& shells,
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
  WeldedSurface surface{positions, triangles, std::vector<bool>(triangles.size()), std::vector<bool>(triangles.size())};
  EdgeGroups edges = surface.weld();
  Patches patches(edges, surface.left_out);
  for (int round = 0; round < kMaxRounds && leaveOutAppendages(surface, patches); ++round) {
    edges = surface.edges();
    patches = Patches(edges, surface.left_out);
  }
  const SurfaceParts parts(surface, patches);
  const std::vector<Border> borders = bordersOf(parts);
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
  const auto again = std::count_if(borders.begin(), borders.end(), [](const Border& border) { return border.again; });
  open_edges_ = borders.size() - static_cast<size_t>(again);
  if (borders.size() > std::max(kMaxCaps, triangles.size() / 4)) return;
  open_.reserve(triangles.size() - closed + borders.size());
  appendOpen(surface, parts, shells, borders, open_, open_parts_);
  open_.shrink_to_fit();
}

}  // namespace sweep_guard_core
