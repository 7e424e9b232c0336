// Our own checks of mesh files, and what comes from the process that reads them with assimp. assimp itself is not fuzzed: it has
// a process of its own because files may crash it.
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "require.h"
#include "ros/tool/gltf_facets.h"
#include "ros/tool/mesh_answer.h"
#include "ros/tool/mesh_text.h"
#include "ros/tool/mesh_wire.h"
#include "ros/tool/ply_facets.h"
#include "ros/tool/stl_facets.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using sweep_guard_ros::Facet;
using sweep_guard_ros::StlFacet;

// Counts as a reader does that knows nothing but lines and words.
size_t linesThatBeginWith(const std::string& keyword, std::string text) {
  std::replace(text.begin(), text.end(), '\r', '\n');
  std::replace(text.begin(), text.end(), '\0', ' ');
  std::istringstream lines(text);
  size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first == keyword) ++count;
  }
  return count;
}

void checkText(std::string text, const std::string& format) {
  const std::string before = text;
  sweep_guard_ros::simplify(text, format);
  require(text.size() == before.size() || text.size() + 3 == before.size(), "only a byte order mark is removed");
  require(format != "dae" || text == before, "a DAE stays as it is");
  bool readable = true;
  try {
    sweep_guard_ros::requireReadable(text, format);
  } catch (const std::runtime_error&) {
    readable = false;
  }
  if (readable && format == "obj") {
    require(linesThatBeginWith("mtllib", text) + linesThatBeginWith("usemtl", text) == 0, "no material is left");
  }
  const size_t faces = sweep_guard_ros::expectedFaces(text, format);
  if (format == "obj") require(faces == linesThatBeginWith("f", text), "each face of an OBJ counts");
}

template <typename Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string written(const sweep_guard_ros::MeshSurface& surface) {
  std::string bytes;
  append(bytes, sweep_guard_ros::MeshWireHeader{static_cast<std::uint32_t>(surface.vertices.size()),
                                                static_cast<std::uint32_t>(surface.triangles.size())});
  for (const Eigen::Vector3d& vertex : surface.vertices) {
    for (const double coordinate : {vertex.x(), vertex.y(), vertex.z()}) append(bytes, coordinate);
  }
  for (const sweep_guard_core::Triangle& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle) append(bytes, corner);
  }
  return bytes;
}

std::string binaryStl(const std::vector<StlFacet>& facets) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(facets.size()));
  for (const StlFacet& facet : facets) {
    bytes.append(12, '\0');
    append(bytes, facet);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string binaryPly(const std::vector<Facet>& facets) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(3 * facets.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(facets.size()) + "\nproperty list uchar uint vertex_index\nend_header\n";
  for (const Facet& facet : facets) append(bytes, facet);
  for (std::uint32_t corner = 0; corner < 3 * facets.size(); ++corner) {
    if (corner % 3 == 0) bytes += '\3';
    append(bytes, corner);
  }
  return bytes;
}

// Empty: it is refused.
template <typename Read>
auto triangles(const std::string& bytes, const Read& read) {
  decltype(read(bytes)) facets;
  try {
    facets = read(bytes);
  } catch (const std::runtime_error& error) {
    require(std::strlen(error.what()) < 200, "a refusal is short");
  }
  return facets;
}

template <typename Facets>
void requireEqual(const Facets& again, const Facets& facets) {
  require(again.size() == facets.size(), "no triangle is lost or made up");
  require(facets.empty() || std::memcmp(again.data(), facets.data(), facets.size() * sizeof(facets[0])) == 0,
          "corners stay as they are");
}

void checkStl(const std::string& bytes) {
  const auto facets = triangles(bytes, sweep_guard_ros::readStlFacets);
  requireEqual(sweep_guard_ros::readStlFacets(binaryStl(facets)), facets);
}

void checkPly(const std::string& bytes) {
  const auto facets = triangles(bytes, sweep_guard_ros::readPlyFacets);
  if (!facets.empty()) requireEqual(sweep_guard_ros::readPlyFacets(binaryPly(facets)), facets);
}

void checkGltf(const std::string& bytes) {
  require(triangles(bytes, sweep_guard_ros::readGltfFacets).size() <= sweep_guard_ros::kMaxMeshTriangles,
          "there are at most a million triangles");
}

void checkAnswer(const std::string& answer) {
  const auto surface = sweep_guard_ros::surfaceFrom(answer);
  if (!surface) return;
  require(!surface->triangles.empty(), "a surface has triangles");
  for (const Eigen::Vector3d& vertex : surface->vertices) require(vertex.allFinite(), "vertices are finite");
  for (const sweep_guard_core::Triangle& triangle : surface->triangles) {
    for (const std::uint32_t corner : triangle) require(corner < surface->vertices.size(), "corners are vertices");
  }
  require(written(*surface) == answer, "nothing of an answer is lost");
}

// The first byte chooses what the others are.
const Target kMeshFiles("mesh_files", [](Input input) {
  const int what = input.byte();
  const std::string rest = input.rest();
  if (what == 'o') checkText(rest, "obj");
  if (what == 's') checkStl(rest);
  if (what == 'd') checkText(rest, "dae");
  if (what == 'p') checkPly(rest);
  if (what == 'g') checkGltf(rest);
  if (what == 'a') checkAnswer(rest);
});

}  // namespace
}  // namespace sweep_guard_fuzz
