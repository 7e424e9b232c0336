"""Hurts a running guard and measures how it recovers: started by scripts/faults, which makes the two networks."""
import argparse
import os
import signal
import statistics
import subprocess
import sys
import threading
import time
import xmlrpc.client

import rospy
from geometry_msgs.msg import Point, PoseStamped, TwistStamped
from process_table import children, resident, started
from shape_msgs.msg import MeshTriangle
from sweep_guard.msg import Contacts, DeformableMesh, MeshVertices, View, Warning

MASTER = os.environ['ROS_MASTER_URI']
POSE_TIMEOUT, MESH_TIMEOUT = 0.1, 0.5  # [s] as configured
REACTION = 0.05  # [s] that the guard may take beyond a timeout
VALID = 0.2  # [s] of a warning
SPEED = 0.01  # [m/s] of the commands to motion_guard
STOPPED = 0.2  # [s] within which motion_guard sends zero once the guard is gone
CORNERS = [(-0.1, -0.1), (0.1, -0.1), (0.0, 0.1)]
IDS = {'left': -1.0, 'right': -2.0}  # workpieces and their heights [m]


def publish_at(hertz, publisher, message):
    """Publishes a message with the present time, again and again."""
    rate = rospy.Rate(hertz)
    while not rospy.is_shutdown():
        message.header.stamp = rospy.Time.now()
        publisher.publish(message)
        rate.sleep()


def publish_poses():
    publisher = rospy.Publisher('tool_pose', PoseStamped, queue_size=10)
    pose = PoseStamped()
    pose.header.frame_id = 'world'
    pose.pose.position.z = 0.5
    pose.pose.orientation.x = 1.0
    publish_at(100, publisher, pose)


def publish_mesh(name):
    meshes = rospy.Publisher('mesh', DeformableMesh, queue_size=1, latch=True)
    vertices = rospy.Publisher('mesh_vertices', MeshVertices, queue_size=10)
    mesh = DeformableMesh(id=name, revision=1)
    mesh.header.frame_id = 'world'
    mesh.header.stamp = rospy.Time.now()
    mesh.mesh.vertices = [Point(x, y, IDS[name]) for x, y in CORNERS]
    mesh.mesh.triangles = [MeshTriangle(vertex_indices=[0, 1, 2])]
    meshes.publish(mesh)
    update = MeshVertices(id=name, revision=1)
    update.header.frame_id = 'world'
    update.positions = [value for x, y in CORNERS for value in (x, y, IDS[name])]
    publish_at(30, vertices, update)


def publish_commands():
    publisher = rospy.Publisher('command', TwistStamped, queue_size=10)
    command = TwistStamped()
    command.header.frame_id = 'world'
    command.twist.linear.x = SPEED
    publish_at(100, publisher, command)


def listen():
    """A subscriber that begins now: ends with the first warning."""
    rospy.wait_for_message('/sweep_guard/warning', Warning)


class Warnings:
    """What the guard's subscriber on its own machine receives."""

    def __init__(self, guard='sweep_guard'):
        self.changed = threading.Condition()
        self.received = []  # with times on the clock that does not stop in suspend
        rospy.Subscriber(f'/{guard}/warning', Warning, self.take, tcp_nodelay=True)

    def take(self, warning):
        with self.changed:
            self.received.append((now(), warning))
            self.changed.notify_all()

    def mark(self):
        with self.changed:
            return len(self.received)

    def since(self, mark):
        with self.changed:
            return [warning for _, warning in self.received[mark:]]

    def wait(self, fits, mark, timeout=60.0):
        """Returns the first warning from there on that fits, and when it arrived."""
        deadline = now() + timeout
        with self.changed:
            while True:
                for arrived, warning in self.received[mark:]:
                    if fits(warning):
                        return arrived, warning
                mark = len(self.received)
                if not self.changed.wait(deadline - now()):
                    last = self.received[-1][1].text if self.received else 'none was received'
                    raise TimeoutError('no such warning; the last: ' + last)

    def oldest_pose(self, mark):
        """Returns the largest age of the newest pose: lack of processor time makes it some 0.1 s, a lost connection seconds."""
        received = self.since(mark)
        texts = [warning.text for warning in received if not clear(warning)]
        print(f'{len(texts)} of {len(received)} messages not CLEAR{": " + texts[0] if texts else ""}', flush=True)
        return max(age_of_pose(warning) for warning in received)

    def wait_until_steadily_clear(self, timeout=60.0):
        deadline = now() + timeout
        while now() < deadline:
            mark = self.mark()
            time.sleep(1.0)
            received = self.since(mark)
            if received and all(clear(warning) for warning in received):
                return
        last = received[-1].text if received else 'none was received'
        raise TimeoutError(f'not CLEAR for a second within {timeout:g} s; the last warning: {last}')


