#include "sweep_guard/motion/proximity_finder.h"

#include <algorithm>

#include "common/floating_point.h"
#include "motion/facing.h"
#include "motion/proximity_planes.h"

namespace sweep_guard_core {
namespace {

constexpr double kNearer = 1e-3;  // share by which a triangle may be nearer than one that gets its plane first

}  // namespace

// Keeps its buffers, and how the surfaces move, for the next search.
class ProximityFinder::Search {
 public:
  void run(const ProximityRequest& request, Proximity& proximity);
  void reset() { facings_.reset(); }

 private:
  enum class Kind : std::uint8_t { kMesh, kGroup, kCluster, kTriangle, kSeparated, kBody };

  // A part of a mesh before a piece, or a body before a mesh. Of all that wait, the one that may be nearest is next.
  struct WaitingPart {
    double bound;  // lower bound on the distance [m]
    std::uint32_t facing;
    std::uint32_t index;    // of the group, cluster, triangle, separation or body
    std::uint32_t checked;  // number of planes that it does not lie behind
    Kind kind;

    bool operator<(const WaitingPart& other) const {
      return bound != other.bound ? bound > other.bound : kind < other.kind;
    }
  };

  bool face(std::uint32_t body);
  void pushIntended(std::uint32_t index);

  void push(const WaitingPart& waiting);
  WaitingPart pop();
  double leastBound() const { return waiting_.empty() ? kInfinity : waiting_.front().bound; }
  bool process(const WaitingPart& waiting);
  template <typename Part>
  bool processPart(const WaitingPart& waiting, const Part& part);
  bool processTriangle(const WaitingPart& waiting);
  void open(const WaitingPart& waiting, const MeshOrder& mesh, const CenteredBox& box);
  void open(const WaitingPart& waiting, const ClusterGroup& group, const CenteredBox& box);
  void open(const WaitingPart& waiting, const Cluster& cluster, const CenteredBox& box);

  bool postpone(WaitingPart waiting);
  double seed(const WaitingPart& waiting, const Cluster& cluster, const CenteredBox& box);
  void wait(std::uint32_t index, const SeparatedTriangle& separated);
  bool standFor(const WaitingPart& waiting, const SeparatedTriangle& separated);
  bool leaveOver(double distance);
  template <typename... Part>
  void quicken(size_t plane, const Facing& facing, const Part&... part) {
    sweep_guard_core::quicken(found_->planes[plane].plane, facing, part...);
  }

  void begin();

