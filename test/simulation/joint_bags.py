#!/usr/bin/env python3
"""Writes rosbags of joints that move, for robots made by others: joint_bags.py DATA FOLDER."""
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

import rosbag
import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

RATE = 100  # [Hz]
UR5 = ['shoulder_pan_joint', 'shoulder_lift_joint', 'elbow_joint', 'wrist_1_joint', 'wrist_2_joint', 'wrist_3_joint']
PANDA = [f'panda_joint{i}' for i in range(1, 8)] + ['panda_finger_joint1']
PSM = ['yaw', 'pitch', 'insertion', 'roll', 'wrist_pitch', 'wrist_yaw', 'jaw']

# robot, joints, positions [rad or m] at the beginning and at the end, duration [s]
SCENES = {
    'ur5': ('ur5', UR5, [0, -1.2, 1.2, -1.57, -1.57, 0], [0, -0.6, 0.9, -1.87, -1.57, 0], 4.0),
    'elbow': ('ur5', UR5, [0, -0.7, 2.4, 0, 0, 0], [1.2, -0.7, 2.4, 0, 0, 0], 4.0),
    'panda': ('panda_with_hand', PANDA, [0, -0.78, 0, -2.36, 0, 1.57, 0.78, 0.04], [0, 0.2, 0, -2.0, 0, 2.2, 0.78, 0.02], 4.0),
    'jaws': ('franka_hand', ['panda_finger_joint1'], [0.04], [0.022], 4.0),
    'psm': ('dvrk_psm1', PSM, [0, 0, 0.05, 0, 0, 0, 0.5], [0.1, 0.1, 0.2, 0.5, 0.3, 0.2, 0.1], 4.0),
}
# The meshes of the instrument's shaft and jaws are missing in the data: shapes of their size, as link: geometry, origin.
PSM_SHAPES = {
    'PSM1_roll_link': ('cylinder', {'radius': '0.004', 'length': '0.4'}, '0 0 -0.2'),
    'PSM1_jaw_1_link': ('box', {'size': '0.003 0.01 0.004'}, '-0.002 0.005 0'),
    'PSM1_jaw_2_link': ('box', {'size': '0.003 0.01 0.004'}, '0.002 0.005 0'),
}


def write_bag(path, names, begin, end, duration, topics=('/joint_states',)):
    with rosbag.Bag(path, 'w') as bag:
        for i in range(int(duration * RATE) + 1):
            stamp = rospy.Time.from_sec(1000.0 + i / RATE)
            share = 0.5 - 0.5 * math.cos(math.pi * i / (duration * RATE))
            message = JointState(name=names, position=[a + share * (b - a) for a, b in zip(begin, end)])
            message.header.stamp = stamp
            for topic in topics:
                bag.write(topic, message, stamp)
        bag.write('/header', Header(), rospy.Time(1000))


def write_urdf(source, path):
    robot = ElementTree.parse(source)
    for link in robot.getroot().findall('link'):
        if link.get('name') not in PSM_SHAPES:
            continue
        for collision in link.findall('collision'):
            link.remove(collision)
        shape, size, origin = PSM_SHAPES[link.get('name')]
        collision = ElementTree.SubElement(link, 'collision')
        ElementTree.SubElement(collision, 'origin', xyz=origin)
        ElementTree.SubElement(ElementTree.SubElement(collision, 'geometry'), shape, size)
    robot.write(path)


def main(data, folder):
    def write_robot(scene, robot):
        write_urdf(os.path.join(data, 'urdf/expanded', robot + '.urdf'), os.path.join(folder, scene + '.urdf'))

    def bag(scene):
        return os.path.join(folder, scene + '.bag')

    for scene, (robot, *motion) in SCENES.items():
        write_robot(scene, robot)
        write_bag(bag(scene), *motion)
    for scene in 'two_topics', 'no_joints', 'few_joints':
        write_robot(scene, 'ur5')
    _, *motion = SCENES['ur5']
    write_bag(bag('two_topics'), *motion, topics=['/joint_states', '/other/joint_states'])
    write_bag(bag('no_joints'), *motion, topics=[])
    write_bag(bag('few_joints'), ['shoulder_pan_joint'], [0.0], [1.0], 1.0)


if __name__ == '__main__':
    main(*sys.argv[1:])
