"""A swing that learns to pump, by an evolution strategy over many worlds at once.

The rider is a weight on a rope, who may stand up and squat: 1.0 to 1.4 m from the bar, by a force of at most 150 N along the
rope, against a weight of 98 N. Nothing says when. Every generation 64 riders try, each with other weights of a policy, and the
weights move towards those who swung higher (OpenAI-ES: Salimans et al. 2017, with antithetic samples and ranks).

    python3 examples/learn_to_swing.py [GENERATIONS]
"""

import sys

import numpy as np
import sinew

scene = {
    "sinew": 1,
    "world": {"gravity": [0, -9.81]},
    "figures": [{
        "name": "swing",
        "particles": {"bar": {"at": [0, 0], "pinned": True}, "rider": {"at": [1.3 * np.sin(0.2), -1.3 * np.cos(0.2)], "mass": 10}},
        "constraints": [{"between": ["bar", "rider"], "low": 1.0, "high": 1.4}],
    }],
}


def swung(angles):
    """Reward of a step: how far out a rider is, radians."""
    return np.abs(angles)


class Swings:
    """The interface of Gymnasium's VectorEnv: reset, also of the worlds of a mask, and step with an action a world, from -1
    (squat) to 1 (stand up). `reward` is a function of the angles of all riders, (n,)."""

    def __init__(self, n, seconds=12.0, reward=swung):
        self.num_envs, self.reward, self.worlds = n, reward, sinew.batch(scene, n)
        self.rider, self.limit = self.worlds.row("swing/rider"), round(seconds * self.worlds.rate)
        self.steps = np.zeros(n, int)

    def reset(self, *, seed=None, options=None):
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, bool))
        self.worlds.reset(mask)
        self.steps[mask] = 0
        return self.observations(), {}

    def step(self, actions):
        place = self.worlds.positions[:, self.rider]
        up = -place / np.linalg.norm(place, axis=1, keepdims=True)
        self.worlds.apply_force("swing/rider", 150 * np.clip(actions, -1, 1)[:, None] * up)
        self.worlds.step()
        self.steps += 1
        truncated = self.steps >= self.limit
        return self.observations(), self.reward(self.angles()) / self.limit, np.zeros_like(truncated), truncated, {}

    def angles(self):
        return np.arctan2(self.worlds.positions[:, self.rider, 0], -self.worlds.positions[:, self.rider, 1])

    def observations(self):
        """Squares and product of the angle and its rate, left and right being alike, and 1: (n, 4)."""
        place, speed = self.worlds.positions[:, self.rider], self.worlds.velocities[:, self.rider]
        rate = (place[:, 0] * speed[:, 1] - place[:, 1] * speed[:, 0]) / (place**2).sum(axis=1)
        angle = self.angles()
        return np.stack([angle**2, (rate / 3) ** 2, angle * rate / 3, np.full_like(angle, 0.1)], axis=1)


def scores(swings, weights):
    """Mean absolute angle of riders with these weights, (n, 4)."""
    observations, _ = swings.reset()
    total, over = 0, False
    while not over:
        observations, rewards, _, done, _ = swings.step(np.tanh(8 * (weights * observations).sum(axis=1)))
        total, over = total + rewards, done.all()
    return total


def learn(generations=15, n=64, seed=1, spread=0.3, rate=0.6):
    random, swings, mean = np.random.default_rng(seed), Swings(n), np.zeros(4)
    for generation in range(generations):
        half = random.normal(size=(n // 2, 4))
        noise = np.concatenate([half, -half])
        found = scores(swings, mean + spread * noise)
        ranks = found.argsort().argsort() / (n - 1) - 0.5
        mean += rate * (ranks @ noise) / (n * np.var(ranks)) ** 0.5 / n**0.5
        print(f"generation {generation:2}: mean angle {found.mean():.3f} rad, best {found.max():.3f}")
    return mean, found


if __name__ == "__main__":
    weights, found = learn(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
    print("weights of angle^2, rate^2, angle * rate, 1:", weights.round(2))