class Motion:
    """What motion_guard sends to the robot."""

    def __init__(self):
        self.changed = threading.Condition()
        self.received = []  # times and speeds
        rospy.Subscriber('/guarded_command', TwistStamped, self.take, tcp_nodelay=True)

    def take(self, command):
        with self.changed:
            self.received.append((now(), command.twist.linear.x))
            self.changed.notify_all()

    def wait(self, speed, timeout=60.0):
        """Returns when this speed is first received from now on."""
        deadline = now() + timeout
        with self.changed:
            mark = len(self.received)
            while True:
                for arrived, sent in self.received[mark:]:
                    if sent == speed:
                        return arrived
                mark = len(self.received)
                if not self.changed.wait(deadline - now()):
                    raise TimeoutError(f'motion_guard does not send {speed:g} m/s within {timeout:g} s')


def now():
    return time.clock_gettime(time.CLOCK_BOOTTIME)


def clear(warning):
    return warning.clear and warning.level == Warning.CLEAR


def unknown(warning):
    return warning.level == Warning.UNKNOWN and not warning.clear and warning.reflex


def has(reason):
    return lambda warning: unknown(warning) and warning.reasons & reason


def age_of_pose(warning):
    return (warning.valid_until - warning.header.stamp).to_sec() - VALID


class Table:
    def __init__(self):
        self.rows = []
        self.failed = False

    def add(self, what, values, bound, unit='s'):
        kept = all(value <= bound for value in values)
        self.failed = self.failed or not kept
        kept_count = sum(value <= bound for value in values)
        row = (f'| {what} | {kept_count} of {len(values)} | {statistics.median(values):.3f} {unit} | {max(values):.3f} {unit} '
               f'| {bound:g} {unit} | {"yes" if kept else "NO"} |')
        self.rows.append(row)
        print(row, flush=True)

    def add_failure(self, what):
        """A measurement that did not end."""
        self.failed = True
        self.rows.append(f'| {what} | | | | | NO |')
        print(self.rows[-1], flush=True)

    def text(self):
        return '\n'.join(['| fault and what is measured | within | median | largest | bound | kept |',
                          '|---|---|---|---|---|---|'] + self.rows)


class World:
    """The processes, each with its log."""

    def __init__(self, peers, folder):
        self.peers = peers
        self.folder = folder
        self.running = {}
        self.link = True

    def start(self, name, command, at_peers=True, **environment):
        there = ['ip', 'netns', 'exec', self.peers] if at_peers else []
        address = {'ROS_IP': '10.99.0.2'} if at_peers else {}
        return self.run(name, there + command, **address, **environment)

    def run(self, name, command, **environment):
        log = open(os.path.join(self.folder, name + '.log'), 'ab')
        self.running[name] = subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                                              env=dict(os.environ, **environment))
        return self.running[name]

    def write_config(self, path, mesh_ids):
        with open(os.path.join(os.path.dirname(__file__), '..', 'config', 'sweep_guard.yaml')) as file:
            lines = [line for line in file if not line.startswith('mesh_ids:')]
        with open(path, 'w') as file:
            file.writelines(lines + [f'mesh_ids: [{", ".join(mesh_ids)}]\n'])

    def start_master(self, timeout=30.0):
        self.start('roscore', ['roscore', '-p', '11311'])
        deadline = now() + timeout
        while now() < deadline:
            try:
                xmlrpc.client.ServerProxy(MASTER).getParam('/faults', '/run_id')
                return
            except OSError:
                time.sleep(0.02)
        raise TimeoutError(f'roscore does not answer within {timeout:g} s')

    def role(self, name, *role):
        return self.start(name, [sys.executable, __file__, '--role', *role])

    def kill(self, name):
        process = self.running.pop(name)
        below = children(process.pid)
        for pid in [process.pid] + below:
            os.kill(pid, signal.SIGKILL)
        process.wait()

    def pids(self, name):
        process = self.running[name]
        return [process.pid] + children(process.pid)

    def freeze(self, name):
        for pid in self.pids(name):
            os.kill(pid, signal.SIGSTOP)

    def thaw(self, name):
        for pid in self.pids(name):
            os.kill(pid, signal.SIGCONT)

    def set_link(self, state):
        subprocess.run(['ip', '-n', self.peers, 'link', 'set', 'peers', state], check=True)

    def guard(self):
        """Process id of the guard below roslaunch; None: there is none now."""
        found = children(self.running['roslaunch'].pid)
        return found[0] if found else None

    def end(self):
        self.set_link('up')
        for process in reversed(list(self.running.values())):
            process.send_signal(signal.SIGCONT)
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()


