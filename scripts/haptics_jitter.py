#!/usr/bin/env python3
"""Moves a tool into a sheet and out, listens to haptics, and prints how even the intervals between its forces are: see
scripts/haptics_jitter."""
import argparse
import math
import os
import sys
import threading
import time

import numpy
import rospy
from geometry_msgs.msg import PoseStamped, WrenchStamped

PERIOD = 1e-3  # [s]
LIMIT = 0.2e-3  # of p99 [s]
WARM_UP = 5.0  # [s]


class Heard:
    """Stamps and receipts of a topic, and how many forces were not zero."""

    def __init__(self, topic):
        self.stamps, self.numbers, self.receipts, self.felt, self.listens = [], [], [], 0, False
        rospy.Subscriber(topic, WrenchStamped, self.hear, tcp_nodelay=True)

    def hear(self, message):
        if not self.listens:
            return
        self.receipts.append(time.monotonic())
        self.stamps.append(message.header.stamp.to_nsec())
        self.numbers.append(message.header.seq)
        self.felt += message.wrench.force.z != 0.0


def jitter(times):
    return numpy.abs(numpy.diff(times) - PERIOD)


def jitter_of_stamps(heard):
    """Returns that of the forces which were sent one after the other: those that arrived too late were replaced by newer ones."""
    next_to = numpy.diff(heard.numbers) == 1
    return jitter(1e-9 * (numpy.array(heard.stamps, dtype=float) - heard.stamps[0]))[next_to]


def line(name, values):
    p50, p99, worst = (1e3 * numpy.quantile(values, q) for q in (0.5, 0.99, 1.0))
    return f'{name:32} {len(values):7} intervals, differ from 1 ms by {p50:.3f} ms (p50), {p99:.3f} ms (p99), {worst:.3f} ms at most'


def move(publisher, ending):
    """Publishes the pose of a tool whose tip points down, 40 mm above the middle of the sheet to 20 mm below."""
    rate = rospy.Rate(500)
    pose = PoseStamped()
    pose.header.frame_id = 'world'
    pose.pose.orientation.x = 1.0
    while not ending.is_set() and not rospy.is_shutdown():
        pose.header.stamp = rospy.Time.now()
        pose.pose.position.z = 0.01 + 0.03 * math.sin(2.0 * pose.header.stamp.to_sec())
        publisher.publish(pose)
        rate.sleep()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--seconds', type=float, default=30.0)
    parser.add_argument('--idle', action='store_true')
    options = parser.parse_args(rospy.myargv()[1:])
    rospy.init_node('haptics_jitter', disable_signals=True)
    sent, passed = Heard('haptics/servo_cf'), Heard('servo_cf')
    ending = threading.Event()
    if not options.idle:
        poses = rospy.Publisher('tool_pose', PoseStamped, queue_size=1, tcp_nodelay=True)
        threading.Thread(target=move, args=(poses, ending), daemon=True).start()
    time.sleep(WARM_UP)
    sent.listens = passed.listens = True
    time.sleep(options.seconds)
    sent.listens = passed.listens = False
    ending.set()
    if len(sent.stamps) < 0.5 * options.seconds / PERIOD:
        print(f'only {len(sent.stamps)} forces were heard')
        return 1
    stamps = jitter_of_stamps(sent)
    numbers = sent.numbers[-1] - sent.numbers[0]
    print(line('sent (stamps of haptics)', stamps))
    print(line('received behind the watchdog', jitter(passed.receipts)))
    print(f'rate {numbers / (1e-9 * (sent.stamps[-1] - sent.stamps[0])):.1f} Hz, '
          f'{100 * (1 - len(sent.numbers) / (numbers + 1)):.1f} % not received here, '
          f'{100 * sent.felt / len(sent.stamps):.0f} % not zero, load {os.getloadavg()[0]:.2f} '
          f'on {os.cpu_count()} processors')
    return 0 if numpy.quantile(stamps, 0.99) < LIMIT else 1


if __name__ == '__main__':
    sys.exit(main())
