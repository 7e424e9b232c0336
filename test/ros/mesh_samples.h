#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace sweep_guard_ros {

/// Returns the text with the first `part` replaced; without such a part it stays.
inline std::string withPart(std::string text, const std::string& part, const std::string& by) {
  const size_t at = text.find(part);
  return at == std::string::npos ? text : text.replace(at, part.size(), by);
}

/// Corners of a tetrahedron, at the origin and at 1 on each axis, and those of its faces.
constexpr std::array<float, 12> kTetrahedronCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr std::array<std::uint16_t, 12> kTetrahedronFaces = {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3};

/// Returns it as a text PLY.
inline std::string tetrahedronPly() {
  return "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
         "z\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n";
}

/// Returns it as a text glTF: four vertices, three float32 each, and twelve indices of 16 bits.
inline std::string tetrahedronGltf() {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAABAAIAAAABAAMAAAACAAMAAQACAAMA"}]})";
}

/// Returns it as a binary glTF.
inline std::string tetrahedronGlb() {
  const std::string gltf = tetrahedronGltf();
  const size_t uri = gltf.find(", \"uri\"");
  const std::string json = gltf.substr(0, uri) + "}]}" + std::string((1 - uri) % 4, ' ');
  std::string bytes = "glTF";
  const auto append = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto json_size = static_cast<std::uint32_t>(json.size());
  append(std::array<std::uint32_t, 4>{2, 28 + json_size + 72, json_size, 0x4E4F534A});
  bytes += json;
  append(std::array<std::uint32_t, 2>{72, 0x004E4942});
  append(kTetrahedronCorners);
  append(kTetrahedronFaces);
  return bytes;
}

}  // namespace sweep_guard_ros
