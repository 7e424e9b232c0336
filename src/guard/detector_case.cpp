#include "guard/detector_case.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <system_error>

#include "common/xyz.h"
#include "guard/triangle_set.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr std::uintmax_t kMinTriangleText = 24;  // [bytes], with its share of the vertices
const std::string kTitle = "sweep_guard detector case 1";

void write(const Eigen::Vector3d& p, std::ostream& stream) { stream << p.x() << ' ' << p.y() << ' ' << p.z() << '\n'; }

// Reads keys and their values, one after the other.
class CaseReader {
 public:
  explicit CaseReader(std::istream& stream) : stream_(stream) { stream_.imbue(std::locale::classic()); }

  std::string line(const std::string& key) {
    expect(key);
    std::string text;
    std::getline(stream_ >> std::ws, text);
    return text;
  }

  template <typename Value>
  Value value() {
    Value value{};
    if (!(stream_ >> value)) throw InvalidInput("not a detector case: a number is missing after '" + key_ + "'");
    return value;
  }

  Eigen::Vector3d vector() {
    const auto x = value<double>();
    const auto y = value<double>();
    return {x, y, value<double>()};
  }

  size_t count(const std::string& key) {
    expect(key);
    const auto count = value<std::uint32_t>();
    return count;
  }

  void expect(const std::string& key) {
    std::string found;
    key_ = key;
    if (!(stream_ >> found) || found != key) throw InvalidInput("not a detector case: '" + key + "' is missing");
  }

 private:
  std::istream& stream_;
  std::string key_;
};

SweptVolume readVolume(CaseReader& read) {
  SweptVolume volume;
  read.expect("axes");
  for (int i = 0; i < 3; ++i) volume.box.X_MB.linear().col(i) = read.vector();
  read.expect("center");
  volume.box.X_MB.translation() = read.vector();
  read.expect("half_extents");
  volume.box.half_extents = read.vector();
  read.expect("interior");
  volume.interior_B = read.vector();
  read.expect("margin");
  volume.margin = read.value<double>();
  for (size_t left = std::min(read.count("clips"), kMaxClips); left > 0; --left) {
    const Eigen::Vector3d normal = read.vector();
    volume.clips_B.push_back(HalfSpace(normal, read.value<double>()));
  }
  return volume;
}

void write(const SweptVolume& volume, std::ostream& stream) {
  stream << "axes\n";
  for (int i = 0; i < 3; ++i) write(Eigen::Vector3d(volume.box.X_MB.linear().col(i)), stream);
  stream << "center ";
  write(Eigen::Vector3d(volume.box.X_MB.translation()), stream);
  stream << "half_extents ";
  write(volume.box.half_extents, stream);
  stream << "interior ";
  write(volume.interior_B, stream);
  stream << "margin " << volume.margin << "\nclips " << volume.clips_B.size() << '\n';
  for (const HalfSpace& clip_B : volume.clips_B) {
    write(clip_B.normal(), stream);
    stream << clip_B.offset() << '\n';
  }
}

TriangleMesh readMesh(CaseReader& read, TriangleSet& numbers) {
  std::vector<float> positions;
  std::vector<Eigen::Vector3d> vertices;
  for (size_t left = read.count("vertices"); left > 0; --left) {
    vertices.push_back(read.vector());
    for (const double x : xyz(vertices.back())) positions.push_back(static_cast<float>(x));
  }
  std::vector<Triangle> triangles;
  for (size_t left = read.count("triangles"); left > 0; --left) {
    triangles.emplace_back();
    for (std::uint32_t& vertex : triangles.back()) vertex = read.value<std::uint32_t>();
    numbers.push_back(read.value<std::uint32_t>());
  }
  TriangleMesh mesh_M(vertices, std::move(triangles));
  mesh_M.deform(positions);  // moves the origin to that of M, where the positions are exact
  return mesh_M;
}

TriangleMesh submeshOf(const TriangleMesh& mesh_M, const TriangleSet& numbers) {
  std::map<std::uint32_t, std::uint32_t> new_index;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<float> positions;
  std::vector<Triangle> triangles;
  for (const std::uint32_t number : numbers) {
    Triangle triangle = mesh_M.triangles()[number];
    for (std::uint32_t& vertex : triangle) {
      const auto [entry, is_new] = new_index.emplace(vertex, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(mesh_M.offset(vertex));
      vertex = entry->second;
    }
    triangles.push_back(triangle);
  }
  for (const Eigen::Vector3d& vertex : vertices) {
    for (const double x : xyz(vertex)) positions.push_back(static_cast<float>(x));
  }
  TriangleMesh submesh(vertices, std::move(triangles));
  submesh.deform(positions);
  return submesh;
}

std::uintmax_t sizeOf(const std::filesystem::path& folder) {
  std::uintmax_t size = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) size += entry.file_size();
  }
  return size;
}

