"""The blog's program, unchanged, in this process: what its server does for a request."""
import contextlib
import functools
import io
import os
import sys
import time

import numpy as np

from latent_pose import skeletons


class Program:
    def __init__(self, clone, skeleton):
        try:
            import torch
        except ImportError:
            sys.exit("PyTorch is missing; in a virtual environment: pip install torch numpy flask")
        self.torch, self.clone, self.skeleton = torch, clone, skeleton

    def __enter__(self):
        self.before = os.getcwd()
        os.chdir(self.clone)  # its files have relative names
        sys.path.insert(0, str(self.clone))
        if not self.torch.cuda.is_available():
            self.torch.Tensor.cuda = lambda tensor: tensor  # it moves its first tensors to a GPU and back
            self.torch.load = functools.partial(self.torch.load, map_location="cpu")  # its weights were saved on a GPU
        import server
        self.torch.set_num_threads(1)  # as ours
        self.server, self.model = server, server.model
        return self

    def __exit__(self, *_):
        os.chdir(self.before)

    def solve(self, truth, fresh):
        """Places [m] of JOINTS and the processor time [ms]; fresh: as the first request to the server."""
        torch, model = self.torch, self.model
        if fresh:
            with torch.no_grad():
                model.pose_embedding.zero_()
                model.global_trans.zero_()
            self.server.optimizer = torch.optim.Adam([model.pose_embedding, model.global_trans], lr=3e-1)  # as server.py
        places, mask = torch.zeros(1, 31, 3), torch.zeros(1, 31, 3)
        for joint in skeletons.TARGETS:
            i = self.skeleton.index[skeletons.OURS[joint]]
            place = skeletons.Z_UP @ truth[skeletons.JOINTS.index(joint)] / skeletons.METRES
            places[0, i], mask[0, i] = torch.tensor(place, dtype=torch.float32), 1
        began = time.process_time()
        with contextlib.redirect_stdout(io.StringIO()):
            self.server.predict_pose(places, mask)
        ms = 1000 * (time.process_time() - began)
        with torch.no_grad():
            points = model.forward()[0].numpy()
        return self.skeleton.ours([skeletons.METRES * skeletons.Z_UP.T @ p for p in points]), ms
