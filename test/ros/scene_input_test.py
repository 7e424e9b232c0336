#!/usr/bin/env python3
"""scene_input with what other programs publish, by their definitions, and beside it a guard that gets it all."""
import copy
import io
import os
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy
import roslib.packages
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from sensor_msgs.msg import PointCloud2, PointField
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive
from std_srvs.srv import Trigger
from sweep_guard.msg import DeformableMesh, MeshVertices
from sweep_guard.srv import Attach, AttachResponse
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', 'scene'))
import foreign_messages  # noqa: E402
import planning_scene_oracle  # noqa: E402

REFUSED_TOPICS = 'topics of /scene_input'
SCENE_TOPIC = '/move_group/monitored_planning_scene'
PATIENCE = 30.0  # [s] longer than any load delays an answer
TETRAHEDRON = numpy.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
OTHER_PUBLISHER = '''
import sys
import roslib.message
import rospy
class Connected(rospy.SubscribeListener):
    def peer_subscribe(self, *_):
        print('connected', flush=True)
rospy.init_node('other_publisher')
rospy.Publisher(sys.argv[1], roslib.message.get_message_class(sys.argv[2]), Connected(), queue_size=1)
rospy.spin()
'''


class Connected(rospy.SubscribeListener):
    def __init__(self):
        super().__init__()
        self.event = threading.Event()

    def peer_subscribe(self, *_):
        self.event.set()


class Workpieces:
    """What a guard knows of the workpieces from `mesh` and `mesh_vertices`, and what it says that it knows."""

    def __init__(self, namespace=''):
        self._lock = threading.Condition()
        self._meshes = {}
        self._positions = {}
        self.confirmed = {}  # times by id
        self.deformed = {}  # numbers by id
        self.known_to_guard = set()
        self.left_out = {}  # what the diagnostics of a topic say
        rospy.Subscriber(namespace + '/mesh', DeformableMesh, self._take_mesh, tcp_nodelay=True)
        rospy.Subscriber(namespace + '/mesh_vertices', MeshVertices, self._take_vertices, tcp_nodelay=True)
        rospy.Subscriber('/diagnostics', DiagnosticArray, self._take_diagnostics)

    def _take_mesh(self, mesh):
        with self._lock:
            self._meshes[mesh.id] = mesh
            self._positions.pop(mesh.id, None)
            self._lock.notify_all()

    def _take_vertices(self, vertices):
        with self._lock:
            mesh = self._meshes.get(vertices.id)
            if mesh is None or mesh.revision != vertices.revision or mesh.refused:
                return
            if vertices.positions:
                self._positions[vertices.id] = numpy.array(vertices.positions).reshape(-1, 3)
                self.deformed[vertices.id] = self.deformed.get(vertices.id, 0) + 1
            else:
                self.confirmed[vertices.id] = time.monotonic()
            self._lock.notify_all()

    def _take_diagnostics(self, array):
        for line in array.status:
            if 'scene_input: /' in line.name:
                with self._lock:
                    self.left_out[line.name.split(': ')[1]] = line.message
                    self._lock.notify_all()
            if line.name.endswith('sweep_guard: workpieces'):
                with self._lock:
                    self.known_to_guard = {value.key.strip("'") for value in line.values if value.value.startswith('revision ')}
                    self._lock.notify_all()

    def await_message(self):
        with self._lock:
            self._lock.wait(PATIENCE)

    def mesh(self, name):
        return self._meshes.get(name)

    def is_there(self, name):
        mesh = self.mesh(name)
        return mesh is not None and not mesh.refused and len(mesh.mesh.triangles) > 0

    def names(self):
        return sorted(name for name in list(self._meshes) if self.is_there(name))

    def vertices(self, name):
        if name in self._positions:
            return self._positions[name]
        return numpy.array([[p.x, p.y, p.z] for p in self._meshes[name].mesh.vertices])

    def refused(self, name):
        mesh = self.mesh(name)
        return mesh.refused if mesh else ''

    def wait(self, happens):
        end = time.monotonic() + PATIENCE
        with self._lock:
            while not happens():
                left = end - time.monotonic()
                if left <= 0:
                    return False
                self._lock.wait(left)
        return True


def pose(x=0.0, y=0.0, z=0.0, rotation=(0.0, 0.0, 0.0, 1.0)):
    return Pose(Point(x, y, z), Quaternion(*rotation))


def mesh_of(vertices, faces):
    return Mesh([MeshTriangle(list(face)) for face in faces], [Point(*vertex) for vertex in vertices])


def marker(kind, name='box', number=0, **fields):
    message = Marker(ns=name, id=number, type=kind, pose=pose(), scale=Vector3(1.0, 1.0, 1.0))
    message.header.frame_id = 'world'
    for field, value in fields.items():
        setattr(message, field, value)
    return message


