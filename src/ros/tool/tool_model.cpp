#include "ros/tool/tool_model.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/xyz.h"
#include "ros/tool/robot_description.h"
#include "ros/tool/robot_tree.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::ConvexPiece;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::poseOf;
using sweep_guard_core::TreeLink;

const std::string kDefaultFrame = "tool";
constexpr double kMaxDistance = 100.0;  // [m]

std::string list(const std::vector<const urdf::Link*>& links) {
  constexpr size_t kMaxCount = 20;
  std::string text;
  for (size_t i = 0; i < std::min(links.size(), kMaxCount); ++i) text += (i == 0 ? "" : ", ") + links[i]->name;
  return text + (links.size() > kMaxCount ? ", ..." : "");
}

InvalidInput noLink(const RobotDescription& robot, const std::string& text) {
  return InvalidInput(text + "; its links are " + list(RobotDescription::subtree(robot.root())));
}

const urdf::Link& linkNamed(const RobotDescription& robot, const std::string& name, const std::string& parameter) {
  const urdf::Link* const link = robot.link(name);
  if (link != nullptr) return *link;
  throw noLink(robot, parameter + " names '" + name + "', which is not a link of the robot");
}

// In tf, a robot's frames may have a prefix, as that of tf_prefix.
std::string withoutPrefix(const std::string& frame) { return frame.substr(frame.rfind('/') + 1); }

const urdf::Link& frameOf(const RobotDescription& robot, const ToolModelOptions& options) {
  const std::string name = withoutPrefix(options.frame);
  for (const std::string& candidate : {options.frame, name}) {
    if (const urdf::Link* const link = robot.link(candidate); link != nullptr) return *link;
  }
  if (name == kDefaultFrame) {
    return options.links.empty() || options.of_root ? robot.root()
                                                    : linkNamed(robot, options.links.front(), "tool/links");
  }
  const std::string nor = name == options.frame ? "" : ", nor is '" + name + "'";
  throw noLink(robot, "tool_frame names '" + options.frame + "', which is not a link of the robot" + nor);
}

std::vector<const urdf::Link*> linksOf(const RobotDescription& robot, const ToolModelOptions& options,
                                       const urdf::Link& frame) {
  if (options.links.empty()) {
    std::vector<const urdf::Link*> links = RobotDescription::subtree(frame);
    const auto has_no_shape = [&robot](const urdf::Link* link) { return robot.hasNoShape(*link); };
    links.erase(std::remove_if(links.begin(), links.end(), has_no_shape), links.end());
    if (links.empty()) throw InvalidInput("link '" + frame.name + "' and the links below it have no shape");
    return links;
  }
  std::vector<const urdf::Link*> links;
  for (const std::string& name : options.links) {
    links.push_back(&linkNamed(robot, name, "tool/links"));
    if (std::count(links.begin(), links.end(), links.back()) > 1) {
      throw InvalidInput("tool/links names '" + name + "' twice");
    }
  }
  return links;
}

double size(double value, const std::string& what) {
  if (value > 0.0 && value <= kMaxDistance) return value;
  std::ostringstream text;
  text << "its " << what << " is " << value << " m, but must be above 0 and at most 100";
  throw InvalidInput(text.str());
}

Eigen::Vector3d scaleOf(const urdf::Mesh& mesh) {
  Eigen::Vector3d scale(mesh.scale.x, mesh.scale.y, mesh.scale.z);
  for (const double factor : sweep_guard_core::xyz(scale)) {
    if (!(std::abs(factor) >= 1e-9 && std::abs(factor) <= 1e9)) {
      throw InvalidInput(mesh.filename + ": its scale must not be 0, nor beyond 1e9");
    }
  }
  return scale;
}

// Uses the vertices as read: TriangleMesh rounds them.
ConvexShape hullOf(const MeshSurface& surface, const std::vector<std::uint32_t>& triangles) {
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t triangle : triangles) {
    for (const std::uint32_t corner : surface.triangles[triangle]) corners.push_back(surface.vertices[corner]);
  }
  return ConvexShape::hull(corners);
}

