"""Our server."""
import json
import os
import pathlib
import socket
import subprocess
import time
import urllib.request

import numpy as np

from latent_pose import skeletons

WAYS = {"`latent`": {"solver": "latent"}, "`vae`": {"prior": "vae"}, "`autoencoder`": {"prior": "autoencoder"},
        "`gmm`": {"prior": "gmm"}}
START_S = 20


class Server:
    def __init__(self, program, actor):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.command = [str(program), "serve", "--actor", str(actor), "--port", str(self.port)]

    def __enter__(self):
        self.process = subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + START_S
        while True:
            try:
                return urllib.request.urlopen(f"http://127.0.0.1:{self.port}/health").read() and self
            except OSError:
                if self.process.poll() is not None or time.monotonic() > deadline:
                    raise
                time.sleep(0.1)

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def processor_ms(self):
        """That the server has used so far."""
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return 1000 * (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def solve_all(self, truths, joints, words):
        """Of each pose the places [m] of JOINTS and the processor time [ms], a request and its answer included."""
        began = self.processor_ms()
        found = [self.solve(truth, joints, words) for truth in truths]
        return [(joints, (self.processor_ms() - began) / len(truths)) for joints in found]

    def solve(self, truth, joints, words):
        targets = {joint: list(truth[skeletons.JOINTS.index(joint)]) for joint in joints}
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}/ik", json.dumps({"targets": targets, **words}).encode())
        answer = json.load(urllib.request.urlopen(request))
        return np.array([answer["joints"][joint] for joint in skeletons.JOINTS])