size_t testedCount(const SampledQuery& query) {
  if (query.whole) return query.workpiece->mesh_M.triangles().size();
  size_t count = 0;
  for (const Cluster& cluster : query.clusters) count += cluster.count;
  return count;
}

std::filesystem::path unusedName(const std::filesystem::path& folder) {
  for (int i = 1;; ++i) {
    std::filesystem::path file = folder / ("detector_case_" + std::to_string(i) + ".txt");
    if (!std::filesystem::exists(file)) return file;
  }
}

std::string saveIn(const std::filesystem::path& folder, const std::string& content) {
  const std::filesystem::path file = unusedName(folder);
  std::ofstream stream(file, std::ios::binary);
  if ((stream << content).flush()) return "saved as " + file.string();
  stream.close();
  std::filesystem::remove(file);
  return "not saved: cannot write " + file.string();
}

}  // namespace

DetectorCase caseOf(const SampledQuery& query, const std::string& other) {
  const TriangleMesh& mesh_M = query.workpiece->mesh_M;
  TriangleSet numbers = testedTriangles(query);
  unite(numbers, query.found.triangles);
  DetectorCase saved{query.workpiece->id, query.detector, other, submeshOf(mesh_M, numbers), numbers,
                     query.swept_M,       query.found};
  saved.swept_M.box.X_MB.translation() -= mesh_M.origin();
  for (std::uint32_t& triangle : saved.found.triangles) {
    const auto place = std::lower_bound(numbers.begin(), numbers.end(), triangle);
    triangle = static_cast<std::uint32_t>(place - numbers.begin());
  }
  return saved;
}

SampledQuery queryOf(const DetectorCase& saved) {
  SampledQuery query;
  query.detector = saved.detector;
  Workpiece workpiece{saved.mesh_id, 0, {}, {}, "", saved.mesh_M};
  query.workpiece = std::make_shared<const Workpiece>(std::move(workpiece));
  query.swept_M = saved.swept_M;
  query.found = saved.found;
  return query;
}

void write(const DetectorCase& saved, std::ostream& stream) {
  stream.imbue(std::locale::classic());
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << kTitle << "\nworkpiece " << saved.mesh_id << "\ndetector " << saved.detector << "\nother " << saved.other
         << '\n';
  write(saved.swept_M, stream);
  stream << "vertices " << saved.mesh_M.vertexCount() << '\n';
  for (size_t i = 0; i < saved.mesh_M.vertexCount(); ++i) write(saved.mesh_M.offset(i), stream);
  stream << "triangles " << saved.numbers.size() << '\n';
  for (size_t i = 0; i < saved.numbers.size(); ++i) {
    for (const std::uint32_t vertex : saved.mesh_M.triangles()[i]) stream << vertex << ' ';
    stream << saved.numbers[i] << '\n';
  }
  stream << "inflation " << saved.found.inflation << "\nfound " << saved.found.triangles.size() << '\n';
  for (const std::uint32_t triangle : saved.found.triangles) stream << triangle << '\n';
}

DetectorCase readDetectorCase(std::istream& stream) {
  std::string title;
  std::getline(stream, title);
  if (title != kTitle) throw InvalidInput("not a detector case: the first line is not '" + kTitle + "'");
  CaseReader read(stream);
  const std::string mesh_id = read.line("workpiece");
  const std::string detector = read.line("detector");
  const std::string other = read.line("other");
  const SweptVolume volume = readVolume(read);
  TriangleSet numbers;
  TriangleMesh mesh_M = readMesh(read, numbers);
  Detection found;
  read.expect("inflation");
  found.inflation = read.value<double>();
  for (size_t left = read.count("found"); left > 0; --left) found.triangles.push_back(read.value<std::uint32_t>());
  return {mesh_id, detector, other, std::move(mesh_M), std::move(numbers), volume, std::move(found)};
}

std::string save(const SampledQuery& query, const std::string& other, const std::filesystem::path& folder,
                 std::uintmax_t max_folder) {
  try {
    std::filesystem::create_directories(folder);
    const std::uintmax_t before = sizeOf(folder);
    std::string full = "not saved: " + folder.string() + " would exceed " + std::to_string(max_folder >> 20U) + " MiB";
    if (before + kMinTriangleText * testedCount(query) > max_folder) return full;
    std::ostringstream text;
    write(caseOf(query, other), text);
    const std::string content = text.str();
    return before + content.size() > max_folder ? full : saveIn(folder, content);
  } catch (const std::filesystem::filesystem_error& error) {
    return std::string("not saved: ") + error.what();
  }
}

}  // namespace sweep_guard_core
