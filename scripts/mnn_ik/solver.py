"""The paper's Levenberg-Marquardt algorithm (its algorithm 1, method (8)), for many poses at once."""
import torch

TAU = 1e-3  # the paper's
MOST_TRIES = 60  # accepted or rejected, as many as our own solver has; the paper does not give its k_max
LEAST_STEP_RAD = 1e-4  # epsilon_2, of the whole step
LEAST_ERROR = 1e-10  # epsilon_1, of the sum of squares


def step(J, E, mu):
    """-(J^T J + mu I)^-1 J^T E, by the smaller of the two systems."""
    rows, dofs = J.shape[1:]
    if rows < dofs:
        A = J @ J.transpose(1, 2) + torch.diag_embed(mu[:, None].expand(-1, rows))
        return -(J.transpose(1, 2) @ torch.cholesky_solve(E[..., None], torch.linalg.cholesky(A)))[..., 0]
    A = J.transpose(1, 2) @ J + torch.diag_embed(mu[:, None].expand(-1, dofs))
    return -torch.cholesky_solve(J.transpose(1, 2) @ E[..., None], torch.linalg.cholesky(A))[..., 0]


def solve(problem, start):
    """problem(poses, which) gives the rows E (n, rows) and their Jacobian for the tasks `which`; the solved poses."""
    x = start.clone()
    active = torch.arange(len(x))
    E, J = problem(x, active)
    energy = E.square().sum(dim=1)
    mu, nu = TAU * J.square().sum(dim=1).amax(dim=1), torch.full((len(x),), 2.0, dtype=x.dtype)
    for _ in range(MOST_TRIES):
        active = active[energy[active] > LEAST_ERROR]
        if len(active) == 0:
            break
        J_a, E_a, mu_a = J[active], E[active], mu[active]
        delta = step(J_a, E_a, mu_a)
        moves = delta.norm(dim=1) > LEAST_STEP_RAD
        active, delta, J_a, E_a, mu_a = (values[moves] for values in (active, delta, J_a, E_a, mu_a))
        if len(active) == 0:
            break
        E_new, J_new = problem(x[active] + delta, active)
        new = E_new.square().sum(dim=1)
        gain = (mu_a[:, None] * delta.square()).sum(dim=1) - (delta * (J_a.transpose(1, 2) @ E_a[..., None])[..., 0]).sum(dim=1)
        rho = (energy[active] - new) / gain
        better = rho > 0
        i, worse = active[better], active[~better]
        x[i], E[i], J[i], energy[i] = x[i] + delta[better], E_new[better], J_new[better], new[better]
        mu[i] *= (1 - (2 * rho[better] - 1) ** 3).clamp(min=1 / 3)
        nu[i] = 2
        mu[worse] *= nu[worse]
        nu[worse] *= 2
    return x
