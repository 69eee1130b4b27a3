"""Requests that nobody should send, by a seeded random generator: what scripts/break-server gives the server."""

import base64
import json
import struct

JOINTS = ["head", "neck", "pelvis", "left_wrist", "right_wrist", "left_ankle", "right_ankle"]
ODD = ["nan", "inf", "-1", "1e308", "1e999", "null", "true", '""', "[]", "{}", '"\\u0000"', "99999999999999999999"]
PATHS = ["/", "/ik", "/health", "/stream", "/body.glb", "/openapi.json", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//", "/%00",
         "/ik?token=" + "a" * 4000, "/\xff\xfe", "/" + "a/" * 3000, "*", "http://example.com/", "/view.js%0d%0aX: y"]
METHODS = ["GET", "POST", "HEAD", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "get", "G" * 5000, "", "PRI"]
HEADERS = ["Content-Length: -1", "Content-Length: 99999999999", "Content-Length: 5\r\nContent-Length: 6", "Content-Length: 0x10",
           "Transfer-Encoding: chunked", "Transfer-Encoding: chunked\r\nContent-Length: 3", "Expect: 100-continue",
           "Expect: nonsense", "Connection: keep-alive, Upgrade", "Upgrade: h2c", "Host: evil.example", "Host: localhost\r\nHost: evil",
           "Origin: http://evil.example", "Origin: null", "X: " + "y" * 9000, "\r\n".join(f"X{i}: y" for i in range(300)), " folded: x",
           "No colon", "Range: bytes=0-,0-,0-", "Authorization: Bearer " + "z" * 500, "Content-Encoding: gzip", "X: \x00\x01"]


def good_body():
    targets = {"head": [0, 1.65, 0], "left_wrist": [0.5, 1.2, 0.3], "right_wrist": [-0.4, 1.0, 0.2], "pelvis": [0, 0.95, 0]}
    return json.dumps({"targets": targets, "prior": "gmm"})


def request(host, method, path, headers, body=b""):
    lines = [f"{method} {path} HTTP/1.1", f"Host: {host}", *headers]
    return "\r\n".join(lines).encode("latin-1") + b"\r\n\r\n" + body


def flipped(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice([1, 2, 8, 40])):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def hostile_body(rng):
    how = rng.randrange(6)
    if how == 0:
        value = rng.choice(ODD)
        return f'{{"targets": {{"{rng.choice(JOINTS)}": [{value}, {rng.choice(ODD)}, 0]}}}}'.encode()
    if how == 1:
        return f'{{"targets": {{"head": [0, 1.6, 0]}}, "{rng.choice(["prior", "solver", "weights", "start", "hold", "bones", "prior_weight_m"])}": {rng.choice(ODD)}}}'.encode()
    if how == 2:
        return b"[" * rng.choice([10, 1000, 60_000])
    if how == 3:
        return b'{"targets": {' + b",".join(b'"head": [0, 1, 0]' for _ in range(rng.choice([2, 500, 3000]))) + b"}}"
    if how == 4:
        return flipped(good_body().encode(), rng)
    return bytes(rng.randrange(256) for _ in range(rng.choice([1, 100, 5000])))


def post(host, rng):
    body = hostile_body(rng)
    length = len(body) if rng.random() < 0.8 else rng.choice([0, 1, len(body) + 1, 70_000, 10**9])
    return request(host, "POST", "/ik", [f"Content-Length: {length}"], body)


def odd_request(host, rng):
    headers = rng.sample(HEADERS, rng.choice([0, 1, 1, 2, 4]))
    body = hostile_body(rng) if rng.random() < 0.5 else b""
    return request(host, rng.choice(METHODS), rng.choice(PATHS), headers, body)


def damaged_request(host, rng):
    return flipped(request(host, "POST", "/ik", [f"Content-Length: {len(good_body())}"], good_body().encode()), rng)


def noise(_, rng):
    if rng.random() < 0.3:
        return rng.choice([b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200), b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
                           b"\r\n" * 5000, b"GET / HTTP/9.9\r\n\r\n", b"GET /\r\n\r\n", b"SSH-2.0-x\r\n"])
    return bytes(rng.randrange(256) for _ in range(rng.choice([1, 50, 3000])))


def frame(rng, payload):
    """A WebSocket frame whose header is wrong more often than not."""
    first = rng.choice([0x81, 0x82, 0x01, 0x00, 0x80, 0x88, 0x89, 0x8A, 0xF1, 0x83, rng.randrange(256)])
    length = rng.choice([len(payload)] * 4 + [0, 125, 70_000, 2**62, 2**64 - 1])
    masked = 0x80 if rng.random() < 0.8 else 0
    head = bytes([first])
    if length < 126:
        head += bytes([masked | length])
    elif length < 65536:
        head += bytes([masked | 126]) + struct.pack(">H", length)
    else:
        head += bytes([masked | 127]) + struct.pack(">Q", length)
    key = rng.randbytes(4)
    return head + (key + bytes(b ^ key[i % 4] for i, b in enumerate(payload)) if masked else payload)


def socket_messages(host, rng):
    key = base64.b64encode(rng.randbytes(16)).decode()
    headers = ["Connection: Upgrade", "Upgrade: websocket", "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {key}"]
    messages = [b'{"type": "seek", "frame": 1e308}', b'{"type": "lock", "x": -1, "y": "a"}', b'{"type": "record", "on": 1}', b"ready" * 1000,
                b'{"type": ' + b"[" * 3000, b'{"type": "speed", "value": nan}', b"\xff\xfe", b"", b'{"type": "calibrate"}' * 100]
    return request(host, "GET", "/stream", headers) + b"".join(frame(rng, rng.choice(messages)) for _ in range(rng.randrange(1, 12)))


KINDS = [post, post, odd_request, odd_request, damaged_request, noise, socket_messages]
