"""Subscribes to a topic of the guard without registering at the master: what restarts there does not interrupt it."""
import http.client
import socket
import threading
import time
import xmlrpc.client

from link import LENGTH, read_frame

RETRY = 0.05  # [s]


class Impatient(xmlrpc.client.Transport):
    def make_connection(self, host):
        return http.client.HTTPConnection(host, timeout=2.0)


def ask(uri, method, *arguments):
    """Value of an answer of ROS's slave or master API. Raises OSError."""
    try:
        code, text, value = getattr(xmlrpc.client.ServerProxy(uri, Impatient()), method)('/soak_listener', *arguments)
    except (xmlrpc.client.Error, http.client.HTTPException, ValueError) as error:
        raise OSError(str(error)) from error
    if code != 1:
        raise OSError(text)
    return value


def header(**fields):
    lines = [f'{key}={value}'.encode() for key, value in fields.items()]
    content = b''.join(LENGTH.pack(len(line)) + line for line in lines)
    return LENGTH.pack(len(content)) + content


class Listener:
    def __init__(self, master, node, topic, message, take):
        """take: called with the time of receipt [s] and the bytes of each message"""
        self._asked = master, node, topic, message
        self._take = take
        self._open = True
        threading.Thread(target=self._run, daemon=True).start()

    def end(self):
        self._open = False

    def _run(self):
        while self._open:
            try:
                with self._connect() as connection:
                    while self._open:
                        frame = read_frame(connection)
                        self._take(time.monotonic(), bytes(frame))
            except OSError:
                time.sleep(RETRY)

    def _connect(self):
        master, node, topic, message = self._asked
        uri = ask(master, 'lookupNode', node)
        protocol = ask(uri, 'requestTopic', topic, [['TCPROS']])
        connection = socket.create_connection((protocol[1], protocol[2]), timeout=2.0)
        connection.settimeout(None)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.sendall(header(callerid='/soak_listener', topic=topic, type=message._type, md5sum=message._md5sum,
                                  tcp_nodelay=1))
        read_frame(connection)
        return connection
