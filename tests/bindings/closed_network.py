"""A network that is closed: a proxy for browsers of tests that refuses each request and keeps what was asked for."""
import re
import socket
import threading

BROWSERS = re.compile(r"(google|googleapis|gvt1|mozilla)\.(com|org)[:/]")  # what a browser asks for itself: time, updates


class ClosedNetwork:
    """`asked`: a list of the caller, which gets a sentence for each request, also of workers."""

    def __init__(self, asked):
        self._asked, self._door = asked, socket.create_server(("127.0.0.1", 0))
        self.port = self._door.getsockname()[1]
        threading.Thread(target=self._refuse, daemon=True).start()

    def _refuse(self):
        while True:
            try:
                one = self._door.accept()[0]
                with one:
                    one.settimeout(1)
                    words = one.recv(1 << 12).decode("latin-1").split()
                    one.sendall(b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\n\r\n")
            except OSError:
                if self._door.fileno() < 0:
                    return  # closed
                continue  # the browser gave up
            if words and not BROWSERS.search(words[1]):
                self._asked.append("asked the network for " + " ".join(words[:2]))

    def close(self):
        self._door.shutdown(socket.SHUT_RDWR)
        self._door.close()
