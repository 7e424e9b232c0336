// A PLY is read completely or not at all.
#include "ros/tool/ply_facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mesh_samples.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

const std::vector<Facet> kPlyTetrahedron = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                            {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                            {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                            {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

std::string ply(const std::string& part, const std::string& by) { return withPart(tetrahedronPly(), part, by); }

std::string refusedPly(const std::string& bytes) {
  return refusal<std::runtime_error>([&] { readPlyFacets(bytes); });
}

std::string binaryPly(bool big_endian) {
  const std::string text = tetrahedronPly();
  std::string bytes = withPart(text.substr(0, text.find("0 0 0\n")), "ascii",
                               big_endian ? "binary_big_endian" : "binary_little_endian");
  const auto append = [&](const auto& value) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  };
  for (const float x : kTetrahedronCorners) append(x);
  for (size_t i = 0; i < kTetrahedronFaces.size(); ++i) {
    if (i % 3 == 0) append(std::uint8_t{3});
    append(std::int32_t{kTetrahedronFaces[i]});
  }
  return bytes;
}

TEST(PlyFacetsTest, AreReadFromTextAndFromBinariesOfBothByteOrders) {
  EXPECT_EQ(readPlyFacets(tetrahedronPly()), kPlyTetrahedron);
  EXPECT_EQ(readPlyFacets(binaryPly(false)), kPlyTetrahedron);
  EXPECT_EQ(readPlyFacets(binaryPly(true)), kPlyTetrahedron);
}

TEST(PlyFacetsTest, AreReadAsProgramsWriteThem) {
  std::string crlf;
  std::string cr = tetrahedronPly();
  for (const char c : cr) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  const std::string camera = "element camera 1\nproperty list int int view\nproperty float x\n";
  const std::vector<std::string> texts = {
      crlf,
      cr,
      ply("vertex_indices", "vertex_index"),
      ply("uchar int", "uint8 uint32"),
      ply("float x", "double x"),
      ply("comment by hand", "by Blender"),
      ply("1 0 0\n", "1.0 0e0 0\n\n"),
      tetrahedronPly() + "\n",
      withPart(ply("element face", camera + "element face"), "3 0 1 2", "2 7 8 0.5\n3 0 1 2"),
  };
  for (const std::string& text : texts) {
    std::vector<Facet> facets;
    EXPECT_EQ(refusal<std::runtime_error>([&] { facets = readPlyFacets(text); }), "") << text;
    EXPECT_EQ(facets, kPlyTetrahedron) << text;
  }
}

TEST(PlyFacetsTest, APolygonBecomesAFan) {
  const std::vector<Facet> facets = readPlyFacets(ply("3 1 2 3", "4 0 1 2 3"));
  ASSERT_EQ(facets.size(), 5U);
  EXPECT_EQ(facets[3], kPlyTetrahedron[0]);
  EXPECT_EQ(facets[4], kPlyTetrahedron[2]);
}

// As programs for scans write it: a vertex that was not seen is NaN, and no face has it.
TEST(PlyFacetsTest, AVertexThatNoFaceHasDoesNotCount) {
  const std::string five = ply("vertex 4", "vertex 5");
  EXPECT_EQ(readPlyFacets(withPart(five, "3 0 1 2", "nan nan nan\n3 0 1 2")), kPlyTetrahedron);
}

TEST(PlyFacetsTest, AMillionTrianglesAreTheMost) {
  const auto polygon = [](std::uint32_t corners) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\nproperty char z\n"
        "element face 1\nproperty list uint uchar vertex_indices\nend_header\n" +
        std::string(3, '\0');
    bytes.append(reinterpret_cast<const char*>(&corners), sizeof corners);
    return bytes + std::string(corners, '\0');
  };
  EXPECT_EQ(readPlyFacets(polygon(1'000'002)).size(), 1'000'000U);
  EXPECT_EQ(refusedPly(polygon(1'000'003)), "more than a million triangles");
}

TEST(PlyFacetsTest, AreRefusedInTheTermsOfTheFile) {
  const std::string binary = binaryPly(false);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"PLY", "the first line is not 'ply'"},
      {ply("ascii", "utf8"), "unknown format 'utf8'"},
      {ply("float z", "half z"), "unknown type 'half'"},
      {ply("float z", "float height"), "vertices have no x, y and z"},
      {ply("vertex_indices", "corners"), "faces have no vertex_indices"},
      {ply("face 4", "face -1"), "element 'face' has no count"},
      {ply("face 4", "face 2147483648"), "face 4 is cut off"},
      {ply("vertex 4", "vertex 2147483648"), "vertex 4 has more numbers"},
      {ply("face 4", "face 3"), "data follow the last element"},
      {binary + binary.substr(binary.size() - 13), "data follow the last element"},
      {ply("face 4", "tristrips 4"), "tristrips is not supported"},
      {ply("face 4", "face 0"), "a point cloud is no surface"},
      {ply("3 1 2 3", "3 1 2"), "face 3 has too few numbers"},
      {ply("3 1 2 3", "3 1 2 3 0"), "face 3 has more numbers"},
      {ply("3 1 2 3", "3 1 2 4"), "face 3 names a missing vertex"},
      {ply("3 1 2 3", "3 1 2 -1"), "face 3 names a missing vertex"},
      {ply("3 1 2 3", "3 1 2 0.5"), "face 3 names a missing vertex"},
      {ply("3 1 2 3", "0"), "face 3 has no corners"},
      {ply("3 1 2 3", "-3 1 2 3"), "face 3 has a list of no length"},
      {ply("3 1 2 3", "2147483648 1 2 3"), "face 3 has too few numbers"},
      {ply("0 0 1\n", "0 0\n"), "vertex 3 has too few numbers"},
      {ply("0 0 1\n", "0 0 0x1\n"), "vertex 3 has '0x1' in place of a number"},
      {ply("0 0 1\n", "0 0 1,5\n"), "vertex 3 has '1,5' in place of a number"},
  };
  for (const auto& [bytes, expected] : cases) EXPECT_TRUE(has(refusedPly(bytes), expected)) << bytes;
}

TEST(PlyFacetsTest, AreCompleteOrRefusedWhereverTheFileIsCut) {
  for (const std::string& bytes : {tetrahedronPly(), binaryPly(false), binaryPly(true)}) {
    for (size_t size = 0; size < bytes.size(); ++size) {
      const std::string cut = bytes.substr(0, size);
      const bool only_its_last_line_end = size + 1 == bytes.size() && bytes.back() == '\n';
      EXPECT_EQ(refusedPly(cut).empty(), only_its_last_line_end) << cut;
    }
  }
}

}  // namespace
}  // namespace sweep_guard_ros