def kill_guard(world, warnings, motion, table, cycles):
    to_clear, first_bad, to_zero = [], [], []
    for i in range(cycles):
        warnings.wait_until_steadily_clear()
        motion.wait(SPEED)
        before = world.guard()
        run = warnings.since(-1)[0].run_id
        mark = warnings.mark()
        begin = now()
        os.kill(before, signal.SIGKILL)
        to_zero.append(motion.wait(0.0) - begin)
        of_next = lambda warning: warning.run_id != run
        first = warnings.wait(of_next, mark)[1]
        arrived = warnings.wait(lambda warning: of_next(warning) and clear(warning), mark)[0]
        first_bad.append(0 if unknown(first) and first.level_counts[Warning.CLEAR] == 0 else 1)
        to_clear.append(arrived - started(world.guard()))
        print(f'kill -9 of the guard {i + 1}: motion_guard stops after {to_zero[-1]:.2f} s, CLEAR {to_clear[-1]:.2f} s after the start',
              flush=True)
    table.add('kill -9 of the guard: until motion_guard sends zero', to_zero, STOPPED)
    table.add('kill -9 of the guard: its first message is not UNKNOWN', first_bad, 0, '')
    table.add('kill -9 of the guard: start of the next one until CLEAR with all of mesh_ids', to_clear, 3.0)


def restart_master(world, warnings, table, cycles):
    served, oldest, changed = [], [], []
    parameters = lambda: xmlrpc.client.ServerProxy(MASTER).getParam('/faults', '/sweep_guard')[2]
    before, guard = parameters(), world.guard()
    warnings.wait_until_steadily_clear()
    for i in range(cycles):
        mark = warnings.mark()
        world.kill('roscore')
        time.sleep(2.0)
        begin = now()
        world.start_master()
        world.role('listener', 'listen').wait(60)
        served.append(now() - begin)
        oldest.append(warnings.oldest_pose(mark))
        changed.append(0 if parameters() == before and world.guard() == guard else 1)
        print(f'kill -9 of roscore {i + 1}: new subscriber served after {served[-1]:.2f} s', flush=True)
    table.add('kill -9 of roscore: start of the next one until a new subscriber has its first message', served, 10.0)
    table.add('kill -9 of roscore: largest age of the newest pose meanwhile', oldest, 0.5)
    table.add('kill -9 of roscore: another guard, or other parameters than before', changed, 0, '')


def break_link(world, warnings, table, cycles):
    for duration in (0.2, 2.0, 20.0):
        to_unknown, to_clear = [], []
        for _ in range(cycles):
            warnings.wait_until_steadily_clear()
            mark = warnings.mark()
            world.set_link('down')
            begin = now()
            to_unknown.append(age_of_pose(warnings.wait(unknown, mark)[1]))
            time.sleep(max(0.0, begin + duration - now()))
            world.set_link('up')
            up, mark = now(), warnings.mark()
            to_clear.append(warnings.wait(clear, mark)[0] - up)
            print(f'link down {duration} s: CLEAR after {to_clear[-1]:.2f} s', flush=True)
        table.add(f'link down {duration:g} s: age of the newest pose at UNKNOWN', to_unknown, POSE_TIMEOUT + REACTION)
        table.add(f'link down {duration:g} s: link up until CLEAR', to_clear, 1.0)


def silence(world, warnings, table, name, timeout, fits, stop, go_on, how, bound):
    """Stops a publisher, and measures how long its newest message is old at UNKNOWN, and the time until CLEAR."""
    to_unknown, to_clear = [], []
    for _ in range(5):
        warnings.wait_until_steadily_clear()
        mark, begin = warnings.mark(), now()
        stop(name)
        to_unknown.append(warnings.wait(fits, mark)[0] - begin)
        time.sleep(2.0)
        begin, mark = now(), warnings.mark()
        go_on(name)
        to_clear.append(warnings.wait(clear, mark)[0] - begin)
    table.add(f'{how} of the publisher of {name}: until UNKNOWN', to_unknown, timeout + REACTION)
    table.add(f'{how} of the publisher of {name}: going on until CLEAR', to_clear, bound)


