#include "soundness/metamorphic.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "soundness/exact_motion.h"

namespace sweep_guard_core::soundness {
namespace {

// Depends on the case alone, so that a replay draws the same numbers.
Random randomOf(const Triangles& triangles) {
  std::uint64_t seed = 0;
  const double first = triangles.corners_M.front().sum();
  std::memcpy(&seed, &first, sizeof(seed));
  return Random(seed);
}

double largestCoordinate(const Triangles& triangles) {
  double largest = 0.0;
  for (const Eigen::Vector3d& p : triangles.corners_M) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  for (const Eigen::Vector3d& p : triangles.before_M) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

// Another description of the same triangles. A triangle is represented by any of `stand_for` among `other`.
struct Restated {
  Triangles other;
  std::vector<std::vector<std::uint32_t>> stand_for;
};

void append(Triangles& triangles, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  triangles.corners_M.insert(triangles.corners_M.end(), {a, b, c});
}

Restated eachTurned(const Triangles& triangles, const std::array<size_t, 3>& order) {
  Restated restated;
  restated.other.streamed = triangles.streamed;
  for (std::uint32_t i = 0; i < triangles.count(); ++i) {
    const Eigen::Vector3d* corners = &triangles.corners_M[size_t{3} * i];
    append(restated.other, corners[order[0]], corners[order[1]], corners[order[2]]);
    restated.stand_for.push_back({i});
  }
  return restated;
}

Restated shuffled(const Triangles& triangles, Random& random) {
  const std::vector<std::uint32_t> order = random.permutation(triangles.count());
  Restated restated;
  restated.other.streamed = triangles.streamed;
  restated.stand_for.resize(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const Eigen::Vector3d* corners = &triangles.corners_M[size_t{3} * order[i]];
    append(restated.other, corners[0], corners[1], corners[2]);
    restated.stand_for[order[i]] = {i};
  }
  return restated;
}

// Copy `which` must be named.
Restated twice(const Triangles& triangles, std::uint32_t which) {
  Restated restated;
  restated.other = triangles;
  restated.other.corners_M.insert(restated.other.corners_M.end(), triangles.corners_M.begin(),
                                  triangles.corners_M.end());
  const auto count = static_cast<std::uint32_t>(triangles.count());
  for (std::uint32_t i = 0; i < count; ++i) restated.stand_for.push_back({i + which * count});
  return restated;
}

Restated cutInFour(const Triangles& triangles) {
  Restated restated;
  for (std::uint32_t i = 0; i < triangles.count(); ++i) {
    const Eigen::Vector3d* p = &triangles.corners_M[size_t{3} * i];
    const Eigen::Vector3d ab = 0.5 * (p[0] + p[1]);
    const Eigen::Vector3d bc = 0.5 * (p[1] + p[2]);
    const Eigen::Vector3d ca = 0.5 * (p[2] + p[0]);
    append(restated.other, p[0], ab, ca);
    append(restated.other, ab, p[1], bc);
    append(restated.other, ca, bc, p[2]);
    append(restated.other, ab, bc, ca);
    restated.stand_for.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  return restated;
}

Restated withMore(const Triangles& triangles, Random& random) {
  Restated restated = eachTurned(triangles, {0, 1, 2});
  const double largest = std::min(kMaxDistance, 2.0 * largestCoordinate(triangles));
  for (int count = 1 + random.below(10); count > 0; --count) {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(largest);
    append(restated.other, random.inBox(half), random.inBox(half), random.inBox(half));
  }
  return restated;
}

Eigen::Isometry3d randomMove(Random& random, const Triangles& triangles) {
  const double room = kMaxDistance - 2.0 * largestCoordinate(triangles);
  if (room <= 0.0) return Eigen::Isometry3d::Identity();
  return random.pose(random.uniform(0.0, std::min(room, 2.0 * largestCoordinate(triangles))) * random.direction());
}

Triangles moved(const Eigen::Isometry3d& move, Triangles triangles) {
  for (Eigen::Vector3d& p : triangles.corners_M) p = move * p;
  for (Eigen::Vector3d& p : triangles.before_M) p = move * p;
  return triangles;
}

// A power of two that keeps all coordinates within bounds.
double randomScale(Random& random, double largest) {
  const int most = std::min(20, static_cast<int>(std::floor(std::log2(kMaxDistance / std::max(largest, 1e-9)))) - 2);
  return std::ldexp(1.0, most - random.below(30));
}

Triangles scaled(Triangles triangles, double scale) {
  for (Eigen::Vector3d& p : triangles.corners_M) p *= scale;
  for (Eigen::Vector3d& p : triangles.before_M) p *= scale;
  return triangles;
}

SweptVolume scaled(SweptVolume volume, double scale) {
  volume.box.X_MB.translation() *= scale;
  volume.box.half_extents *= scale;
  volume.interior_B *= scale;
  volume.margin *= scale;
  for (HalfSpace& clip_B : volume.clips_B) clip_B = HalfSpace(clip_B.normal(), scale * clip_B.offset());
  return volume;
}

Motion scaled(Motion motion, double scale) {
  motion.X_MT_start.translation() *= scale;
  motion.X_MT_end.translation() *= scale;
  return motion;
}

Motion moved(const Eigen::Isometry3d& move, const Motion& motion) {
  return {move * motion.X_MT_start, move * motion.X_MT_end};
}

// Checks relations of one case with one detector.
class Relations {
 public:
  Relations(const Context& context, TestedDetector& tested, std::function<std::string(const std::string&)> text)
      : context_(context),
        tested_(tested),
        text_(std::move(text)),
        tally_(context.report.of(tested.name, context.family)) {}

  // Counts a triangle that must be named.
  void demand(bool named, const std::string& relation, std::uint32_t triangle) {
    ++tally_.positives;
    if (named) return;
    ++tally_.misses;
    context_.report.fail("relation '" + relation + "', triangle " + std::to_string(triangle),
                         [&] { return text_(context_.family + ' ' + context_.about + " detector " + tested_.name); });
  }

  void demandSame(bool same, const std::string& relation) {
    ++tally_.cases;
    demand(same, relation, 0);
  }

  // Demands that a triangle named here is named there too, in a volume grown by the error bounds of both.
  void implies(const std::string& relation, const PairCase& pair, const Restated& restated,
               const SweptVolume& other_M) {
    ++tally_.cases;
    const TriangleMesh mesh = pair.triangles.mesh();
    const TriangleMesh other_mesh = restated.other.mesh();
    const Detection here = detect(mesh, pair.swept_M);
    const double rounding =
        0x1p-49 * (largestCoordinate(pair.triangles) + largestCoordinate(restated.other) +
                   pair.swept_M.box.X_MB.translation().norm() + other_M.box.X_MB.translation().norm());
    const double kept = pair.triangles.streamed == restated.other.streamed && !pair.triangles.streamed
                            ? mesh.rounding() + other_mesh.rounding()
                            : floatRounding(pair.triangles) + floatRounding(restated.other);
    const Detection there = detect(other_mesh, other_M.grown(here.inflation + rounding + kept));
    for (const std::uint32_t triangle : here.triangles) {
      const auto& stand_for = restated.stand_for[triangle];
      demand(std::any_of(stand_for.begin(), stand_for.end(), [&](auto i) { return contains(there.triangles, i); }),
             relation, triangle);
    }
  }

  Detection detect(const TriangleMesh& mesh, const SweptVolume& volume) const {
    return tested_.detector->detect(mesh, volume);
  }

  SweepResult sweep(const SweepCase& sweep) const { return checkCase(*tested_.detector, sweep); }

  // A path meets everything that its first poses meet.
  void keepsTheBeginning(const SweepCase& sweep, int count) {
    ++tally_.cases;
    constexpr int kPoses = 8;
    std::vector<Eigen::Isometry3d> path;
    path.reserve(kPoses);
    for (int i = 0; i < kPoses; ++i) path.push_back(sweep.motion.at(static_cast<double>(i) / (kPoses - 1)));
    const TriangleMesh mesh = sweep.triangles.mesh();
    const auto contactsOf = [&](const std::vector<Eigen::Isometry3d>& poses) {
      return checkPath(*tested_.detector, {toolOf(sweep.tool), poses, mesh, sweep.options}).all.not_ruled_out;
    };
    const std::vector<std::uint32_t> all = contactsOf(path);
    for (const std::uint32_t triangle : contactsOf({path.begin(), path.begin() + count})) {
      demand(contains(all, triangle), "beginning of a path", triangle);
    }
  }

  // Demands that contacts at fractions from `from` to `to` are named.
  void keepsContacts(const std::string& relation, const SweepCase& sweep, double from = 0.0, double to = 1.0) {
    ++tally_.cases;
    const std::vector<std::uint32_t> triangles = this->sweep(sweep).not_ruled_out;
    for (const Contact& contact : sweep.contacts) {
      if (contact.fraction < from || contact.fraction > to) continue;
      demand(contains(triangles, contact.triangle), relation, contact.triangle);
    }
  }

 private:
  static double floatRounding(const Triangles& triangles) {
    return triangles.streamed ? 0x1p-23 * largestCoordinate(triangles) : triangles.mesh().rounding();
  }

  const Context& context_;
  TestedDetector& tested_;
  std::function<std::string(const std::string&)> text_;
  Tally& tally_;
};

void checkOne(Relations& relations, const PairCase& pair) {
  Random random = randomOf(pair.triangles);
  const SweptVolume& volume = pair.swept_M;
  relations.implies("triangles in another order", pair, shuffled(pair.triangles, random), volume);
  relations.implies("corners in another order", pair, eachTurned(pair.triangles, {1, 2, 0}), volume);
  relations.implies("wound the other way", pair, eachTurned(pair.triangles, {0, 2, 1}), volume);
  relations.implies("every triangle twice, the first", pair, twice(pair.triangles, 0), volume);
  relations.implies("every triangle twice, the second", pair, twice(pair.triangles, 1), volume);
  relations.implies("each triangle cut in four", pair, cutInFour(pair.triangles), volume);
  relations.implies("more triangles", pair, withMore(pair.triangles, random), volume);
  const Restated same = eachTurned(pair.triangles, {0, 1, 2});
  relations.implies("larger volume", pair, same,
                    volume.grown(volume.box.half_extents.norm() * random.logUniform(1e-12, 1.0)));

  Restated quarters = cutInFour(pair.triangles);
  Restated whole{pair.triangles, {}};
  for (std::uint32_t i = 0; i < quarters.other.count(); ++i) whole.stand_for.push_back({i / 4});
  relations.implies("whole of a cut triangle", {quarters.other, volume}, whole, volume);

  const Eigen::Isometry3d move = randomMove(random, pair.triangles);
  Restated elsewhere = same;
  elsewhere.other = moved(move, pair.triangles);
  SweptVolume volume_elsewhere = volume;
  volume_elsewhere.box.X_MB = move * volume.box.X_MB;
  relations.implies("everything moved", pair, elsewhere, volume_elsewhere);

  const double largest = std::max(largestCoordinate(pair.triangles), volume.box.X_MB.translation().norm());
  const double scale = randomScale(random, largest);
  const Detection here = relations.detect(pair.triangles.mesh(), volume);
  const Detection there = relations.detect(scaled(pair.triangles, scale).mesh(), scaled(volume, scale));
  relations.demandSame(here.triangles == there.triangles && here.inflation * scale == there.inflation,
                       "scaled by a power of two");
}

// At half a turn, rounding decides which way the tool turns.
bool isHalfATurn(const Motion& motion) { return motion.angle() > M_PI - 1e-7; }

SweepCase reversed(SweepCase sweep) {
  std::swap(sweep.motion.X_MT_start, sweep.motion.X_MT_end);
  if (sweep.frame_W) std::swap(sweep.frame_W->X_MT_start, sweep.frame_W->X_MT_end);
  if (!sweep.triangles.before_M.empty()) std::swap(sweep.triangles.corners_M, sweep.triangles.before_M);
  return sweep;
}

void checkHalves(Relations& relations, const SweepCase& sweep, double fraction) {
  SweepCase first = sweep;
  SweepCase second = sweep;
  first.motion.X_MT_end = second.motion.X_MT_start = sweep.motion.at(fraction);
  if (sweep.frame_W) first.frame_W->X_MT_end = second.frame_W->X_MT_start = sweep.frame_W->at(fraction);
  relations.keepsContacts("first part of a sweep", first, 0.0, fraction);
  relations.keepsContacts("second part of a sweep", second, fraction, 1.0);
}

SweepCase scaledSweep(const SweepCase& sweep, double scale) {
  SweepCase other = sweep;
  other.triangles = scaled(sweep.triangles, scale);
  other.motion = scaled(sweep.motion, scale);
  if (sweep.frame_W) other.frame_W = scaled(*sweep.frame_W, scale);
  other.options.margin *= scale;
  for (Body& body : other.tool) body = scaled(body, scale);
  return other;
}

void checkOne(Relations& relations, const SweepCase& sweep) {
  Random random = randomOf(sweep.triangles);
  relations.keepsContacts("time runs backwards", reversed(sweep));
  checkHalves(relations, sweep, (1 + random.below(15)) / 16.0);

  SweepCase larger = sweep;
  for (Body& body : larger.tool) body = enlarged(body, random.logUniform(1e-6, 1.0) * extentOf(sweep.tool));
  relations.keepsContacts("larger tool", larger);

  relations.keepsTheBeginning(sweep, 1 + random.below(8));

  if (!sweep.frame_W && !isHalfATurn(sweep.motion)) {
    const Eigen::Isometry3d move = randomMove(random, sweep.triangles);
    SweepCase elsewhere = sweep;
    elsewhere.triangles = moved(move, sweep.triangles);
    elsewhere.motion = moved(move, sweep.motion);
    const double all =
        largestCoordinate(sweep.triangles) + largestCoordinate(elsewhere.triangles) + extentOf(sweep.tool);
    elsewhere.options.margin += (sweep.triangles.streamed ? 0x1p-22 : 0x1p-49) * all;
    relations.keepsContacts("everything moved", elsewhere);
  }

  double largest = std::max(largestCoordinate(sweep.triangles),
                            sweep.motion.X_MT_start.translation().norm() + sweep.motion.X_MT_end.translation().norm());
  if (sweep.frame_W) largest += sweep.frame_W->X_MT_start.translation().norm();
  largest += extentOf(sweep.tool);
  const double scale = randomScale(random, largest);
  const SweepResult here = relations.sweep(sweep);
  const SweepCase other = scaledSweep(sweep, scale);
  const SweepResult there = relations.sweep(other);
  relations.demandSame(here.triangles == there.triangles && here.not_ruled_out == there.not_ruled_out &&
                           here.margin * scale == there.margin,
                       "sweep scaled by a power of two");
}

}  // namespace

void checkRelations(const Context& context, const PairCase& pair) {
  for (TestedDetector& tested : context.detectors) {
    Relations relations(context, tested, [&](const std::string& about) { return textOf(pair, about); });
    checkOne(relations, pair);
  }
}

void checkRelations(const Context& context, const SweepCase& sweep) {
  for (TestedDetector& tested : context.detectors) {
    for (const VolumeKind kind : volumeKinds()) {
      SweepCase of_kind = sweep;
      of_kind.options.volume = kind;
      Relations relations(context, tested, [&](const std::string& about) { return textOf(of_kind, about); });
      checkOne(relations, of_kind);
    }
  }
}

}  // namespace sweep_guard_core::soundness
