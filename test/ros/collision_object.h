#pragma once

#include <string>

namespace sweep_guard_ros {

inline const std::string kObjectTypes =
    "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
    "MSG: object_recognition_msgs/ObjectType\nstring key # in a database\nstring db\n"
    "MSG: shape_msgs/SolidPrimitive\nuint8 BOX=1\nuint8 type\nfloat64[] dimensions\n"
    "MSG: shape_msgs/Mesh\nMeshTriangle[] triangles\ngeometry_msgs/Point[] vertices\n"
    "MSG: shape_msgs/MeshTriangle\nuint32[3] vertex_indices\n"
    "MSG: shape_msgs/Plane\nfloat64[4] coef\n"
    "MSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n"
    "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";

/// Returns the definition of a moveit_msgs/CollisionObject.
/// @param pose, names  lines of the fields that came with MoveIt 1.1
inline std::string objectDefinition(const std::string& pose, const std::string& names) {
  return "Header header\n" + pose +
         "string id\nobject_recognition_msgs/ObjectType type\n"
         "shape_msgs/SolidPrimitive[] primitives\ngeometry_msgs/Pose[] primitive_poses\n"
         "shape_msgs/Mesh[] meshes\ngeometry_msgs/Pose[] mesh_poses\n"
         "shape_msgs/Plane[] planes\ngeometry_msgs/Pose[] plane_poses\n" +
         names + "byte ADD=0\nbyte REMOVE=1\nbyte operation\n" + kObjectTypes;
}

}  // namespace sweep_guard_ros
