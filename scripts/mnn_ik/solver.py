"""The paper's Levenberg-Marquardt algorithm (its algorithm 1, method (8)), for many poses at once."""
import torch

TAU = 1e-3  # the paper's
MOST_TRIES = 100  # accepted or rejected; the paper does not give its k_max
LEAST_STEP_RAD = 1e-4  # epsilon_2, of the whole step
LEAST_ERROR = 1e-10  # epsilon_1, of the sum of squares


def solve(problem, start):
    """problem(poses, which) gives the rows E (n, rows) and their Jacobian for the tasks `which`; the solved poses."""
    x = start.clone()
    every = torch.arange(len(x))
    E, J = problem(x, every)
    A, g = J.transpose(1, 2) @ J, -(J.transpose(1, 2) @ E[..., None])[..., 0]
    energy = E.square().sum(dim=1)
    mu, nu = TAU * A.diagonal(dim1=1, dim2=2).amax(dim=1), torch.full((len(x),), 2.0, dtype=x.dtype)
    active = every
    for _ in range(MOST_TRIES):
        active = active[energy[active] > LEAST_ERROR]
        if len(active) == 0:
            break
        damped = A[active] + torch.diag_embed(mu[active, None].expand(-1, x.shape[1]))
        delta = torch.cholesky_solve(g[active, :, None], torch.linalg.cholesky(damped))[..., 0]
        moves = delta.norm(dim=1) > LEAST_STEP_RAD
        active, delta = active[moves], delta[moves]
        if len(active) == 0:
            break
        E, J = problem(x[active] + delta, active)
        new = E.square().sum(dim=1)
        rho = (energy[active] - new) / (delta * (mu[active, None] * delta + g[active])).sum(dim=1)
        better = rho > 0
        i, J_i = active[better], J[better]
        x[i] += delta[better]
        energy[i] = new[better]
        A[i], g[i] = J_i.transpose(1, 2) @ J_i, -(J_i.transpose(1, 2) @ E[better, :, None])[..., 0]
        mu[i] *= (1 - (2 * rho[better] - 1) ** 3).clamp(min=1 / 3)
        nu[i] = 2
        worse = active[~better]
        mu[worse] *= nu[worse]
        nu[worse] *= 2
    return x, energy
