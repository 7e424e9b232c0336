#include "ros/tool/gltf_facets.h"

#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // the JSON parser prints a note otherwise

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "ros/tool/mesh_wire.h"
#include "ros/tool/singular_transform.h"

namespace sweep_guard_ros {
namespace {

using boost::property_tree::ptree;
using std::string_view;

constexpr size_t kMaxGltfNumber = 0x7FFFFFFF;
constexpr int kMaxGltfDepth = 100;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr size_t kFloat = 5126;
constexpr size_t kVertexSize = 3 * sizeof(float);

enum GltfMode : size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

struct GltfChunks {
  std::string json;
  std::optional<std::string> binary;
};

using Corner = Facet::value_type;

// Of an accessor.
struct GltfElements {
  const char* begin;
  size_t count;
  size_t stride;  // [byte]
};

[[noreturn]] void refuseGltf(const std::string& reason) { throw std::runtime_error(reason); }

[[noreturn]] void refuseVersion(const std::string& version) {
  refuseGltf("glTF " + version + " is not supported: export it as glTF 2.0");
}

[[noreturn]] void refuseExtension(const std::string& name) {
  refuseGltf("extension " + name.substr(0, 60) + " is not supported: export it without");
}

// A binary file is a header of three numbers, then chunks: length, kind, bytes.
GltfChunks gltfChunks(const std::string& bytes) {
  if (bytes.compare(0, 4, "glTF") != 0) return {bytes, {}};
  const auto number = [&](size_t at) {
    size_t value = 0;
    if (at + 4 > bytes.size()) refuseGltf("the file is cut off");
    std::memcpy(&value, &bytes[at], 4);
    return value;
  };
  if (number(4) != 2) refuseVersion(std::to_string(number(4)));
  const size_t end = number(8);
  GltfChunks chunks;
  for (size_t at = 12; at < end; at += 8 + number(at)) {
    if (number(at) + at + 8 > std::min(end, bytes.size())) refuseGltf("the file is cut off");
    if (number(at + 4) == kJsonChunk) chunks.json = bytes.substr(at + 8, number(at));
    if (number(at + 4) == kBinaryChunk) chunks.binary = bytes.substr(at + 8, number(at));
  }
  return chunks;
}

ptree parsedJson(const std::string& json) {
  ptree tree;
  std::istringstream stream(json);
  try {
    boost::property_tree::read_json(stream, tree);
  } catch (const boost::property_tree::json_parser_error& error) {
    refuseGltf("not JSON: line " + std::to_string(error.line()) + ": " + error.message());
  }
  return tree;
}

std::string decodedBase64(string_view text) {
  constexpr string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  size_t bits = 0;
  unsigned waiting = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const size_t digit = kDigits.find(c);
    if (digit == string_view::npos) refuseGltf("a buffer is not base64");
    bits = (bits << 6U | digit) & 0xFFFFU;
    waiting += 6;
    if (waiting < 8) continue;
    waiting -= 8;
    bytes += static_cast<char>(bits >> waiting & 0xFFU);
  }
  return bytes;
}

std::string embeddedBytes(const std::string& uri) {
  if (uri.rfind("data:", 0) != 0) {
    refuseGltf("the file names another file, " + uri.substr(0, 60) + ": export it as .glb");
  }
  const size_t begin = uri.find(";base64,");
  if (begin == std::string::npos) refuseGltf("a buffer is not base64");
  return decodedBase64(string_view(uri).substr(begin + 8));
}

const ptree& member(const ptree& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.not_found()) refuseGltf(std::string("'") + name + "' is missing");
  return found->second;
}

size_t wholeNumber(const ptree& value) {
  const std::string& text = value.data();
  const bool digits = !text.empty() && text.size() <= 10 && text.find_first_not_of("0123456789") == std::string::npos;
  const size_t number = digits ? std::strtoull(text.c_str(), nullptr, 10) : kMaxGltfNumber + 1;
  if (number > kMaxGltfNumber) refuseGltf("'" + text.substr(0, 40) + "' is not a whole number from 0 to 2147483647");
  return number;
}

std::optional<size_t> optionalNumber(const ptree& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.not_found()) return {};
  return wholeNumber(found->second);
}

size_t numberOf(const ptree& object, const char* name) { return wholeNumber(member(object, name)); }

