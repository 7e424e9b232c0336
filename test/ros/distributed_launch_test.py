#!/usr/bin/env python3
"""launch/distributed.launch puts each guard on its host and gives the merger their names: distributed_launch_test.py LAUNCH."""
import os
import sys
import unittest

from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader

HOSTS = {'/left/': '192.0.2.1', '/right/': '192.0.2.2'}  # of the addresses for documents


class DistributedLaunchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.environ['ROS_MASTER_URI'] = 'http://localhost:11311'  # which nothing is asked of
        cls.config = ROSLaunchConfig()
        arguments = ['left_host:=192.0.2.1', 'right_host:=192.0.2.2', 'left_mesh_ids:=[liver]', 'user:=operator',
                     'scene:={}']
        XmlLoader().load(sys.argv[1], cls.config, argv=arguments, verbose=False)
        cls.config.assign_machines()

    def parameter(self, name):
        return self.config.params[name].value

    def test_each_guard_is_on_its_host_and_the_rest_is_here(self):
        machines = {node.namespace + node.name: node.machine for node in self.config.nodes}
        self.assertEqual(set(machines), {'/left/sweep_guard', '/right/sweep_guard', '/scene_input', '/warning_merger'})
        for namespace, address in HOSTS.items():
            machine = machines[namespace + 'sweep_guard']
            self.assertEqual((machine.address, machine.user), (address, 'operator'))
            self.assertTrue(machine.env_loader)
        for node in ('/scene_input', '/warning_merger'):
            self.assertEqual(machines[node].address, 'localhost')

    def test_the_merger_hears_the_guards_that_are_started(self):
        guards = [node.namespace + node.name for node in self.config.nodes if node.type == 'sweep_guard_node']
        self.assertEqual(sorted(self.parameter('/warning_merger/guards')), sorted(guards))

    def test_each_guard_has_the_workpieces_that_it_guards(self):
        self.assertEqual(self.parameter('/left/sweep_guard/mesh_ids'), ['liver'])
        self.assertEqual(self.parameter('/right/sweep_guard/mesh_ids'), [])

    def test_both_hear_the_same_workpieces(self):
        for node in self.config.nodes:
            if node.type in ('sweep_guard_node', 'scene_input'):
                self.assertIn(['mesh', '/mesh'], [list(pair) for pair in node.remap_args])


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
