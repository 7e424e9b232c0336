#include "soundness/cases.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <istream>
#include <map>
#include <sstream>

#include "guard/sweep_checker.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

std::string hex(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%a", value);
  return text.data();
}

template <typename Derived>
std::string hex(const Eigen::MatrixBase<Derived>& values) {
  std::string text;
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    for (Eigen::Index row = 0; row < values.rows(); ++row) text += ' ' + hex(values(row, column));
  }
  return text;
}

std::string hex(const Eigen::Isometry3d& pose) { return hex(pose.linear()) + hex(pose.translation()); }

std::string textOf(const std::string& word, const std::vector<Eigen::Vector3d>& corners) {
  std::string text;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) text += word;
    text += hex(corners[i]);
    if (i % 3 == 2) text += '\n';
  }
  return text;
}

std::string textOf(const Triangles& triangles) {
  return std::string(triangles.streamed ? "streamed\n" : "") + (triangles.welded ? "welded\n" : "") +
         textOf("triangle", triangles.corners_M) + textOf("before", triangles.before_M);
}

std::string textOf(const std::string& word, const Motion& motion) {
  return word + hex(motion.X_MT_start) + hex(motion.X_MT_end) + '\n';
}

constexpr std::array<const char*, 4> kKinds = {"cylinder", "sphere", "box", "hull"};

std::string textOf(const Body& body) {
  std::string text = std::string("body ") + kKinds[static_cast<size_t>(body.kind)] + ' ' + hex(body.radius) + ' ' +
                     hex(body.length) + ' ' + std::to_string(body.sides) + hex(body.half_extents) + hex(body.X_TS) +
                     ' ' + hex(body.padding) + ' ' + std::to_string(body.points.size());
  for (const Eigen::Vector3d& p : body.points) text += hex(p);
  return text + '\n';
}

// Reads the numbers of one line.
class Line {
 public:
  explicit Line(const std::string& line) : stream_(line) { stream_ >> word_; }

  const std::string& word() const { return word_; }
  std::string rest() {
    std::string text;
    std::getline(stream_ >> std::ws, text);
    return text;
  }
  std::string next() {
    std::string text;
    if (!(stream_ >> text)) throw InvalidInput("soundness case: a number is missing after '" + word_ + "'");
    return text;
  }
  double number() {
    const std::string text = next();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end != '\0') throw InvalidInput("soundness case: '" + text + "' is not a number");
    return value;
  }
  Eigen::Vector3d vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  Eigen::Isometry3d pose() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i) pose.linear().col(i) = vector();
    pose.translation() = vector();
    return pose;
  }
  Motion motion() {
    Motion motion;
    motion.X_MT_start = pose();
    motion.X_MT_end = pose();
    return motion;
  }
  Body body() {
    Body body;
    body.kind = kind();
    body.radius = number();
    body.length = number();
    body.sides = static_cast<int>(number());
    body.half_extents = vector();
    body.X_TS = pose();
    body.padding = number();
    for (double count = number(); count > 0.0; --count) body.points.push_back(vector());
    return withFacets(body);
  }

 private:
  Body::Kind kind() {
    const std::string name = next();
    const auto* const known = std::find(kKinds.begin(), kKinds.end(), name);
    if (known == kKinds.end()) throw InvalidInput("soundness case: body '" + name + "' is unknown");
    return static_cast<Body::Kind>(known - kKinds.begin());
  }

  std::istringstream stream_;
  std::string word_;
};

bool readTriangles(Line& line, Triangles& triangles) {
  if (line.word() == "streamed") {
    triangles.streamed = true;
  } else if (line.word() == "welded") {
    triangles.welded = true;
  } else if (line.word() == "before") {
    for (int i = 0; i < 3; ++i) triangles.before_M.push_back(line.vector());
  } else if (line.word() == "triangle") {
    for (int i = 0; i < 3; ++i) triangles.corners_M.push_back(line.vector());
  } else {
    return false;
  }
  return true;
}

void readPair(Line& line, PairCase& pair) {
  SweptVolume& volume = pair.swept_M;
  if (readTriangles(line, pair.triangles)) return;
  if (line.word() == "box") {
    volume.box.X_MB = line.pose();
    volume.box.half_extents = line.vector();
  } else if (line.word() == "inside") {
    volume.interior_B = line.vector();
    volume.margin = line.number();
  } else if (line.word() == "clip") {
    const Eigen::Vector3d normal = line.vector();
    volume.clips_B.emplace_back(normal, line.number());
  } else {
    throw InvalidInput("soundness case: '" + line.word() + "' is unknown in a pair");
  }
}

void readSweep(Line& line, SweepCase& sweep) {
  if (readTriangles(line, sweep.triangles)) return;
  if (line.word() == "body") {
    sweep.tool.push_back(line.body());
  } else if (line.word() == "motion") {
    sweep.motion = line.motion();
  } else if (line.word() == "deviation") {
    sweep.motion.deviation_bound = line.number();
  } else if (line.word() == "frame") {
    sweep.frame_W = line.motion();
  } else if (line.word() == "options") {
    sweep.options.volume = volumeKind(line.next());
    sweep.options.max_rotation = line.number();
    sweep.options.margin = line.number();
  } else if (line.word() == "contact") {
    const auto triangle = static_cast<std::uint32_t>(line.number());
    const double fraction = line.number();
    sweep.contacts.push_back({triangle, fraction, line.number()});
  } else {
    throw InvalidInput("soundness case: '" + line.word() + "' is unknown in a sweep");
  }
}

