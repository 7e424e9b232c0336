#!/usr/bin/env python3
"""The Python package beside a running guard."""
import os
import queue
import socket
import sys
import threading
import time
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy
import rosgraph
import rospy
import rostest
from sweep_guard import MeshPublisher, NotTested, check_sweep, is_clear, wait_for_clear
from sweep_guard.msg import DeformableMesh, MeshVertices, Warning
from sweep_guard.srv import CheckSweep, CheckSweepResponse

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', 'ros'))
from tool_poses import publish_tool_pose, tool_pose  # noqa: E402

PATIENCE = 60.0  # [s] longer than any load delays an answer
SOON = 0.3  # [s] until something has to be given up
TRIANGLE = numpy.array([[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.0, 0.1, 0.0]])
FACES = numpy.array([[0, 1, 2]])


def check(*heights, **options):
    return check_sweep([tool_pose(z) for z in heights], deadline=PATIENCE, **options)


def eventually(happens):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if happens():
            return True
    return False


class RunningGuardTest(unittest.TestCase):
    def publisher(self, name='sheet', **topics):
        publisher = MeshPublisher(name, 'world', **topics)
        self.addCleanup(publisher.remove)
        return publisher

    def known(self, name, known=True):
        def answers():
            try:
                check(0.5, mesh_ids=[name])
                return known
            except NotTested:
                return not known
        return eventually(answers)

    def publish_triangle(self):
        publisher = self.publisher()
        publisher.publish(TRIANGLE, FACES)
        self.assertTrue(self.known('sheet'))
        return publisher


