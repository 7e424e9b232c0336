"""Reads the warning of the guard as doc/safety.md asks for."""
import threading
import time

import rospy
from sweep_guard.msg import Warning

_POLL = 0.1  # [s] between looks at whether the node is shutting down


def is_clear(warning: Warning) -> bool:
    """Returns whether the newest warning permits a motion now: it is clear and still valid.

    Ask again before each motion: a warning is valid for 0.2 s. The clocks of the machines must be synchronized.
    """
    now = rospy.Time.now()
    return warning.clear and not now.is_zero() and now < warning.valid_until


class _NewestWarning:
    def __init__(self):
        self._arrived = threading.Condition()
        self.warning = None

    def take(self, warning):
        with self._arrived:
            self.warning = warning
            self._arrived.notify_all()

    def wait_until_clear(self, timeout):
        """Returns the warning, or None if none was clear in time."""
        end = time.monotonic() + timeout
        with self._arrived:
            while not rospy.is_shutdown():
                if self.warning is not None and is_clear(self.warning):
                    return self.warning
                left = end - time.monotonic()
                if not left > 0.0:
                    return None
                self._arrived.wait(min(left, _POLL))
        raise rospy.ROSInterruptException('the node is shutting down')


def wait_for_clear(timeout: float, guard: str = 'sweep_guard') -> Warning:
    """Waits for at most `timeout` [s] of wall time and returns the Warning that is clear and still valid.

    Raises TimeoutError with the text of the last warning.
    guard: name of its node
    """
    newest = _NewestWarning()
    topic = rospy.resolve_name(guard + '/warning')
    subscriber = rospy.Subscriber(topic, Warning, newest.take, tcp_nodelay=True)
    try:
        clear = newest.wait_until_clear(timeout)
    finally:
        subscriber.unregister()
    if clear is None:
        raise TimeoutError(f'not clear within {timeout} s: ' + _reason(newest.warning, topic))
    return clear


def _reason(warning, topic):
    if warning is None:
        return f'no warning arrived on {topic}'
    if warning.clear:
        return f"the last warning, '{warning.text}', is no longer valid, or the clocks differ"
    return warning.text
