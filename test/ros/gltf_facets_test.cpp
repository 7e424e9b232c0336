// A glTF is read completely or not at all.
#include "ros/tool/gltf_facets.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "mesh_samples.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

const std::vector<Facet> kGltfTetrahedron = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                             {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                             {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                             {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

std::string gltf(const std::string& part, const std::string& by) { return withPart(tetrahedronGltf(), part, by); }

std::string withNodes(const std::string& nodes) { return gltf(R"([{"mesh": 0}])", nodes); }

std::string withMode(int mode) { return gltf(R"("indices": 1)", R"("indices": 1, "mode": )" + std::to_string(mode)); }

std::string refusedGltf(const std::string& bytes) {
  return refusal<std::runtime_error>([&] { readGltfFacets(bytes); });
}

TEST(GltfFacetsTest, AreReadFromTextAndBinary) {
  EXPECT_EQ(readGltfFacets(tetrahedronGltf()), kGltfTetrahedron);
  EXPECT_EQ(readGltfFacets(tetrahedronGlb()), kGltfTetrahedron);
}

// Images, unlike buffers, are not needed.
TEST(GltfFacetsTest, DoNotDependOnAppearance) {
  const std::string colored = gltf(R"("scene": 0)", R"("images": [{"uri": "skin.png"}], "scene": 0,
    "extensionsUsed": ["KHR_materials_ior", "KHR_texture_basisu"], "extensionsRequired": ["KHR_texture_basisu"])");
  EXPECT_EQ(readGltfFacets(colored), kGltfTetrahedron);
}

TEST(GltfFacetsTest, AreWhereTheNodesOfTheDefaultScenePutThem) {
  const std::string quarter_turn_about_z = "0, 0, 0.70710678, 0.70710678";
  const std::string placed = withPart(
      withNodes(R"([{"mesh": 0, "translation": [9, 9, 9]}, {"children": [2], "translation": [1, 2, 3]},
                   {"mesh": 0, "rotation": [)" +
                quarter_turn_about_z + R"(], "scale": [2, 1, 1]},
                   {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]}])"),
      R"("scene": 0, "scenes": [{"nodes": [0]}])", R"("scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1, 3]}])");
  const std::vector<Facet> facets = readGltfFacets(placed);
  ASSERT_EQ(facets.size(), 8U);
  const Facet first = {{{1, 2, 3}, {1, 4, 3}, {0, 2, 3}}};
  for (size_t corner = 0; corner < 3; ++corner) {
    for (size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(facets[0][corner][axis], first[corner][axis], 1e-7);
  }
  EXPECT_EQ(facets[4], (Facet{{{5, 6, 7}, {6, 6, 7}, {5, 7, 7}}}));
}

TEST(GltfFacetsTest, StripsAndFansAreTriangles) {
  const std::vector<Facet> strip = readGltfFacets(withMode(5));
  ASSERT_EQ(strip.size(), 10U);
  EXPECT_EQ(strip[0], kGltfTetrahedron[0]);                         // 0 1 2
  EXPECT_EQ(strip[1], (Facet{{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}}));  // 1 2 0, turned
  EXPECT_EQ(strip[9], (Facet{{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}));  // 1 2 3, turned
  const std::vector<Facet> fan = readGltfFacets(withMode(6));
  ASSERT_EQ(fan.size(), 10U);
  EXPECT_EQ(fan[9], kGltfTetrahedron[2]);  // 0 2 3
}

TEST(GltfFacetsTest, AMillionTrianglesAreTheMost) {
  const auto fan = [](size_t corners) {
    const std::string count = std::to_string(corners);
    std::string text = withPart(withMode(6), R"(5123, "count": 12)", R"(5121, "count": )" + count);
    text = withPart(text, R"("byteLength": 24)", R"("byteLength": )" + count);
    text = withPart(text, R"("byteLength": 72)", R"("byteLength": )" + std::to_string(48 + corners));
    return withPart(text, R"("}]})", std::string((corners / 3 + 1) * 4, 'A') + R"("}]})");
  };
  EXPECT_EQ(readGltfFacets(fan(1'000'002)).size(), 1'000'000U);
  EXPECT_EQ(refusedGltf(fan(1'000'003)), "more than a million triangles");
}

TEST(GltfFacetsTest, WithoutIndicesTheVerticesAreTheCorners) {
  const std::string three = withPart(gltf(R"(, "indices": 1)", ""), R"("count": 4)", R"("count": 3)");
  EXPECT_EQ(readGltfFacets(three), std::vector<Facet>{kGltfTetrahedron[0]});
}