  Facings facings_;
  std::vector<WaitingPart> waiting_;  // a heap
  std::vector<SeparatedTriangle> separated_;
  // Of the running search:
  const ProximityRequest* request_ = nullptr;
  Proximity* found_ = nullptr;
  double reach_ = 0.0;  // to the triangles as they are [m]
};

void ProximityFinder::Search::begin() {
  found_->planes.clear();
  found_->unplaced.clear();
  found_->uncovered = {};
  waiting_.clear();
  separated_.clear();
  facings_.begin(*request_, found_->unplaced);
  reach_ = request_->reach + facings_.padding();
  for (std::uint32_t i = 0; i < facings_.bodies(); ++i) push({facings_.body(i).distance(), 0, i, 0, Kind::kBody});
}

void ProximityFinder::Search::run(const ProximityRequest& request, Proximity& proximity) {
  request_ = &request;
  found_ = &proximity;
  begin();
  while (!waiting_.empty() && process(pop())) {
  }
  std::sort(proximity.planes.begin(), proximity.planes.end(),
            [](const auto& a, const auto& b) { return a.plane.gap < b.plane.gap; });
  facings_.end();
  request_ = nullptr;
  found_ = nullptr;
}

// Bodies that are farther than the search goes are never faced.
bool ProximityFinder::Search::face(std::uint32_t body) {
  auto i = static_cast<std::uint32_t>(facings_.size());
  facings_.face(body);
  for (; i < facings_.size(); ++i) {
    const Facing& facing = facings_[i];
    const CenteredBox box(facing.surface->boxes.of(facing.mesh().order()));
    push({facing.cover.distance(box), i, 0, 0, Kind::kMesh});
    pushIntended(i);
  }
  return true;
}

// They are not where the boxes of the mesh say.
void ProximityFinder::Search::pushIntended(std::uint32_t index) {
  const Facing& facing = facings_[index];
  for (const Intention* intention : facing.body->contact.intentionsFor(facing.piece)) {
    for (const std::uint32_t triangle : intention->triangles)
      push({facing.cover.distance(facing.corners(triangle)), index, triangle, 0, Kind::kTriangle});
  }
}

void ProximityFinder::Search::push(const WaitingPart& waiting) {
  waiting_.push_back(waiting);
  std::push_heap(waiting_.begin(), waiting_.end());
}

ProximityFinder::Search::WaitingPart ProximityFinder::Search::pop() {
  std::pop_heap(waiting_.begin(), waiting_.end());
  const WaitingPart waiting = waiting_.back();
  waiting_.pop_back();
  return waiting;
}

// Returns false at the end of the search.
bool ProximityFinder::Search::process(const WaitingPart& waiting) {
  if (waiting.kind == Kind::kBody) return face(waiting.index);
  const MeshOrder& order = facings_[waiting.facing].mesh().order();
  switch (waiting.kind) {
    case Kind::kMesh:
      return processPart(waiting, order);
    case Kind::kGroup:
      return processPart(waiting, order.groups[waiting.index]);
    case Kind::kCluster:
      return processPart(waiting, order.clusters[waiting.index]);
    default:
      return processTriangle(waiting);
  }
}

template <typename Part>
bool ProximityFinder::Search::processPart(const WaitingPart& waiting, const Part& part) {
  const Facing& facing = facings_[waiting.facing];
  const CenteredBox box(facing.surface->boxes.of(part));
  if (const auto plane = facing.cover.behind(box)) {
    quicken(*plane, facing, part, box);
    return true;
  }
  if (waiting.bound >= reach_) return leaveOver(waiting.bound);
  if (facing.cover.behindNearest(box)) return postpone(waiting);
  open(waiting, part, box);
  return true;
}

void ProximityFinder::Search::open(const WaitingPart& waiting, const MeshOrder& mesh, const CenteredBox& /*box*/) {
  const Facing& facing = facings_[waiting.facing];
  for (std::uint32_t i = 0; i < mesh.groups.size(); ++i) {
    const CenteredBox box(facing.surface->boxes.of(mesh.groups[i]));
    push({std::max(waiting.bound, facing.cover.distance(box)), waiting.facing, i, 0, Kind::kGroup});
  }
}

void ProximityFinder::Search::open(const WaitingPart& waiting, const ClusterGroup& group, const CenteredBox& /*box*/) {
  const Facing& facing = facings_[waiting.facing];
  const auto& clusters = facing.mesh().order().clusters;
  for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
    const CenteredBox box(facing.surface->boxes.of(clusters[i]));
    push({std::max(waiting.bound, facing.cover.distance(box)), waiting.facing, i, 0, Kind::kCluster});
  }
}

void ProximityFinder::Search::open(const WaitingPart& waiting, const Cluster& cluster, const CenteredBox& box) {
  Facing& facing = facings_[waiting.facing];
  const double least = facing.cover.hasNearest() ? 0.0 : seed(waiting, cluster, box);
  const PieceCover::Classified classified = facing.cover.classify(cluster, box);
  for (const size_t plane : classified.standing) quicken(plane, facing, cluster, box);
  const double limit = std::min(facing.nearest, reach_);
  double rest = classified.not_nearer != 0 ? facing.nearest : least >= reach_ ? least : kInfinity;
  for (std::uint64_t left = least >= reach_ ? 0 : classified.nearer; left != 0; left &= left - 1) {
    const std::uint32_t triangle = facing.triangleAt(cluster, left);
    if (facing.intendedDepth(triangle) > 0.0) continue;
    const double bound = std::max(waiting.bound, facing.cover.distance(facing.corners(triangle)));
    if (bound < limit) {
      push({bound, waiting.facing, triangle, static_cast<std::uint32_t>(classified.tested), Kind::kTriangle});
    } else {
      rest = std::min(rest, bound);
    }
  }
  if (rest < kInfinity) push({std::max(waiting.bound, rest), waiting.facing, waiting.index, 0, Kind::kCluster});
}

