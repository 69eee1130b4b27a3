"""Asks `depthmocap serve` for poses, on a thread of its own: Blender never waits. Knows nothing of Blender."""
import http.client
import json
import socket
import threading
from urllib.parse import parse_qs, urlsplit

TIMEOUT_S = 1.0  # of a connection and of an answer; a solve takes some ms
OLDEST = (0, 2)  # version of the server that has all that is asked for


class ServerError(Exception):
    """What to tell the user."""


class IkConnection:
    """One connection, opened when it is needed. For one thread."""

    def __init__(self, url):
        parts = urlsplit(url if "//" in url else f"http://{url}")
        try:
            self.address = (parts.hostname, parts.port or 80)
        except ValueError:
            self.address = (None, 0)
        if parts.scheme != "http" or not self.address[0]:
            raise ServerError(f"{url} is no address of a server; for example http://127.0.0.1:8010")
        token = parse_qs(parts.query).get("token")
        self.headers = {"Authorization": f"Bearer {token[0]}"} if token else {}
        self.connection = None
        self.version = ""

    def ask(self, request):
        """The answer to POST /ik; ServerError says what went wrong."""
        if self.connection is None:
            self.open()
        return self.exchange("POST", "/ik", json.dumps(request))

    def open(self):
        self.connection = http.client.HTTPConnection(*self.address, timeout=TIMEOUT_S)
        self.version = str(self.exchange("GET", "/health").get("version", ""))
        numbers = self.version.split(".")
        if not all(part.isdigit() for part in numbers[:2]) or tuple(map(int, numbers[:2])) < OLDEST:
            self.close()
            oldest = ".".join(map(str, OLDEST))
            raise ServerError(f"The server has version {self.version or 'unknown'}; at least {oldest} is needed: update depthmocap")

    def exchange(self, method, path, body=None):
        where = "{}:{}".format(*self.address)
        try:
            self.connection.request(method, path, body, self.headers)
            self.connection.sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            response = self.connection.getresponse()
            answer = json.loads(response.read())
            if not isinstance(answer, dict):
                raise ValueError("no object")
        except socket.timeout as error:
            self.close()
            raise ServerError(f"The server at {where} does not answer within {TIMEOUT_S:.0f} s") from error
        except ConnectionRefusedError as error:
            self.close()
            raise ServerError(f"There is no server at {where}: start depthmocap serve") from error
        except OSError as error:
            self.close()
            raise ServerError(f"The connection to {where} is lost: {error}") from error
        except (http.client.HTTPException, ValueError) as error:
            self.close()
            raise ServerError(f"{where} does not answer as depthmocap does: is another program there?") from error
        if response.status != 200:
            if response.will_close:
                self.close()
            raise ServerError(str(answer.get("error", f"The server answers {response.status}")))
        return answer

    def close(self):
        if self.connection is not None:
            self.connection.close()
        self.connection = None


class IkClient:
    """Sends the latest request only: one that waits gives way to the next. Every method returns at once."""

    def __init__(self, url):
        self.connection = IkConnection(url)
        self.url = url
        self.changed = threading.Condition()
        self.request = None  # waits to be sent
        self.answer = None  # (request, answer), waits to be taken
        self.error = ""
        self.busy = False
        self.ends = False
        self.thread = threading.Thread(target=self.run, name="depthmocap ik", daemon=True)
        self.thread.start()

    def submit(self, request):
        with self.changed:
            self.request = request
            self.changed.notify()

    def take(self):
        """(request, answer) that came since the last call, or None."""
        with self.changed:
            answer, self.answer = self.answer, None
            return answer

    def is_idle(self):
        with self.changed:
            return self.request is None and self.answer is None and not self.busy

    def end(self):
        with self.changed:
            self.ends = True
            self.changed.notify()

    def run(self):
        while True:
            with self.changed:
                self.busy = False
                self.changed.wait_for(lambda: self.ends or self.request is not None)
                if self.ends:
                    break
                request, self.request = self.request, None
                self.busy = True
            try:
                answer, error = self.connection.ask(request), ""
            except ServerError as failure:
                answer, error = None, str(failure)
            with self.changed:
                self.error = error
                if answer is not None:
                    self.answer = (request, answer)
        self.connection.close()
