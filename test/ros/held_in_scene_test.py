#!/usr/bin/env python3
"""What the robot holds in a planning scene is part of the tool, until the robot lets go of it."""
import threading

import rospy
import rostest
from scene_input_test import PATIENCE, SceneTest, full_scene, object_of
from sweep_guard.msg import ToolShape, Warning
from tool_poses import publish_tool_pose

HELD = (0.05, 0.05, 0.05)


def attached(operation, objects=()):
    return {'type': 'scene', 'is_diff': True, 'is_state_diff': True, 'names_joints': False, 'objects': list(objects),
            'attached': [{'link': 'left', 'object': dict(object_of('held'), operation=operation)}]}


class HeldInSceneTest(SceneTest):
    def setUp(self):
        self.changed = threading.Condition()
        self.level = self.links = None
        for subscriber in (rospy.Subscriber('/arm_guard/warning', Warning, self.hear_warning),
                           rospy.Subscriber('/arm_guard/tool', ToolShape, self.hear_tool)):
            self.addCleanup(subscriber.unregister)
        publish_tool_pose(self, z=1.0, rate=50)

    def hear_warning(self, warning):
        with self.changed:
            self.level = warning.level
            self.changed.notify_all()

    def hear_tool(self, tool):
        with self.changed:
            self.links = tool.links
            self.changed.notify_all()

    def await_clear(self, holds):
        with self.changed:
            self.assertTrue(self.changed.wait_for(
                lambda: self.level == Warning.CLEAR and self.links and ('held' in self.links) == holds, PATIENCE), self.links)

    def test_it_is_part_of_the_tool_while_the_robot_holds_it(self):
        move_group = self.move_group()
        scene = full_scene({'held': HELD, 'table': (1.0, 1.0, 0.1)})
        scene['objects'][0]['pose'] = (0.0, 0.0, 1.4, 0.0, 0.0, 0.0, 1.0)
        move_group.step(scene)
        self.await_clear(holds=False)
        for y in (0.5, 0.6):
            move_group.step(attached('ADD'))
            self.await_clear(holds=True)
            released = dict(object_of('held', HELD), pose=(0.0, y, 1.4, 0.0, 0.0, 0.0, 1.0))
            move_group.step(attached('REMOVE', [released]))
            self.await_clear(holds=False)
            self.await_bounds('held', (-0.025, y - 0.025, 1.375), (0.025, y + 0.025, 1.425))


if __name__ == '__main__':
    rospy.init_node('held_in_scene_test')
    rostest.rosrun('sweep_guard', 'held_in_scene_test', HeldInSceneTest)