def box(size):
    return SolidPrimitive(SolidPrimitive.BOX, list(size))


def object_of(name, size=None):
    return {'id': name, 'frame': 'world', 'operation': 'ADD', 'pose': planning_scene_oracle.IDENTITY,
            'primitives': [size] if size else [], 'primitive_poses': [planning_scene_oracle.IDENTITY] if size else [],
            'meshes': [], 'mesh_poses': []}


def full_scene(sizes):
    return {'type': 'scene', 'is_diff': False, 'is_state_diff': False, 'names_joints': True, 'attached': [],
            'objects': [object_of(name, size) for name, size in sizes.items()]}


def is_published(step):
    """Whether it leaves out attached objects, which the guard would have to hold."""
    return step['type'] == 'object' or step['type'] == 'scene' and not step['attached']


def pose_message(numbers):
    return Pose(Point(*numbers[:3]), Quaternion(*numbers[3:]))


def object_message(step):
    moveit = foreign_messages.moveit
    message = moveit.CollisionObject(id=step['id'], operation=getattr(moveit.CollisionObject, step['operation']))
    message.header.frame_id = step['frame']
    message.pose = pose_message(step['pose'])
    message.primitives = [box(size) for size in step['primitives']]
    message.meshes = [mesh_of(*surface) for surface in step['meshes']]
    message.primitive_poses = [pose_message(one) for one in step['primitive_poses']]
    message.mesh_poses = [pose_message(one) for one in step['mesh_poses']]
    return message


def scene_message(step):
    moveit = foreign_messages.moveit
    message = moveit.PlanningScene(is_diff=step['is_diff'])
    message.robot_state = moveit.RobotState(is_diff=step['is_state_diff'])
    message.robot_state.joint_state.name = ['joint'] if step['names_joints'] else []
    message.world.collision_objects = [object_message(one) for one in step['objects']]
    message.robot_state.attached_collision_objects = [
        moveit.AttachedCollisionObject(link_name=one['link'], object=object_message(one['object'])) for one in step['attached']]
    return message


class MoveGroup:
    """A stand-in that publishes its planning scene, and answers for the whole of it."""

    def __init__(self, test, namespace='', topic=SCENE_TOPIC):
        self.oracle = planning_scene_oracle.Oracle(awaits_full_scene=False)
        self.asked = threading.Event()
        self.may_answer = threading.Event()
        self.may_answer.set()
        self._test = test
        self._service = rospy.Service(namespace + '/get_planning_scene', foreign_messages.moveit.GetPlanningScene, self._answer)
        self._publisher = test.publisher(topic, foreign_messages.moveit.PlanningScene)

    def _answer(self, _):
        scene = full_scene({})
        scene['objects'] = [dict(object_of(name), frame=thing.frame, pose=thing.pose, meshes=[one for one, _ in thing.shapes],
                                 mesh_poses=[where for _, where in thing.shapes]) for name, thing in self.oracle.world.items()]
        self.asked.set()
        self.may_answer.wait(PATIENCE)
        return foreign_messages.moveit.GetPlanningSceneResponse(scene_message(scene))

    def step(self, step):
        """Takes a step as move_group does: what it refuses changes nothing, and is not published."""
        if step['type'] == 'object':
            step = {'type': 'scene', 'is_diff': True, 'is_state_diff': True, 'names_joints': False, 'attached': [],
                    'objects': [step['object']]}
        after = copy.deepcopy(self.oracle)
        after.apply(step)
        if not after.refused and not after.needs_full_scene:
            self.oracle = after
            self._publisher.publish(scene_message(step))

    def publish_diff(self, step):
        """Publishes an object whatever it builds on."""
        self._publisher.publish(scene_message({'type': 'scene', 'is_diff': True, 'is_state_diff': True, 'names_joints': False,
                                               'attached': [], 'objects': [step]}))

    def publish(self, message):
        self._publisher.publish(message)

    def publish_filler(self, size):
        message = foreign_messages.moveit.PlanningScene(is_diff=True, name='x' * size)
        message.robot_state.is_diff = True
        self._publisher.publish(message)

    def end(self):
        self.may_answer.set()
        self._service.shutdown()
        self._publisher.unregister()


