"""The processes of the soak: a master, a guard as a new user launches it, and what sends to it through links."""
import os
import random
import signal
import socket
import subprocess
import sys
import threading
import time

import rosgraph
from process_table import children, program

import link
import listener
import world

HERE = os.path.dirname(os.path.abspath(__file__))
START_TIME = 60.0  # [s] within which a master or a guard has to answer
END_TIME = 20.0  # [s] within which a launched process ends
PEER_END_TIME = 2.0  # [s] the same of a peer: after its master was started anew, one of rospy sometimes never ends


def free_port():
    with socket.socket() as listening:
        listening.bind(('127.0.0.1', 0))
        return listening.getsockname()[1]


class GuardedWorld:
    """One master, one guard and one of each peer, each with its log."""

    def __init__(self, folder, simulated, note):
        """note: as of link.Link"""
        self.folder = folder
        self.port = free_port()
        self.master = f'http://127.0.0.1:{self.port}'
        self.simulated = simulated
        self.clock_file = os.path.join(folder, 'clock') if simulated else ''
        self.clock = world.StampClock(self.clock_file)
        if simulated:
            self.clock.set(10**12)
        self.running = {}
        self.frozen = {}
        self.ports = {name: free_port() for name in self.peers()}
        self.links = {name: link.Link(note, port) for name, port in self.ports.items()}
        self.lock = threading.Lock()

    def start(self, name, command):
        log = open(os.path.join(self.folder, name + '.log'), 'ab')
        environment = dict(os.environ, ROS_MASTER_URI=self.master, ROS_IP='127.0.0.1')
        self.running[name] = subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, env=environment,
                                              start_new_session=True)
        return self.running[name]

    def start_all(self):
        self.start_master()
        for name in self.peers():
            self.start_peer(name)
        self.start('guard', ['nice', '-n', str(-os.nice(0)), 'roslaunch', '-p', str(self.port), 'sweep_guard', 'sweep_guard.launch'])

    def start_master(self):
        self.start('roscore', ['roscore', '-p', str(self.port)])
        deadline = time.monotonic() + START_TIME
        while time.monotonic() < deadline:
            try:
                listener.ask(self.master, 'getParam', '/run_id')
                break
            except OSError:
                time.sleep(0.02)
        else:
            raise TimeoutError(f'roscore does not answer within {START_TIME:g} s')
        if self.simulated:
            listener.ask(self.master, 'setParam', '/use_sim_time', True)

    def peers(self):
        return (['clock'] if self.simulated else []) + ['tf', 'mesh', 'poses']

    def start_peer(self, name):
        command = [sys.executable, os.path.join(HERE, 'peers.py'), name, '--clock', self.clock_file]
        command += ['--port', str(self.ports[name]), '--proxy', str(self.links[name].port)]
        self.start(name, command)

    def guard(self):
        """Process id of the guard below roslaunch; None: there is none now."""
        found = [pid for pid in children(self.running['guard'].pid) if program(pid).endswith('sweep_guard_node')]
        return found[0] if found else None

    def pids(self, name):
        if name == 'guard':
            guard = self.guard()
            return [] if guard is None else [guard]
        if name not in self.running:
            return []
        return [self.running[name].pid] + children(self.running[name].pid)

    def freeze(self, name):
        self.frozen[name] = self.pids(name)
        self._signal(self.frozen[name], signal.SIGSTOP)

    def thaw(self, name):
        self._signal(self.frozen.pop(name), signal.SIGCONT)

    def kill(self, name, by=signal.SIGKILL):
        """Ends a process; a guard is started again by roslaunch."""
        self._signal(self.pids(name), by)
        if name != 'guard' and name in self.running:
            self._wait(self.running.pop(name), PEER_END_TIME)

    def restart_publishers(self):
        """Those of rospy do not register at a new master."""
        for name in self.peers():
            self.kill(name, signal.SIGTERM)
        for name in random.sample(self.peers(), len(self.peers())):
            self.start_peer(name)

    @staticmethod
    def _signal(pids, number):
        for pid in pids:
            try:
                os.kill(pid, number)
            except ProcessLookupError:
                pass

    @staticmethod
    def _wait(process, seconds=END_TIME):
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def end(self):
        for pids in self.frozen.values():
            self._signal(pids, signal.SIGCONT)
        for process in reversed(list(self.running.values())):
            process.send_signal(signal.SIGINT)
            self._wait(process)


def corruption(what, seed):
    return {'flip bits': link.flip_bit, 'noise': link.replace_bytes, 'shorten': link.shorten}[what](random.Random(seed))
