#include "sweep_guard/motion/proximity_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "common/heartbeat.h"
#include "geometry/penetration.h"
#include "guard/intended_contact.h"
#include "motion/piece_cover.h"
#include "motion/surface_motion.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kSlack = 0.05;        // share of its gap by which a plane moves to the tool
constexpr double kMinSlack = 0x1p-17;  // of the mesh's radius: more than what float32 leaves in doubt
constexpr double kSameNormal = 0.9;    // cosine of the angle between normals in contact that one plane stands for
constexpr double kNearer = 1e-3;       // share by which a triangle may be nearer than one that gets its plane first
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

class ProximityFinder::Search {
 public:
  void find(const ProximityRequest& request, Proximity& proximity);
  void reset() { motions_.clear(); }

 private:
  enum class Kind : std::uint8_t { kMesh, kGroup, kCluster, kTriangle, kSeparated };

  // A part of a mesh before a piece. Of all that wait, the one that may be nearest is next.
  struct Candidate {
    double bound;  // lower bound on the distance [m]
    std::uint32_t facing;
    std::uint32_t index;    // of the group, cluster, triangle or separation
    std::uint32_t checked;  // number of planes that it does not lie behind
    Kind kind;

    bool operator<(const Candidate& other) const {
      return bound != other.bound ? bound > other.bound : kind < other.kind;
    }
  };
  struct SeparatedTriangle {
    std::uint32_t triangle;
    Eigen::Vector3d normal_T;
    double gap;             // negative in contact
    Eigen::Vector3d top_T;  // corner farthest along the normal
  };
  // A mesh at the pose.
  struct Surface {
    std::shared_ptr<const Workpiece> workpiece;
    SurfaceMotion* motion;
    const std::vector<TriangleContact>* contacts;  // null: not known
    IntendedContact intended;
    BlockBoxes boxes;
  };
  // A piece of the tool and a mesh.
  struct Facing {
    size_t piece;
    size_t surface;
    Eigen::Vector3d guess_T;  // normal of the last separation
    double nearest;           // bound of the nearest triangle known that waits for its plane [m]
    PieceCover cover;
  };

  void begin(const ProximityRequest& request, Proximity& proximity);
  void place(const std::shared_ptr<const Workpiece>& workpiece, const Eigen::Isometry3d& X_WM);
  void pushIntended(std::uint32_t index);
  void forgetRemoved();

  void push(const Candidate& candidate);
  Candidate pop();
  double leastBound() const { return candidates_.empty() ? kInfinity : candidates_.front().bound; }
  bool process(const Candidate& candidate);
  template <typename Part>
  bool processPart(const Candidate& candidate, const Part& part);
  bool processTriangle(const Candidate& candidate);
  void open(const Candidate& candidate, WholeMesh all, const CenteredBox& box);
  void open(const Candidate& candidate, const ClusterGroup& group, const CenteredBox& box);
  void open(const Candidate& candidate, const Cluster& cluster, const CenteredBox& box);

  bool postpone(Candidate candidate);
  void seed(const Candidate& candidate, const Cluster& cluster, const CenteredBox& box);
  void wait(std::uint32_t index, const SeparatedTriangle& separated);
  static void forgetNearest(Facing& facing);
  void separate(Facing& facing, SeparatedTriangle& separated) const;
  Eigen::Vector3d contactNormal_T(const Facing& facing, std::uint32_t triangle,
                                  const std::array<Eigen::Vector3d, 3>& corners_T) const;
  bool standFor(const Candidate& candidate, const SeparatedTriangle& separated);
  bool joinContact(Facing& facing, const SeparatedTriangle& separated);
  void addPlane(Facing& facing, const SeparatedTriangle& separated);
  bool leaveOver(double distance);
  template <typename... Part>
  void quicken(size_t plane, const Facing& facing, const Part&... part);

  // The triangle of a cluster that the lowest bit stands for.
  std::uint32_t triangleAt(const Facing& facing, const Cluster& cluster, std::uint64_t bits) const {
    const auto& triangle_at = meshOf(facing).order().triangle_at;
    const std::uint32_t place = cluster.first + static_cast<std::uint32_t>(__builtin_ctzll(bits));
    return triangle_at.empty() ? place : triangle_at[place];
  }
  const TriangleMesh& meshOf(const Facing& facing) const { return surfaces_[facing.surface].workpiece->mesh_M; }
  double allowedDepth(const Facing& facing, std::uint32_t triangle) const {
    return surfaces_[facing.surface].intended.allowedDepth(facing.piece, triangle);
  }
  PieceCover::Corners corners(const Facing& facing, std::uint32_t triangle) const;

