// Meshes are found only in allowed folders, and read completely or not at all. No file stops the guard.
#include "sweep_guard/ros/tool/mesh_file.h"
#include "data_path.h"
#include "mesh_samples.h"
#include "refusal.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cstring>

#include "ros/package_folder.h"

namespace sweep_guard_ros {
namespace {

namespace fs = std::filesystem;

class MeshFileTest : public testing::Test {
 protected:
  std::string refused(const std::string& name, const std::string& content) const {
    const fs::path file = folder_.write(name, content);
    std::string message = refusal([&] { readMesh(file); });
    EXPECT_NE(message, "") << name << " is read";
    EXPECT_TRUE(has(message, file.string()));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }

  PackageFolder folder_;
};

Eigen::AlignedBox3d boxOf(const MeshSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.vertices) box.extend(p);
  return box;
}

void expectUnitTetrahedron(const MeshSurface& surface, double scale = 1.0) {
  EXPECT_EQ(surface.vertices.size(), 4U);
  EXPECT_EQ(surface.triangles.size(), 4U);
  const Eigen::AlignedBox3d box = boxOf(surface);
  EXPECT_LT(box.min().norm(), 1e-9);
  EXPECT_LT((box.max() - Eigen::Vector3d::Constant(scale)).norm(), 1e-9);
}

std::string asciiStl() {
  std::string text = "solid tetrahedron\n";
  for (const char* const corners :
       {"0 0 0 1 0 0 0 1 0", "0 0 0 1 0 0 0 0 1", "0 0 0 0 1 0 0 0 1", "1 0 0 0 1 0 0 0 1"}) {
    std::istringstream numbers(corners);
    text += "facet normal 0 0 0\nouter loop\n";
    for (int i = 0; i < 3; ++i) {
      std::string x, y, z;
      numbers >> x >> y >> z;
      text.append("vertex ").append(x).append(" ").append(y).append(" ").append(z).append("\n");
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

std::string binaryStl(std::uint32_t claimed_facets) {
  std::string bytes(80, ' ');
  const auto append = [&bytes](const void* data, size_t size) { bytes.append(static_cast<const char*>(data), size); };
  append(&claimed_facets, sizeof claimed_facets);
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}) {
    bytes.append(12, '\0');
    for (const int corner : {a, b, c}) append(corners[corner], sizeof corners[corner]);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string dae(const std::string& unit, const std::string& up, const std::string& scene) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>" +
         unit + up +
         "</asset><library_geometries><geometry id='g'><mesh><source id='p'><float_array id='a' count='12'>0 0 0 1 0 0 "
         "0 "
         "1 0 0 0 1</float_array><technique_common><accessor source='#a' count='4' stride='3'><param name='X' "
         "type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common>"
         "</source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles count='4'><input "
         "semantic='VERTEX' source='#v' offset='0'/><p>0 1 2 0 1 3 0 2 3 1 2 3</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id='s'>" +
         scene + "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

const std::string kInstance = "<node><instance_geometry url='#g'/></node>";

TEST_F(MeshFileTest, ReadsEveryFormat) {
  expectUnitTetrahedron(readMesh(folder_.write("t.obj", tetrahedronObj())));
  expectUnitTetrahedron(readMesh(folder_.write("t.STL", asciiStl())));
  expectUnitTetrahedron(readMesh(folder_.write("b.stl", binaryStl(4))));
  expectUnitTetrahedron(readMesh(folder_.write("t.dae", dae("", "", kInstance))));
  expectUnitTetrahedron(readMesh(folder_.write("t.ply", tetrahedronPly())));
  expectUnitTetrahedron(readMesh(folder_.write("t.gltf", tetrahedronGltf())));
  expectUnitTetrahedron(readMesh(folder_.write("t.GLB", tetrahedronGlb())));
}

// A model names its unit. Its axes are kept even if z is not up.
TEST_F(MeshFileTest, TakesTheUnitOfADaeAndNotItsUpAxis) {
  const MeshSurface inches = readMesh(folder_.write("i.dae", dae("<unit name='inch' meter='0.0254'/>", "", kInstance)));
  EXPECT_LT((boxOf(inches).max() - Eigen::Vector3d::Constant(0.0254)).norm(), 1e-8);
  const std::string placed =
      "<node><translate>0 0 5</translate><scale>1 2 3</scale><instance_geometry url='#g'/></node>";
  for (const char* const up : {"X_UP", "Y_UP", "Z_UP"}) {
    const MeshSurface mesh =
        readMesh(folder_.write("u.dae", dae("", std::string("<up_axis>") + up + "</up_axis>", placed)));
    EXPECT_LT((boxOf(mesh).max() - Eigen::Vector3d(1, 2, 8)).norm(), 1e-6) << up;
  }
}

// Materials are in other files.
TEST_F(MeshFileTest, ReadsAnObjWithoutItsMaterials) {
  expectUnitTetrahedron(readMesh(folder_.write("m.obj", "mtllib /dev/zero\nusemtl steel\n" + tetrahedronObj())));
}

TEST_F(MeshFileTest, KeepsEdgesAndPointsBesideTriangles) {
  const MeshSurface mesh = readMesh(folder_.write("e.obj", tetrahedronObj() + "v 5 0 0\nl 1 5\n"));
  EXPECT_EQ(boxOf(mesh).max().x(), 5.0);
}

TEST_F(MeshFileTest, RefusesWhatItCannotReadCompletely) {
  EXPECT_TRUE(has(refused("empty.obj", ""), "empty"));
  EXPECT_TRUE(has(refused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "no triangles"));
  EXPECT_TRUE(has(refused("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "NaN"));
  EXPECT_TRUE(has(refused("inf.obj", "v 0 0 1e39\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "infinite"));
  EXPECT_TRUE(has(refused("index.obj", tetrahedronObj() + "f 1 2 9\n"), "index"));
  const std::string stl = asciiStl();
  EXPECT_TRUE(has(refused("cut.stl", stl.substr(0, stl.rfind("facet normal"))), "end is missing"));
  EXPECT_TRUE(has(refused("cut.stl", stl.substr(0, stl.rfind("vertex"))), "cannot be read"));
  EXPECT_TRUE(has(refused("lfs.obj", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n"), "git lfs pull"));
  const std::string cut = refused("cut.dae", "<COLLADA version='1.4.1'><asset>");
  EXPECT_TRUE(has(cut, "XML") || has(cut, "Collada: File came out empty")) << cut;  // assimp 5.0 says the latter
  EXPECT_TRUE(has(refused("nan.ply", withPart(tetrahedronPly(), "1 0 0", "1 0 nan")), "NaN"));
  EXPECT_TRUE(has(refused("cloud.ply", withPart(tetrahedronPly(), "face 4", "face 0")), "a point cloud is no surface"));
  EXPECT_TRUE(has(refused("cut.glb", tetrahedronGlb().substr(0, 400)), "cut off"));
  EXPECT_TRUE(has(refused("lines.gltf", withPart(tetrahedronGltf(), "s\": 1", "s\": 1, \"mode\": 1")), "no triangles"));
  EXPECT_TRUE(has(refused("t.off", "OFF"), "give an STL, OBJ, DAE, PLY or glTF file"));
}

std::string replacedAll(std::string text, const std::string& part, const std::string& by) {
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + by.size())) {
    text.replace(at, part.size(), by);
  }
  return text;
}

// What other programs show, although it is not as the format has it.
TEST_F(MeshFileTest, ReadsAnStlAsProgramsWriteIt) {
  const std::string binary = binaryStl(4);
  const std::string solid = "solid" + binary.substr(5);
  const std::string text = asciiStl();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a binary that begins with solid", solid},
      {"zeros at its end", binary + std::string(92, '\0')},
      {"zeros with room for a triangle", binary + std::string(50, '\0')},
      {"one byte too many", binary + "\n"},
      {"words at its end", binary + "written by a program that signs what it writes, in sixty bytes"},
      {"both", solid + std::string(92, '\0')},
      {"a color in its header", "COLOR=\xff\x80\x40\xff" + binary.substr(10)},
      {"attributes", binary.substr(0, binary.size() - 2) + "\x21\x84"},
      {"end solid", replacedAll(text, "endsolid", "end solid")},
      {"end loop", replacedAll(text, "endloop", "end loop")},
      {"END FACET", replacedAll(text, "endfacet", "END FACET")},
      {"normals that are NaN", replacedAll(text, "normal 0 0 0", "normal NaN NaN NaN")},
      {"other normals that are NaN", replacedAll(text, "normal 0 0 0", "normal -nan(ind) 1.#QNAN -1.#IND")},
      {"no normals", replacedAll(text, "facet normal 0 0 0", "facet")},
      {"lines of another system", replacedAll(text, "\n", "\r\n")},
      {"no name", replacedAll(text, " tetrahedron", "")},
      {"a name in umlauts", replacedAll(text, "tetrahedron", "\xC3\x84rmel facet")},
      {"an end of file", text + "\x1a"},
      {"a solid without triangles", text + "solid empty\nendsolid empty\n"},
  };
  for (const auto& [what, bytes] : cases) {
    SCOPED_TRACE(what);
    EXPECT_EQ(refusal([&, &stl = bytes] { expectUnitTetrahedron(readMesh(folder_.write("t.stl", stl))); }), "");
  }
}

TEST_F(MeshFileTest, RefusesAnStlInTheTermsOfTheFile) {
  const std::string text = asciiStl();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {binaryStl(3), "header says 3 triangles, the file has room for 4"},
      {binaryStl(3) + "\n", "header says 3 triangles, the file has room for 4"},
      {binaryStl(0), "header says 0 triangles, the file has room for 4"},
      {binaryStl(5), "header says 5 triangles, the file has room for 4"},
      {"solid" + binaryStl(5).substr(5), "header says 5 triangles, the file has room for 4"},
      {binaryStl(4).substr(0, 283), "header says 4 triangles, the file has room for 3"},
      {binaryStl(4000000000U), "header says 4000000000 triangles, the file has room for 4"},
      {binaryStl(0).substr(0, 84), "no triangles"},
      {std::string("\0\1", 2), "shorter than the 84 bytes"},
      {tetrahedronObj(), "text that does not begin with 'solid' and 'facet'"},
      {"<!DOCTYPE html><html><body>404</body></html>", "text that does not begin with 'solid' and 'facet'"},
      {replacedAll(text, "vertex 1 0 0", "vertex 1 0"), "triangle 1 has 'vertex' in place of a number"},
      {replacedAll(text, "vertex 0 0 1", "vertex 0 0,5 1"), "triangle 2 has '0,5' in place of a number"},
      {replacedAll(text, "vertex 0 0 1", "vertex 0 0x1 1"), "triangle 2 has '0x1' in place of a number"},
      {replacedAll(text, "endloop", "vertex 1 1 1\nendloop"), "triangle 1 has 'vertex' in place of 'endloop'"},
      {replacedAll(text, "vertex 1 0 0", "vertex nan 0 0"), "a vertex is NaN"},
      {text + "facet normal 0 0 0\n", "triangles follow the end"},
      {text.substr(0, text.rfind("vertex")), "the file ends in triangle 4"},
      {text.substr(0, text.rfind("endsolid")), "end is missing: no 'endsolid' after 4 triangles"},
  };
  for (const auto& [bytes, expected] : cases) {
    const std::string message = refused("t.stl", bytes);
    EXPECT_TRUE(has(message, expected)) << message;
  }
}

// Some exporters write capitals or a byte order mark.
TEST_F(MeshFileTest, ReadsCapitalsAndAByteOrderMark) {
  expectUnitTetrahedron(readMesh(folder_.write("bom.stl", "\xEF\xBB\xBF" + asciiStl())));
  std::string capitals = tetrahedronObj();
  std::replace(capitals.begin(), capitals.end(), 'f', 'F');
  expectUnitTetrahedron(readMesh(folder_.write("f.obj", capitals)));
  expectUnitTetrahedron(readMesh(folder_.write("bom.obj", "\xEF\xBB\xBF" + tetrahedronObj())));
  std::string stl = asciiStl();
  const auto half = stl.begin() + static_cast<std::ptrdiff_t>(stl.size() / 2);
  std::transform(half, stl.end(), half, [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  expectUnitTetrahedron(readMesh(folder_.write("f.stl", stl)));
}

TEST_F(MeshFileTest, RefusesAnObjWithALineThatAssimpIgnores) {
  const std::string obj = tetrahedronObj();
  EXPECT_TRUE(has(refused("surf.obj", obj + "surf 0 1 0 1 1 2 3 4\nend\n"), "'surf'"));
  EXPECT_TRUE(has(refused("hex.obj", "v 0x10 0 0\n" + obj), "'0x10'"));
  EXPECT_TRUE(has(refused("seven.obj", "v 1 2 3 1 1 1 1\n" + obj), "7 numbers"));
  EXPECT_TRUE(has(refused("indented.obj", " v 1 2 3\n" + obj), "indented"));
  EXPECT_TRUE(has(refused("indented.obj", obj + " f 1 2 3\n"), "faces"));
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  return text.replace(text.find(part), part.size(), by);
}

TEST_F(MeshFileTest, RefusesADaeWithoutAMesh) {
  EXPECT_TRUE(has(refused("camera.dae", dae("", "", "<node id='Camera'/>")), "no triangles"));
  const std::string uncounted = replaced(dae("", "", kInstance), "triangles count='4'", "triangles count='0'");
  EXPECT_TRUE(has(refused("count.dae", uncounted), "count 0"));
}

TEST_F(MeshFileTest, RefusesADaeThatAssimpReadsIncompletely) {
  const std::string gone = "<node><instance_geometry url='#gone'/></node>";
  EXPECT_TRUE(has(refused("gone.dae", dae("", "", kInstance + gone)), "gone"));
  const std::string skin = "<node><instance_controller url='#gone'/></node>";
  EXPECT_TRUE(has(refused("skin.dae", dae("", "", kInstance + skin)), "gone"));
  for (const std::string unit : {"0", "-1", "inch", "nan", "inf", "", "1 inch"}) {
    const std::string message = refused("u.dae", dae("<unit name='x' meter='" + unit + "'/>", "", kInstance));
    EXPECT_TRUE(has(message, "'" + unit + "' meters"));
  }
  for (const std::string matrix : {"0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", "1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1"}) {
    const std::string flat = "<node><matrix>" + matrix + "</matrix><instance_geometry url='#g'/></node>";
    EXPECT_TRUE(has(refused("flat.dae", dae("", "", kInstance + flat)), "singular"));
  }
  const std::string negative = replaced(dae("", "", kInstance), "1 2 3</p>", "1 2 -1</p>");
  EXPECT_TRUE(has(refused("p.dae", negative), "index"));
  const std::string spline = replaced(dae("", "", kInstance), "</mesh>", "</mesh><spline/>");
  EXPECT_TRUE(has(refused("spline.dae", spline), "<spline>"));
}

TEST_F(MeshFileTest, RefusesAMeshWithoutExtent) {
  EXPECT_TRUE(has(refused("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n"), "points or lines"));
  EXPECT_TRUE(has(refused("line.obj", "v 1 2 3\nv 1 2 3\nv 1 2 4\nf 1 2 3\n"), "points or lines"));
}

// The name of the link tells the format.
TEST_F(MeshFileTest, FollowsASymbolicLinkOnRequest) {
  const fs::path link = folder_.path() / "link.obj";
  fs::create_symlink(folder_.write("blob", tetrahedronObj()), link);
  EXPECT_TRUE(has(refusal([&] { readMesh(link); }), "cannot be opened"));
  expectUnitTetrahedron(readMesh(link, /*follow_link=*/true));
}

TEST_F(MeshFileTest, RefusesHugeAndSpecialFiles) {
  const fs::path huge = folder_.write("huge.stl", "solid");
  fs::resize_file(huge, std::uintmax_t{4} << 30U);
  EXPECT_TRUE(has(refusal([&] { readMesh(huge); }), "32 MiB"));
  const fs::path pipe = folder_.path() / "pipe.stl";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(has(refusal([&] { readMesh(pipe); }), "not a regular file"));
  fs::create_directory(folder_.path() / "folder.stl");
  EXPECT_TRUE(has(refusal([&] { readMesh(folder_.path() / "folder.stl"); }), "not a regular file"));
}

// assimp recurses into nested nodes until the stack overflows.
TEST_F(MeshFileTest, RefusesAFileThatCrashesItsReader) {
  constexpr int kNested = 200000;
  std::string nested;
  for (int i = 0; i < kNested; ++i) nested += "<node>";
  for (int i = 0; i < kNested; ++i) nested += "</node>";
  EXPECT_TRUE(has(refused("nested.dae", dae("", "", nested)), "crashes mesh_reader"));
}

TEST_F(MeshFileTest, SurvivesEveryHostileFileUnderEveryName) {
  const fs::path hostile = dataPath("hostile");
  if (!fs::exists(hostile)) GTEST_SKIP() << missing(hostile);
  int read = 0;
  int refused_files = 0;
  for (const auto& entry : fs::directory_iterator(hostile)) {
    for (const char* const name : {"h.stl", "h.obj", "h.dae", "h.ply", "h.gltf", "h.glb"}) {
      const fs::path copy = folder_.path() / name;
      fs::copy_file(entry.path(), copy, fs::copy_options::overwrite_existing);
      fs::permissions(copy, fs::perms::owner_all);
      const std::string message = refusal([&] {
        const MeshSurface surface = readMesh(copy);
        EXPECT_FALSE(surface.triangles.empty());
        EXPECT_TRUE(boxOf(surface).diagonal().allFinite());
      });
      ++(message.empty() ? read : refused_files);
    }
  }
  EXPECT_GT(read, 10);  // some are only unusual
  EXPECT_GT(refused_files, 60);
}

TEST_F(MeshFileTest, IsFoundInAPackage) {
  const fs::path file = folder_.write("robot/meshes/t.obj", tetrahedronObj());
  EXPECT_EQ(locateMesh("package://robot/meshes/t.obj", {}), file);
  EXPECT_EQ(locateMesh("package://robot/meshes/../meshes/t.obj", {}), file);
  EXPECT_EQ(locateMesh("file://" + file.string(), {}), file);
}

// Downloaded models often lack package.xml.
TEST_F(MeshFileTest, IsFoundInAFolderOnThePackagePath) {
  const fs::path file = folder_.write("bare_robot/t.obj", tetrahedronObj());
  EXPECT_EQ(locateMesh("package://bare_robot/t.obj", {}), file);
}

TEST_F(MeshFileTest, IsFoundInARoot) {
  const fs::path file = folder_.write("elsewhere/t.obj", tetrahedronObj());
  EXPECT_EQ(locateMesh("file://" + file.string(), {file.parent_path().string()}), file);
  EXPECT_TRUE(has(refusal([&] { locateMesh("file://" + file.string(), {}); }), "tool/mesh_roots"));
  EXPECT_NE(refusal([&] { locateMesh("file://" + file.string(), {folder_.path() / "else"}); }), "");
}

// The parent folder of / is /.
TEST_F(MeshFileTest, IsNotFoundByAPackagePathOfEverything) {
  const fs::path file = folder_.write("elsewhere/t.obj", tetrahedronObj());
  PackageFolder::setPackagePath("/");
  EXPECT_TRUE(has(refusal([&] { locateMesh("file://" + file.string(), {}); }), "neither in a package"));
  EXPECT_EQ(locateMesh("file://" + folder_.write("robot/t.obj", tetrahedronObj()).string(), {}),
            folder_.package() / "t.obj");
}

TEST_F(MeshFileTest, IsNotFoundOutsideOfItsPackage) {
  const fs::path outside = folder_.write("outside/t.obj", tetrahedronObj());
  fs::create_symlink(outside, folder_.package() / "link.obj");
  fs::create_directory_symlink(outside.parent_path(), folder_.package() / "linked");
  const auto expectRefused = [](const std::string& uri, const std::string& expected) {
    const std::string message = refusal([&] { locateMesh(uri, {}); });
    EXPECT_TRUE(has(message, expected)) << uri << ": " << message;
    EXPECT_TRUE(has(message, uri));
  };
  expectRefused("package://robot/../outside/t.obj", "leads out of");
  expectRefused("package://robot/link.obj", "leads out of");
  expectRefused("package://robot/linked/t.obj", "leads out of");
  expectRefused("file://" + (folder_.package() / "link.obj").string(), "neither in a package");
  expectRefused("package://robot//etc/passwd", "no such file");
  expectRefused("package://robot/", "package://NAME/PATH");
  expectRefused("package://../outside/t.obj", "package://NAME/PATH");
  expectRefused("package://robot", "package://NAME/PATH");
  expectRefused("package://no_such_robot/t.obj", "no package 'no_such_robot'");
  expectRefused("package://robot/missing.obj", "no such file");
  expectRefused("file://other_host/etc/passwd", "file:///PATH");
  expectRefused("file:etc/passwd", "file:///PATH");
  for (const std::string start : {"file:///", "file:/", "file:////", "file://localhost/", "file:///%65tc/../"}) {
    expectRefused(start + "etc/passwd", "neither in a package");
  }
}

std::string locationOf(const std::string& uri) { return locateMesh(uri, {}).string(); }

// rviz needs the escapes, older programs the blanks.
TEST_F(MeshFileTest, IsFoundByItsNameWithAndWithoutPercentEscapes) {
  for (const std::string name : {"upper arm", "100%", "\xC3\x84rmel", "a+b", "50%2", "x%zz"}) {
    const std::string file = folder_.write("robot/my meshes/" + name + ".obj", tetrahedronObj()).string();
    std::string escaped = replacedAll(replacedAll(name, "%", "%25"), " ", "%20");
    escaped = "my%20meshes/" + replacedAll(escaped, "\xC3\x84", "%C3%84") + ".obj";
    const std::string folder = folder_.package().string() + "/";
    for (const std::string& path :
         {"my meshes/" + name + ".obj", escaped, "/my meshes/" + name + ".obj", '/' + escaped}) {
      SCOPED_TRACE(path);
      EXPECT_EQ(locationOf("package://robot/" + path), file);
      EXPECT_EQ(locationOf("file://" + folder + path), file);
      EXPECT_EQ(locationOf("file://localhost" + folder + path), file);
      EXPECT_EQ(locationOf("file:" + folder + path), file);
      EXPECT_EQ(locationOf("file:///" + folder + path), file);
    }
  }
}

TEST_F(MeshFileTest, TheNameAsItIsGoesBeforeTheDecodedOne) {
  const std::string decoded = folder_.write("robot/a b.obj", tetrahedronObj()).string();
  EXPECT_EQ(locationOf("package://robot/a%20b.obj"), decoded);
  const std::string literal = folder_.write("robot/a%20b.obj", tetrahedronObj()).string();
  EXPECT_EQ(locationOf("package://robot/a%20b.obj"), literal);
  EXPECT_EQ(locationOf("package://robot/a%2520b.obj"), literal);
  EXPECT_EQ(locationOf("package://robot/a b.obj"), decoded);
}

// It is decoded once, and before it is tested where the file is.
TEST_F(MeshFileTest, EscapesLeadNowhereElse) {
  folder_.write("robot/in/t.obj", tetrahedronObj());
  folder_.write("outside/t.obj", tetrahedronObj());
  fs::create_symlink(folder_.path() / "outside/t.obj", folder_.package() / "a link.obj");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"in%2Ft.obj", "'%2F' is not supported"},
      {"in%2ft.obj", "'%2f' is not supported"},
      {"in/t.obj%00", "'%00' is not supported"},
      {"%2e%2e/outside/t.obj", "'%2e%2e' is not supported; write '..'"},
      {"in/.%2E/in/t.obj", "'.%2E' is not supported; write '..'"},
      {"%2e/in/t.obj", "'%2e' is not supported; write '.'"},
      {"..%2foutside/t.obj", "'%2f' is not supported"},
      {"a%20link.obj", "leads out of"},
      {"in%252Ft.obj", "no such file"},
  };
  for (const auto& [path, expected] : cases) {
    const std::string message = refusal([&path = path] { locateMesh("package://robot/" + path, {}); });
    EXPECT_TRUE(has(message, expected)) << path << ": " << message;
  }
}

TEST_F(MeshFileTest, IsRefusedWithWhatToWrite) {
  folder_.write("robot/Meshes/UPPER_ARM.STL", "");
  folder_.write("outside/UPPER_ARM.STL", "");
  const std::string package = folder_.package().string();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"meshes/upper arm.stl", "write package://NAME/meshes/upper arm.stl"},
      {"./meshes/\xC3\x84rmel.stl", "write package://NAME/meshes/\xC3\x84rmel.stl"},
      {"../t.obj", "write package://NAME/../t.obj"},
      {"/opt/robot/a b.stl", "write file:///opt/robot/a b.stl"},
      {"model://arm/meshes/t.dae", "write package://arm/meshes/t.dae, and add the folder to ROS_PACKAGE_PATH"},
      {"http://example.org/t.obj", "write package://NAME/PATH"},
      {"package://robot/meshes/upper_arm.stl", "there is " + package + "/Meshes/UPPER_ARM.STL"},
      {"package://robot/Meshes/UPPER%5fARM.stl", "there is " + package + "/Meshes/UPPER_ARM.STL"},
      {"file://" + package + "/meshes/upper_arm.stl", "there is " + package + "/Meshes/UPPER_ARM.STL"},
      {"package://robot/\xC3\x84rmel.stl", "package://robot/\xC3\x84rmel.stl: no such file"},
      {"package://robot/a\nb.stl", "package://robot/a?b.stl: no such file"},
  };
  for (const auto& [uri, expected] : cases) {
    const std::string message = refusal([&uri = uri] { locateMesh(uri, {}); });
    EXPECT_TRUE(has(message, expected)) << uri << ": " << message;
  }
  for (const std::string& uri : {std::string("package://robot/../outside/upper_arm.stl"),
                                 "file://" + folder_.path().string() + "/outside/upper_arm.stl"}) {
    const std::string message = refusal([&uri] { locateMesh(uri, {}); });
    EXPECT_FALSE(has(message, "UPPER_ARM")) << uri << ": " << message;
  }
}

}  // namespace
}  // namespace sweep_guard_ros
