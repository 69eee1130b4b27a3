"""What says how natural a pose is: residuals r (n, rows) of poses (n, 93) and their Jacobian. As one row, as in the paper, a
prior is g = |r|^2."""
import math

import torch

COMPONENTS = 70  # of the mixture, as in GMM-IK
KEPT_VARIANCE = 0.99  # by the linear reduction before the mixture
EM_STEPS = 25
LEAST_DEVIATION_RAD = math.radians(0.5)  # of a Gaussian in any direction, so that no component shrinks to one motion


class Prior:
    def __init__(self, name):
        self.name = name

    def one_row(self, x):
        r, J = self.rows(x)
        return r.square().sum(dim=1, keepdim=True), 2 * (r[:, None] @ J)


class Nothing(Prior):
    def rows(self, x):
        return torch.zeros(len(x), 1, dtype=x.dtype), torch.zeros(len(x), 1, x.shape[1], dtype=x.dtype)


def principal(poses):
    """Mean, variances and directions, largest first."""
    mean = poses.mean(dim=0)
    variances, V = torch.linalg.eigh(torch.cov((poses - mean).T))
    return mean, variances.flip(0).clamp(min=0), V.flip(1)


class Ppca(Prior):
    """Probabilistic PCA: Mahalanobis distance."""

    def __init__(self, poses, dims):
        super().__init__(f"PPCA of {dims}")
        self.mean, variances, V = principal(poses)
        variances[dims:] = variances[dims:].mean()
        self.whiten = V.T / variances.sqrt()[:, None]

    def rows(self, x):
        return (x - self.mean) @ self.whiten.T, self.whiten.expand(len(x), -1, -1)


class Mixture(Prior):
    """GMM-IK: the most probable of 70 Gaussians in a linear subspace; what lies outside has one deviation."""

    def __init__(self, poses, seed=1):
        super().__init__("GMM")
        torch.manual_seed(seed)
        self.mean, variances, V = principal(poses)
        dims = int((variances.cumsum(0) / variances.sum() < KEPT_VARIANCE).sum()) + 1
        self.V, rest = V[:, :dims], V[:, dims:]
        self.rest = rest.T / variances[dims:].mean().sqrt()
        y = (poses - self.mean) @ self.V
        self.weights, self.means, self.factors = expectation_maximisation(y)
        self.inverse = torch.linalg.solve_triangular(self.factors, torch.eye(dims, dtype=y.dtype), upper=False)
        logs = -self.weights.log() + self.factors.diagonal(dim1=1, dim2=2).log().sum(dim=1)
        self.offsets = (2 * (logs - logs.min())).sqrt()
        self.typical = self.mean + self.means @ self.V.T

    def rows(self, x):
        d = x - self.mean
        y = d @ self.V
        distances = torch.einsum("kij,nkj->nki", self.inverse, y[:, None] - self.means).square().sum(-1)
        k = (distances + self.offsets.square()).argmin(dim=1)
        whiten = self.inverse[k] @ self.V.T
        r = torch.cat([(self.inverse[k] @ (y - self.means[k])[..., None])[..., 0], d @ self.rest.T, self.offsets[k, None]], 1)
        J = torch.cat([whiten, self.rest.expand(len(x), -1, -1), torch.zeros(len(x), 1, x.shape[1], dtype=x.dtype)], 1)
        return r, J


def log_densities(y, weights, means, factors):
    inverse = torch.linalg.solve_triangular(factors, torch.eye(y.shape[1], dtype=y.dtype), upper=False)
    values = torch.empty(len(y), len(means), dtype=y.dtype)
    for k in range(len(means)):
        values[:, k] = -0.5 * ((y - means[k]) @ inverse[k].T).square().sum(dim=1)
    return values + weights.log() - factors.diagonal(dim1=1, dim2=2).log().sum(dim=1)


def expectation_maximisation(y):
    """Weights, means and Cholesky factors of the covariances; starts from random poses and the whole's covariance."""
    means = y[torch.randperm(len(y))[:COMPONENTS]]
    weights = torch.full((COMPONENTS,), 1 / COMPONENTS, dtype=y.dtype)
    floor = LEAST_DEVIATION_RAD ** 2 * torch.eye(y.shape[1], dtype=y.dtype)
    factors = torch.linalg.cholesky(torch.cov(y.T) / 10 + floor).repeat(COMPONENTS, 1, 1)
    for _ in range(EM_STEPS):
        shares = log_densities(y, weights, means, factors).softmax(dim=1)
        counts = shares.sum(dim=0).clamp(min=1)
        weights, means = counts / counts.sum(), shares.T @ y / counts[:, None]
        for k in range(COMPONENTS):
            d = y - means[k]
            factors[k] = torch.linalg.cholesky((shares[:, k, None] * d).T @ d / counts[k] + floor)
    return weights, means, factors


class Autoencoder(Prior):
    """r = theta - theta^, what is lost on the way through the network; it runs in single precision."""

    def __init__(self, name, net):
        super().__init__(name)
        self.net = net.float()

    def one_row(self, x):
        inputs = x.float().requires_grad_(True)
        g = (inputs - self.net(inputs)).square().sum(dim=1)
        return g.detach().double()[:, None], torch.autograd.grad(g.sum(), inputs)[0].double()[:, None]

    def rows(self, x):
        value = x.float()
        tangents = torch.eye(x.shape[1]).expand(len(x), -1, -1)  # of each input
        for layer in self.net:
            if isinstance(layer, torch.nn.Linear):
                value, tangents = layer(value), tangents @ layer.weight.T
            else:
                tangents = tangents * (value > 0)[:, None]
                value = layer(value)
        return x - value.double(), torch.eye(x.shape[1], dtype=x.dtype) - tangents.transpose(1, 2).double()