// Empty: there is no such member.
std::vector<double> realNumbers(const ptree& object, const char* name, size_t count) {
  std::vector<double> numbers;
  const auto found = object.find(name);
  if (found == object.not_found()) return numbers;
  char* end = nullptr;
  for (const auto& [key, value] : found->second) {
    numbers.push_back(std::strtod(value.data().c_str(), &end));
    if (*end != '\0' || value.data().empty()) refuseGltf(std::string("'") + name + "' has no number");
  }
  if (numbers.size() != count) refuseGltf(std::string("'") + name + "' has not " + std::to_string(count) + " numbers");
  return numbers;
}

Eigen::Affine3d transformOf(const ptree& node) {
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  if (const auto matrix = realNumbers(node, "matrix", 16); !matrix.empty()) {
    X.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix.data());
    return X;
  }
  if (const auto t = realNumbers(node, "translation", 3); !t.empty()) X.translate(Eigen::Vector3d(t.data()));
  if (const auto r = realNumbers(node, "rotation", 4); !r.empty()) {
    const Eigen::Quaterniond rotation(r.data());
    if (!(std::abs(rotation.norm() - 1.0) < 0.01)) refuseGltf("a rotation is not a unit quaternion");
    X.rotate(rotation.normalized());
  }
  if (const auto s = realNumbers(node, "scale", 3); !s.empty()) X.scale(Eigen::Vector3d(s.data()));
  return X;
}

// What only changes how a surface looks.
bool isOfAppearance(const std::string& extension) {
  for (const char* const start : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"}) {
    if (extension.rfind(start, 0) == 0) return true;
  }
  return false;
}

class GltfFile {
 public:
  explicit GltfFile(const std::string& bytes) {
    GltfChunks chunks = gltfChunks(bytes);
    root_ = parsedJson(chunks.json);
    for (const auto& [name, array] : root_) {
      for (const auto& [key, item] : array) items_[name].push_back(&item);
    }
    requireSupported();
    for (const ptree* const buffer : items_["buffers"]) {
      buffers_.push_back(bytesOf(*buffer, buffers_.empty() ? chunks.binary : std::nullopt));
    }
  }

  std::vector<Facet> read() {
    const size_t scene = optionalNumber(root_, "scene").value_or(0);
    for (const auto& [key, node] : member(item("scenes", scene), "nodes"))
      addNode(wholeNumber(node), Eigen::Affine3d::Identity(), 0);
    return std::move(facets_);
  }

 private:
  const ptree& item(const char* array, size_t index) {
    const std::vector<const ptree*>& items = items_[array];
    if (index >= items.size()) refuseGltf(std::string("'") + array + "' has no number " + std::to_string(index));
    return *items[index];
  }

  void requireSupported() {
    const std::string version = member(member(root_, "asset"), "version").data().substr(0, 40);
    if (version.rfind("2.", 0) != 0) refuseVersion(version);
    for (const ptree* const extension : items_["extensionsRequired"]) {
      if (!isOfAppearance(extension->data())) refuseExtension(extension->data());
    }
    for (const ptree* const extension : items_["extensionsUsed"]) {
      if (extension->data() == "EXT_mesh_gpu_instancing") refuseExtension(extension->data());
    }
  }

  static std::string bytesOf(const ptree& buffer, const std::optional<std::string>& binary) {
    const size_t size = numberOf(buffer, "byteLength");
    const auto uri = buffer.find("uri");
    if (uri == buffer.not_found() && !binary) refuseGltf("a buffer has no data");
    std::string bytes = uri == buffer.not_found() ? *binary : embeddedBytes(uri->second.data());
    if (bytes.size() < size) refuseGltf("a buffer is cut off");
    bytes.resize(size);
    return bytes;
  }

  // Returns where its elements are, of so many bytes each.
  GltfElements elementsOf(const ptree& accessor, size_t size) {
    if (accessor.count("sparse") != 0) refuseGltf("sparse accessors are not supported");
    const ptree& view = item("bufferViews", numberOf(accessor, "bufferView"));
    const size_t buffer = numberOf(view, "buffer");
    if (buffer >= buffers_.size()) refuseGltf("'buffers' has no number " + std::to_string(buffer));
    const size_t view_begin = optionalNumber(view, "byteOffset").value_or(0);
    const size_t view_end = view_begin + numberOf(view, "byteLength");
    const size_t begin = view_begin + optionalNumber(accessor, "byteOffset").value_or(0);
    const size_t stride = optionalNumber(view, "byteStride").value_or(size);
    const size_t count = numberOf(accessor, "count");
    const bool inside = view_end <= buffers_[buffer].size() && count > 0 && stride >= size &&
                        begin + (count - 1) * stride + size <= view_end;
    if (!inside) refuseGltf("an accessor leads out of its buffer");
    return {&buffers_[buffer][begin], count, stride};
  }

