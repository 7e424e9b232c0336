#include "soundness/camera_sessions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "soundness/exact_motion.h"
#include "soundness/nearest_point.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core::soundness {
namespace {

using RealCorners = std::array<Vector3r, 3>;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using Says = SeenSurfaces::Says;

constexpr Real kTouch = 1e-6L;                         // [m]: more than float32 costs at 4 m
constexpr int kRandomTimes = 12;                       // at random, between two images
constexpr int kDense = 32;                             // times of a sweep
constexpr Real kFar = 0.02L;                           // [m]
constexpr std::array<int, 3> kDistances = {1, 5, 20};  // [mm]

struct Ball {
  Vector3r middle;
  Real radius;

  bool isWithin(Real distance, const Vector3r& p) const {
    return (p - middle).squaredNorm() <= (radius + distance) * (radius + distance);
  }
};

struct Piece {
  Body body;
  Ball ball;  // around it
};

Body randomToolPiece(Random& random) {
  Body body;
  const int kind = random.below(4);
  body.kind = kind == 0 ? Body::Kind::kSphere : kind == 1 ? Body::Kind::kBox : Body::Kind::kCylinder;
  body.radius = random.logUniform(0.003, 0.05);
  body.length = random.logUniform(0.01, 0.2);
  for (double& half : body.half_extents) half = random.logUniform(0.003, 0.06);
  if (kind == 3) {  // a capsule
    body.padding = body.radius;
    body.radius = 0.0;
  }
  if (random.chance(0.6)) body.X_TS = random.pose(random.inBox({0.05, 0.05, 0.05}));
  return body;
}

// What is known to be touched, or nearly so.
struct Aim {
  size_t image = 0;  // the later one
  bool moving = true;
  SeenTriangle triangle;
  std::array<Real, 3> shares = {1, 1, 1};
  Vector3r weights;
  Time time;
};

struct ToolPath {
  std::vector<Time> stamps;
  std::vector<Isometry3d> poses;
};

// The tool as it is placed at one time.
struct Placed {
  Vector3r p_F;
  Matrix3r R_TF;