class StandIn:
    """Stands in for a guard that attaches workpieces: keeps what it is asked, and answers as one that holds them."""

    def __init__(self, test, namespace):
        self._lock = threading.Condition()
        self._held = {}
        self.asked = []
        service = rospy.Service(namespace + '/guard/attach', Attach, self._answer)
        test.addCleanup(service.shutdown)

    def _answer(self, request):
        with self._lock:
            self.asked.append((request.mesh_id, request.link if request.attach else None))
            self._lock.notify_all()
            if request.attach and request.mesh_id in self._held:
                return AttachResponse(False, f"'{request.mesh_id}' is attached already: detach it first")
            if not request.attach and request.mesh_id not in self._held:
                return AttachResponse(False, f"'{request.mesh_id}' is not attached")
            if request.attach:
                self._held[request.mesh_id] = request.link
            else:
                del self._held[request.mesh_id]
            return AttachResponse(True, '')

    def await_any(self, asked):
        """That it is asked this at some time."""
        with self._lock:
            assert self._lock.wait_for(lambda: asked in self.asked, PATIENCE), self.asked

    def await_asked(self, *asked):
        """The next questions."""
        with self._lock:
            is_asked = self._lock.wait_for(lambda: len(self.asked) >= len(asked), PATIENCE)
            assert is_asked and self.asked[:len(asked)] == list(asked), self.asked
            del self.asked[:len(asked)]


class SceneTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.workpieces = Workpieces()

    def publisher(self, topic, kind):
        listener = Connected()
        publisher = rospy.Publisher(topic, kind, listener, queue_size=0, latch=True)  # who asks for the definition connects, too
        self.addCleanup(publisher.unregister)
        self.assertTrue(listener.event.wait(PATIENCE), topic)
        return publisher

    def start(self, command):
        """Returns a process that ends with the test."""
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)

        def end():
            process.terminate()
            process.communicate()
        self.addCleanup(end)
        return process

    def start_scene_input(self, namespace, scene):
        """Starts one with topics and a guard of its own; this test hears it from now on."""
        self.workpieces = Workpieces(namespace)
        program, = roslib.packages.find_node('sweep_guard', 'scene_input')
        self.start([program, '__ns:=' + namespace, '_scene:=' + scene, '_guard:=guard'])

    def eventually(self, happens):
        """Looks again with each message; diagnostics come once a second."""
        end = time.monotonic() + PATIENCE
        while not happens():
            if time.monotonic() > end:
                return False
            self.workpieces.await_message()
        return True

    def move_group(self, *args):
        move_group = MoveGroup(self, *args)
        self.addCleanup(move_group.end)
        return move_group

    def deform(self, name, publish):
        """Publishes until positions come without a mesh."""
        def is_deformed():
            publish()
            return self.workpieces.deformed.get(name, 0) > 0
        self.assertTrue(self.eventually(is_deformed))

    def await_there(self, name):
        self.assertTrue(self.workpieces.wait(lambda: self.workpieces.is_there(name)), (name, self.workpieces.refused(name)))
        return self.workpieces.mesh(name)

    def await_confirmed(self, name):
        before = time.monotonic()
        self.assertTrue(self.workpieces.wait(lambda: self.workpieces.confirmed.get(name, 0.0) > before), name)

    def await_while_table_rests(self, seconds):
        """Waits until the table has been confirmed so long from now."""
        end = time.monotonic() + seconds
        self.assertTrue(self.workpieces.wait(lambda: self.workpieces.confirmed['table'] > end))

    def await_gone(self, name):
        self.assertTrue(self.workpieces.wait(lambda: not self.workpieces.is_there(name) and not self.workpieces.refused(name)), name)

    def await_refused(self, name, words):
        self.assertTrue(self.workpieces.wait(lambda: words in self.workpieces.refused(name)), self.workpieces.refused(name))

    def await_topic_refused(self, topic, words):
        self.await_refused(REFUSED_TOPICS, topic + ': ' + words)

    def await_topic_taken(self, topic):
        self.assertTrue(self.workpieces.wait(lambda: f' {topic}:' not in ' ' + self.workpieces.refused(REFUSED_TOPICS)),
                        self.workpieces.refused(REFUSED_TOPICS))

    def await_bounds(self, name, low, high):
        def fits():
            if not self.workpieces.is_there(name):
                return False
            vertices = self.workpieces.vertices(name)
            return numpy.allclose(vertices.min(axis=0), low, atol=1e-5) and numpy.allclose(vertices.max(axis=0), high, atol=1e-5)
        self.assertTrue(self.workpieces.wait(fits), (name, self.workpieces.is_there(name) and self.workpieces.vertices(name)))


class Cut:
    """A message that is sent without its end."""

    def serialize(self, buff):
        whole = io.BytesIO()
        super().serialize(whole)
        buff.write(whole.getvalue()[:-1])


class CutMesh(Cut, Mesh):
    pass


class CutMarker(Cut, Marker):
    pass


