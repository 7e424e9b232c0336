#!/usr/bin/env python3
"""A nodelet manager that ends does not register again at its master, which is this test."""
import os
import signal
import subprocess
import threading
import unittest

from rosgraph.xmlrpc import XmlRpcNode
from rosmaster.master_api import ROSMasterHandler

NODE = '/sweep_guard'
COMMAND = ['rosrun', 'nodelet', 'nodelet', 'standalone', 'sweep_guard/SweepGuardNodelet', '__name:=' + NODE[1:]]
PATIENCE = 20.0  # [s]
TIME_TO_ANSWER = 0.4  # [s], less than the guard waits for an answer
ATTEMPTS = 10  # a busy machine may not end it in time


class Master(ROSMasterHandler):
    """Answers the guard's question whether it is known only when it has unregistered, while it ends."""

    def __init__(self):
        super().__init__(num_workers=1)
        self._has_address = threading.Event()
        self._asked = threading.Event()
        self._gone = threading.Event()
        self._answered_in_time = False
        self._calls_after_the_answer = []

    def _ready(self, uri):
        super()._ready(uri)
        self._has_address.set()

    def _dispatch(self, method, params):
        of_node = bool(params) and params[0] == NODE
        if of_node and method == 'lookupNode' and not self._asked.is_set():
            self._asked.set()
            self._answered_in_time = self._gone.wait(TIME_TO_ANSWER)
        elif of_node and self._gone.is_set() and method.startswith(('register', 'setParam')):
            self._calls_after_the_answer.append(method)
        result = getattr(self, method)(*params)
        if self._asked.is_set() and self.reg_manager.get_node(NODE) is None:
            self._gone.set()
        return result


class EndingNodeTest(unittest.TestCase):
    def run_node(self):
        """Returns the master of a node that ended while its question waited for an answer."""
        master = Master()
        server = XmlRpcNode(0, master)
        server.start()
        self.assertTrue(master._has_address.wait(PATIENCE))
        node = subprocess.Popen(COMMAND, env=dict(os.environ, ROS_MASTER_URI=server.uri))
        try:
            self.assertTrue(master._asked.wait(PATIENCE), 'it has not asked whether it is known')
            node.send_signal(signal.SIGINT)
            self.assertEqual(node.wait(PATIENCE), 0)
        finally:
            node.kill()
            node.wait()
            server.shutdown('the test ends')
        return master

    def test_does_not_register_again(self):
        for _ in range(ATTEMPTS):
            master = self.run_node()
            self.assertEqual(master._calls_after_the_answer, [])
            if master._answered_in_time:
                return
        self.fail('it has not unregistered in time')


if __name__ == '__main__':
    unittest.main()