class MeshPublisherTest(RunningGuardTest):
    def received(self, topic, kind):
        messages = queue.Queue()
        subscriber = rospy.Subscriber(topic, kind, messages.put)
        self.addCleanup(subscriber.unregister)
        return messages

    def test_a_workpiece_that_rests_is_confirmed_ten_times_a_second_and_cannot_deform(self):
        vertices = self.received('mesh_vertices', MeshVertices)
        publisher = self.publisher('table', rests=True)
        publisher.publish(TRIANGLE, FACES)
        for revision in (publisher.revision, publisher.revision + 1):
            message = next((one for one in (vertices.get(timeout=PATIENCE) for _ in range(100)) if one.revision == revision), None)
            self.assertIsNotNone(message, revision)
            self.assertEqual((message.id, message.header.frame_id, len(message.positions)), ('table', 'world', 0))
            publisher.publish(TRIANGLE, FACES)
        stamps = [vertices.get(timeout=PATIENCE).header.stamp for _ in range(11)]
        self.assertLess((stamps[-1] - stamps[0]).to_sec(), 5.0)  # a busy machine delays it
        with self.assertRaisesRegex(ValueError, "'table' rests: publish"):
            publisher.deform(TRIANGLE)

    def test_the_guard_knows_a_published_mesh(self):
        publisher = self.publish_triangle()
        met, = check(0.5, -0.5).objects
        self.assertEqual((met.mesh_id, met.revision, list(met.triangles)), ('sheet', publisher.revision, [0]))

    def test_the_guard_knows_a_mesh_with_vertices_and_faces(self):
        self.publisher('solid').publish(SimpleNamespace(vertices=TRIANGLE.tolist(), faces=FACES.tolist()))
        self.assertTrue(self.known('solid'))

    def test_the_guard_tests_deformed_vertices(self):
        publisher = self.publish_triangle()
        self.assertTrue(check(0.5, -0.5).collision)
        publisher.deform(TRIANGLE - [0.0, 0.0, 2.0])
        self.assertTrue(eventually(lambda: not check(0.5, -0.5).collision))
        self.assertTrue(check(-1.5, -2.5).collision)

    def test_the_guard_forgets_a_removed_workpiece(self):
        publisher = self.publish_triangle()
        publisher.remove()
        self.assertTrue(self.known('sheet', known=False))

    def test_a_workpiece_can_be_published_again_after_its_removal(self):
        publisher = self.publish_triangle()
        publisher.remove()
        self.assertTrue(self.known('sheet', known=False))
        publisher.publish(TRIANGLE, FACES)
        self.assertTrue(self.known('sheet'))

    def test_the_revision_counts_changes_of_the_triangles(self):
        publisher = self.publisher(mesh_topic='revised', vertices_topic='revised_vertices')
        square = numpy.vstack([TRIANGLE, [[0.1, 0.1, 0.0]]])
        revisions = []
        for vertices, faces in ((TRIANGLE, FACES), (TRIANGLE + 1.0, FACES), (square, FACES),
                                (square, [[0, 1, 2], [1, 3, 2]]), (square, [[0, 1, 2], [1, 3, 2]])):
            publisher.publish(vertices, faces)
            revisions.append(publisher.revision)
        self.assertEqual(revisions, [1, 1, 2, 3, 3])

    def test_messages_carry_the_arrays(self):
        meshes, updates = self.received('carried', DeformableMesh), self.received('carried_vertices', MeshVertices)
        publisher = self.publisher(mesh_topic='carried', vertices_topic='carried_vertices')
        stamp = rospy.Time(12, 34)
        publisher.publish(TRIANGLE, FACES, stamp=stamp)
        mesh = meshes.get(timeout=PATIENCE)
        self.assertEqual([[v.x, v.y, v.z] for v in mesh.mesh.vertices], TRIANGLE.tolist())
        self.assertEqual([list(t.vertex_indices) for t in mesh.mesh.triangles], FACES.tolist())
        self.assertEqual((mesh.id, mesh.revision, mesh.header.frame_id, mesh.header.stamp), ('sheet', 1, 'world', stamp))
        self.assertFalse(mesh.open)
        while updates.empty():
            publisher.deform(TRIANGLE + 1.0, stamp=stamp)
        update = updates.get()
        self.assertEqual(list(update.positions), (TRIANGLE + 1.0).astype(numpy.float32).ravel().tolist())
        self.assertEqual((update.id, update.revision, update.header.frame_id, update.header.stamp),
                         ('sheet', 1, 'world', stamp))

    def test_a_surface_without_an_inside_is_said_to_be_open(self):
        meshes = self.received('carried', DeformableMesh)
        self.publisher(mesh_topic='carried', open=True).publish(TRIANGLE, FACES)
        mesh = meshes.get(timeout=PATIENCE)
        self.assertTrue(mesh.open)
        self.assertEqual([list(t.vertex_indices) for t in mesh.mesh.triangles], FACES.tolist())

    def test_a_late_subscriber_receives_every_workpiece_of_the_node(self):
        publishers = [self.publisher(name, mesh_topic='late') for name in ('gone', 'left', 'right')]
        for publisher in publishers:
            publisher.publish(TRIANGLE, FACES)
        publishers[0].remove()
        meshes = self.received('late', DeformableMesh)
        self.assertEqual([meshes.get(timeout=PATIENCE).id for _ in range(2)], ['left', 'right'])

    def test_bad_input_is_refused_before_anything_is_sent(self):
        meshes, updates = self.received('refused', DeformableMesh), self.received('refused_vertices', MeshVertices)
        publisher = self.publisher(mesh_topic='refused', vertices_topic='refused_vertices')
        hole, far = TRIANGLE.copy(), TRIANGLE.copy()
        hole[1, 2], far[2, 0] = numpy.nan, 1e8
        for vertices, faces, text in (
                (TRIANGLE[:, :2], FACES, r'vertices have shape \(3, 2\): give x, y, z'),
                (TRIANGLE.ravel(), FACES, r'vertices have shape \(9,\)'),
                (numpy.zeros((0, 3)), FACES, r'vertices have shape \(0, 3\)'),
                (TRIANGLE.astype(str), FACES, 'vertices have dtype <U.*: give real numbers'),
                (hole, FACES, 'vertex 1 is .*nan.*: give finite'),
                (far, FACES, 'vertex 2 is .*: give finite meters, at most 1e7'),
                (TRIANGLE, [[0, 1, 2, 2]], r'faces have shape \(1, 4\): give three .*cut other polygons'),
                (TRIANGLE, numpy.zeros((0, 3), int), r'faces have shape \(0, 3\)'),
                (TRIANGLE, FACES.astype(float), 'faces have dtype float64: give 0-based integer'),
                (TRIANGLE, [[0, 1, 2], [0, 1, 3]], 'face 1 is .*: there are only the vertices 0 to 2'),
                (TRIANGLE, [[-1, 0, 1]], r'face 0 is \[-1'),
                (TRIANGLE, None, 'give vertices and faces')):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                publisher.publish(vertices, faces)
        with self.assertRaisesRegex(ValueError, "'sheet' is not published"):
            publisher.deform(TRIANGLE)
        publisher.publish(TRIANGLE, FACES)
        for vertices, text in ((TRIANGLE[:2], "2 vertices, but 'sheet' has 3"), (hole, 'vertex 1 is'), ([], 'shape')):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                publisher.deform(vertices)
        while updates.empty():
            publisher.deform(TRIANGLE)
        self.assertEqual(list(updates.get().positions), TRIANGLE.astype(numpy.float32).ravel().tolist())
        self.assertEqual(meshes.get(timeout=PATIENCE).revision, 1)
        self.assertTrue(meshes.empty())

    def test_vertices_that_float32_makes_coarse_are_said_at_the_sender(self):
        publisher = self.publisher(mesh_topic='coarse', vertices_topic='coarse_vertices')
        publisher.publish(TRIANGLE, FACES)
        for at in ([5.0, 0.0, 0.0], [16e3, 0.0, 0.0]):
            with self.subTest(at), mock.patch('rospy.logwarn_throttle') as log:
                publisher.deform(TRIANGLE + at)
                log.assert_not_called()
        for at, text in (([30e3, 30e3, 0.0], '1.4 mm'), ([130e3, 0.0, 0.0], '3.9 mm'), ([0.0, 0.0, -200e3], '7.8 mm')):
            with self.subTest(at), mock.patch('rospy.logwarn_throttle') as log:
                publisher.deform(TRIANGLE + at)
                self.assertRegex(log.call_args[0][1], f"'sheet' by up to {text}: send them in a frame near")
        for at, text in (([500e3, 4000e3, 0.0], '126.0 mm'), ([0.0, 0.0, 270e3], '15.6 mm')):
            with self.subTest(at), self.assertRaisesRegex(ValueError, f"'sheet' by up to {text}"):
                publisher.deform(TRIANGLE + at)

    def test_names_that_the_guard_would_refuse_are_refused(self):
        for name, frame in (('', 'world'), ('sheet', ''), ('a' * 129, 'world'), ('a\nb', 'world')):
            with self.subTest(name + frame), self.assertRaisesRegex(ValueError, 'give 1 to 128 printable'):
                MeshPublisher(name, frame)


