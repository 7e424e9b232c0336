#include "sweep_guard/guard/contact_policy.h"

#include <algorithm>
#include <iterator>

#include "guard/intended_contact.h"

namespace sweep_guard_core {

ContactPolicy::ContactPolicy(const Tool& tool, const Workpiece& workpiece, const AllowedPairs* allowed,
                             const Intentions* intentions)
    : tool_(&tool) {
  if (allowed != nullptr) allow(*allowed, workpiece.id);
  if (intentions == nullptr) return;
  for (const Intention& intention : *intentions) {
    if (intention.concerns(workpiece)) intentions_.push_back(&intention);
  }
}

void ContactPolicy::allow(const AllowedPairs& pairs, const std::string& id) {
  const auto& pieces = tool_->pieces();
  for (const AllowedPair& pair : pairs) {
    if (!pair.concerns(id)) continue;
    for (size_t piece = 0; piece < pieces.size(); ++piece) {
      if (!pair.holds(pieces[piece].link)) continue;
      allowed_.resize(pieces.size());
      allowed_[piece] = true;
    }
  }
}

bool ContactPolicy::allowsAll() const {
  return !allowed_.empty() && std::all_of(allowed_.begin(), allowed_.end(), [](bool allowed) { return allowed; });
}

std::vector<const Intention*> ContactPolicy::intentionsFor(size_t piece) const {
  std::vector<const Intention*> regions;
  std::copy_if(intentions_.begin(), intentions_.end(), std::back_inserter(regions),
               [&](const Intention* intention) { return intention->allows(tool_->pieces()[piece].link); });
  return regions;
}

IntendedTriangles ContactPolicy::trianglesIntendedFor(size_t piece, const std::vector<Motion>& sub_motions_M,
                                                      double margin) const {
  if (!intendsAny()) return {};
  std::vector<const Intention*> regions = intentionsFor(piece);
  if (regions.empty()) return {};
  return {std::move(regions), *tool_, tool_->pieces()[piece].link, sub_motions_M, margin};
}

double ContactPolicy::intendedDepth(size_t piece, std::uint32_t triangle) const {
  double depth = 0.0;
  for (const Intention* intention : intentions_) {
    if (intention->allows(tool_->pieces()[piece].link) && intention->holds(triangle))
      depth = std::max(depth, intention->depth);
  }
  return depth;
}

}  // namespace sweep_guard_core