std::vector<ConvexShape> meshShapes(const urdf::Mesh& mesh, const ToolModelOptions& options) {
  const Eigen::Vector3d scale = scaleOf(mesh);
  MeshSurface surface = readMesh(locateMesh(mesh.filename, options.mesh_roots));
  for (Eigen::Vector3d& p : surface.vertices) p = p.cwiseProduct(scale);
  try {
    const sweep_guard_core::TriangleMesh rounded(surface.vertices, surface.triangles);
    sweep_guard_core::DecompositionOptions cuts;
    cuts.max_depth = options.mesh_depth;
    std::vector<ConvexShape> hulls;
    for (const auto& triangles : sweep_guard_core::decompose(rounded, cuts))
      hulls.push_back(hullOf(surface, triangles));
    return hulls;
  } catch (const InvalidInput& error) {
    throw InvalidInput(mesh.filename + ": " + error.what());
  }
}

std::vector<ConvexShape> shapesOf(const urdf::Geometry& geometry, const ToolModelOptions& options) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return {ConvexShape::sphere(size(static_cast<const urdf::Sphere&>(geometry).radius, "sphere's radius"))};
    case urdf::Geometry::BOX: {
      const urdf::Vector3& dim = static_cast<const urdf::Box&>(geometry).dim;
      return {ConvexShape::box(0.5 * Eigen::Vector3d{size(dim.x, "box's size in x"), size(dim.y, "box's size in y"),
                                                     size(dim.z, "box's size in z")})};
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      const double length = size(cylinder.length, "cylinder's length");
      return {ConvexShape::cylinder(size(cylinder.radius, "cylinder's radius"), length)
                  .placed(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.5 * length)))};
    }
    case urdf::Geometry::MESH:
      return meshShapes(static_cast<const urdf::Mesh&>(geometry), options);
  }
  throw InvalidInput("its geometry is of an unknown type");
}

void requireWithinReach(double distance, const std::string& frame) {
  if (distance <= kMaxDistance) return;  // false for NaN too
  std::ostringstream text;
  text << "it reaches " << distance << " m from the frame of '" << frame << "', but the limit is 100 m; "
       << "if a mesh is in millimeters, set its scale";
  throw InvalidInput(text.str());
}

// @param element  a collision or a visual
template <typename Element>
void addPiecesOf(const Element& element, const urdf::Link& link, const Eigen::Isometry3d& X_TL,
                 const ToolModelOptions& options, ToolModel& model) {
  const Eigen::Isometry3d X_TC = X_TL * fromUrdf(element.origin);
  requireWithinReach(X_TC.translation().norm(), model.frame);
  for (const ConvexShape& shape_C : shapesOf(*element.geometry, options)) {
    requireWithinReach(shape_C.boundingRadius(), model.frame);
    const ConvexShape shape_T = shape_C.placed(X_TC).padded(options.padding);
    requireWithinReach(shape_T.boundingRadius(), model.frame);
    model.pieces.push_back({link.name, shape_T});
  }
}

void addPieces(const RobotDescription& robot, const urdf::Link& link, const Eigen::Isometry3d& X_TL,
               const ToolModelOptions& options, ToolModel& model) {
  robot.requireOneGeometryEach(link);
  const size_t before = model.pieces.size();
  const bool visual = robot.isMadeOfVisuals(link);
  if (visual) {
    for (const auto& element : link.visual_array) addPiecesOf(*element, link, X_TL, options, model);
  } else {
    for (const auto& element : link.collision_array) addPiecesOf(*element, link, X_TL, options, model);
  }
  model.shapes.push_back({link.name, visual, model.pieces.size() - before});
}

template <typename Work>
void withLinkInErrors(const urdf::Link& link, Work work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    throw InvalidInput("link '" + link.name + "': " + error.what());
  }
}

void requireGeometry(const RobotDescription& robot, const urdf::Link& link) {
  const bool visual = robot.isMadeOfVisuals(link);
  if (visual ? !link.visual_array.empty() : !link.collision_array.empty()) return;
  const std::string wanted = visual ? "visual" : "collision";
  const std::string found = robot.hasNoShape(link) ? "it has no geometry"
                                                   : std::string("it has ") + (visual ? "collision" : "visual") +
                                                         " geometry, but no " + wanted;
  const std::string other = robot.hasNoShape(link) ? "" : "set tool/geometry to either, ";
  throw InvalidInput("link '" + link.name + "': " + found + "; " + other + "add a <" + wanted +
                     ">, or list only links with one in tool/links");
}

// Returns whether a joint moves the link relative to the root.
bool isMoved(const urdf::Link& link) {
  for (const urdf::Link* at = &link; at->parent_joint; at = at->getParent().get()) {
    if (at->parent_joint->type != urdf::Joint::FIXED) return true;
  }
  return false;
}