def hurt_publishers(world, warnings, table):
    roles = {'poses': ['poses'], 'left': ['mesh', 'left']}
    restart = lambda name: world.role(name, *roles[name])
    for name, timeout, reason in (('poses', POSE_TIMEOUT, Warning.POSE_STALE), ('left', MESH_TIMEOUT, Warning.MESH_STALE)):
        silence(world, warnings, table, name, timeout, has(reason), world.freeze, world.thaw, 'SIGSTOP', 1.0)
        silence(world, warnings, table, name, timeout, has(reason), world.kill, restart, 'kill -9', 5.0)


def freeze_bystander(world, warnings, table, name, seconds):
    warnings.wait_until_steadily_clear()
    mark, before = warnings.mark(), resident(world.guard())
    world.freeze(name)
    time.sleep(seconds)
    world.thaw(name)
    table.add(f'SIGSTOP of {name} for {seconds} s: largest age of the newest pose', [warnings.oldest_pose(mark)], 0.5)
    table.add(f'SIGSTOP of {name} for {seconds} s: growth of the guard', [resident(world.guard()) - before], 8.0, 'MB')


def program(world, name):
    return os.path.join(world.folder, '..', 'devel/lib/sweep_guard', name)


def fill_disk(world, table):
    folder = os.path.join(world.folder, 'full_disk')
    if not os.path.ismount(folder):
        print('SKIPPED: the full disk')
        return
    try:
        with open(os.path.join(folder, 'filling'), 'wb') as file:
            file.write(bytes(1 << 20))
    except OSError:
        pass
    warnings = Warnings('guard_on_a_full_disk')
    guard = world.start('guard_on_a_full_disk', [program(world, 'sweep_guard_node'), '__name:=guard_on_a_full_disk'],
                        at_peers=False, ROS_HOME=folder, ROS_LOG_DIR=folder)
    warnings.wait(clear, 0)
    warnings.wait_until_steadily_clear()
    begin = now()
    guard.terminate()
    code = guard.wait(20)
    table.add('full disk: exit status of a guard that was CLEAR', [code], 0, '')
    table.add('full disk: SIGTERM until its end', [now() - begin], 1.0)


def measure(options):
    world = World(options.peers, options.folder)
    table = Table()
    try:
        world.start_master()
        for name, role in (('poses', ['poses']), ('left', ['mesh', 'left']), ('right', ['mesh', 'right'])):
            world.role(name, *role)
        world.role('subscriber', 'subscribe')
        config = os.path.join(options.folder, 'parameters.yaml')
        world.write_config(config, ['left', 'right'])
        world.start('roslaunch', ['roslaunch', 'sweep_guard', 'sweep_guard.launch', 'config:=' + config], at_peers=False)
        world.start('motion_guard', [program(world, 'motion_guard_node')], at_peers=False)
        world.role('commands', 'commands')
        rospy.init_node('faults', disable_signals=True)
        warnings, motion = Warnings(), Motion()
        warnings.wait(clear, 0)
        asked = lambda part: options.only in (None, part)
        if asked('links'):
            break_link(world, warnings, table, options.links)
        if asked('publishers'):
            hurt_publishers(world, warnings, table)
        if asked('bystanders'):
            freeze_bystander(world, warnings, table, 'subscriber', 20)
            freeze_bystander(world, warnings, table, 'roscore', 10)
        if asked('kills'):
            kill_guard(world, warnings, motion, table, options.kills)
        if asked('disk'):
            fill_disk(world, table)
        if asked('masters'):
            restart_master(world, warnings, table, options.masters)
    except (TimeoutError, subprocess.TimeoutExpired) as error:
        table.add_failure(str(error))
    finally:
        world.end()
        print('\n' + table.text())
    return 1 if table.failed else 0


def play(role):
    rospy.init_node('_'.join(role), anonymous=role[0] == 'listen')
    if role[0] == 'poses':
        publish_poses()
    elif role[0] == 'mesh':
        publish_mesh(role[1])
    elif role[0] == 'commands':
        publish_commands()
    elif role[0] == 'listen':
        listen()
    else:
        for topic, message in (('warning', Warning), ('contacts', Contacts), ('view', View)):
            rospy.Subscriber('/sweep_guard/' + topic, message, lambda message: None)
        rospy.spin()


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--role', nargs='+')
    parser.add_argument('--peers')
    parser.add_argument('--folder')
    parser.add_argument('--only', choices=['links', 'publishers', 'bystanders', 'kills', 'masters', 'disk'])
    parser.add_argument('--kills', type=int, default=100)
    parser.add_argument('--masters', type=int, default=20)
    parser.add_argument('--links', type=int, default=3)
    asked = parser.parse_args(rospy.myargv()[1:])
    try:
        sys.exit(measure(asked) if asked.role is None else play(asked.role))
    except rospy.ROSInterruptException:
        pass
