#!/usr/bin/env python3
"""Writes a rosbag of a depth camera that looks at a box on a table from 45 degrees: depth_bag.py FILE."""
import math
import sys

import numpy
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL_LENGTH = 160, 120, 150.0
CAMERA = numpy.array([-0.7, 0.0, 0.9])  # [m] in world; the box is around its z axis
BOX = numpy.array([[-0.1, -0.1, 0.0], [0.1, 0.1, 0.2]])
AXES = numpy.array([[0.0, -math.sqrt(0.5), math.sqrt(0.5)], [-1.0, 0.0, 0.0], [0.0, -math.sqrt(0.5), -math.sqrt(0.5)]])


def depths():
    """Returns z of each pixel [m]: where its ray enters the box, or the table at z = 0."""
    u, v = numpy.meshgrid(numpy.arange(WIDTH), numpy.arange(HEIGHT))
    rays = numpy.stack([(u - 79.5) / FOCAL_LENGTH, (v - 59.5) / FOCAL_LENGTH, numpy.ones_like(u)], axis=-1) @ AXES.T
    with numpy.errstate(divide='ignore', invalid='ignore'):
        ends = (BOX[:, None, None] - CAMERA) / rays
        table = numpy.where(rays[..., 2] < 0, -CAMERA[2] / rays[..., 2], numpy.inf)
    first = ends.min(axis=0).max(axis=-1)
    return numpy.where(first <= ends.max(axis=0).min(axis=-1), first, table)


def mount():
    transform = TransformStamped()
    transform.header.frame_id = 'base'
    transform.child_frame_id = 'camera_optical'
    transform.transform.translation.x, _, transform.transform.translation.z = CAMERA
    half = math.radians(135.0) / 2  # about x, after a quarter turn about -z
    x, z = math.sin(half), math.cos(half)
    rotation = transform.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = -x * math.sqrt(0.5), x * math.sqrt(0.5), -z * math.sqrt(0.5), z * math.sqrt(0.5)
    return TFMessage([transform])


def main():
    data = numpy.where(depths() < 3.0, 1000.0 * depths(), 0.0).round().astype('<u2').tobytes()
    with rosbag.Bag(sys.argv[1], 'w') as bag:
        bag.write('/tf_static', mount(), rospy.Time.from_sec(1000.0))
        for i in range(60):
            image = Image(height=HEIGHT, width=WIDTH, encoding='16UC1', step=2 * WIDTH, data=data)
            image.header.stamp = rospy.Time.from_sec(1000.0 + i / 30.0)
            image.header.frame_id = 'camera_optical'
            info = CameraInfo(header=image.header, height=HEIGHT, width=WIDTH)
            info.P = [FOCAL_LENGTH, 0, 79.5, 0, 0, FOCAL_LENGTH, 59.5, 0, 0, 0, 1, 0]
            bag.write('/camera/depth/camera_info', info, image.header.stamp)
            bag.write('/camera/depth/image_rect', image, image.header.stamp)


if __name__ == '__main__':
    main()