// Makes the mesh of one moment. Corners are welded if they are equal at the end of the motion.
TriangleMesh meshOf(const Triangles& all, const std::vector<Eigen::Vector3d>& corners) {
  std::map<std::array<double, 3>, std::uint32_t> known;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles(all.count());
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& p = all.corners_M[i];
    const auto next = static_cast<std::uint32_t>(vertices.size());
    const std::uint32_t vertex =
        all.welded ? known.emplace(std::array<double, 3>{p.x(), p.y(), p.z()}, next).first->second : next;
    if (vertex == next) vertices.push_back(corners[i]);
    triangles[i / 3][i % 3] = vertex;
  }
  TriangleMesh mesh(vertices, std::move(triangles));
  if (!all.streamed) return mesh;
  std::vector<float> positions;
  for (const Eigen::Vector3d& p : vertices) {
    const Eigen::Vector3f kept = p.cast<float>();
    positions.insert(positions.end(), kept.data(), kept.data() + 3);
  }
  return deformed(mesh, std::move(positions));
}

}  // namespace

TriangleMesh Triangles::mesh() const { return meshOf(*this, corners_M); }

TriangleMesh Triangles::meshBefore() const { return before_M.empty() ? mesh() : meshOf(*this, before_M); }

std::vector<Motion> SweepCase::subMotions() const {
  if (!frame_W && motion.deviation_bound == 0.0) return split(motion, options.max_rotation);
  return split(RelativeMotion{motion, frame_W.value_or(Motion{})}, options.max_rotation, toolOf(tool).boundingRadius());
}

SweepResult checkCase(Detector& detector, const SweepCase& sweep) {
  const TriangleMesh mesh_M = sweep.triangles.mesh();
  const TriangleMesh before_M = sweep.triangles.meshBefore();
  return checkSweep(detector,
                    {toolOf(sweep.tool), sweep.subMotions(),
                     MovingMesh(mesh_M, before_M, {before_M, mesh_M}, /*path_deviation=*/0.0), sweep.options});
}

std::vector<VolumeKind> volumeKinds() { return {VolumeKind::kObb, VolumeKind::kObbPlanes, VolumeKind::kHull}; }

std::string textOf(const PairCase& pair, const std::string& about) {
  const SweptVolume& volume = pair.swept_M;
  std::string text = "soundness-pair " + about + '\n';
  text += "box" + hex(volume.box.X_MB) + hex(volume.box.half_extents) + '\n';
  text += "inside" + hex(volume.interior_B) + ' ' + hex(volume.margin) + '\n';
  for (const HalfSpace& clip_B : volume.clips_B) {
    text += "clip" + hex(clip_B.normal()) + ' ' + hex(clip_B.offset()) + '\n';
  }
  return text + textOf(pair.triangles) + "end\n";
}

std::string textOf(const SweepCase& sweep, const std::string& about) {
  std::string text = "soundness-sweep " + about + '\n';
  for (const Body& body : sweep.tool) text += textOf(body);
  text += textOf("motion", sweep.motion);
  if (sweep.motion.deviation_bound > 0.0) text += "deviation " + hex(sweep.motion.deviation_bound) + '\n';
  if (sweep.frame_W) text += textOf("frame", *sweep.frame_W);
  text += "options " + nameOf(sweep.options.volume) + ' ' + hex(sweep.options.max_rotation) + ' ' +
          hex(sweep.options.margin) + '\n';
  text += textOf(sweep.triangles);
  for (const Contact& contact : sweep.contacts) {
    text += "contact " + std::to_string(contact.triangle) + ' ' + hex(contact.fraction) + ' ' +
            hex(contact.mesh_fraction) + '\n';
  }
  return text + "end\n";
}

std::optional<AnyCase> readCase(std::istream& stream) {
  AnyCase any;
  for (std::string text; std::getline(stream, text);) {
    Line line(text);
    const bool started = any.pair || any.sweep;
    if (started && line.word() == "end") return any;
    if (any.pair) {
      readPair(line, *any.pair);
    } else if (any.sweep) {
      readSweep(line, *any.sweep);
    } else if (line.word() == "soundness-pair") {
      any.pair.emplace();
      any.about = line.rest();
    } else if (line.word() == "soundness-sweep") {
      any.sweep.emplace();
      any.about = line.rest();
    }
  }
  if (any.pair || any.sweep) throw InvalidInput("soundness case: cut off before 'end'");
  return std::nullopt;
}

SweptVolume normalized(SweptVolume volume) {
  for (HalfSpace& clip_B : volume.clips_B) {
    for (int i = 0; i < 8; ++i) clip_B = HalfSpace(clip_B.normal(), clip_B.offset());
  }
  return volume;
}

}  // namespace sweep_guard_core::soundness
