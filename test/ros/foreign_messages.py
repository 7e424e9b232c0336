"""Messages of packages that are not installed: classes with the fields that docs.ros.org lists, whose publishers send their definition."""
import re
from types import SimpleNamespace

import genpy.dynamic
import roslib.message

_SEPARATOR = '\n' + '=' * 80 + '\n'
_OBJECT = '''string id
object_recognition_msgs/ObjectType type
shape_msgs/SolidPrimitive[] primitives
geometry_msgs/Pose[] primitive_poses
shape_msgs/Mesh[] meshes
geometry_msgs/Pose[] mesh_poses
shape_msgs/Plane[] planes
geometry_msgs/Pose[] plane_poses
'''
_OPERATION = '''byte ADD=0
byte REMOVE=1
byte APPEND=2
byte MOVE=3
byte operation'''
_SINCE_1_1 = ('Header header\ngeometry_msgs/Pose pose\n' + _OBJECT + 'string[] subframe_names\ngeometry_msgs/Pose[] subframe_poses\n' +
              _OPERATION)
_BEFORE_1_1 = 'Header header\n' + _OBJECT + _OPERATION
_MOVEIT = {
    'object_recognition_msgs/ObjectType': 'string key\nstring db',
    'octomap_msgs/Octomap': 'Header header\nbool binary\nstring id\nfloat64 resolution\nint8[] data',
    'octomap_msgs/OctomapWithPose': 'Header header\ngeometry_msgs/Pose origin\noctomap_msgs/Octomap octomap',
    'moveit_msgs/AttachedCollisionObject': '''string link_name
CollisionObject object
string[] touch_links
trajectory_msgs/JointTrajectory detach_posture
float64 weight''',
    'moveit_msgs/RobotState': '''sensor_msgs/JointState joint_state
sensor_msgs/MultiDOFJointState multi_dof_joint_state
AttachedCollisionObject[] attached_collision_objects
bool is_diff''',
    'moveit_msgs/AllowedCollisionEntry': 'bool[] enabled',
    'moveit_msgs/AllowedCollisionMatrix': '''string[] entry_names
AllowedCollisionEntry[] entry_values
string[] default_entry_names
bool[] default_entry_values''',
    'moveit_msgs/LinkPadding': 'string link_name\nfloat64 padding',
    'moveit_msgs/LinkScale': 'string link_name\nfloat64 scale',
    'moveit_msgs/ObjectColor': 'string id\nstd_msgs/ColorRGBA color',
    'moveit_msgs/PlanningSceneWorld': 'CollisionObject[] collision_objects\noctomap_msgs/OctomapWithPose octomap',
    'moveit_msgs/PlanningScene': '''string name
RobotState robot_state
string robot_model_name
geometry_msgs/TransformStamped[] fixed_frame_transforms
AllowedCollisionMatrix allowed_collision_matrix
LinkPadding[] link_padding
LinkScale[] link_scale
ObjectColor[] object_colors
PlanningSceneWorld world
bool is_diff''',
    'moveit_msgs/PlanningSceneComponents': 'uint32 components',
    'moveit_msgs/GetPlanningSceneRequest': 'PlanningSceneComponents components',
    'moveit_msgs/GetPlanningSceneResponse': 'PlanningScene scene',
}
_PCL = {
    'pcl_msgs/Vertices': 'uint32[] vertices',
    'pcl_msgs/PolygonMesh': 'Header header\nsensor_msgs/PointCloud2 cloud\nVertices[] polygons',
}
_MESH = {
    'mesh_msgs/MeshTriangleIndices': 'uint32[3] vertex_indices',
    'mesh_msgs/MeshGeometry': 'geometry_msgs/Point[] vertices\ngeometry_msgs/Point[] vertex_normals\nMeshTriangleIndices[] faces',
    'mesh_msgs/MeshGeometryStamped': 'Header header\nstring uuid\nMeshGeometry mesh_geometry',
    'mesh_msgs/TriangleMesh': '''MeshTriangleIndices[] triangles
geometry_msgs/Point[] vertices
geometry_msgs/Point[] vertex_normals
std_msgs/ColorRGBA[] vertex_colors''',
    'mesh_msgs/TriangleMeshStamped': 'Header header\nTriangleMesh mesh',
}


def _needed(name, own, found):
    """Adds the definition of a type, and those of all that it needs, to `found`."""
    if name in found:
        return
    found[name] = own.get(name) or roslib.message.get_message_class(name)._full_text.split(_SEPARATOR)[0]
    for kind in re.findall(r'^\s*([\w/]+)(?:\[\d*\])?\s+\w+\s*(?:#.*)?$', found[name], re.MULTILINE):
        if kind == 'Header':
            _needed('std_msgs/Header', own, found)
        elif kind[0].isupper():
            _needed(name.split('/')[0] + '/' + kind, own, found)
        elif '/' in kind:
            _needed(kind, own, found)


def _classes(name, own):
    """The classes of this type and of all that it needs, by their names without a package."""
    found = {}
    _needed(name, own, found)
    text = found.pop(name) + '\n' + ''.join(f'{_SEPARATOR}MSG: {other}\n{fields}' for other, fields in found.items())
    return SimpleNamespace(**{kind.split('/')[1]: made for kind, made in genpy.dynamic.generate_dynamic(name, text).items()})


def _moveit(collision_object):
    own = dict(_MOVEIT, **{'moveit_msgs/CollisionObject': collision_object})
    made = _classes('moveit_msgs/GetPlanningSceneResponse', own)
    made.GetPlanningScene = type('GetPlanningScene', (), {
        '_type': 'moveit_msgs/GetPlanningScene', '_md5sum': '2' * 32, '_response_class': made.GetPlanningSceneResponse,
        '_request_class': _classes('moveit_msgs/GetPlanningSceneRequest', own).GetPlanningSceneRequest})
    return made


moveit = _moveit(_SINCE_1_1)
moveit_before_1_1 = _moveit(_BEFORE_1_1)
pcl = _classes('pcl_msgs/PolygonMesh', _PCL)
MeshGeometryStamped = _classes('mesh_msgs/MeshGeometryStamped', _MESH).MeshGeometryStamped
TriangleMeshStamped = _classes('mesh_msgs/TriangleMeshStamped', _MESH).TriangleMeshStamped
