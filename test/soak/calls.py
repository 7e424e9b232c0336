"""Calls of the guard's services in the soak, one after the other, in a thread of their own."""
import queue
import threading
import time

import rospy
from dynamic_reconfigure.msg import BoolParameter, Config, DoubleParameter, StrParameter
from dynamic_reconfigure.srv import Reconfigure
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from std_msgs.msg import Header
from std_srvs.srv import SetBool, Trigger
from sweep_guard.msg import Intend
from sweep_guard.srv import Acknowledge, CheckSweep, Predict, SetIntent

NAMES = {'check_sweep': CheckSweep, 'predict': Predict, 'enable': SetBool, 'reset': Trigger, 'acknowledge': Acknowledge,
         'intend': SetIntent, 'set_parameters': Reconfigure}
HIGHEST, LOWEST = 0.9, -0.4  # [m] a path between them meets the plate wherever it is
HIGH = 0.75  # [m] above the plate wherever it is

def pose_at(z):
    return PoseStamped(Header(frame_id='world'), Pose(Point(z=z), Quaternion(x=1.0)))

def path_request(*heights):
    return CheckSweep._request_class(path=[pose_at(z) for z in heights])

def config(name, value):
    kinds = {bool: ('bools', BoolParameter), str: ('strs', StrParameter), float: ('doubles', DoubleParameter)}
    kind, message = kinds[type(value)]
    return Reconfigure._request_class(Config(**{kind: [message(name, value)]}))

class Calls:
    """Runs functions in their order."""

    def __init__(self):
        self._waiting = queue.Queue()
        self.answered = self.failed = 0
        threading.Thread(target=self._run, daemon=True).start()

    def later(self, function):
        self._waiting.put(function)

    def _run(self):
        while True:
            self._waiting.get()()

    def call(self, name, request):
        """Returns the answer, or None without one."""
        try:
            answer = rospy.ServiceProxy('/sweep_guard/' + name, NAMES[name]).call(request)
            self.answered += 1
            return answer
        except (rospy.ServiceException, rospy.ROSException, OSError):
            self.failed += 1
            return None

    def until_answered(self, name, request, give_up):
        """Calls again until it is answered. give_up: ends that"""
        while not give_up():
            answer = self.call(name, request)
            if answer is not None:
                return answer
            time.sleep(0.1)
        return None

def intend_everywhere():
    intend = Intend(mesh_id='plate', radius=10.0, depth=0.5)
    return SetIntent._request_class([intend])

def intend_nowhere():
    return SetIntent._request_class([Intend(mesh_id='plate')])
