"""Places of joints and their Jacobian for many poses at once."""
import torch

AXES = torch.eye(3, dtype=torch.float64)


def about(axis, angles):
    """Rotations (..., 3, 3) about coordinate axis 0, 1 or 2."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = torch.zeros(*angles.shape, 3, 3, dtype=angles.dtype)
    c, s = angles.cos(), angles.sin()
    R[..., axis, axis] = 1
    R[..., i, i], R[..., i, j], R[..., j, i], R[..., j, j] = c, -s, s, c
    return R


def local_rotations(poses):
    """(n, 31, 3, 3) of poses (n, 93)."""
    z, y, x = poses.reshape(len(poses), -1, 3).unbind(-1)
    return about(2, z) @ about(1, y) @ about(0, x)


class Skeleton:
    def __init__(self, parents, ends_m):
        self.parents, self.ends_m = [int(p) for p in parents], torch.as_tensor(ends_m, dtype=torch.float64)
        count = len(self.parents)
        # Joints that turn about the same point as another one count once; the root stands still and does not count.
        self.places = [i for i in range(1, count) if self.parents[i] > 0 and self.parents[i] not in self.parents[:i]]
        self.below = torch.zeros(len(self.places), count, dtype=torch.bool)  # place moves when joint turns
        for row, place in enumerate(self.places):
            joint = self.parents[place]
            while joint >= 0:
                self.below[row, joint] = True
                joint = self.parents[joint]

    def forward(self, poses):
        """Places [m] (n, places, 3), and where joints are and their axes of rotation (n, 31, 3), (n, 31, 3, 3)."""
        z, y, _ = poses.reshape(len(poses), -1, 3).unbind(-1)
        R, Rz, Ry = local_rotations(poses), about(2, z), about(1, y)
        G, points, axes = [], [], []
        for i, parent in enumerate(self.parents):
            G_parent = G[parent] if parent >= 0 else torch.eye(3, dtype=poses.dtype).expand(len(poses), 3, 3)
            points.append(points[parent] + G_parent @ self.ends_m[parent] if parent >= 0 else torch.zeros(len(poses), 3, dtype=poses.dtype))
            G_z = G_parent @ Rz[:, i]
            axes.append(torch.stack([G_parent[:, :, 2], G_z[:, :, 1], (G_z @ Ry[:, i])[:, :, 0]], dim=1))
            G.append(G_parent @ R[:, i])
        points = torch.stack(points, dim=1)
        return points[:, self.places], points, torch.stack(axes, dim=1)

    def jacobian(self, places, points, axes, given):
        """(n, given, 3, 93) of the given places (n, given)."""
        arms = places.gather(1, given[..., None].expand(-1, -1, 3))[:, :, None] - points[:, None]
        arms = arms * self.below[given][..., None]
        J = torch.linalg.cross(axes[:, None], arms[:, :, :, None])
        return J.flatten(2, 3).transpose(2, 3)


def rotation_errors_deg(a, b):
    """Mean angle (n) between the local rotations of all joints."""
    R = local_rotations(a).transpose(-1, -2) @ local_rotations(b)
    cosine = (R.diagonal(dim1=-2, dim2=-1).sum(-1) - 1) / 2
    return torch.acos(cosine.clamp(-1, 1)).mean(dim=1).rad2deg()
