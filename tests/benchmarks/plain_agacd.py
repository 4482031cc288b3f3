"""AGACD in plain Python, without the sampling that takes over where its walks do not arrive."""

import math

from benchmarks.plain import PlainPlanner

W_SAFETY = 1 / (1 + 1.4 + 1.2 * 1.4)
W_SMOOTHNESS = 1.4 * W_SAFETY
W_LENGTH = 1.2 * W_SMOOTHNESS


class PlainAgacd(PlainPlanner):
    def __init__(self, occupied, start, goal, seed):
        super().__init__(occupied, start, goal, seed)
        self.cells = sorted(self.free)
        self.obstacles = {(r, c) for r in range(self.rows) for c in range(self.cols)} - self.free

    def trial(self, a, b):
        """Sample the segment along its longer axis; a half is rounded down."""
        (yi, xi), (yj, xj) = a, b
        steep = abs(yj - yi) > abs(xj - xi)
        if steep:
            xi, yi, xj, yj = yi, xi, yj, xj
        if xi == xj:
            return True
        xi, yi, xj, yj = xi + 1, yi + 1, xj + 1, yj + 1  # as the paper counts, on which rounding depends
        slope = (yj - yi) / (xj - xi)
        offset = yi - slope * xi
        x, end = min(xi, xj), max(xi, xj)
        while x < end:
            x += 0.1
            along, across = math.ceil(x - 0.5) - 1, math.ceil(slope * x + offset - 0.5) - 1
            if ((along, across) if steep else (across, along)) not in self.free:
                return False
        return True

    def sees(self, a, b):
        return self.trial(a, b) and super().sees(a, b)

    def sample(self):
        while True:
            path = [self.start]
            while path[-1] != self.goal and len(path) <= 20 * (self.rows + self.cols):
                target = self.goal if self.random.random() < 0.5 else self.random.choice(self.cells)
                near = self.near(path[-1])
                far = [(n[0] - target[0]) ** 2 + (n[1] - target[1]) ** 2 for n in near]
                least = min(far)
                path.append(self.random.choice([n for n, f in zip(near, far, strict=True) if f == least]))
            if path[-1] == self.goal:
                return self.without_loops(path)

    def values(self, path):
        angle = sum(math.atan2(cross, dot) for cross, dot in self.turns(path))
        beside = {(r + i, c + j) for r, c in path for i, j in self.steps} & self.obstacles
        return self.length(path), angle, 1 + 0.1 * len(beside)

    def fitness(self, path):
        length, smoothness, safety = self.values(path)
        return W_LENGTH / max(length, 1) + W_SMOOTHNESS / max(smoothness, math.radians(1)) + W_SAFETY / safety

    @staticmethod
    def falling(fits, equal, above, below, factor):
        """Return rates that fall from ``above`` at the mean to 0 at the best; ``below`` under the mean."""
        mean, top = sum(fits) / len(fits), max(fits)
        if top == min(fits):
            return [min(1, equal * factor)] * len(fits)
        rates = (below if f < mean else above * (top - f) / (top - mean) for f in fits)
        return [min(1, rate * factor) for rate in rates]

    def cross(self, mother, father):
        i, j = self.random.randrange(len(mother) - 1), self.random.randrange(len(father) - 1)
        daughter, son = mother, father
        if self.sees(mother[i], father[j + 1]):
            daughter = self.without_loops(mother[: i + 1] + father[j + 1 :])
        if self.sees(father[j], mother[i + 1]):
            son = self.without_loops(father[: j + 1] + mother[i + 1 :])
        return daughter, son

    def mutate(self, path):
        if len(path) < 3:
            return path
        i = self.random.randrange(1, len(path) - 1)
        before, after = path[i - 1], path[i + 1]
        near = [n for n in self.near(path[i]) if n not in (before, after)]
        if not near:
            return path
        cell = self.random.choice(near)
        if not (self.sees(before, cell) and self.sees(cell, after)):
            return path
        return self.without_loops([*path[:i], cell, *path[i + 1 :]])

    def run(self, population=60, generations=300):
        paths = [self.sample() for _ in range(population)]
        fits = [self.fitness(p) for p in paths]
        for generation in range(generations):
            progress = generation / generations
            chosen = self.roulette(fits)
            parents, theirs = [paths[k] for k in chosen], [fits[k] for k in chosen]
            crossing = self.falling(theirs, 0.65, 0.7, 0.7, math.exp(-progress))
            mutating = self.falling(theirs, 0.3, 0.15, 0.3, math.exp(progress))
            children = self.vary(parents, crossing, mutating, theirs)
            grown = [self.fitness(p) for p in children]
            self.keep_best(paths, fits, children, grown)
            paths, fits = children, grown
        return self.length(self.delete(paths[fits.index(max(fits))]))