  std::map<std::string, SurfaceMotion> motions_;  // by id
  // Of the running call:
  const ProximityRequest* request_ = nullptr;
  double rounding_ = 0.0;
  Proximity* found_ = nullptr;
  std::vector<Surface> surfaces_;
  size_t surface_count_ = 0;
  std::vector<Facing> facings_;
  size_t facing_count_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<SeparatedTriangle> separated_;
};

void ProximityFinder::Search::find(const ProximityRequest& request, Proximity& proximity) {
  begin(request, proximity);
  while (!candidates_.empty() && process(pop())) {
  }
  std::sort(proximity.planes.begin(), proximity.planes.end(),
            [](const auto& a, const auto& b) { return a.plane.gap < b.plane.gap; });
  for (size_t i = 0; i < surface_count_; ++i) surfaces_[i].workpiece.reset();
}

void ProximityFinder::Search::begin(const ProximityRequest& request, Proximity& proximity) {
  request_ = &request;
  found_ = &proximity;
  proximity.planes.clear();
  proximity.unplaced.clear();
  proximity.uncovered = {};
  rounding_ = 0.0;
  surface_count_ = 0;
  facing_count_ = 0;
  candidates_.clear();
  separated_.clear();
  forgetRemoved();
  for (const auto& workpiece : request.workpieces) {
    const auto X_WM = request.pose.X_WM.find(workpiece->frame);
    if (X_WM == request.pose.X_WM.end()) {
      proximity.unplaced.push_back(workpiece);
    } else {
      place(workpiece, X_WM->second);
    }
  }
}

void ProximityFinder::Search::place(const std::shared_ptr<const Workpiece>& workpiece, const Eigen::Isometry3d& X_WM) {
  if (surface_count_ == surfaces_.size()) surfaces_.emplace_back();
  Surface& surface = surfaces_[surface_count_];
  surface.workpiece = workpiece;
  surface.motion = &motions_[workpiece->id];
  surface.motion->update(workpiece, X_WM, request_->pose.stamp);
  surface.intended = request_->intentions == nullptr
                         ? IntendedContact()
                         : IntendedContact(request_->tool, *request_->intentions, *workpiece);
  surface.contacts = nullptr;
  if (request_->swept != nullptr) {
    for (const SweptObject& object : request_->swept->objects) {
      if (object.workpiece == workpiece) surface.contacts = &object.result.in_contact;
    }
  }
  const TriangleMesh& mesh_M = workpiece->mesh_M;
  surface.boxes.assign(mesh_M.blocks());
  rounding_ = std::max(rounding_, mesh_M.rounding());
  Eigen::Isometry3d X_MT = X_WM.inverse() * request_->pose.X_WT;
  X_MT.translation() -= mesh_M.origin();
  const CenteredBox box(surface.boxes.of(WholeMesh()));
  for (size_t piece = 0; piece < request_->tool.pieces().size(); ++piece) {
    if (facing_count_ == facings_.size()) facings_.emplace_back();
    Facing& facing = facings_[facing_count_];
    facing.piece = piece;
    facing.surface = surface_count_;
    facing.guess_T = Eigen::Vector3d::Zero();
    facing.nearest = kInfinity;
    facing.cover.begin(request_->tool.pieces()[piece].shape_T, mesh_M, X_MT);
    push({facing.cover.distance(box), static_cast<std::uint32_t>(facing_count_), 0, 0, Kind::kMesh});
    if (!surface.intended.empty()) pushIntended(static_cast<std::uint32_t>(facing_count_));
    ++facing_count_;
  }
  ++surface_count_;
}

// They are not where the boxes of the mesh say.
void ProximityFinder::Search::pushIntended(std::uint32_t index) {
  const Facing& facing = facings_[index];
  const Workpiece& workpiece = *surfaces_[facing.surface].workpiece;
  const std::string& link = request_->tool.pieces()[facing.piece].link;
  for (const Intention& intention : *request_->intentions) {
    if (!intention.concerns(workpiece) || !intention.allows(link)) continue;
    for (const std::uint32_t triangle : intention.triangles) {
      push({facing.cover.distance(corners(facing, triangle)), index, triangle, 0, Kind::kTriangle});
    }
  }
}

