#!/usr/bin/env python3
"""A table and bricks on a carriage from a scene, and a liver that deforms at 60 Hz, each with its own timeout: the guard follows the
carriage in tf, and notices which of the senders dies."""
import os
import queue
import sys
import threading
import unittest
from xmlrpc.client import ServerProxy

import numpy
import rosgraph
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from sweep_guard import MeshPublisher
from sweep_guard.msg import DeformableMesh, MeshVertices, Warning
from tool_poses import publish_tool_pose

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', 'soak'))
from transforms import TFMessage  # noqa: E402

PATIENCE = 30.0  # [s]
LIVER = numpy.array([[0.5, 0.0, 0.2], [0.6, 0.0, 0.2], [0.5, 0.1, 0.2], [0.5, 0.0, 0.3]])
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
SLACK = 0.05  # [s]
BETWEEN = -0.2  # [m] x of the carriage where the tool is between the bricks


class TableAndLiverTest(unittest.TestCase):
    def setUp(self):
        self.changed = threading.Condition()
        self.warnings = []
        self.newest = {}  # stamps of MeshVertices by id
        for subscriber in (rospy.Subscriber('/sweep_guard/warning', Warning, self.hear, tcp_nodelay=True),
                           rospy.Subscriber('/mesh_vertices', MeshVertices, self.hear_vertices, tcp_nodelay=True)):
            self.addCleanup(subscriber.unregister)
        publish_tool_pose(self, z=2.0, rate=100)
        self.tf = rospy.Publisher('/tf', TFMessage, queue_size=10)
        self.carriage = self.goal = BETWEEN
        self.liver = MeshPublisher('liver', 'world')
        self.deforms = True
        for timer in (rospy.Timer(rospy.Duration(1.0 / 100), self.move), rospy.Timer(rospy.Duration(1.0 / 60), self.deform)):
            self.addCleanup(timer.shutdown)

    def hear(self, warning):
        with self.changed:
            self.warnings.append(warning)
            self.changed.notify_all()

    def hear_vertices(self, vertices):
        self.newest[vertices.id] = vertices.header.stamp

    def move(self, _):
        """Moves the carriage toward its goal, by at most 1 cm."""
        self.carriage += min(max(self.goal - self.carriage, -0.01), 0.01)
        transform = TransformStamped(child_frame_id='carriage')
        transform.header.frame_id = 'world'
        transform.header.stamp = rospy.Time.now()
        transform.transform.translation.x = self.carriage
        transform.transform.translation.z = 1.8
        transform.transform.rotation.w = 1.0
        self.tf.publish(TFMessage([transform]))

    def deform(self, _):
        if self.liver.revision == 0:
            self.liver.publish(LIVER, FACES)
        if self.deforms:
            self.liver.deform(LIVER)

    def await_warning(self, fits):
        """The next warning that fits."""
        with self.changed:
            self.warnings.clear()
            end = rospy.Time.now() + rospy.Duration(PATIENCE)
            while rospy.Time.now() < end:
                for warning in self.warnings:
                    if fits(warning):
                        return warning
                self.warnings.clear()
                self.changed.wait(1.0)
        self.fail('no such warning')

    def await_stale(self, name, timeout):
        warning = self.await_warning(lambda one: one.level == Warning.UNKNOWN)
        self.assertIn(f"workpiece '{name}' is 0.", warning.text)
        self.assertLess((warning.header.stamp - self.newest[name]).to_sec(), timeout + SLACK)

    def test_a_brick_is_where_tf_moves_its_frame(self):
        for goal, brick in ((0.05, 'left'), (-0.45, 'right')):
            self.await_warning(lambda one: one.level == Warning.CLEAR)
            self.goal = goal
            self.assertEqual(self.await_warning(lambda one: one.level == Warning.CONTACT).mesh_id, brick)
            self.goal = BETWEEN
        self.await_warning(lambda one: one.level == Warning.CLEAR)

    def test_a_guard_that_starts_is_told_that_topics_which_were_refused_before_are_not_now(self):
        meshes = queue.Queue()
        subscriber = rospy.Subscriber('/mesh', DeformableMesh, meshes.put)
        self.addCleanup(subscriber.unregister)
        told = next(mesh for mesh in iter(lambda: meshes.get(timeout=PATIENCE), None) if mesh.id == 'topics of /scene_input')
        self.assertEqual((told.refused, len(told.mesh.triangles)), ('', 0))

    def test_the_diagnostics_have_the_age_and_the_rule_of_each_and_name_a_rule_without_a_workpiece(self):
        self.await_warning(lambda one: one.level == Warning.CLEAR)
        arrays = queue.Queue()
        subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, arrays.put)
        self.addCleanup(subscriber.unregister)
        is_of_workpieces = lambda line: line.name.endswith('sweep_guard: workpieces')
        line = next(filter(is_of_workpieces, (line for _ in range(20) for line in arrays.get(timeout=PATIENCE).status)))
        values = {value.key: value.value for value in line.values}
        self.assertIn("no workpiece 'ghost' so far (workpieces)", line.message)
        self.assertIn('stale from 0.20 s on', values["age of 'liver'"])
        self.assertIn('stale from 0.40 s on', values["age of 'table'"])

    def test_the_end_of_each_sender_is_unknown_in_time_and_the_table_does_not_age_before(self):
        for _ in range(3):
            self.deforms = True
            self.await_warning(lambda one: one.level == Warning.CLEAR)
            later = rospy.Time.now() + rospy.Duration(1.5)  # longer than the timeouts
            self.assertNotIn('table', self.await_warning(lambda one: 'table' in one.text or one.header.stamp > later).text)
            self.await_warning(lambda one: one.level == Warning.CLEAR)
            self.deforms = False
            self.await_stale('liver', 0.2)
        self.deforms = True
        self.await_warning(lambda one: one.level == Warning.CLEAR)
        ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode('/scene_input')).shutdown(rospy.get_name(), '')
        self.await_stale('table', 0.4)


if __name__ == '__main__':
    rospy.init_node('table_and_liver_test')
    rostest.rosrun('sweep_guard', 'table_and_liver_test', TableAndLiverTest)
