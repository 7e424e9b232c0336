"""A TCP proxy between a publisher and the guard, which delays, stalls, cuts and corrupts, and notes what departs when."""
import collections
import socket
import struct
import threading
import time

LENGTH = struct.Struct('<I')
MAX_WAITING = 16 << 20  # [bytes] that a link takes from the publisher while they cannot depart
MAX_FRAMES = 3000  # the same


def field(header, name):
    """A field of a TCPROS connection header, without the length before it."""
    place = 0
    while place + LENGTH.size <= len(header):
        size, = LENGTH.unpack_from(header, place)
        key, _, value = header[place + LENGTH.size:place + LENGTH.size + size].partition(b'=')
        if key == name.encode():
            return value.decode()
        place += LENGTH.size + size
    return ''


def read_exactly(connection, size):
    data = bytearray(size)
    view, got = memoryview(data), 0
    while got < size:
        count = connection.recv_into(view[got:])
        if count == 0:
            raise ConnectionError('closed')
        got += count
    return data


def read_frame(connection):
    return read_exactly(connection, LENGTH.unpack(read_exactly(connection, LENGTH.size))[0])


def read_frames(connection):
    """Yields lists of whole frames, all that have arrived."""
    left = bytearray()
    while True:
        received = connection.recv(1 << 18)
        if not received:
            raise ConnectionError('closed')
        left += received
        frames, place = [], 0
        while place + LENGTH.size <= len(left):
            end = place + LENGTH.size + LENGTH.unpack_from(left, place)[0]
            if end > len(left):
                break
            frames.append(left[place + LENGTH.size:end])
            place = end
        del left[:place]
        if frames:
            yield frames


class Connection:
    """Passes the frames of one topic to one subscriber."""

    def __init__(self, link, subscriber):
        self.link, self.subscriber = link, subscriber
        self.publisher = None
        self.waiting = collections.deque()  # when due, frame
        self.changed = threading.Condition()
        self.size = 0
        self.open = True
        self.garbled = False
        threading.Thread(target=self._run, daemon=True).start()

    def close(self):
        with self.changed:
            self.open = False
            self.changed.notify_all()
        for end in (self.subscriber, self.publisher):
            if end is not None:
                try:
                    end.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass
                end.close()

    def _run(self):
        try:
            request = read_frame(self.subscriber)
            self.publisher = socket.create_connection(('127.0.0.1', self.link.publisher_port), timeout=5.0)
            self.publisher.settimeout(None)
            for end in (self.subscriber, self.publisher):
                end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self.publisher.sendall(LENGTH.pack(len(request)) + request)
            answer = read_frame(self.publisher)
            self.subscriber.sendall(LENGTH.pack(len(answer)) + answer)
            threading.Thread(target=self._send, args=(field(request, 'topic'), field(request, 'callerid')), daemon=True).start()
            for frames in read_frames(self.publisher):
                self._take(frames)
        except (OSError, ConnectionError, struct.error):
            pass
        finally:
            self.close()
            self.link.forget(self)

    def _take(self, frames):
        with self.changed:
            while self.open and (self.size > MAX_WAITING or len(self.waiting) > MAX_FRAMES):
                self.changed.wait(1.0)
            due = time.monotonic() + self.link.delay
            self.waiting.extend((due, frame) for frame in frames)
            self.size += sum(map(len, frames))
            self.changed.notify_all()

    def _due(self):
        """The frames that are due, once there are any; none when the connection is closed."""
        with self.changed:
            while self.open:
                now, frames = time.monotonic(), []
                while self.waiting and max(self.waiting[0][0], self.link.stalled_until) <= now:
                    frames.append(self.waiting.popleft()[1])
                if frames:
                    self.size -= sum(map(len, frames))
                    self.changed.notify_all()
                    return frames
                due = max(self.waiting[0][0], self.link.stalled_until) if self.waiting else now + 1.0
                self.changed.wait(min(due - now, 0.1))
        return []

    def _send(self, topic, subscriber):
        try:
            while frames := self._due():
                for frame in frames:
                    self._pass_on(topic, subscriber, frame)
        except OSError:
            self.close()

    def _pass_on(self, topic, subscriber, frame):
        length = len(frame)
        corrupt = self.link.corruption
        if self.garbled and corrupt is None:
            raise ConnectionError('the subscriber cannot read on')
        if corrupt is not None:
            length, self.garbled = corrupt(frame, self.garbled)
        if not self.garbled:
            self.link.note(topic, subscriber, time.monotonic(), frame, corrupt is not None)
        if len(frame) < 1024:
            self.subscriber.sendall(LENGTH.pack(length) + frame)
        else:
            self.subscriber.sendall(LENGTH.pack(length))
            self.subscriber.sendall(frame)


class Link:
    def __init__(self, note, publisher_port):
        """note: called with topic, subscriber, time of departure [s], frame and whether it is corrupted, just before it departs"""
        self.note = note
        self.publisher_port = publisher_port
        self.delay = 0.0  # [s] of every frame
        self.stalled_until = 0.0  # [s] of the monotonic clock
        self.closed_until = 0.0  # no connection is accepted until then
        self.corruption = None  # function of a frame, changes it and returns the length to announce and whether frames are lost
        self._connections = set()
        self._lock = threading.Lock()
        self._listener = socket.create_server(('127.0.0.1', 0))
        self.port = self._listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            connection, _ = self._listener.accept()
            if time.monotonic() < self.closed_until:
                connection.close()
                continue
            with self._lock:
                self._connections.add(Connection(self, connection))

    def forget(self, connection):
        with self._lock:
            self._connections.discard(connection)

    def cut(self, closed_for=0.0):
        self.closed_until = time.monotonic() + closed_for
        with self._lock:
            connections = list(self._connections)
        for connection in connections:
            connection.close()


def flip_bit(random):
    """Changes one bit of every frame; the frames stay apart."""
    def corrupt(frame, garbled):
        place = random.randrange(len(frame))
        frame[place] ^= 1 << random.randrange(8)
        return len(frame), garbled
    return corrupt


def shorten(random):
    """Announces fewer or more bytes than follow: nothing can be read any more. Afterwards the connection is closed."""
    def corrupt(frame, _garbled):
        return max(0, len(frame) + random.choice((-7, -1, 1, 3, 64))), True
    return corrupt


def replace_bytes(random):
    """Sends noise in place of every frame."""
    def corrupt(frame, garbled):
        frame[:] = random.getrandbits(8 * len(frame)).to_bytes(len(frame), 'little')
        return len(frame), garbled
    return corrupt
