"""RRT with a straightened branch in plain Python: what the compiled tree is measured against."""

import math
import random
from itertools import pairwise


class PlainRrt:
    """A tree drawn to the goal, every node looked at for the nearest one, segments sampled closely."""

    def __init__(self, occupied, start, goal, seed, step=1.7, bias=0.4):
        self.occupied, self.start, self.goal = occupied, start, goal
        self.rows, self.cols = len(occupied), len(occupied[0])
        self.step, self.bias, self.random = step, bias, random.Random(seed)

    def sees(self, a, b):
        samples = max(1, math.ceil(20 * math.dist(a, b)))
        for k in range(samples + 1):
            r, c = (x + (y - x) * k / samples for x, y in zip(a, b, strict=True))
            if self.occupied[math.floor(r + 0.5)][math.floor(c + 0.5)]:
                return False
        return True

    def run(self):
        nodes, parents = [self.start], [-1]
        while True:
            target = self.goal
            if self.random.random() > self.bias:
                target = self.random.uniform(0, self.rows - 1), self.random.uniform(0, self.cols - 1)
            near = min(range(len(nodes)), key=lambda k: math.dist(nodes[k], target))
            far = math.dist(nodes[near], target)
            if far == 0:
                continue
            share = min(1.0, self.step / far)
            new = tuple(x + (y - x) * share for x, y in zip(nodes[near], target, strict=True))
            if not self.sees(nodes[near], new):
                continue
            nodes.append(new)
            parents.append(near)
            if math.dist(new, self.goal) <= self.step and self.sees(new, self.goal):
                return self.straightened(nodes, parents)

    def straightened(self, nodes, parents):
        branch, k = [self.goal], len(nodes) - 1
        while k >= 0:
            branch.append(nodes[k])
            k = parents[k]
        branch.reverse()
        path, at = [branch[0]], 0
        while at < len(branch) - 1:
            at = next(j for j in range(len(branch) - 1, at, -1) if j == at + 1 or self.sees(branch[at], branch[j]))
            path.append(branch[at])
        return sum(math.dist(a, b) for a, b in pairwise(path))