  std::vector<size_t> indicesIn(const ptree& accessor) {
    static const std::map<size_t, size_t> kSizes = {{5121, 1}, {5123, 2}, {5125, 4}};  // [byte], by type
    const auto size = kSizes.find(numberOf(accessor, "componentType"));
    if (size == kSizes.end()) refuseGltf("indices are of an unknown type");
    const GltfElements elements = elementsOf(accessor, size->second);
    std::vector<size_t> indices(elements.count, 0);
    for (size_t i = 0; i < indices.size(); ++i)
      std::memcpy(&indices[i], elements.begin + i * elements.stride, size->second);
    return indices;
  }

  // Returns one for each index, or else for each vertex.
  std::vector<Corner> cornersOf(const ptree& primitive, const Eigen::Affine3d& X) {
    const ptree& accessor = item("accessors", numberOf(member(primitive, "attributes"), "POSITION"));
    if (numberOf(accessor, "componentType") != kFloat || member(accessor, "type").data() != "VEC3") {
      refuseGltf("vertices are not three float32 each");
    }
    const GltfElements vertices = elementsOf(accessor, kVertexSize);
    std::vector<size_t> indices(vertices.count);
    std::iota(indices.begin(), indices.end(), size_t{0});
    if (const auto listed = optionalNumber(primitive, "indices")) indices = indicesIn(item("accessors", *listed));
    std::vector<Corner> corners;
    for (const size_t index : indices) {
      if (index >= vertices.count) refuseGltf("a face names a missing vertex");
      Eigen::Vector3f position;
      std::memcpy(position.data(), vertices.begin + index * vertices.stride, kVertexSize);
      const Eigen::Vector3d p = X * position.cast<double>();
      corners.push_back({p.x(), p.y(), p.z()});
    }
    return corners;
  }

  void addPrimitive(const ptree& primitive, const Eigen::Affine3d& X) {
    const size_t mode = optionalNumber(primitive, "mode").value_or(kTriangles);
    if (mode < kTriangles) return;  // points and lines
    if (mode > kFan) refuseGltf("mode " + std::to_string(mode) + " is not supported");
    if (primitive.count("targets") != 0)
      refuseGltf("morph targets are not supported: export the mesh in its final shape");
    const std::vector<Corner> corners = cornersOf(primitive, X);
    if (mode == kTriangles && corners.size() % 3 != 0) refuseGltf("corners are left over from triangles");
    for (size_t i = 0; i + 2 < corners.size(); i += mode == kTriangles ? 3 : 1) {
      if (facets_.size() == kMaxMeshTriangles) refuseGltf("more than a million triangles");
      const size_t turned = mode == kStrip ? i % 2 : 0;
      facets_.push_back({corners[mode == kFan ? 0 : i + turned], corners[i + 1 - turned], corners[i + 2]});
    }
  }

  void addNode(size_t index, const Eigen::Affine3d& X_parent, int depth) {
    if (!visited_.insert(index).second) refuseGltf("node " + std::to_string(index) + " is named twice");
    if (depth > kMaxGltfDepth) refuseGltf("nodes are nested too deeply");
    const ptree& node = item("nodes", index);
    const Eigen::Affine3d X = X_parent * transformOf(node);
    if (const auto mesh = optionalNumber(node, "mesh")) {
      if (node.count("skin") != 0) refuseGltf("skins are not supported: export the mesh in its final shape");
      if (isSingular(X.linear())) refuseGltf("a transform is singular");
      for (const auto& [key, primitive] : member(item("meshes", *mesh), "primitives")) addPrimitive(primitive, X);
    }
    const auto children = node.find("children");
    if (children == node.not_found()) return;
    for (const auto& [key, child] : children->second) addNode(wholeNumber(child), X, depth + 1);
  }

  ptree root_;
  std::map<std::string, std::vector<const ptree*>> items_;  // of the arrays in it
  std::vector<std::string> buffers_;
  std::set<size_t> visited_;
  std::vector<Facet> facets_;
};

}  // namespace

std::vector<Facet> readGltfFacets(const std::string& bytes) { return GltfFile(bytes).read(); }

}  // namespace sweep_guard_ros
