"""Clients of the guard for rospy nodes. The messages are in sweep_guard.msg, the services in sweep_guard.srv."""
from .mesh_publisher import MeshPublisher
from .permission import is_clear, wait_for_clear
from .sweep_check import NotTested, check_sweep

__all__ = ['MeshPublisher', 'NotTested', 'check_sweep', 'is_clear', 'wait_for_clear']