class CheckSweepTest(RunningGuardTest):
    def serve(self, name, answer):
        service = rospy.Service(name + '/check_sweep', CheckSweep, answer)
        self.addCleanup(service.shutdown)

    def test_finds_a_contact(self):
        self.publish_triangle()
        answer = check(1.0, 0.5, -0.5)
        self.assertTrue(answer.collision)
        self.assertEqual(answer.segment, 1)
        self.assertFalse(answer.clear)

    def test_finds_a_free_path(self):
        self.publish_triangle()
        self.assertTrue(check(1.0, 0.5).clear)

    def test_tests_the_workpieces_that_are_named(self):
        self.publish_triangle()
        self.publisher('far').publish(TRIANGLE + 10.0, FACES)
        self.assertTrue(self.known('far'))
        self.assertTrue(check(0.5, -0.5, mesh_ids=['far']).clear)

    def test_a_margin_grows_the_tool(self):
        self.publish_triangle()
        self.assertTrue(check(1.0, 0.5, margin=1.0).collision)

    def test_a_path_that_is_not_tested_is_an_error(self):
        self.publish_triangle()
        with self.assertRaisesRegex(NotTested, "no workpiece 'nobody'"):
            check(0.5, mesh_ids=['nobody'])

    def test_a_guard_that_does_not_answer_is_given_up(self):
        answered = threading.Event()
        self.addCleanup(answered.set)
        self.serve('stuck', lambda request: answered.wait() and CheckSweepResponse())
        with self.assertRaisesRegex(TimeoutError, f'/stuck/check_sweep gave no answer within {SOON} s'):
            check_sweep([tool_pose(0.5)], deadline=SOON, guard='stuck')

    def test_a_process_that_is_frozen_is_given_up(self):
        with socket.create_server(('127.0.0.1', 0)) as frozen:
            master = rosgraph.Master('/frozen')
            place = f'rosrpc://127.0.0.1:{frozen.getsockname()[1]}'
            master.registerService('/frozen/check_sweep', place, 'http://127.0.0.1:1')
            self.addCleanup(master.unregisterService, '/frozen/check_sweep', place)
            with self.assertRaisesRegex(TimeoutError, '/frozen/check_sweep gave no answer'):
                check_sweep([tool_pose(0.5)], deadline=SOON, guard='frozen')

    def test_a_guard_that_is_not_there_is_given_up(self):
        with self.assertRaisesRegex(TimeoutError, '/nobody/check_sweep gave no answer.*: no node offers it'):
            check_sweep([tool_pose(0.5)], deadline=SOON, guard='nobody')

    def test_a_guard_that_starts_meanwhile_answers(self):
        serving = threading.Timer(SOON, self.serve, ['late', lambda request: CheckSweepResponse(success=True)])
        serving.start()
        self.addCleanup(serving.join)
        self.assertTrue(check_sweep([tool_pose(0.5)], deadline=PATIENCE, guard='late').success)

    def test_a_guard_that_is_busy_is_asked_again(self):
        answers = iter([CheckSweepResponse(message='BUSY: 4 calls wait'), CheckSweepResponse(success=True)])
        self.serve('busy', lambda request: next(answers))
        self.assertTrue(check_sweep([tool_pose(0.5)], deadline=PATIENCE, guard='busy').success)

    def test_a_guard_that_stays_busy_is_given_up(self):
        self.serve('busier', lambda request: CheckSweepResponse(message='BUSY: 4 calls wait'))
        with self.assertRaisesRegex(TimeoutError, 'BUSY: 4 calls wait'):
            check_sweep([tool_pose(0.5)], deadline=SOON, guard='busier')

    def test_a_roscore_that_is_frozen_is_given_up(self):
        with socket.create_server(('127.0.0.1', 0)) as frozen, \
                mock.patch.dict('os.environ', ROS_MASTER_URI=f'http://127.0.0.1:{frozen.getsockname()[1]}'), \
                self.assertRaisesRegex(TimeoutError, 'no roscore answers'):
            check_sweep([tool_pose(0.5)], deadline=SOON)

    def test_no_roscore_is_given_up(self):
        with mock.patch.dict('os.environ', ROS_MASTER_URI='http://127.0.0.1:1'), \
                self.assertRaisesRegex(TimeoutError, 'no roscore answers at http://127.0.0.1:1'):
            check_sweep([tool_pose(0.5)], deadline=SOON)

    def test_an_error_of_the_server_is_an_error(self):
        def fail(request):
            raise rospy.ServiceException('out of order')
        self.serve('broken', fail)
        with self.assertRaisesRegex(rospy.ServiceException, 'out of order'):
            check_sweep([tool_pose(0.5)], deadline=PATIENCE, guard='broken')


