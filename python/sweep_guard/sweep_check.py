"""Asks the guard whether a path is free."""
import time
from typing import Iterable

import rospy
from geometry_msgs.msg import PoseStamped
from sweep_guard.srv import CheckSweep, CheckSweepRequest, CheckSweepResponse

from .service_call import Deadline, call

_RETRY = 0.05  # [s]


class NotTested(RuntimeError):
    """The guard answered that it could not test the path. The text says why."""


def check_sweep(path: Iterable[PoseStamped], mesh_ids: Iterable[str] = (), deadline: float = 1.0, margin: float = 0.0,
                fine: bool = False, volume: str = '', detector: str = '',
                guard: str = 'sweep_guard') -> CheckSweepResponse:
    """Returns the response of srv/CheckSweep.srv to the poses of the tool frame in `path`.

    Only its field `clear` means that the path is free: without a collision, a workpiece may still be stale.

    mesh_ids: workpieces to test; none: all
    deadline: [s] of wall time for everything. While the guard is not there or BUSY, it is asked again. What it still
        tests after the deadline, it gives up at its parameter check_sweep/deadline.
    margin: [m] by which the tool is grown
    fine, volume, detector: as in srv/CheckSweep.srv
    guard: name of its node

    Raises NotTested if the path was not tested, TimeoutError if no answer came by the deadline.
    """
    request = CheckSweepRequest(path=list(path), mesh_ids=list(mesh_ids), margin=margin, fine=fine, volume=volume,
                                detector=detector)
    response = _ask(rospy.resolve_name(guard + '/check_sweep'), request, Deadline(deadline))
    if not response.success:
        raise NotTested(response.message)
    return response


def _ask(service, request, deadline):
    reasons = {}  # each once, in their order
    while not rospy.is_shutdown():
        try:
            response = call(service, CheckSweep, request, deadline)
            if not response.message.startswith('BUSY'):
                return response
            reasons[response.message] = True
        except OSError as error:
            reasons[str(error)] = True
        if deadline.left() < _RETRY:
            raise TimeoutError(f"{service} gave no answer within {deadline.seconds} s: {'; '.join(reasons)}")
        time.sleep(_RETRY)
    raise rospy.ROSInterruptException('the node is shutting down')
