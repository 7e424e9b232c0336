"""Publishes a workpiece from numpy arrays."""
import io
import struct
import threading
import time
from typing import Any, Optional, Sequence, Union

import numpy
import rospy
from sweep_guard.msg import DeformableMesh, MeshVertices

from .mesh_arrays import (COARSE_ROUNDING, MAX_ROUNDING, checked_faces, checked_vertices, coarse_text,
                          float32_rounding)

_MAX_WORKPIECES = 1000  # that a guard watches; the meshes of all may wait for one connection
_MAX_NAME_LENGTH = 128  # [bytes]
_COUNT = struct.Struct('<I')  # goes before each array
_ALIVE_PERIOD = 0.1  # [s]

Rows = Union[numpy.ndarray, Sequence[Sequence[float]]]  # of three numbers


class _Packed:
    """A message whose arrays, the last of its fields, are serialized already: rospy would pack each element."""
    packed = b''

    def serialize(self, buff):
        without_arrays = io.BytesIO()
        super().serialize(without_arrays)
        buff.write(without_arrays.getvalue()[:-self.array_count * _COUNT.size])
        buff.write(self.packed)


class _PackedMesh(_Packed, DeformableMesh):
    array_count = 2

    def pack(self, vertices, faces):
        self.packed = _packed_array(faces, '<u4') + _packed_array(vertices, '<f8')


class _PackedVertices(_Packed, MeshVertices):
    array_count = 1

    def pack(self, vertices):
        self.packed = _packed_array(vertices.ravel(), '<f4')


def _packed_array(array, dtype):
    return _COUNT.pack(len(array)) + array.astype(dtype).tobytes()


def _checked_name(what, name):
    if not name or len(name.encode()) > _MAX_NAME_LENGTH or not name.isprintable():
        raise ValueError(f'{what} is {name!r}: give 1 to {_MAX_NAME_LENGTH} printable characters')
    return name


class MeshPublisher(rospy.SubscribeListener):
    """Publishes one workpiece: its triangles once, then its vertices as it deforms.

    A guard that starts later, or again, receives the newest mesh of every MeshPublisher of the node. rospy's own latch
    keeps one message for each topic of a node, however many publishers the node has.
    """

    _publishing = threading.RLock()  # rospy's message to one new subscriber shares a buffer with those to all

    def __init__(self, mesh_id: str, frame: str, mesh_topic: str = 'mesh', vertices_topic: str = 'mesh_vertices',
                 queue_size: int = 10, open: bool = False, rests: bool = False):
        """
        mesh_id: name of the workpiece
        frame: tf frame of the vertices
        queue_size: how many vertex messages of this node may wait for the network, of all its workpieces together;
            then the oldest is dropped
        open: the surface has no inside, as cloth or sheet metal: the guard does not test whether the tool is inside, and
            does not report INSIDE_UNTESTED
        rests: it does not deform. A thread says 10 times a second that it is as it was, until the node shuts down, so that
            the guard notices the end of this node. To move it, publish() it again
        """
        self.mesh_id = _checked_name('mesh_id', mesh_id)
        self.frame = _checked_name('frame', frame)
        self.open = open
        self.rests = rests
        self.revision = 0
        self._faces = self._vertex_count = self._newest = None
        self._mesh = rospy.Publisher(mesh_topic, DeformableMesh, subscriber_listener=self, queue_size=_MAX_WORKPIECES,
                                     headers={'latching': '1'})
        self._vertices = rospy.Publisher(vertices_topic, MeshVertices, queue_size=queue_size)
        if rests:
            threading.Thread(target=self._confirm_until_shutdown, daemon=True).start()

    def publish(self, vertices: Any, faces: Optional[Rows] = None, stamp: Optional[rospy.Time] = None) -> None:
        """Publishes vertices [m] and triangles, or a mesh that has `vertices` and `faces`, as trimesh's.

        The revision changes with the triangles. stamp: when the vertices had these positions; None: now.
        Raises ValueError, and sends nothing, if the guard would refuse the mesh.
        """
        if faces is None:
            if not (hasattr(vertices, 'vertices') and hasattr(vertices, 'faces')):
                raise ValueError('give vertices and faces, or one mesh that has both')
            vertices, faces = vertices.vertices, vertices.faces
        vertices = checked_vertices(vertices)
        faces = checked_faces(faces, len(vertices))
        with self._publishing:
            self._count_revision(faces, len(vertices))
            mesh = self._fill(_PackedMesh(), stamp)
            mesh.open = self.open
            mesh.pack(vertices, faces)
            self._newest = mesh
            self._mesh.publish(mesh)

    def deform(self, vertices: Rows, stamp: Optional[rospy.Time] = None) -> None:
        """Publishes new positions [m] of all vertices of the published mesh, in their order. Sends float32.

        From coordinates of about 30 km on, float32 rounds them by more than 1 mm, which is logged; by more than 10 mm
        from about 130 km on, which is refused. Choose a frame near the workpiece.
        Raises ValueError, and sends nothing, if the guard would refuse them.
        """
        if self.rests:
            raise ValueError(f"'{self.mesh_id}' rests: publish() it again, or make its MeshPublisher without rests")
        vertices = checked_vertices(vertices)
        with self._publishing:
            if self._newest is None:
                raise ValueError(f"'{self.mesh_id}' is not published: call publish(vertices, faces) first")
            if len(vertices) != self._vertex_count:
                raise ValueError(f"{len(vertices)} vertices, but '{self.mesh_id}' has {self._vertex_count}: "
                                 'call publish(vertices, faces) when the triangles change')
            self._check_rounding(vertices)
            update = self._fill(_PackedVertices(), stamp)
            update.pack(vertices)
            self._vertices.publish(update)

    def remove(self) -> None:
        """Removes the workpiece from the guard, whoever published it."""
        with self._publishing:
            self._newest = self._faces = None
            self._mesh.publish(self._fill(DeformableMesh(), None))

    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        with self._publishing:
            if self._newest is not None:
                peer_publish(self._newest)

    def _confirm_until_shutdown(self):
        while not rospy.is_shutdown():
            with self._publishing:
                if self._newest is not None:
                    self._vertices.publish(self._fill(MeshVertices(), None))
            time.sleep(_ALIVE_PERIOD)

    def _check_rounding(self, vertices):
        rounding = float32_rounding(vertices)
        if rounding > MAX_ROUNDING:
            raise ValueError(coarse_text(self.mesh_id, rounding))
        if rounding >= COARSE_ROUNDING:
            rospy.logwarn_throttle(60.0, coarse_text(self.mesh_id, rounding))

    def _count_revision(self, faces, vertex_count):
        same = self._faces is not None and vertex_count == self._vertex_count and numpy.array_equal(faces, self._faces)
        if self.rests or not same:  # what is confirmed is this mesh
            self.revision += 1
        self._faces, self._vertex_count = faces, vertex_count

    def _fill(self, message, stamp):
        message.header.stamp = rospy.Time.now() if stamp is None else stamp
        message.header.frame_id = self.frame
        message.id = self.mesh_id
        message.revision = self.revision
        return message
