#!/usr/bin/env python3
"""The processes around the guard in the soak: peers.py poses|mesh|tf|clock --clock FILE [--port N --proxy N]."""
import argparse
import time

import numpy
import rospy
from geometry_msgs.msg import PoseStamped, TransformStamped
from rosgraph_msgs.msg import Clock
from rospy.impl.tcpros_pubsub import TCPROSHandler
from sweep_guard import MeshPublisher

import world
from transforms import TFMessage

TRANSFORM_LEAD = 0.1  # [s] that transforms are stamped ahead, so that no pose waits for one


def every(period):
    """Yields on time; after a delay it goes on from now."""
    due = time.monotonic()
    while not rospy.is_shutdown():
        yield
        due = max(due + period, time.monotonic() - 10.0 * period)
        time.sleep(max(0.0, due - time.monotonic()))


def stamp_of(nanoseconds):
    return rospy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def publish_poses(clock):
    publisher = rospy.Publisher('tool_pose', PoseStamped, queue_size=1000)
    message = PoseStamped()
    message.header.frame_id = 'tracker'
    position, orientation = message.pose.position, message.pose.orientation
    for _ in every(0.001):
        message.header.stamp = stamp_of(clock.now())
        at, turned = world.tool_in_tracker(time.monotonic())
        position.x, position.y, position.z = at
        orientation.x, orientation.y, orientation.z, orientation.w = turned
        publisher.publish(message)


def publish_mesh(clock):
    x, y = world.plate_corners()
    vertices = numpy.stack([x.ravel(), y.ravel(), world.plate_heights(time.monotonic(), x).ravel()], axis=1)
    publisher = MeshPublisher('plate', 'world')
    publisher.publish(vertices, world.plate_faces(), stamp_of(clock.now()))
    for _ in every(1.0 / 60.0):
        stamp = stamp_of(clock.now())
        vertices[:, 2] = world.plate_heights(time.monotonic(), x).ravel()
        publisher.deform(vertices, stamp)


def publish_transforms(clock):
    publisher = rospy.Publisher('/tf', TFMessage, queue_size=100)
    transform = TransformStamped(child_frame_id='tracker')
    transform.header.frame_id = 'world'
    at, turn = transform.transform.translation, transform.transform.rotation
    at.x, at.y, at.z = world.TRACKER_AT
    turn.z, turn.w = numpy.sin(0.5 * world.TRACKER_YAW), numpy.cos(0.5 * world.TRACKER_YAW)
    for _ in every(0.02):
        transform.header.stamp = stamp_of(clock.now() + int(1e9 * TRANSFORM_LEAD))
        publisher.publish(TFMessage([transform]))


def publish_clock(clock):
    publisher = rospy.Publisher('/clock', Clock, queue_size=10)
    for _ in every(0.002):
        publisher.publish(Clock(stamp_of(clock.now())))


ROLES = {'poses': publish_poses, 'mesh': publish_mesh, 'tf': publish_transforms, 'clock': publish_clock}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('role', choices=ROLES)
    parser.add_argument('--clock', default='')
    parser.add_argument('--port', type=int, default=0)
    parser.add_argument('--proxy', type=int, default=0)
    asked = parser.parse_args(rospy.myargv()[1:])
    if asked.proxy:
        TCPROSHandler.init_publisher_of_its_own = TCPROSHandler.init_publisher
        TCPROSHandler.init_publisher = lambda self, topic, protocol: redirected(self, topic, protocol, asked.proxy)
    rospy.init_node('soak_' + asked.role, tcpros_port=asked.port, disable_rosout=True)
    ROLES[asked.role](world.StampClock(asked.clock))


def redirected(handler, topic, protocol, port):
    """What a subscriber is sent to in place of this process."""
    code, text, address = handler.init_publisher_of_its_own(topic, protocol)
    return code, text, [address[0], address[1], port] if code == 1 else address


if __name__ == '__main__':
    try:
        main()
    except rospy.ROSInterruptException:
        pass
