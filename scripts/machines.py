"""Cuts the links between a warning_merger and two guards, and measures it: started by scripts/machines, which makes the
machines."""
import argparse
import os
import subprocess
import sys
import time

import rospy
from faults import Table, Warnings, World, clear, now, unknown

LENGTHS = (0.2, 2.0, 20.0)  # [s] of a cut
ADDRESSES = {'left': '10.98.1.2', 'right': '10.98.2.2'}
CUTS = (['left'], ['right'], ['left', 'right'])  # in turn
SILENCE = 0.2  # [s] until the merger takes a guard for silent
TO_UNKNOWN = 0.3  # [s]
TO_CLEAR = 1.0  # [s] beyond the length of the cut


class Machines(World):
    """The hub, which this process is on, and the machines of the guards."""

    def __init__(self, router, namespaces, folder):
        super().__init__(None, folder)
        # One process for all: to start one takes time.
        self.rules = subprocess.Popen(['ip', '-n', router, '-batch', '-'], stdin=subprocess.PIPE, text=True)
        self.namespaces = namespaces

    def start(self, name, command, at_peers=True, at=None, **environment):
        there = {'ROS_IP': ADDRESSES[at], 'ROS_NAMESPACE': at} if at else {}
        prefix = ['ip', 'netns', 'exec', self.namespaces[at]] if at else []
        return self.run(name, prefix + command, **there, **environment)

    def start_guard(self, side):
        config = os.path.join(self.folder, side + '.yaml')
        self.write_config(config, [side])
        self.start('guard_' + side, ['roslaunch', 'sweep_guard', 'sweep_guard.launch', 'config:=' + config,
                                     'tool_pose:=/tool_pose', 'mesh:=/mesh', 'mesh_vertices:=/mesh_vertices'], at=side)

    def set_links(self, sides, state):
        """Neither end notices but by the silence, as when a switch between them fails. Returns when it was asked for."""
        change = 'add' if state == 'down' else 'del'
        asked = now()
        for side in sides:
            for way in 'from', 'to':
                self.rules.stdin.write(f'rule {change} {way} {ADDRESSES[side]} blackhole\n')
        self.rules.stdin.flush()
        return asked

    def set_link(self, state):
        """At the end: the router ends with the script."""
        self.rules.stdin.close()


def after_last(warnings, fits, mark):
    """Returns the mark after the last warning from there on that fits; None: none does."""
    found = [i for i, warning in enumerate(warnings.since(mark)) if fits(warning)]
    return mark + found[-1] + 1 if found else None


def cut(machines, warnings, table, length, count):
    to_unknown, to_clear = [], []
    for i in range(count):
        warnings.wait_until_steadily_clear()
        sides = CUTS[i % len(CUTS)]
        mark = warnings.mark()
        begin = machines.set_links(sides, 'down')
        if length > SILENCE:
            to_unknown.append(warnings.wait(unknown, mark)[0] - begin)
        time.sleep(max(0.0, begin + length - now()))
        up = machines.set_links(sides, 'up')
        time.sleep(SILENCE)  # until the warnings from before the cut are over
        after_unknown = after_last(warnings, unknown, mark)
        what = f'cut of {length:g} s, {" and ".join(sides)}'
        if after_unknown is None:
            print(what + ': CLEAR all the time', flush=True)
            continue
        to_clear.append(max(0.0, warnings.wait(clear, after_unknown)[0] - up))
        print(f'{what}: CLEAR {to_clear[-1]:.2f} s after it', flush=True)
    if to_unknown:
        table.add(f'cut of {length:g} s: until UNKNOWN', to_unknown, TO_UNKNOWN)
    if to_clear:
        table.add(f'cut of {length:g} s, {len(to_clear)} of {count} UNKNOWN: link up until CLEAR', to_clear, length + TO_CLEAR)


def measure(options):
    machines = Machines(options.router, {'left': options.left, 'right': options.right}, options.folder)
    table = Table()
    try:
        machines.start_master()
        for name, role in (('poses', ['poses']), ('left', ['mesh', 'left']), ('right', ['mesh', 'right'])):
            machines.role(name, *role)
        for side in ADDRESSES:
            machines.start_guard(side)
        machines.start('merger', ['roslaunch', 'sweep_guard', 'warning_merger.launch',
                                  'guards:=[/left/sweep_guard, /right/sweep_guard]'])
        rospy.init_node('machines', disable_signals=True)
        warnings = Warnings('warning_merger')
        warnings.wait(clear, 0)
        for length, count in zip(LENGTHS, options.cuts.split(',')):
            cut(machines, warnings, table, length, int(count))
    except (TimeoutError, subprocess.SubprocessError) as error:
        table.add_failure(str(error))
    finally:
        machines.end()
        print('\n' + table.text())
    return 1 if table.failed else 0


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=__doc__)
    for option in ('--router', '--left', '--right', '--folder', '--cuts'):
        parser.add_argument(option, required=True)
    sys.exit(measure(parser.parse_args(rospy.myargv()[1:])))