class SceneInputTest(SceneTest):
    def test_shapes_of_the_scene_are_where_it_says(self):
        self.assertEqual(self.await_there('table').header.frame_id, 'base')
        self.await_bounds('table', (0.0, -0.4, -0.1), (1.0, 0.4, 0.0))
        self.await_bounds('ground', (-10.0, -10.0, -2.0), (10.0, 10.0, -1.0))
        self.await_there('post')
        self.assertAlmostEqual(self.workpieces.vertices('post')[:, 1].max(), 1.0, 6)
        self.await_there('ball')
        distances = numpy.linalg.norm(self.workpieces.vertices('ball') - (0.0, 0.0, 1.0), axis=1)
        self.assertGreaterEqual(distances.min(), 0.5)
        self.assertLess(distances.max(), 0.51)

    def test_a_file_of_each_format_has_the_scale_and_the_place_of_the_scene_and_the_guard_knows_it(self):
        files = {'block': ('moving', (0.0, 0.0, 0.0), (0.1, 0.1, 0.1)), 'ply': ('base', (0.0, 0.0, 0.0), (0.1, 0.2, 0.3)),
                 'gltf': ('world', (0.0, 0.0, 1.0), (0.1, 0.2, 1.3)), 'obj': ('world', (0.0, 0.0, 0.0), (0.1, 0.4, 0.3)),
                 'dae': ('world', (0.0, -0.3, 0.0), (0.1, 0.0, 0.2))}
        for name, (frame, low, high) in files.items():
            self.assertEqual(self.await_there(name).header.frame_id, frame)
            self.await_bounds(name, low, high)
        self.assertTrue(self.workpieces.wait(lambda: self.workpieces.known_to_guard.issuperset(files)), self.workpieces.known_to_guard)

    def test_what_rests_is_confirmed_all_the_time(self):
        self.await_there('table')
        for _ in range(3):
            before = time.monotonic()
            self.assertTrue(self.workpieces.wait(lambda: self.workpieces.confirmed.get('table', 0.0) > before))

    def test_a_mesh_without_a_header_is_in_the_frame_of_the_scene_and_deforms(self):
        publisher = self.publisher('/mesh_without_header', Mesh)
        publisher.publish(mesh_of(TETRAHEDRON, FACES))
        self.assertEqual(self.await_there('surface').header.frame_id, 'camera')
        self.deform('surface', lambda: publisher.publish(mesh_of(TETRAHEDRON + (0.0, 0.0, 2.0), FACES)))
        self.await_bounds('surface', (0.0, 0.0, 2.0), (1.0, 1.0, 3.0))
        publisher.publish(mesh_of(TETRAHEDRON, FACES[1:]))
        self.assertTrue(self.workpieces.wait(lambda: len(self.workpieces.mesh('surface').mesh.triangles) == 3))

    def test_triangles_of_a_marker_share_vertices_and_follow_pose_and_scale(self):
        publisher = self.publisher('/marker', Marker)
        corners = [Point(*TETRAHEDRON[corner]) for face in FACES for corner in face]
        publisher.publish(marker(Marker.TRIANGLE_LIST, 'cloth', 7, points=corners, pose=pose(z=1.0), scale=Vector3(2.0, 1.0, 1.0)))
        mesh = self.await_there('cloth/7')
        self.assertEqual((len(mesh.mesh.vertices), len(mesh.mesh.triangles)), (4, 4))
        self.await_bounds('cloth/7', (0.0, 0.0, 1.0), (2.0, 1.0, 2.0))
        moved = marker(Marker.TRIANGLE_LIST, 'cloth', 7, points=corners, pose=pose(z=3.0))
        self.deform('cloth/7', lambda: publisher.publish(moved))
        self.await_bounds('cloth/7', (0.0, 0.0, 3.0), (1.0, 1.0, 4.0))
        publisher.publish(marker(Marker.TRIANGLE_LIST, 'cloth', 7, action=Marker.DELETE))
        self.await_gone('cloth/7')

    def test_shapes_and_files_of_markers_are_workpieces_until_their_lifetime_ends(self):
        publisher = self.publisher('/marker', Marker)
        publisher.publish(marker(Marker.CUBE, 'a', scale=Vector3(1.0, 2.0, 3.0)))
        publisher.publish(marker(Marker.SPHERE, 'b', scale=Vector3(1.0, 2.0, 3.0)))
        publisher.publish(marker(Marker.CYLINDER, 'c', scale=Vector3(1.0, 2.0, 3.0), lifetime=rospy.Duration(0.5)))
        publisher.publish(marker(Marker.MESH_RESOURCE, 'd', scale=Vector3(0.01, 0.01, 0.01),
                                 mesh_resource='package://sweep_guard/test/ros/block.stl'))
        publisher.publish(marker(Marker.ARROW, 'e'))
        publisher.publish(marker(Marker.MESH_RESOURCE, 'f', mesh_resource='package://sweep_guard/none.stl'))
        self.await_bounds('a/0', (-0.5, -1.0, -1.5), (0.5, 1.0, 1.5))
        self.await_bounds('d/0', (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
        self.await_there('b/0')
        self.await_refused('f/0', 'no such file')
        self.await_gone('c/0')
        self.assertIsNone(self.workpieces.mesh('e/0'))
        publisher.publish(marker(Marker.CUBE, action=3))
        for name in ('a/0', 'b/0', 'd/0', 'f/0'):
            self.await_gone(name)

    def test_markers_of_which_some_are_dropped_are_refused_until_their_publisher_connects_anew(self):
        large = tempfile.NamedTemporaryFile(suffix='.ply')  # takes a while, and is refused then
        self.addCleanup(large.close)
        large.write(b'ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\nproperty char z\n'
                    b'element face 1\nproperty list uint uchar vertex_indices\nend_header\n' + struct.pack('<3xI', 1000003) + bytes(1000003))
        large.flush()
        publisher = self.publisher('/markers', MarkerArray)
        publisher.publish(MarkerArray([marker(Marker.MESH_RESOURCE, 'wall', number, mesh_resource='file://' + large.name)
                                       for number in range(20)]))
        for _ in range(70):
            publisher.publish(MarkerArray([marker(Marker.ARROW, 'wall', text='x' * (4 << 20))]))  # together more than may wait
        self.await_topic_refused('/markers', 'messages come faster than they can be read')
        self.await_refused('wall/19', 'more than a million triangles')
        publisher.publish(MarkerArray([marker(Marker.CUBE, 'box', 3)]))
        self.await_there('box/3')
        self.assertIn('/markers: messages come faster', self.workpieces.refused(REFUSED_TOPICS))
        publisher.unregister()
        self.publisher('/markers', MarkerArray).publish(MarkerArray([marker(Marker.CUBE, action=3)]))
        self.await_topic_taken('/markers')
        self.await_gone('box/3')

    def test_of_an_array_the_namespaces_that_are_named_count(self):
        publisher = self.publisher('/markers', MarkerArray)
        publisher.publish(MarkerArray([marker(Marker.CUBE, 'wall', 1), marker(Marker.CUBE, 'text', 1), marker(Marker.CUBE, 'box', 2)]))
        self.await_there('wall/1')
        self.await_there('box/2')
        self.assertIsNone(self.workpieces.mesh('text/1'))
        publisher.publish(MarkerArray([marker(Marker.CUBE, action=3)]))
        self.await_gone('wall/1')

    def test_more_markers_than_workpieces_can_be_are_refused(self):
        publisher = self.publisher('/markers', MarkerArray)
        publisher.publish(MarkerArray([marker(Marker.CUBE, 'box', number) for number in range(10000)]))
        self.await_refused('/markers/too many', 'more than 1000 markers')
        publisher.publish(MarkerArray([marker(Marker.CUBE, action=3)]))
        self.await_gone('/markers/too many')

    def test_a_polygon_mesh_of_a_cloud(self):
        message = foreign_messages.pcl.PolygonMesh()
        message.header.frame_id = 'camera'
        message.cloud = PointCloud2(height=1, width=4, point_step=16, row_step=64, data=b''.join(
            struct.pack('<4f', *vertex, 0.0) for vertex in TETRAHEDRON))
        message.cloud.fields = [PointField(axis, 4 * i, PointField.FLOAT32, 1) for i, axis in enumerate('xyz')]
        message.polygons = [foreign_messages.pcl.Vertices(list(face)) for face in FACES]
        publisher = self.publisher('/polygons', foreign_messages.pcl.PolygonMesh)
        publisher.publish(message)
        self.assertEqual(self.await_there('polygons').header.frame_id, 'camera')
        self.await_bounds('polygons', (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
        message.cloud.width = 5
        publisher.publish(message)
        self.await_topic_refused('/polygons', 'the cloud is big-endian, or its sizes do not fit its data')

    def test_both_meshes_of_mesh_msgs(self):
        geometry = foreign_messages.MeshGeometryStamped()
        geometry.header.frame_id = 'map'
        geometry.mesh_geometry.vertices = [Point(*vertex) for vertex in TETRAHEDRON]
        geometry.mesh_geometry.faces = [MeshTriangle(list(face)) for face in FACES]
        self.publisher('/geometry', foreign_messages.MeshGeometryStamped).publish(geometry)
        self.await_bounds('/geometry', (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
        stamped = foreign_messages.TriangleMeshStamped()
        stamped.header.frame_id = 'map'
        stamped.mesh.vertices = geometry.mesh_geometry.vertices
        stamped.mesh.triangles = geometry.mesh_geometry.faces
        self.publisher('/triangle_mesh', foreign_messages.TriangleMeshStamped).publish(stamped)
        self.await_bounds('/triangle_mesh', (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))

    def test_collision_objects_of_both_versions(self):
        for topic, version, has_pose in (('/collision_object', foreign_messages.moveit, True),
                                         ('/old_collision_object', foreign_messages.moveit_before_1_1, False)):
            publisher = self.publisher(topic, version.CollisionObject)
            name = topic[1:]
            message = version.CollisionObject(id=name)
            message.header.frame_id = 'base'
            message.primitives = [box((0.2, 0.2, 0.2)), SolidPrimitive(SolidPrimitive.CYLINDER, [1.0, 0.1])]
            message.primitive_poses = [pose(z=1.0), pose(z=1.0)]
            message.planes = [Plane([0.0, 0.0, 1.0, 1.0])]
            message.plane_poses = [pose()]
            if has_pose:
                message.pose = pose(x=1.0)
            publisher.publish(message)
            self.await_there(name)
            x = 1.0 if has_pose else 0.0
            self.await_bounds(name, (x - 10.0, -10.0, -2.0), (x + 10.0, 10.0, 1.5))
            message.operation = version.CollisionObject.REMOVE
            publisher.publish(message)
            self.await_gone(name)

    def test_a_workpiece_that_was_sent_once_may_outlive_its_publisher(self):
        once, ends = self.publisher('/sent_once', Mesh), self.publisher('/ends', Mesh)
        for publisher in (once, ends):
            publisher.publish(mesh_of(TETRAHEDRON, FACES))
        for name in ('once', 'ends'):
            self.await_there(name)
            self.assertTrue(self.workpieces.wait(lambda name=name: name in self.workpieces.confirmed))
            (once if name == 'once' else ends).unregister()
        def only_one_is_confirmed():
            return self.workpieces.confirmed['once'] > self.workpieces.confirmed['ends'] + 1.0
        self.assertTrue(self.workpieces.wait(only_one_is_confirmed))

    def test_what_streams_ages_once_it_is_silent(self):
        self.publisher('/streams', Mesh).publish(mesh_of(TETRAHEDRON, FACES))
        self.await_there('streams')
        self.await_while_table_rests(1.0)
        self.assertNotIn('streams', self.workpieces.confirmed)

    def test_when_one_of_several_publishers_ends_its_workpieces_age_until_a_message_comes(self):
        publisher = self.publisher('/ends', Mesh)
        other = self.start([sys.executable, '-c', OTHER_PUBLISHER, '/ends', 'shape_msgs/Mesh'])
        self.assertEqual(other.stdout.readline(), 'connected\n')
        publisher.publish(mesh_of(TETRAHEDRON, FACES))
        self.await_confirmed('ends')
        self.await_confirmed('ends')
        other.terminate()
        confirmed = self.workpieces.confirmed
        self.assertTrue(self.workpieces.wait(lambda: confirmed['table'] > confirmed['ends'] + 1.0))
        publisher.publish(mesh_of(TETRAHEDRON, FACES))
        self.await_confirmed('ends')

    def test_markers_do_not_end_while_nobody_publishes(self):
        publisher = self.publisher('/marker', Marker)
        publisher.publish(marker(Marker.CUBE, 'lasting', lifetime=rospy.Duration(3.0)))
        self.await_there('lasting/0')
        publisher.unregister()
        self.await_while_table_rests(4.0)
        self.assertTrue(self.workpieces.is_there('lasting/0'))
        self.publisher('/marker', Marker)
        self.await_gone('lasting/0')

    def test_a_marker_that_cannot_be_read_refuses_the_topic_until_its_publisher_connects_anew(self):
        publisher = self.publisher('/marker', Marker)
        publisher.publish(CutMarker())
        self.await_topic_refused('/marker', 'message is cut off')
        publisher.publish(marker(Marker.CUBE, 'after'))
        self.await_there('after/0')
        self.assertIn('/marker: message is cut off', self.workpieces.refused(REFUSED_TOPICS))
        publisher.unregister()
        self.publisher('/marker', Marker).publish(marker(Marker.CUBE, action=3))
        self.await_topic_taken('/marker')
        self.await_gone('after/0')

    def test_a_mesh_that_cannot_be_read_refuses_the_topic_until_the_next(self):
        publisher = self.publisher('/ends', Mesh)
        publisher.publish(CutMesh())
        self.await_topic_refused('/ends', 'message is cut off')
        publisher.publish(mesh_of(TETRAHEDRON, FACES))
        self.await_topic_taken('/ends')

    def test_what_has_moved_is_confirmed_when_it_rests_again(self):
        publisher = self.publisher('/mesh_without_header', Mesh)
        publisher.publish(mesh_of(TETRAHEDRON, FACES))
        self.deform('surface', lambda: publisher.publish(mesh_of(TETRAHEDRON + (0.0, 0.0, 4.0), FACES)))
        self.await_confirmed('surface')

    def test_an_id_that_is_no_name_is_refused(self):
        message = foreign_messages.moveit.CollisionObject(id='', primitives=[box((0.2, 0.2, 0.2))], primitive_poses=[pose()], pose=pose())
        message.header.frame_id = 'base'
        self.publisher('/collision_object', foreign_messages.moveit.CollisionObject).publish(message)
        self.await_refused('(no id)', 'its id is empty')

    def test_a_scene_that_is_loaded_again_takes_the_place_of_the_one_before(self):
        started = time.time()
        scene = tempfile.NamedTemporaryFile('w', suffix='.yaml')
        self.addCleanup(scene.close)

        def write(text):
            scene.seek(0)
            scene.truncate()
            scene.write(text)
            scene.flush()
        write('{a: {box: [1.0, 1.0, 1.0], open: true}, b: {sphere: 1.0}}')
        self.start_scene_input('/loaded', scene.name)
        self.assertTrue(self.await_there('a').open)
        self.assertGreaterEqual(self.await_there('b').revision, int(started), 'no revision of the scene_input before')
        load = rospy.ServiceProxy('/loaded/scene_input/load_scene', Trigger)
        load.wait_for_service(PATIENCE)
        write('{a: {box: [1.0, 1.0, 1.0]}, c: {sphere: 1.0}}')
        self.assertEqual(load().message, '2 workpieces')
        self.await_there('c')
        self.await_gone('b')
        self.assertTrue(self.workpieces.wait(lambda: not self.workpieces.mesh('a').open))
        for text, why in (('{d: {sphere: 1.0}, environment: [{topic: /new}]}', 'the topics under `environment` have changed'),
                          ('{d: {sphere: 1.0}', scene.name)):
            write(text)
            answer = load()
            self.assertFalse(answer.success)
            self.assertIn(why, answer.message)
        self.await_confirmed('c')
        self.assertEqual(self.workpieces.names(), ['a', 'c'])

    def test_a_publisher_of_another_type_refuses_the_topic_until_it_ends(self):
        self.publisher('/ends', Mesh).publish(mesh_of(TETRAHEDRON, FACES))
        self.await_there('ends')
        other = self.start(['rostopic', 'pub', '/ends', 'std_msgs/Empty'])
        self.await_refused(REFUSED_TOPICS, ' sends std_msgs/Empty, other publishers shape_msgs/Mesh: give each a topic')
        other.terminate()
        self.await_topic_taken('/ends')

    def test_a_publisher_of_another_version_is_heard_once_the_first_has_ended(self):
        for version, name in ((foreign_messages.moveit_before_1_1, 'old'), (foreign_messages.moveit, 'new')):
            message = version.CollisionObject(id=name, primitives=[box((0.2, 0.2, 0.2))], primitive_poses=[pose()])
            message.header.frame_id = 'base'
            publisher = self.publisher('/old_collision_object', version.CollisionObject)
            publisher.publish(message)
            self.await_there(name)
            publisher.unregister()

    def test_an_id_that_two_sources_give_is_refused(self):
        self.await_there('table')
        publisher = self.publisher('/again', Mesh)
        publisher.publish(mesh_of(TETRAHEDRON, FACES))
        self.await_refused('table', 'both /again and the scene give it')
        publisher.publish(Mesh())
        self.assertTrue(rospy.ServiceProxy('/scene_input/load_scene', Trigger)().success)
        self.await_there('table')

    def test_what_describes_no_workpieces_is_refused_and_so_are_the_markers_of_a_guard(self):
        self.publisher('/odometry', PointField).publish(PointField())
        self.await_topic_refused('/odometry', 'messages of type sensor_msgs/PointField describe no workpieces')
        self.await_topic_refused('/sweep_guard/markers', 'a guard publishes it')

    def test_a_planning_scene_is_refused_until_the_whole_of_it_is_known(self):
        self.await_topic_refused(SCENE_TOPIC, 'nobody has published it yet')
        publisher = self.publisher(SCENE_TOPIC, foreign_messages.moveit.PlanningScene)
        self.await_topic_refused(SCENE_TOPIC, 'the whole planning scene is not known: it is asked for at /get_planning_scene')
        publisher.unregister()
        move_group = self.move_group()
        move_group.oracle.apply(full_scene({'a': (0.2, 0.2, 0.2)}))
        self.await_bounds('a', (-0.1, -0.1, -0.1), (0.1, 0.1, 0.1))
        self.await_topic_taken(SCENE_TOPIC)

    def test_after_its_publisher_has_ended_a_planning_scene_is_refused_again(self):
        move_group = self.move_group()
        move_group.step(full_scene({'a': (0.2, 0.2, 0.2)}))
        self.await_confirmed('a')
        move_group.end()
        self.await_refused('a', 'the whole planning scene is not known')
        self.await_topic_refused(SCENE_TOPIC, 'the whole planning scene is not known')

    def test_the_diagnostics_say_that_an_octomap_is_left_out(self):
        move_group = self.move_group()
        message = scene_message(full_scene({}))
        message.world.octomap.octomap.data = [1]
        move_group.publish(message)
        self.assertTrue(self.eventually(lambda: 'an octomap is left out' in self.workpieces.left_out.get(SCENE_TOPIC, '')))

    def test_steps_that_are_dropped_while_it_waits_for_an_answer_are_asked_for(self):
        move_group = self.move_group()
        move_group.step(full_scene({'a': (0.2, 0.2, 0.2)}))
        self.await_there('a')
        move_group.asked.clear()
        move_group.may_answer.clear()
        move_group.publish_diff(dict(object_of('b'), operation='MOVE'))
        self.assertTrue(move_group.asked.wait(PATIENCE))
        move_group.step({'type': 'object', 'object': object_of('lost', (0.2, 0.2, 0.2))})
        for _ in range(70):
            move_group.publish_filler(4 << 20)  # together more than may wait
        self.await_topic_refused(SCENE_TOPIC, 'messages come faster than they can be read')
        move_group.may_answer.set()
        self.await_there('lost')

    def hold(self):
        """Starts a scene_input whose guard is a stand-in that holds 'held'; returns the guard, and what attaches and releases."""
        guard = StandIn(self, '/held')
        self.start_scene_input('/held', '{environment: [{topic: planning_scene}]}')
        move_group = self.move_group('/held', '/held/planning_scene')

        def attach(operation, link):
            held = object_of('held', (0.2, 0.2, 0.2))
            move_group.step({'type': 'scene', 'is_diff': True, 'is_state_diff': True, 'names_joints': False,
                             'objects': [held] if operation == 'REMOVE' else [],
                             'attached': [{'link': link, 'object': dict(held, operation=operation)}]})
        move_group.step(full_scene({}))
        self.await_gone('topics of /held/scene_input')
        attach('ADD', 'hand')
        guard.await_asked(('held', 'hand'))
        self.await_there('held')
        return guard, attach

    def test_what_the_robot_takes_with_another_link_is_detached_before_and_a_guard_that_starts_is_asked_again(self):
        guard, attach = self.hold()
        attach('ADD', 'arm')
        guard.await_asked(('held', None), ('held', 'arm'))
        self.await_gone('held (held)')
        before = self.workpieces.mesh('held (held)')
        self.start(['rostopic', 'echo', '/held/mesh/id'])  # it may be a guard, and this one holds it already
        guard.await_asked(('held', 'arm'))
        self.assertTrue(self.workpieces.wait(lambda: self.workpieces.mesh('held (held)') is not before))
        self.assertEqual(self.workpieces.refused('held (held)'), '')
        attach('REMOVE', 'arm')
        guard.await_asked(('held', None))

    def test_what_the_robot_releases_just_after_a_guard_has_started_is_detached(self):
        guard, attach = self.hold()
        listener = self.start(['rostopic', 'echo', '/held/mesh/id'])
        self.assertTrue(listener.stdout.readline())  # what the guard is asked again comes at most half a second later
        attach('REMOVE', 'hand')
        guard.await_any(('held', None))

    def test_what_the_robot_holds_is_refused_unless_the_guard_attaches_it(self):
        move_group = self.move_group()
        move_group.step(full_scene({'held': (0.2, 0.2, 0.2)}))
        self.await_there('held')
        move_group.step({'type': 'scene', 'is_diff': True, 'is_state_diff': True, 'names_joints': False, 'objects': [],
                         'attached': [{'link': 'hand', 'object': dict(object_of('held'), operation='ADD')}]})
        self.await_refused('held (held)', "held by the link 'hand', and not attached: ")

    def test_a_thousand_random_steps_leave_what_the_planning_scene_holds_and_so_does_the_guard(self):
        move_group = self.move_group()
        move_group.step(full_scene({}))
        for number, step in enumerate(step for step in planning_scene_oracle.random_steps(3000, 1) if is_published(step)):
            if number == 1000:
                break
            move_group.step(step)
            if number % 50 == 49:
                self.assertTrue(self.workpieces.wait(lambda: self.difference(move_group.oracle) is None), (number, self.difference(move_group.oracle)))
        self.assertEqual(number, 1000)
        ids = set(move_group.oracle.objects())
        self.assertTrue(self.eventually(lambda: {name for name in self.workpieces.known_to_guard if len(name) == 1} == ids))

    def difference(self, oracle):
        held = oracle.objects()
        names = [name for name in self.workpieces.names() if len(name) == 1]
        if names != sorted(held):
            return names, sorted(held)
        for name, (_, frame, (vertices, triangles)) in held.items():
            mesh = self.workpieces.mesh(name)
            known = self.workpieces.vertices(name)
            if mesh.header.frame_id != frame or [tuple(one.vertex_indices) for one in mesh.mesh.triangles] != list(triangles):
                return name, mesh.header.frame_id, frame
            if not numpy.allclose(known, numpy.array(vertices), atol=1e-5):
                return name, known, vertices
        return None


if __name__ == '__main__':
    rospy.init_node('scene_input_test')
    rostest.rosrun('sweep_guard', 'scene_input_test', SceneInputTest)
