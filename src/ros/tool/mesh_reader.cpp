// Reads a mesh file for the guard in a separate process, because assimp crashes on some broken files. It reads OBJ and DAE.
#include <assimp/config.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>

#include <Eigen/Dense>
#include <array>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ros/tool/gltf_facets.h"
#include "ros/tool/mesh_text.h"
#include "ros/tool/mesh_wire.h"
#include "ros/tool/ply_facets.h"
#include "ros/tool/singular_transform.h"
#include "ros/tool/stl_facets.h"

namespace {

using sweep_guard_ros::kMaxMeshTriangles;
using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr rlim_t kMemory = rlim_t{1} << 30U;  // [byte]
constexpr rlim_t kProcessorTime = 10;         // [s]
constexpr int kMaxNodeDepth = 100;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // reserves terabytes of addresses, and opens files to report
#else
constexpr bool kSanitized = false;
#endif

void limit(__rlimit_resource resource, rlim_t value) {
  const rlimit both{value, value};
  if (setrlimit(resource, &both) != 0) throw std::runtime_error("mesh_reader cannot limit its resources");
}

// close_range needs glibc 2.34.
void closeInheritedFiles() {
  std::vector<int> files;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    files.push_back(std::stoi(entry.path().filename()));
  }
  for (const int file : files) {
    if (file > STDERR_FILENO) close(file);
  }
}

// Afterwards no file can be opened: a mesh may name any other file.
void confine() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  closeInheritedFiles();
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kProcessorTime);
  if (kSanitized) return;
  limit(RLIMIT_NOFILE, 0);
  limit(RLIMIT_AS, kMemory);
}

struct FileSurface {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
  size_t faces = 0;
  size_t polygons = 0;  // faces with at least three corners
  bool solid = false;   // a polygon has three different corners

  std::uint32_t add(const Point& point) {
    const auto [known, is_new] = index_.try_emplace(point, static_cast<std::uint32_t>(vertices.size()));
    if (is_new) vertices.push_back(point);
    return known->second;
  }

 private:
  std::map<Point, std::uint32_t> index_;
};

Point transformed(const aiMatrix4x4& X, const aiVector3D& p) {
  const auto x = static_cast<double>(p.x);
  const auto y = static_cast<double>(p.y);
  const auto z = static_cast<double>(p.z);
  const auto row = [&](ai_real a, ai_real b, ai_real c, ai_real d) {
    return static_cast<double>(a) * x + static_cast<double>(b) * y + static_cast<double>(c) * z +
           static_cast<double>(d);
  };
  return {row(X.a1, X.a2, X.a3, X.a4), row(X.b1, X.b2, X.b3, X.b4), row(X.c1, X.c2, X.c3, X.c4)};
}

bool finite(const Point& point) {
  for (const double coordinate : point) {
    if (!(coordinate > -1e30 && coordinate < 1e30)) return false;
  }
  return true;
}

std::uint32_t addVertex(const Point& point, FileSurface& surface) {
  if (!finite(point)) throw std::runtime_error("a vertex is NaN or infinite");
  return surface.add(point);
}

// A fan covers a polygon, even a concave one. Points and edges become triangles without area.
void addPolygon(std::vector<std::uint32_t> corners, FileSurface& surface) {
  ++surface.faces;
  if (corners.size() >= 3) ++surface.polygons;
  surface.solid = surface.solid || std::set<std::uint32_t>(corners.begin(), corners.end()).size() >= 3;
  while (corners.size() < 3) corners.push_back(corners.back());
  for (size_t i = 2; i < corners.size(); ++i) surface.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  if (surface.triangles.size() > kMaxMeshTriangles) throw std::runtime_error("more than a million triangles");
}

void addFace(const aiFace& face, const std::vector<std::uint32_t>& vertex, FileSurface& surface) {
  if (face.mNumIndices == 0) return;
  std::vector<std::uint32_t> corners;
  for (unsigned i = 0; i < face.mNumIndices; ++i) {
    if (face.mIndices[i] >= vertex.size()) throw std::runtime_error("a face names a missing vertex");
    corners.push_back(vertex[face.mIndices[i]]);
  }
  addPolygon(std::move(corners), surface);
}

void addMesh(const aiMesh& mesh, const aiMatrix4x4& X, FileSurface& surface) {
  std::vector<std::uint32_t> vertex;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    vertex.push_back(addVertex(transformed(X, mesh.mVertices[i]), surface));
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) addFace(mesh.mFaces[i], vertex, surface);
}

Eigen::Matrix3d linearOf(const aiMatrix4x4& X) {
  Eigen::Matrix3d linear;
  linear << X.a1, X.a2, X.a3, X.b1, X.b2, X.b3, X.c1, X.c2, X.c3;
  return linear;
}

void addNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_parent, int depth, FileSurface& surface) {
  if (depth > kMaxNodeDepth) throw std::runtime_error("nodes are nested too deeply");
  const aiMatrix4x4 X = X_parent * node.mTransformation;
  if (node.mNumMeshes > 0 && sweep_guard_ros::isSingular(linearOf(X)))
    throw std::runtime_error("a transform is singular");
  for (unsigned i = 0; i < node.mNumMeshes; ++i) addMesh(*scene.mMeshes[node.mMeshes[i]], X, surface);
  for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(scene, *node.mChildren[i], X, depth + 1, surface);
}

// assimp only warns of some omissions; most warnings are about materials. Its logger also skips lines that are repeated.
bool isOmission(const std::string& message) {
  if (message.find("lines with the same contents") != std::string::npos) return false;
  return message.rfind("Warn", 0) != 0 || message.find("Skipping") != std::string::npos;
}

// assimp continues after an error and omits what it did not understand, but no part of a tool may be lost.
class FirstError : public Assimp::LogStream {
 public:
  explicit FirstError(std::string& text) : text_(text) {}
  void write(const char* message) override {
    if (text_.empty() && isOmission(message)) text_ = message;
  }

 private:
  std::string& text_;
};

void requireSolid(const FileSurface& surface) {
  if (surface.polygons == 0) throw std::runtime_error("no triangles");
  if (!surface.solid) throw std::runtime_error("all triangles are points or lines");
}

void requireComplete(const std::string& bytes, const std::string& format, const FileSurface& surface) {
  requireSolid(surface);
  const size_t expected = sweep_guard_ros::expectedFaces(bytes, format);
  if (surface.faces < expected) {
    throw std::runtime_error("only " + std::to_string(surface.faces) + " of " + std::to_string(expected) +
                             " faces can be read");
  }
}

// Removes assimp's log prefix.
std::string plain(std::string text) {
  for (const std::string& noise : {std::string("Error, T0: "), std::string("Warn,  T0: ")}) {
    const size_t at = text.find(noise);
    if (at != std::string::npos) text.erase(at, noise.size());
  }
  return text;
}

template <typename Facets>
FileSurface surfaceOf(const Facets& facets) {
  FileSurface surface;
  for (const auto& facet : facets) {
    std::vector<std::uint32_t> corners;
    corners.reserve(facet.size());
    for (const auto& [x, y, z] : facet) corners.push_back(addVertex({x, y, z}, surface));
    addPolygon(std::move(corners), surface);
  }
  requireSolid(surface);
  return surface;
}

FileSurface readWithAssimp(std::string bytes, const std::string& format) {
  sweep_guard_ros::simplify(bytes, format);
  std::string error;
  Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(new FirstError(error), Assimp::Logger::Err | Assimp::Logger::Warn);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // keeps the axes, as rviz does
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);           // keeps a file without a mesh empty
  const aiScene* const scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) throw std::runtime_error(plain(importer.GetErrorString()));
  if (!error.empty()) throw std::runtime_error(plain(error));
  sweep_guard_ros::requireReadable(bytes, format);
  FileSurface surface;
  addNode(*scene, *scene->mRootNode, aiMatrix4x4(), 0, surface);
  requireComplete(bytes, format, surface);
  return surface;
}

FileSurface read(const std::string& bytes, const std::string& format) {
  if (bytes.empty()) throw std::runtime_error("file is empty");
  if (bytes.compare(0, 19, "version https://git") == 0) {
    throw std::runtime_error("file is a git-lfs pointer, not the mesh: run git lfs pull");
  }
  if (format == "stl") return surfaceOf(sweep_guard_ros::readStlFacets(bytes));
  if (format == "ply") return surfaceOf(sweep_guard_ros::readPlyFacets(bytes));
  if (format == "gltf" || format == "glb") return surfaceOf(sweep_guard_ros::readGltfFacets(bytes));
  return readWithAssimp(bytes, format);
}

template <typename Value>
void write(const std::vector<Value>& values) {
  std::cout.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

void write(const FileSurface& surface) {
  write(std::vector<sweep_guard_ros::MeshWireHeader>{
      {static_cast<std::uint32_t>(surface.vertices.size()), static_cast<std::uint32_t>(surface.triangles.size())}});
  write(surface.vertices);
  write(surface.triangles);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: mesh_reader stl|obj|dae|ply|gltf|glb <FILE\n";
    return 2;
  }
  try {
    confine();
    write(read({std::istreambuf_iterator<char>(std::cin), {}}, argv[1]));
    std::cout.flush();
    return std::cout ? 0 : 2;
  } catch (const std::bad_alloc&) {
    std::cout << "reading takes more than 1 GiB of memory";
  } catch (const std::exception& error) {
    std::cout << error.what();
  }
  std::cout.flush();
  return 1;
}