// A triangle that the piece is meant to touch counts from the depth on that is allowed.
PieceCover::Corners ProximityFinder::Search::corners(const Facing& facing, std::uint32_t triangle) const {
  PieceCover::Corners corners = facing.cover.corners(meshOf(facing).triangles()[triangle]);
  const double depth = allowedDepth(facing, triangle);
  if (depth == 0.0) return corners;
  const Eigen::Vector3d inwards = (corners[2] - corners[0]).cross(corners[1] - corners[0]).stableNormalized();
  for (Eigen::Vector3d& corner : corners) corner += depth * inwards;
  return corners;
}

void ProximityFinder::Search::forgetRemoved() {
  for (auto motion = motions_.begin(); motion != motions_.end();) {
    const auto same = [&](const auto& workpiece) { return workpiece->id == motion->first; };
    const bool there = std::any_of(request_->workpieces.begin(), request_->workpieces.end(), same);
    motion = there ? std::next(motion) : motions_.erase(motion);
  }
}

void ProximityFinder::Search::push(const Candidate& candidate) {
  candidates_.push_back(candidate);
  std::push_heap(candidates_.begin(), candidates_.end());
}

ProximityFinder::Search::Candidate ProximityFinder::Search::pop() {
  std::pop_heap(candidates_.begin(), candidates_.end());
  const Candidate candidate = candidates_.back();
  candidates_.pop_back();
  return candidate;
}

// Returns false at the end of the search.
bool ProximityFinder::Search::process(const Candidate& candidate) {
  const MeshOrder& order = meshOf(facings_[candidate.facing]).order();
  switch (candidate.kind) {
    case Kind::kMesh:
      return processPart(candidate, WholeMesh());
    case Kind::kGroup:
      return processPart(candidate, order.groups[candidate.index]);
    case Kind::kCluster:
      return processPart(candidate, order.clusters[candidate.index]);
    default:
      return processTriangle(candidate);
  }
}

template <typename Part>
bool ProximityFinder::Search::processPart(const Candidate& candidate, const Part& part) {
  const Facing& facing = facings_[candidate.facing];
  const CenteredBox box(surfaces_[facing.surface].boxes.of(part));
  if (const auto plane = facing.cover.behind(box)) {
    quicken(*plane, facing, part, box);
    return true;
  }
  if (candidate.bound >= request_->reach) return leaveOver(candidate.bound);
  if (facing.cover.behindNearest(box)) return postpone(candidate);
  open(candidate, part, box);
  return true;
}

void ProximityFinder::Search::open(const Candidate& candidate, WholeMesh /*all*/, const CenteredBox& /*box*/) {
  const Facing& facing = facings_[candidate.facing];
  const auto& groups = meshOf(facing).order().groups;
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    const CenteredBox box(surfaces_[facing.surface].boxes.of(groups[i]));
    push({std::max(candidate.bound, facing.cover.distance(box)), candidate.facing, i, 0, Kind::kGroup});
  }
}

void ProximityFinder::Search::open(const Candidate& candidate, const ClusterGroup& group, const CenteredBox& /*box*/) {
  const Facing& facing = facings_[candidate.facing];
  const auto& clusters = meshOf(facing).order().clusters;
  for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
    const CenteredBox box(surfaces_[facing.surface].boxes.of(clusters[i]));
    push({std::max(candidate.bound, facing.cover.distance(box)), candidate.facing, i, 0, Kind::kCluster});
  }
}

void ProximityFinder::Search::open(const Candidate& candidate, const Cluster& cluster, const CenteredBox& box) {
  Facing& facing = facings_[candidate.facing];
  if (!facing.cover.hasNearest()) seed(candidate, cluster, box);
  const PieceCover::Classified classified = facing.cover.classify(cluster, box);
  for (const size_t plane : classified.standing) quicken(plane, facing, cluster, box);
  const double limit = std::min(facing.nearest, request_->reach);
  double rest = classified.not_nearer != 0 ? facing.nearest : kInfinity;
  for (std::uint64_t left = classified.nearer; left != 0; left &= left - 1) {
    const std::uint32_t triangle = triangleAt(facing, cluster, left);
    if (allowedDepth(facing, triangle) > 0.0) continue;
    const double bound = std::max(candidate.bound, facing.cover.distance(corners(facing, triangle)));
    if (bound < limit) {
      push({bound, candidate.facing, triangle, static_cast<std::uint32_t>(classified.tested), Kind::kTriangle});
    } else {
      rest = std::min(rest, bound);
    }
  }
  if (rest < kInfinity) push({std::max(candidate.bound, rest), candidate.facing, candidate.index, 0, Kind::kCluster});
}