using Pieces = std::vector<ConvexPiece>;

Pieces placed(const Eigen::Isometry3d& X, Pieces::const_iterator first, Pieces::const_iterator last) {
  Pieces there;
  for (; first != last; ++first) there.push_back({first->link, first->shape_T.placed(X)});
  return there;
}

void addRobot(RobotTree&& robot_tree, const std::vector<double>& positions, const Eigen::Isometry3d& X_TR,
              const std::vector<std::pair<size_t, Pieces>>& pieces_of_links, ToolModel& model) {
  const size_t frame = robot_tree.frame;
  if (frame != TreeLink::kRoot && robot_tree.tree.bodyOf(frame) != TreeLink::kRoot) {
    model.why_no_robot =
        "joints of the tool move its frame, '" + model.frame + "': set tool_frame to a link above them";
    return;
  }
  model.robot = std::make_shared<const RobotModel>(
      RobotModel{robotOf(std::move(robot_tree.tree), pieces_of_links), positions, X_TR, std::move(robot_tree.beside)});
}

}  // namespace

ToolModel loadToolModel(const std::string& urdf, const ToolModelOptions& options) {
  const RobotDescription robot(urdf, options.geometry);
  const urdf::Link& frame = frameOf(robot, options);
  const std::vector<const urdf::Link*> links = linksOf(robot, options, frame);
  RobotTree robot_tree = treeOf(robot, frame, links);
  const std::vector<double> positions = positionsOf(robot, robot_tree.tree, options.joints);
  std::vector<Eigen::Isometry3d> X_RL;
  robot_tree.tree.poses(positions, X_RL);
  const Eigen::Isometry3d X_TR = poseOf(robot_tree.frame, X_RL).inverse();
  ToolModel model{{}, frame.name, {}, robot_tree.tree.jointPositions(positions), nullptr, {}};
  std::vector<std::pair<size_t, Pieces>> pieces_of_links;
  for (size_t i = 0; i < links.size(); ++i) {
    const Eigen::Isometry3d X_TL = X_TR * poseOf(robot_tree.links[i], X_RL);
    const auto before = static_cast<std::ptrdiff_t>(model.pieces.size());
    withLinkInErrors(*links[i], [&] { addPieces(robot, *links[i], X_TL, options, model); });
    pieces_of_links.emplace_back(robot_tree.links[i],
                                 placed(X_TL.inverse(), model.pieces.begin() + before, model.pieces.end()));
  }
  for (const urdf::Link* link : links) requireGeometry(robot, *link);  // last, to report a missing mesh first
  addRobot(std::move(robot_tree), positions, X_TR, pieces_of_links, model);
  return model;
}

sweep_guard_core::KinematicTree loadTree(const std::string& urdf, const std::string& frame) {
  const RobotDescription robot(urdf);
  const urdf::Link* const named = robot.link(frame);
  const urdf::Link& link = named != nullptr ? *named : linkNamed(robot, withoutPrefix(frame), "tool_frame");
  return treeOf(robot, link, RobotDescription::subtree(link)).tree;
}

std::map<std::string, Pieces> loadLinks(const std::string& urdf, const ToolModelOptions& options) {
  const RobotDescription robot(urdf, options.geometry);
  std::map<std::string, Pieces> links;
  for (const urdf::Link* link : RobotDescription::subtree(robot.root())) {
    if (robot.hasNoShape(*link) || !isMoved(*link)) continue;
    ToolModel model;
    model.frame = link->name;
    withLinkInErrors(*link, [&] { addPieces(robot, *link, Eigen::Isometry3d::Identity(), options, model); });
    links.emplace(link->name, std::move(model.pieces));
  }
  return links;
}

std::vector<ConvexPiece> piecesByBody(const RobotModel& model) {
  std::vector<Eigen::Isometry3d> X_TB;
  bodyPoses(model.robot.tree, model.robot.bodies, {model.X_TR, model.positions}, X_TB);
  Pieces all;
  for (size_t body = 0; body < X_TB.size(); ++body) {
    const Pieces& pieces = model.robot.tools[body].pieces();
    for (ConvexPiece& piece : placed(X_TB[body], pieces.begin(), pieces.end())) all.push_back(std::move(piece));
  }
  return all;
}

}  // namespace sweep_guard_ros
