"""Ant System on a grid in plain Python: what the compiled colony is measured against."""

import math
import random
from itertools import pairwise

STEPS = [(r, c) for r in (-1, 0, 1) for c in (-1, 0, 1) if (r, c) != (0, 0)]


class PlainAco:
    """Ants go to free cells not visited yet, step back where there is none, and all leave pheromone; ``allow``."""

    def __init__(self, occupied, start, goal, seed, ants=50, alpha=1.0, beta=5.0, rho=0.1):
        self.free = {(r, c) for r, row in enumerate(occupied) for c, closed in enumerate(row) if not closed}
        self.start, self.goal = start, goal
        self.ants, self.alpha, self.beta, self.rho = ants, alpha, beta, rho
        self.random = random.Random(seed)
        self.moves = {a: [b for b in ((a[0] + r, a[1] + c) for r, c in STEPS) if b in self.free] for a in self.free}
        self.pheromone = {(a, b): 1.0 for a in self.free for b in self.moves[a]}
        self.best = math.inf

    def walk(self):
        path, visited = [self.start], {self.start}
        while path and path[-1] != self.goal:
            here = path[-1]
            ways = [cell for cell in self.moves[here] if cell not in visited]
            if not ways:
                path.pop()
                continue
            if self.goal in ways:
                chosen = self.goal
            else:
                pulls = [
                    self.pheromone[here, cell] ** self.alpha / math.dist(cell, self.goal) ** self.beta for cell in ways
                ]
                chosen = self.random.choices(ways, pulls)[0]
            path.append(chosen)
            visited.add(chosen)
        return path

    def march(self):
        paths = [path for path in (self.walk() for _ in range(self.ants)) if path]
        for step in self.pheromone:
            self.pheromone[step] *= 1.0 - self.rho
        for path in paths:
            steps = list(pairwise(path))
            length = sum(math.dist(a, b) for a, b in steps)
            self.best = min(self.best, length)
            for step in steps:
                self.pheromone[step] += 1.0 / length

    def run(self, iterations=100):
        for _ in range(iterations + 1):
            self.march()
        return self.best