// What lies behind the plane of the nearest triangle known waits until that triangle has its plane.
bool ProximityFinder::Search::postpone(Candidate candidate) {
  candidate.bound = std::max(candidate.bound, facings_[candidate.facing].nearest);
  push(candidate);
  return true;
}

// Separates one triangle of a cluster, so that it need not be done for those that are farther.
void ProximityFinder::Search::seed(const Candidate& candidate, const Cluster& cluster, const CenteredBox& box) {
  Facing& facing = facings_[candidate.facing];
  double least = kInfinity;
  SeparatedTriangle nearest{};
  for (std::uint64_t left = facing.cover.classify(cluster, box).nearer; left != 0; left &= left - 1) {
    const std::uint32_t triangle = triangleAt(facing, cluster, left);
    if (allowedDepth(facing, triangle) > 0.0) continue;
    const double distance = facing.cover.distance(corners(facing, triangle));
    if (distance < least) nearest.triangle = triangle;
    least = std::min(least, distance);
  }
  if (least >= request_->reach) return;
  separate(facing, nearest);
  if (nearest.gap > 0.0) wait(candidate.facing, nearest);
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

bool ProximityFinder::Search::processTriangle(const Candidate& candidate) {
  Facing& facing = facings_[candidate.facing];
  const bool known = candidate.kind == Kind::kSeparated;
  SeparatedTriangle separated = known ? separated_[candidate.index] : SeparatedTriangle{candidate.index, {}, 0.0, {}};
  const PieceCover::Corners at = corners(facing, separated.triangle);
  if (known && candidate.bound >= facing.nearest) forgetNearest(facing);
  if (const auto plane = facing.cover.behind(at, candidate.checked)) {
    quicken(*plane, facing, meshOf(facing).triangles()[separated.triangle]);
    return true;
  }
  if (candidate.bound >= request_->reach) return leaveOver(candidate.bound);
  if (!known) {
    if (facing.cover.behindNearest(at)) return postpone(candidate);
    separate(facing, separated);
    if ((1.0 - kNearer) * separated.gap > leastBound()) {
      wait(candidate.facing, separated);
      return true;
    }
  }
  return standFor(candidate, separated);
}

void ProximityFinder::Search::forgetNearest(Facing& facing) {
  facing.nearest = kInfinity;
  facing.cover.setNearest(std::nullopt);
}

void ProximityFinder::Search::separate(Facing& facing, SeparatedTriangle& separated) const {
  beat();
  const ConvexShape& shape_T = facing.cover.shape_T();
  const auto corners_T = facing.cover.corners_T(corners(facing, separated.triangle));
  const PointHull hull(corners_T);
  const Separation apart = separation(shape_T, hull, /*accuracy=*/0.0, facing.guess_T);
  separated.normal_T = apart.gap > 0.0 ? apart.normal : contactNormal_T(facing, separated.triangle, corners_T);
  separated.top_T = hull.supportPoint(separated.normal_T);
  separated.gap = -shape_T.support(-separated.normal_T) - separated.normal_T.dot(separated.top_T);
  facing.guess_T = separated.normal_T;
}

Eigen::Vector3d ProximityFinder::Search::contactNormal_T(const Facing& facing, std::uint32_t triangle,
                                                         const std::array<Eigen::Vector3d, 3>& corners_T) const {
  if (const auto* contacts = surfaces_[facing.surface].contacts) {
    const auto before = [](const TriangleContact& contact, std::uint32_t index) { return contact.triangle < index; };
    const auto contact = std::lower_bound(contacts->begin(), contacts->end(), triangle, before);
    if (contact != contacts->end() && contact->triangle == triangle) {
      return facing.cover.normal_T(contact->impact.normal_M);
    }
  }
  const PointHull hull(corners_T);
  const auto& [a, b, c] = corners_T;
  Eigen::Vector3d normal = (b - a).cross(c - a).stableNormalized();
  if (!(normal.norm() > 0.5)) normal = facing.cover.shape_T().proposeNormal(corners_T);
  const double depth = depthAlong(normal, facing.cover.shape_T(), hull);
  return depth <= depthAlong(-normal, facing.cover.shape_T(), hull) ? normal : Eigen::Vector3d(-normal);
}

// Returns false if it is left over: no plane is free.
bool ProximityFinder::Search::standFor(const Candidate& candidate, const SeparatedTriangle& separated) {
  Facing& facing = facings_[candidate.facing];
  if (separated.gap <= 0.0 && joinContact(facing, separated)) return true;
  const double distance = std::min((1.0 - kNearer) * separated.gap, leastBound());
  if (distance >= request_->reach || found_->planes.size() == kMaxPlanes) return leaveOver(distance);
  addPlane(facing, separated);
  return true;
}

// Without a free plane, the most similar one stands for the triangle.
bool ProximityFinder::Search::joinContact(Facing& facing, const SeparatedTriangle& separated) {
  const Eigen::Vector3d n_W = request_->pose.X_WT.linear() * separated.normal_T;
  ProximityPlane* best = nullptr;
  double cosine = found_->planes.size() == kMaxPlanes ? -1.0 : kSameNormal;
  for (ProximityPlane& each : found_->planes) {
    const bool in_contact =
        each.workpiece == surfaces_[facing.surface].workpiece && each.plane.piece == facing.piece && each.contact;
    if (!in_contact || !(each.plane.normal_W.dot(n_W) >= cosine)) continue;
    cosine = each.plane.normal_W.dot(n_W);
    best = &each;
  }
  if (best == nullptr) return false;
  const auto number = static_cast<size_t>(best - found_->planes.data());
  SeparatingPlane& plane = best->plane;
  const Eigen::Isometry3d& X_WT = request_->pose.X_WT;
  const Eigen::Vector3d n_T = X_WT.linear().transpose() * plane.normal_W;
  const PointHull hull(facing.cover.corners_T(corners(facing, separated.triangle)));
  const Eigen::Vector3d top_W = X_WT * hull.supportPoint(n_T);
  const double step = std::max(0.0, plane.normal_W.dot(top_W - plane.point_W) + meshOf(facing).rounding());
  plane.gap -= step;
  plane.point_W += step * plane.normal_W;
  quicken(number, facing, meshOf(facing).triangles()[separated.triangle]);
  return true;
}

// A plane that the piece reaches through separates it from nothing: triangles join it one by one.
void ProximityFinder::Search::addPlane(Facing& facing, const SeparatedTriangle& separated) {
  const TriangleMesh& mesh_M = meshOf(facing);
  const double slack = separated.gap > 0.0 ? std::max(kSlack * separated.gap, kMinSlack * mesh_M.radius()) : 0.0;
  const double step = slack + mesh_M.rounding();
  const Eigen::Vector3d point_T = separated.top_T + step * separated.normal_T;
  const size_t number = found_->planes.size();
  const Eigen::Isometry3d& X_WT = request_->pose.X_WT;
  if (separated.gap > 0.0) facing.cover.add(separated.normal_T, separated.normal_T.dot(point_T), number);
  found_->planes.push_back(
      {{facing.piece, X_WT.linear() * separated.normal_T, X_WT * point_T, separated.gap - step, -kInfinity},
       surfaces_[facing.surface].workpiece,
       separated.triangle,
       separated.gap <= 0.0});
  quicken(number, facing, mesh_M.triangles()[separated.triangle]);
}

// Counts the speed of what a plane stands for.
template <typename... Part>
void ProximityFinder::Search::quicken(size_t plane, const Facing& facing, const Part&... part) {
  const SurfaceMotion& motion = *surfaces_[facing.surface].motion;
  SeparatingPlane& found = found_->planes[plane].plane;
  const Eigen::Vector3d n_M = facing.cover.normal_M(request_->pose.X_WT.linear().transpose() * found.normal_W);
  found.surface_speed = std::max(found.surface_speed, motion.moves() ? motion.alongNormal(n_M, part...) : 0.0);
}

bool ProximityFinder::Search::leaveOver(double distance) {
  found_->uncovered.distance = std::max(0.0, distance - rounding_);
  for (size_t i = 0; i < surface_count_; ++i) {
    const CenteredBox box(surfaces_[i].boxes.of(WholeMesh()));
    found_->uncovered.speed = std::max(found_->uncovered.speed, surfaces_[i].motion->fastest(box));
  }
  return false;
}

ProximityFinder::ProximityFinder() : search_(std::make_unique<Search>()) {}

ProximityFinder::~ProximityFinder() = default;

void ProximityFinder::find(const ProximityRequest& request, Proximity& proximity) { search_->find(request, proximity); }

void ProximityFinder::reset() { search_->reset(); }

}  // namespace sweep_guard_core