TEST(GltfFacetsTest, PointsAndLinesAreNone) {
  for (const int mode : {0, 1, 2, 3}) EXPECT_TRUE(readGltfFacets(withMode(mode)).empty());
}

TEST(GltfFacetsTest, AreRefusedIfTheFileNamesAnother) {
  const std::string named =
      withPart(tetrahedronGltf(), tetrahedronGltf().substr(tetrahedronGltf().find("data:")), R"(arm/BUFFER.bin"}]})");
  EXPECT_EQ(refusedGltf(named), "the file names another file, arm/BUFFER.bin: export it as .glb");
}

TEST(GltfFacetsTest, AreRefusedInTheTermsOfTheFile) {
  const auto requiring = [](const std::string& extension) {
    return gltf(R"("scene": 0)", R"("scene": 0, "extensionsRequired": [")" + extension + R"("])");
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{", "not JSON: line 1"},
      {"{}", "'asset' is missing"},
      {gltf("2.0", "1.0"), "glTF 1.0 is not supported"},
      {requiring("KHR_draco_mesh_compression"), "extension KHR_draco_mesh_compression is not supported"},
      {requiring("EXT_meshopt_compression"), "extension EXT_meshopt_compression is not supported"},
      {requiring("KHR_mesh_quantization"), "extension KHR_mesh_quantization is not supported"},
      {gltf(R"("scene": 0)", R"("scene": 0, "extensionsUsed": ["EXT_mesh_gpu_instancing"])"),
       "EXT_mesh_gpu_instancing"},
      {gltf(R"("scene": 0)", R"("scene": 1)"), "'scenes' has no number 1"},
      {gltf(R"("mesh": 0)", R"("mesh": 1)"), "'meshes' has no number 1"},
      {gltf(R"("mesh": 0)", R"("mesh": 0, "skin": 0)"), "skins are not supported"},
      {gltf(R"("indices": 1)", R"("indices": 1, "targets": [{"POSITION": 0}])"), "morph targets are not supported"},
      {withMode(7), "mode 7 is not supported"},
      {withNodes(R"([{"mesh": 0, "children": [0]}])"), "node 0 is named twice"},
      {withNodes(R"([{"mesh": 0, "scale": [1, 1, 0]}])"), "singular"},
      {withNodes(R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])"), "not a unit quaternion"},
      {withNodes(R"([{"mesh": 0, "translation": [0, 0]}])"), "'translation' has not 3 numbers"},
      {withNodes(R"([{"mesh": 0, "translation": [0, 0, null]}])"), "'translation' has no number"},
      {gltf(R"("bufferView": 0, )", ""), "'bufferView' is missing"},
      {gltf(R"("count": 4)", R"("count": 4, "sparse": {})"), "sparse accessors are not supported"},
      {gltf("5126", "5122"), "not three float32"},
      {gltf("VEC3", "VEC2"), "not three float32"},
      {gltf("5123", "5122"), "indices are of an unknown type"},
      {gltf(R"("count": 4)", R"("count": 2147483648)"), "'2147483648' is not a whole number"},
      {gltf(R"("count": 4)", R"("count": -1)"), "'-1' is not a whole number"},
      {gltf(R"("count": 4)", R"("count": 5)"), "leads out of its buffer"},
      {gltf(R"("count": 4)", R"("count": 2147483647)"), "leads out of its buffer"},
      {gltf(R"("byteOffset": 48)", R"("byteOffset": 2147483647)"), "leads out of its buffer"},
      {gltf(R"("byteLength": 48)", R"("byteLength": 48, "byteStride": 4)"), "leads out of its buffer"},
      {gltf(R"("count": 12)", R"("count": 11)"), "corners are left over"},
      {gltf(R"("count": 4)", R"("count": 3)"), "a face names a missing vertex"},
      {gltf(R"("byteLength": 72)", R"("byteLength": 73)"), "a buffer is cut off"},
      {gltf("base64,AAAA", "base64,AA A"), "not base64"},
      {withPart(tetrahedronGlb(), std::string("glTF\2"), std::string("glTF\1")), "glTF 1 is not supported"},
  };
  for (const auto& [bytes, expected] : cases) EXPECT_TRUE(has(refusedGltf(bytes), expected)) << bytes;
}

TEST(GltfFacetsTest, AreCompleteOrRefusedWhereverTheFileIsCut) {
  for (const std::string& bytes : {tetrahedronGltf(), tetrahedronGlb()}) {
    for (size_t size = 0; size < bytes.size(); ++size) EXPECT_NE(refusedGltf(bytes.substr(0, size)), "") << size;
  }
}

}  // namespace
}  // namespace sweep_guard_ros
