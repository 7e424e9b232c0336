"""Calls a service with a deadline. rospy's ServiceProxy waits for as long as the server does."""
import io
import socket
import struct
import time
import xmlrpc.client

import rosgraph
import rospy
from rosgraph.network import decode_ros_handshake_header, encode_ros_handshake_header


class Deadline:
    def __init__(self, seconds):
        self.seconds = seconds
        self._end = time.monotonic() + seconds

    def left(self):
        return self._end - time.monotonic()

    def timeout(self):
        """Returns the time left [s] for a socket, which takes 0 for "do not wait"."""
        left = self.left()
        if not left > 0.0:
            raise socket.timeout('timed out')
        return left


class _TimedTransport(xmlrpc.client.Transport):
    def __init__(self, timeout):
        super().__init__()
        self._timeout = timeout

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self._timeout
        return connection


def _find(service, deadline):
    uri = rosgraph.get_master_uri()
    master = xmlrpc.client.ServerProxy(uri, _TimedTransport(deadline.timeout()))
    try:
        code, _, place = master.lookupService(rospy.get_caller_id(), service)
    except OSError as error:
        raise ConnectionError(f'no roscore answers at {uri}') from error
    if code != 1:
        raise ConnectionError('no node offers it')
    return rospy.core.parse_rosrpc_uri(place)


def _send(connection, data, deadline):
    connection.settimeout(deadline.timeout())
    connection.sendall(data)


def _receive(connection, size, deadline):
    data = bytearray()
    while len(data) < size:
        connection.settimeout(deadline.timeout())
        part = connection.recv(size - len(data))
        if not part:
            raise ConnectionError('the connection was closed')
        data += part
    return bytes(data)


def _receive_block(connection, deadline):
    length = _receive(connection, 4, deadline)
    return length + _receive(connection, struct.unpack('<I', length)[0], deadline)


def _shake_hands(connection, service, service_class, deadline):
    header = {'service': service, 'type': service_class._type, 'md5sum': service_class._md5sum,
              'callerid': rospy.get_caller_id()}
    _send(connection, encode_ros_handshake_header(header), deadline)
    answer = decode_ros_handshake_header(_receive_block(connection, deadline))
    if 'error' in answer:
        raise rospy.ServiceException(f"{service}: {answer['error']}")


def call(service, service_class, request, deadline):
    """Returns the response. No thread and no connection outlives the call.

    Raises OSError (as socket.timeout) if no answer came, rospy.ServiceException if the answer is an error.
    """
    with socket.create_connection(_find(service, deadline), deadline.timeout()) as connection:
        _shake_hands(connection, service, service_class, deadline)
        body = io.BytesIO()
        request.serialize(body)
        _send(connection, struct.pack('<I', len(body.getvalue())) + body.getvalue(), deadline)
        succeeded = _receive(connection, 1, deadline) != b'\0'
        answer = _receive_block(connection, deadline)[4:]
    if not succeeded:
        raise rospy.ServiceException(f"{service}: {answer.decode(errors='replace')}")
    return service_class._response_class().deserialize(answer)