  Vector3r inTool(const Vector3r& q_F) const { return R_TF * (q_F - p_F); }
  RealCorners inTool(const RealCorners& corners_F) const {
    return {inTool(corners_F[0]), inTool(corners_F[1]), inTool(corners_F[2])};
  }
};

Placed placedOnPath(const ToolPath& path, Time time) {
  const auto later = std::lower_bound(path.stamps.begin() + 1, path.stamps.end() - 1, time);
  const auto end = static_cast<size_t>(later - path.stamps.begin());
  const ExactMotion motion(Motion{path.poses[end - 1], path.poses[end]});
  const Time begin = path.stamps[end - 1];
  const Real fraction =
      static_cast<Real>((time - begin).count()) / static_cast<Real>((path.stamps[end] - begin).count());
  Placed placed{motion.at(fraction, Vector3r::Zero()), {}};
  for (int axis = 0; axis < 3; ++axis) placed.R_TF.col(axis) = motion.directionInTool(fraction, Vector3r::Unit(axis));
  return placed;
}

Time randomTime(Random& random, Time from, Time to) {
  return from +
         Duration(static_cast<Duration::rep>(random.uniform(0.0, 1.0) * static_cast<double>((to - from).count())));
}

Ball ballAround(const Body& body) {
  const bool is_cylinder = body.kind == Body::Kind::kCylinder;
  const Vector3d middle_S(0.0, 0.0, is_cylinder ? -0.5 * body.length : 0.0);
  const double round = std::hypot(body.radius, is_cylinder ? 0.5 * body.length : 0.0);
  const double size = body.kind == Body::Kind::kBox ? body.half_extents.norm() : round;
  return {(body.X_TS * middle_S).cast<Real>(), static_cast<Real>(1.001 * (size + body.padding))};
}

Real sizeOf(const RealCorners& corners, const Vector3r& middle) {
  return std::max({(corners[0] - middle).norm(), (corners[1] - middle).norm(), (corners[2] - middle).norm()});
}

Vector3r weighted(const RealCorners& corners, const Vector3r& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

Vector3r randomWeights(Random& random) {
  const auto u = static_cast<Real>(random.uniform(0.0, 1.0));
  const auto v = static_cast<Real>(random.uniform(0.0, 1.0)) * (1 - u);
  return {u, v, 1 - u - v};
}

// Returns whether some point of a triangle is found that is deep in the tool: corners, points at random and those
// nearest to points ever farther from the middle of a piece.
bool touches(Random& random, const std::vector<Piece>& tool, const RealCorners& corners_T) {
  const Vector3r center = (corners_T[0] + corners_T[1] + corners_T[2]) / 3;
  const Real size = sizeOf(corners_T, center);
  for (const auto& [body, ball] : tool) {
    if (!ball.isWithin(size, center) || depth(body, center) < -size) continue;
    for (const Vector3r& corner : corners_T) {
      if (depth(body, corner) > kTouch) return true;
    }
    for (int i = 0; i < 3; ++i) {
      if (depth(body, weighted(corners_T, randomWeights(random))) > kTouch) return true;
    }
    Vector3r p = nearestOfTriangle(corners_T, ball.middle);
    for (const Real inwards : {0.5L, 0.3L, 0.1L, 0.03L, 0.01L}) {
      if (depth(body, p) > kTouch) return true;
      const Vector3r of_body = nearest(body, p);
      p = nearestOfTriangle(corners_T, of_body + inwards * (ball.middle - of_body));
    }
  }
  return false;
}

// Returns a lower bound of the distance, or 0 if there is none: the width of a slab between them.
Real distanceBetween(const Piece& piece, const RealCorners& corners_T) {
  const Body& body = piece.body;
  Vector3r p = nearestOfTriangle(corners_T, piece.ball.middle);
  Real width = 0;
  for (int i = 0; i < 8; ++i) {
    if (depth(body, p) >= 0) return 0;
    const Vector3r of_body = nearest(body, p);
    p = nearestOfTriangle(corners_T, of_body);
    const Vector3r across = (p - of_body).normalized();
    const Real triangle = std::min({across.dot(corners_T[0]), across.dot(corners_T[1]), across.dot(corners_T[2])});
    width = std::max(width, triangle - across.dot(support(body, across)));
    if (width > 0.95L * (p - of_body).norm()) break;
  }
  return width;
}

class CameraSession {
 public:
  CameraSession(Random& random, const SeenSurfaces& surfaces)
      : random_(random), surfaces_(surfaces), images_(surfaces.images().images) {
    for (int pieces = random.chance(0.7) ? 1 : 2 + random.below(2); pieces > 0; --pieces)
      tool_.push_back(randomToolPiece(random));
    for (const Body& body : tool_) pieces_.push_back({body, ballAround(body)});
    extent_ = static_cast<Real>(extentOf(tool_));
    makeStamps();
    makeAim();
    makePoses();
  }

  CameraFindings check(bool looseness) {
    play();
    for (size_t i = first_swept_ + 1; i < images_.size(); ++i) checkPair(i);
    checkLast();
    for (size_t i = 0; looseness && i < sweeps_.size(); ++i) checkLooseness(sweeps_[i]);
    return std::move(findings_);
  }

 private:
  struct Sweep {
    Time begin;         // of the path
    Time end;           // stamp of the pose
    size_t oldest = 0;  // image that counts
    size_t newest = 0;
    std::vector<std::uint32_t> found;
    bool contact = false;
  };

  void makeStamps() {
    const Time begin = images_.front().stamp;
    const Time end = images_.back().stamp;
    const Time first = begin + fromSeconds(random_.uniform(-0.04, 0.01));
    const Time last = end + fromSeconds(random_.uniform(-0.005, 0.04));
    std::vector<Time>& stamps = path_.stamps;
    stamps = {first, std::max(last, first + fromSeconds(0.001))};
    for (int count = random_.below(9); count > 0; --count) {
      const auto image = static_cast<size_t>(random_.below(static_cast<int>(images_.size())));
      const Time stamp = randomTime(random_, stamps[0], stamps[1]);
      stamps.push_back(random_.chance(0.15) ? std::max(stamps[0], images_[image].stamp) : stamp);
    }
    std::sort(stamps.begin(), stamps.end());
    stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
  }

  // What is at rest is the earlier image of a pair, or the last one after all.
  void makeAim() {
    Aim aim;
    aim.image = 1 + static_cast<size_t>(random_.below(static_cast<int>(images_.size())));
    aim.moving = aim.image < images_.size() && random_.chance(0.6);
    const Time from = std::max(path_.stamps.front(), images_[aim.image - 1].stamp);
    const Time to =
        aim.image < images_.size() ? std::min(path_.stamps.back(), images_[aim.image].stamp) : path_.stamps.back();
    if (!(from < to)) return;
    std::vector<SeenTriangle> found;
    for (int tries = aim.moving ? 1 + random_.below(20) : 1; tries > 0; --tries) {
      const auto more = surfaces_.any(random_, aim.moving ? aim.image : aim.image - 1, aim.moving);
      found.insert(found.end(), more.begin(), more.end());
    }
    if (found.empty()) return;
    const auto shorter = [](const SeenTriangle& a, const SeenTriangle& b) { return a.length() < b.length(); };
    aim.triangle = *std::max_element(found.begin(), found.end(), shorter);
    for (Real& share : aim.shares) share = randomShare();
    aim.weights = randomWeights(random_);
    aim.time = randomTime(random_, from, to);
    aim_ = aim;
  }

  Real randomShare() {
    const int kind = random_.below(4);
    return kind == 0 ? 0 : kind == 1 ? 1 : static_cast<Real>(random_.uniform(0.0, 1.0));
  }

  // The tip of the tool is at the aim at its time, or near it.
  Isometry3d poseAtAim(Vector3d& outward_F) {
    const Isometry3d& X_FC = images_.front().X_FC;
    Isometry3d X = random_.pose(X_FC * Vector3d(0.0, 0.0, random_.uniform(0.3, 2.0)));
    outward_F = -X_FC.linear().col(2);
    if (!aim_) return X;
    const RealCorners corners = aim_->triangle.at(aim_->shares);
    const Vector3r p_F = weighted(corners, aim_->weights);
    Vector3r out = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (!out.allFinite()) out = (X_FC.translation().cast<Real>() - p_F).normalized();
    if (out.dot(X_FC.translation().cast<Real>() - p_F) < 0) out = -out;
    outward_F = out.cast<double>();
    if (random_.chance(0.2)) out = random_.direction().cast<Real>();
    const Body& body = tool_[static_cast<size_t>(random_.below(static_cast<int>(tool_.size())))];
    Real inset = static_cast<Real>(random_.logUniform(2e-6, 0.02));
    if (random_.chance(0.3)) inset = -static_cast<Real>(random_.logUniform(1e-5, 0.1));
    while (inset > 2e-6L && !hasInset(body, inset)) inset = inset / 2;
    const Vector3r tip_T = support(body, -(X.linear().transpose().cast<Real>() * out), inset);
    X.translation() = (p_F - X.linear().cast<Real>() * tip_T).cast<double>();
    return X;
  }

  void makePoses() {
    Vector3d out_F;
    const Isometry3d X = poseAtAim(out_F);
    const std::vector<Time>& stamps = path_.stamps;
    const Time time = aim_ ? aim_->time : stamps.front();
    const auto end = static_cast<size_t>(std::lower_bound(stamps.begin() + 1, stamps.end() - 1, time) - stamps.begin());
    const double fraction = toSeconds(time - stamps[end - 1]) / toSeconds(stamps[end] - stamps[end - 1]);
    const double speed = random_.chance(0.15) ? 0.0 : random_.logUniform(0.01, 3.0);
    const double turn = random_.chance(0.4) ? 0.0 : random_.logUniform(1e-3, 0.6);
    const bool leaves = random_.chance(0.5);  // on both sides
    const auto step = [&](size_t i, double side) {
      const double length = speed * toSeconds(stamps[i] - stamps[i - 1]);
      Vector3d direction = random_.direction();
      if (leaves) direction = (direction - direction.dot(out_F) * out_F + side * random_.uniform(0.0, 3.0) * out_F);
      return Vector3d(length * direction);
    };
    path_.poses.assign(stamps.size(), X);
    const Vector3d way = step(end, 0.0);
    const Vector3d axis = random_.direction();
    for (const size_t i : {end - 1, end}) {
      const double share = (i == end ? 1.0 : 0.0) - fraction;
      path_.poses[i].translation() += share * way;
      path_.poses[i].linear() = X.linear() * Eigen::AngleAxisd(share * turn, axis).toRotationMatrix();
    }
    for (size_t i = end + 1; i < stamps.size(); ++i) {
      path_.poses[i].translation() = path_.poses[i - 1].translation() + step(i, 1.0);
      path_.poses[i].linear() = path_.poses[i - 1].linear() * random_.turn(random_.uniform(0.0, turn));
    }
    for (size_t i = end - 1; i > 0; --i) {
      path_.poses[i - 1].translation() = path_.poses[i].translation() + step(i, 1.0);
      path_.poses[i - 1].linear() = path_.poses[i].linear() * random_.turn(random_.uniform(0.0, turn));
    }
  }

  GuardOptions randomOptions() {
    GuardOptions options;
    const std::vector<VolumeKind> kinds = volumeKinds();
    options.sweep.volume = kinds[static_cast<size_t>(random_.below(static_cast<int>(kinds.size())))];
    options.sweep.max_rotation = random_.logUniform(0.05, 1.0);
    return options;
  }

  // The guard keeps the way of the tool in a frame only while it has a workpiece there.
  static std::shared_ptr<const Workpiece> farAway() {
    const Vector3d corner(100.0, 100.0, 100.0);
    const TriangleMesh mesh({corner, corner + Vector3d::UnitX(), corner + Vector3d::UnitY()}, {{0, 1, 2}});
    return std::make_shared<const Workpiece>(Workpiece{"far", 0, {}, {}, "F", mesh});
  }

  // Poses arrive soon, images late; each in its order.
  void play() {
    guard_.emplace(toolOf(tool_), makeDetector("reference"), randomOptions());
    if (random_.chance(0.5)) shown_ = others_ = {farAway()};
    const DepthImages& camera = surfaces_.images();
    const Grid grid(camera.width, camera.height);
    DepthSurface surface(grid, camera.camera, camera.options);
    const TriangleMesh empty(grid);
    std::vector<Time> arrivals;
    const double delay = random_.chance(0.3) ? 0.0 : random_.logUniform(1e-3, 0.1);
    for (const auto& image : images_) {
      const Time arrival = image.stamp + fromSeconds(delay * random_.uniform(0.5, 1.5));
      arrivals.push_back(arrivals.empty() ? arrival : std::max(arrival, arrivals.back()));
    }
    size_t pose = 0;
    for (size_t i = 0; i < images_.size(); ++i) {
      for (; pose < path_.stamps.size() && path_.stamps[pose] <= arrivals[i]; ++pose)
        arrive(pose, pose + 1 < path_.stamps.size() && path_.stamps[pose + 1] <= arrivals[i]);
      show(i, surface, empty);
    }
    for (; pose < path_.stamps.size(); ++pose) arrive(pose, pose + 1 < path_.stamps.size());
  }

  void show(size_t i, DepthSurface& surface, const TriangleMesh& empty) {
    const auto& image = images_[i];
    const double since = i == 0 ? 0.0 : toSeconds(image.stamp - images_[i - 1].stamp);
    surface.take(image.depths, image.X_FC, since);
    Workpiece seen{"camera", 0, image.stamp, SteadyTime(image.stamp.time_since_epoch()), "F", empty};
    seen.mesh_M.deform(surface.places_F(), surface.before_F(), surface.existing());
    seen.of_camera = true;
    seen.updates = i;
    shown_ = others_;
    shown_.push_back(std::make_shared<const Workpiece>(std::move(seen)));
    sees_ = true;
    newest_ = i;
    if (swept_to_) sweep(*swept_to_, /*arrived=*/false);
  }

  // @param next  has arrived, too
  void arrive(size_t pose, bool next) {
    if (next && random_.chance(0.3)) return guard_->pass(poseAt(pose));
    sweep(pose, /*arrived=*/true);
  }

  PoseWithFrames poseAt(size_t i) const {
    const Time stamp = path_.stamps[i];
    return {stamp, SteadyTime(stamp.time_since_epoch()), path_.poses[i], {{"F", Isometry3d::Identity()}}};
  }

  void sweep(size_t pose, bool arrived) {
    guard_->sweep(poseAt(pose), shown_, report_, arrived);
    if (sees_) keep(pose);
    swept_to_ = pose;
  }

  // The image that held at the last pose counts, and all since. A new one is swept from the one before it on.
  void keep(size_t pose) {
    Sweep sweep;
    sweep.end = path_.stamps[pose];
    sweep.begin = path_.stamps[swept_to_.value_or(pose)];
    sweep.newest = newest_;
    const bool first = sweeps_.empty();
    if (first) {
      first_swept_ = newest_;
      known_from_ = others_.empty() ? sweep.begin : path_.stamps.front();
    }
    sweep.oldest = first ? newest_ : sweeps_.back().newest;
    while (sweep.oldest > first_swept_ && images_[sweep.oldest].stamp > sweep.begin) --sweep.oldest;
    if (!first && newest_ > sweeps_.back().newest) {
      const Time again = std::min(sweep.begin, images_[newest_ - 1].stamp);
      const auto later = std::upper_bound(path_.stamps.begin() + 1, path_.stamps.end(), again);
      sweep.begin = *std::prev(later);
    }
    if (!report_.complete()) fail("a sweep is not complete");
    for (const SweptObject& object : report_.objects) {
      if (!object.workpiece->of_camera) continue;
      sweep.contact = sweep.contact || object.result.contact();
      sweep.found.insert(sweep.found.end(), object.result.not_ruled_out.begin(), object.result.not_ruled_out.end());
    }
    sweeps_.push_back(std::move(sweep));
  }

  void checkPair(size_t i) {
    ++findings_.images;
    const Time from = std::max(images_[i - 1].stamp, known_from_);
    const Time to = std::min(images_[i].stamp, path_.stamps.back());
    if (!(from < to)) return;
    checkTimes(i - 1, /*moving=*/false, from, to, i);
    checkTimes(i, /*moving=*/true, from, to, i);
  }

  void checkLast() {
    const size_t last = images_.size() - 1;
    const Time from = std::max(images_[last].stamp, known_from_);
    if (first_swept_ < last && from < path_.stamps.back())
      checkTimes(last, /*moving=*/false, from, path_.stamps.back(), last + 1);
  }

  std::vector<Time> timesBetween(Time from, Time to) const {
    std::vector<Time> times = {from, to};
    for (const Time stamp : path_.stamps) {
      if (from < stamp && stamp < to) times.push_back(stamp);
    }
    return times;
  }

  // @param deadline  the image after which the first pose must tell; all of them if there is none
  void checkTimes(size_t image, bool moving, Time from, Time to, size_t deadline) {
    std::vector<Time> times = timesBetween(from, to);
    for (int i = 0; i < kRandomTimes; ++i) times.push_back(randomTime(random_, from, to));
    std::sort(times.begin(), times.end());
    std::vector<Placed> places;
    for (const Time time : times) places.push_back(placedOnPath(path_, time));
    const auto [center, radius] = ballAroundAll(places);
    std::map<std::uint32_t, Time> touched;
    std::vector<SeenTriangle> ways = surfaces_.near(image, moving, Says::kMust, center, radius);
    for (size_t i = 0; i < places.size(); ++i) {
      for (SeenTriangle& way : ways) {
        if (touched.count(way.number) != 0) continue;
        const std::array<Real, 3> shares =
            moving ? std::array{randomShare(), randomShare(), randomShare()} : std::array<Real, 3>{1, 1, 1};
        if (touches(random_, pieces_, places[i].inTool(way.at(shares)))) touched.try_emplace(way.number, times[i]);
      }
    }
    if (aim_ && aim_->image == deadline && aim_->moving == moving && from <= aim_->time && aim_->time <= to &&
        hits(*aim_))
      touched.try_emplace(aim_->triangle.number, aim_->time);
    judge(touched, image, moving, deadline);
  }

  bool hits(const Aim& aim) const {
    const Vector3r p_T = placedOnPath(path_, aim.time).inTool(weighted(aim.triangle.at(aim.shares), aim.weights));
    return std::any_of(tool_.begin(), tool_.end(), [&](const Body& body) { return depth(body, p_T) > kTouch; });
  }

  Ball ballAroundAll(const std::vector<Placed>& places) const {
    Vector3r least = places.front().p_F;
    Vector3r most = least;
    for (const Placed& placed : places) {
      least = least.cwiseMin(placed.p_F);
      most = most.cwiseMax(placed.p_F);
    }
    return {(least + most) / 2, (most - least).norm() / 2 + extent_};
  }

  void judge(const std::map<std::uint32_t, Time>& touched, size_t image, bool moving, size_t deadline) {
    std::set<std::uint32_t> found;
    for (const Sweep& sweep : sweeps_) {
      found.insert(sweep.found.begin(), sweep.found.end());
      if (deadline < images_.size() && sweep.newest >= deadline && sweep.end >= images_[deadline].stamp) break;
    }
    findings_.touched += touched.size();
    for (const auto& [triangle, time] : touched) {
      if (found.count(triangle) != 0) continue;
      ++findings_.missed;
      if (findings_.missed > 3) continue;
      std::ostringstream text;
      text << "triangle " << triangle << " of image " << image << (moving ? " on its way" : " at rest") << " at "
           << inMilliseconds(time) << " ms";
      fail(text.str());
    }
  }

  double inMilliseconds(Time time) const { return 1e3 * toSeconds(time - images_.front().stamp); }

  void fail(const std::string& what) {
    std::ostringstream text;
    text << what << "; images at";
    for (const auto& image : images_) text << ' ' << inMilliseconds(image.stamp);
    text << " ms, poses at";
    for (const Time stamp : path_.stamps) text << ' ' << inMilliseconds(stamp);
    text << " ms; sweeps";
    for (const Sweep& sweep : sweeps_)
      text << " [" << inMilliseconds(sweep.begin) << ' ' << inMilliseconds(sweep.end) << ": " << sweep.newest << ", "
           << sweep.found.size() << ']';
    findings_.text += text.str() + '\n';
  }

  // Between two times, no point of the tool moves farther from both than half of the way between them.
  void checkLooseness(const Sweep& sweep) {
    std::vector<Time> times = timesBetween(sweep.begin, sweep.end);
    for (int i = 1; i < kDense; ++i) times.push_back(sweep.begin + i * (sweep.end - sweep.begin) / kDense);
    std::sort(times.begin(), times.end());
    std::vector<Placed> places;
    Real longest = 0;
    for (const Time time : times) {
      places.push_back(placedOnPath(path_, time));
      const Placed& before = places[places.size() > 1 ? places.size() - 2 : 0];
      longest = std::max(longest,
                         (places.back().p_F - before.p_F).norm() + (places.back().R_TF - before.R_TF).norm() * extent_);
    }
    const auto [center, radius] = ballAroundAll(places);
    Real least = 2 * kFar;
    for (size_t image = sweep.oldest; image <= sweep.newest; ++image) {
      for (const SeenTriangle& way : surfaces_.near(image, image > sweep.oldest, Says::kMay, center, radius + least))
        approach(way, places, longest / 2, least);
    }
    for (const int distance : kDistances) {
      if (least <= 1e-3L * distance) continue;
      ++findings_.clear[distance];
      if (sweep.contact) ++findings_.false_contacts[distance];
    }
  }

  void approach(const SeenTriangle& way, const std::vector<Placed>& places, Real half_step, Real& least) const {
    const Real length = way.length();
    const int parts = length > 0 ? static_cast<int>(std::ceil(length / 0.002L)) : 0;
    for (int part = 0; part <= parts && least > 0; ++part) {
      const Real share = parts > 0 ? static_cast<Real>(part) / parts : 1;
      const RealCorners corners_F = way.at({share, share, share});
      const Vector3r center_F = (corners_F[0] + corners_F[1] + corners_F[2]) / 3;
      const Real near = sizeOf(corners_F, center_F) + half_step + (parts > 0 ? length / (2 * parts) : 0);
      for (const Placed& placed : places) {
        const Vector3r center_T = placed.inTool(center_F);
        for (const Piece& piece : pieces_) {
          if (!piece.ball.isWithin(near + least, center_T) || -depth(piece.body, center_T) - near >= least) continue;
          const Real distance = distanceBetween(piece, placed.inTool(corners_F));
          least = std::min(least, distance - half_step - (parts > 0 ? length / (2 * parts) : 0));
        }
      }
    }
  }

  Random& random_;
  const SeenSurfaces& surfaces_;
  const std::vector<DepthImages::Image>& images_;
  Bodies tool_;
  std::vector<Piece> pieces_;
  Real extent_ = 0;
  ToolPath path_;
  std::optional<Aim> aim_;
  std::optional<Guard> guard_;
  Workpieces others_;
  Workpieces shown_;
  SweepReport report_;
  size_t newest_ = 0;
  bool sees_ = false;
  Time known_from_;  // the path of the tool
  size_t first_swept_ = std::numeric_limits<size_t>::max() - 1;
  std::optional<size_t> swept_to_;
  std::vector<Sweep> sweeps_;
  CameraFindings findings_;
};

}  // namespace

CameraFindings checkCameraSession(Random& random, const SeenSurfaces& surfaces, bool looseness) {
  return CameraSession(random, surfaces).check(looseness);
}

void add(const CameraFindings& findings, const std::string& family, const std::string& about, Report& report) {
  Tally& tally = report.of("halfspace", family);
  tally.cases += findings.images;
  tally.positives += findings.touched;
  tally.misses += findings.missed;
  for (const int distance : kDistances) {
    Tally& clear = report.of("halfspace/" + std::to_string(distance) + "mm", family);
    const auto count = [distance](const std::map<int, std::uint64_t>& counts) {
      const auto found = counts.find(distance);
      return found == counts.end() ? 0 : found->second;
    };
    clear.cases += findings.images;
    clear.positives += count(findings.clear);
    clear.extras += count(findings.false_contacts);
  }
  if (!findings.text.empty()) report.fail(family + ' ' + about, [&] { return findings.text; });
}

void checkCamera(const Context& context, std::uint64_t seed) {
  Random random(seed);
  const DepthImages images = renderedImages(random);
  const SeenSurfaces surfaces(images);
  for (int tool = 0; tool < 3; ++tool)
    add(checkCameraSession(random, surfaces, /*looseness=*/tool == 0), context.family, context.about, context.report);
}

}  // namespace sweep_guard_core::soundness