class WaitForClearTest(RunningGuardTest):
    def warn(self, guard, **fields):
        publisher = rospy.Publisher(guard + '/warning', Warning, queue_size=1, latch=True)
        publisher.publish(Warning(**fields))
        self.addCleanup(publisher.unregister)

    def wait_for_unknown(self):
        self.assertTrue(eventually(lambda: rospy.wait_for_message('sweep_guard/warning', Warning).level == Warning.UNKNOWN))

    def test_returns_a_warning_that_is_clear(self):
        self.publish_triangle()
        publish_tool_pose(self, z=0.5, rate=50)
        warning = wait_for_clear(PATIENCE)
        self.assertEqual((warning.level, warning.clear), (Warning.CLEAR, True))

    def test_says_why_nothing_is_clear(self):
        self.publish_triangle()
        self.wait_for_unknown()
        with self.assertRaisesRegex(TimeoutError, f'not clear within {SOON + 1} s: .*pose'):
            wait_for_clear(SOON + 1)

    def test_silence_is_not_clear(self):
        with self.assertRaisesRegex(TimeoutError, 'no warning arrived on /silent/warning'):
            wait_for_clear(SOON, guard='silent')

    def test_a_warning_that_is_no_longer_valid_is_not_clear(self):
        self.warn('stale', clear=True, text='clear', valid_until=rospy.Time.now())
        with self.assertRaisesRegex(TimeoutError, "the last warning, 'clear', is no longer valid"):
            wait_for_clear(SOON + 1, guard='stale')

    def test_a_warning_is_clear_until_it_is_no_longer_valid(self):
        self.warn('fresh', clear=True, valid_until=rospy.Time.now() + rospy.Duration(PATIENCE))
        self.assertTrue(is_clear(wait_for_clear(PATIENCE, guard='fresh')))

    def test_only_the_field_clear_permits(self):
        valid_until = rospy.Time.now() + rospy.Duration(PATIENCE)
        self.assertFalse(is_clear(Warning(level=Warning.CLEAR, valid_until=valid_until)))
        self.assertFalse(is_clear(Warning()))

    def test_nothing_is_clear_before_the_clock_is_known(self):
        with mock.patch('rospy.Time.now', return_value=rospy.Time()):
            self.assertFalse(is_clear(Warning(clear=True, valid_until=rospy.Time(1))))


if __name__ == '__main__':
    rospy.init_node('clients_test')
    try:
        rostest.rosrun('sweep_guard', 'clients_test', __name__)
    except KeyboardInterrupt:  # ROSInterruptException is one; rostest passes a test that leaves no whole result
        os.remove(next(argument for argument in sys.argv if 'xml:' in argument).split('xml:')[1])
        raise