// What lies behind the plane of the nearest triangle known waits until that triangle has its plane.
bool ProximityFinder::Search::postpone(WaitingPart waiting) {
  waiting.bound = std::max(waiting.bound, facings_[waiting.facing].nearest);
  push(waiting);
  return true;
}

// Separates one triangle of a cluster, so that it need not be done for those that are farther. Returns a lower bound on the
// distance of those that no plane stands for.
double ProximityFinder::Search::seed(const WaitingPart& waiting, const Cluster& cluster, const CenteredBox& box) {
  Facing& facing = facings_[waiting.facing];
  double least = kInfinity;
  std::uint32_t nearest = 0;
  for (std::uint64_t left = facing.cover.classify(cluster, box).nearer; left != 0; left &= left - 1) {
    const std::uint32_t triangle = facing.triangleAt(cluster, left);
    if (facing.intendedDepth(triangle) > 0.0) continue;
    const double distance = facing.cover.distance(facing.corners(triangle));
    if (distance < least) nearest = triangle;
    least = std::min(least, distance);
  }
  if (least >= reach_) return least;
  const SeparatedTriangle separated = facing.separate(nearest);
  if (separated.gap > 0.0) wait(waiting.facing, separated);
  return least;
}

void ProximityFinder::Search::wait(std::uint32_t index, const SeparatedTriangle& separated) {
  Facing& facing = facings_[index];
  const double bound = (1.0 - kNearer) * separated.gap;
  separated_.push_back(separated);
  push({bound, index, static_cast<std::uint32_t>(separated_.size() - 1),
        static_cast<std::uint32_t>(facing.cover.planes()), Kind::kSeparated});
  if (bound >= facing.nearest) return;
  facing.nearest = bound;
  facing.cover.setNearest(separated.normal_T, separated.normal_T.dot(separated.top_T) + kNearer * separated.gap);
}

bool ProximityFinder::Search::processTriangle(const WaitingPart& waiting) {
  Facing& facing = facings_[waiting.facing];
  const bool known = waiting.kind == Kind::kSeparated;
  SeparatedTriangle separated = known ? separated_[waiting.index] : SeparatedTriangle{waiting.index, {}, 0.0, {}};
  const PieceCover::Corners at = facing.corners(separated.triangle);
  if (known && waiting.bound >= facing.nearest) facing.forgetNearest();
  if (const auto plane = facing.cover.behind(at, waiting.checked)) {
    quicken(*plane, facing, facing.mesh().triangles()[separated.triangle]);
    return true;
  }
  if (waiting.bound >= reach_) return leaveOver(waiting.bound);
  if (!known) {
    if (facing.cover.behindNearest(at)) return postpone(waiting);
    separated = facing.separate(separated.triangle);
    if ((1.0 - kNearer) * separated.gap > leastBound()) {
      wait(waiting.facing, separated);
      return true;
    }
  }
  return standFor(waiting, separated);
}

// Returns false if it is left over: no plane is free.
bool ProximityFinder::Search::standFor(const WaitingPart& waiting, const SeparatedTriangle& separated) {
  Facing& facing = facings_[waiting.facing];
  if (separated.gap <= 0.0 && joinFacingPlane(facing, separated, found_->planes)) return true;
  const double distance = std::min((1.0 - kNearer) * separated.gap, leastBound());
  if (distance >= reach_ || found_->planes.size() == kMaxPlanes) return leaveOver(distance);
  addFacingPlane(facing, separated, found_->planes);
  return true;
}

bool ProximityFinder::Search::leaveOver(double distance) {
  found_->uncovered.distance = std::max(0.0, distance - facings_.margin() - facings_.maxDisplacement());
  found_->uncovered.speed = facings_.fastest();
  return false;
}

ProximityFinder::ProximityFinder() : search_(std::make_unique<Search>()) {}

ProximityFinder::~ProximityFinder() = default;

void ProximityFinder::find(const ProximityRequest& request, Proximity& proximity) { search_->run(request, proximity); }

void ProximityFinder::reset() { search_->reset(); }

}  // namespace sweep_guard_core
