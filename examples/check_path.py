#!/usr/bin/env python3
"""Asks the guard whether the straight path of a tool that points down is free.

Exit status 0: it is free. 1: it is not. 2: nobody knows, because the guard could not test it or did not answer.
"""
import argparse
import sys

import rospy
from geometry_msgs.msg import PoseStamped
from sweep_guard import NotTested, check_sweep, wait_for_clear


def arguments():
    parser = argparse.ArgumentParser(prog='check_path.py', description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--from', dest='begin', nargs=3, type=float, default=[0.0, 0.0, 0.5], metavar=('X', 'Y', 'Z'),
                        help='[m] where the tip begins (0 0 0.5)')
    parser.add_argument('--to', dest='end', nargs=3, type=float, default=[0.0, 0.0, -0.5], metavar=('X', 'Y', 'Z'),
                        help='[m] where it ends (0 0 -0.5)')
    parser.add_argument('--frame', default='world', help='tf frame of both (world)')
    parser.add_argument('--deadline', type=float, default=1.0, help='[s] to wait for the answer (1)')
    parser.add_argument('--wait-for-clear', type=float, metavar='SECONDS',
                        help='if the path is free, also wait for the warning to be clear')
    return parser.parse_args(rospy.myargv()[1:])


def pose(frame, position):
    stamped = PoseStamped()
    stamped.header.frame_id = frame
    stamped.pose.position.x, stamped.pose.position.y, stamped.pose.position.z = position
    stamped.pose.orientation.x = 1.0  # z of the tool points down
    return stamped


def is_free(options):
    path = [pose(options.frame, options.begin), pose(options.frame, options.end)]
    answer = check_sweep(path, deadline=options.deadline)
    for met in answer.objects:
        print(f'meets {met.mesh_id}: {len(met.triangles)} triangles')
    if not answer.clear:
        print('not free: ' + (answer.message or 'collision'))
    return answer.clear


def main():
    options = arguments()
    rospy.init_node('check_path', anonymous=True)
    try:
        if not is_free(options):
            return 1
        if options.wait_for_clear is not None:
            wait_for_clear(options.wait_for_clear)
    except (NotTested, TimeoutError) as error:
        print(f'not known: {error}')
        return 2
    print('free')
    return 0


if __name__ == '__main__':
    sys.exit(main())
