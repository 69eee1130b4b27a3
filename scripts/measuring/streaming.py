"""A long recording to play as a camera, and clients that read the stream of its page."""

import base64
import os
import shutil
import socket
import threading
import time
from urllib.parse import urlparse


PONG_S = 5.0  # a server that hears nothing from a page for a minute takes it for gone
PONG = bytes([0x8A, 0x80, 0, 0, 0, 0])  # masked, without a payload: as a browser answers a ping


class Client:
    def __init__(self, url, stalled):
        address = urlparse(url)
        self.socket = socket.create_connection((address.hostname, address.port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /stream HTTP/1.1\r\nHost: {address.netloc}\r\nConnection: Upgrade\r\n"
                             f"Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        self.received = 0
        if not stalled:
            threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        buffer = bytearray(1 << 20)
        answered = time.monotonic()
        try:
            while count := self.socket.recv_into(buffer):
                self.received += count
                if time.monotonic() - answered > PONG_S:
                    answered = time.monotonic()
                    self.socket.sendall(PONG)
        except OSError:
            pass  # it left

    def leave(self):
        self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()


def to_and_fro(recording, frames, folder):
    """The recording's frames to and fro, as one long recording."""
    shutil.copy(recording / "recording.json", folder)
    os.symlink(recording / "depth", folder / "depth")
    files = sorted(p.name for p in (recording / "depth").iterdir())
    files += files[-2:0:-1]
    rows = [f"{i},{i / 30:.6f},depth/{files[i % len(files)]}" for i in range(frames)]
    (folder / "frames.csv").write_text("\n".join(["frame,time_s,file", *rows]) + "\n")
