"""What the planners in plain Python share; each of them stands in a file of its own.

They do what the compiled planners do, operator by operator and with the same
parameters: these are what the compiled ones are measured against. They measure
every individual of every generation, as a plainly written program does, where
the kernel measures each distinct one once. A path is a list of cells (row,
column). Corner policy ``allow``; no row and no column of the start is greater
than the goal's, which can be reached from it.
"""

import math
import random
from itertools import pairwise

STEPS = [(r, c) for r in (-1, 0, 1) for c in (-1, 0, 1) if (r, c) != (0, 0)]
STRAIGHT = [(r, c) for r, c in STEPS if r == 0 or c == 0]


class PlainPlanner:
    steps = STEPS  # to the cells to which one in an obstacle gives way

    def __init__(self, occupied, start, goal, seed):
        self.rows, self.cols = len(occupied), len(occupied[0])
        self.free = {(r, c) for r in range(self.rows) for c in range(self.cols) if not occupied[r][c]}
        self.start, self.goal = start, goal
        self.random = random.Random(seed)

    def near(self, cell):
        around = [(cell[0] + r, cell[1] + c) for r, c in self.steps]
        return [n for n in around if n in self.free]

    def connect(self, a, b):
        """Return the cells from behind a to b, by median insertion."""
        path, stack, inserted = [], [b], 0
        while stack:
            target = stack[-1]
            gap = max(abs(a[0] - target[0]), abs(a[1] - target[1]))
            if gap == 0:
                stack.pop()
                continue
            if gap == 1:
                path.append(target)
                a = stack.pop()
                continue
            cell = ((a[0] + target[0]) // 2, (a[1] + target[1]) // 2)
            if cell not in self.free:
                near = [n for n in self.near(cell) if n not in (a, target)]
                if not near:
                    return None
                good = [
                    n for n in near if max(abs(n[0] - e[0]) for e in (a, target)) < gap
                    and max(abs(n[1] - e[1]) for e in (a, target)) < gap
                ]  # fmt: skip
                cell = self.random.choice(good or near)
            inserted += 1
            if inserted > 4 * (self.rows + self.cols):
                return None
            stack.append(cell)
        return path

    @staticmethod
    def without_loops(path):
        kept, at = [], {}
        for cell in path:
            if cell in at:
                for gone in kept[at[cell] + 1 :]:
                    del at[gone]
                kept = kept[: at[cell] + 1]
            else:
                at[cell] = len(kept)
                kept.append(cell)
        return kept

    def mutate(self, path):
        """Move an interior cell to a free one beside it, and join both sides by median insertion."""
        if len(path) < 3:
            return path
        i = self.random.randrange(1, len(path) - 1)
        near = [n for n in self.near(path[i]) if n not in (path[i - 1], path[i + 1])]
        if not near:
            return path
        cell = self.random.choice(near)
        before, after = self.connect(path[i - 1], cell), self.connect(cell, path[i + 1])
        if before is None or after is None:
            return path
        return self.without_loops(path[:i] + before + after + path[i + 2 :])

    def sees(self, a, b):
        """Say whether the segment is free: the exact test."""
        dr, dc = b[0] - a[0], b[1] - a[1]
        for r in range(min(a[0], b[0]), max(a[0], b[0]) + 1):
            for c in range(min(a[1], b[1]), max(a[1], b[1]) + 1):
                if (r, c) not in self.free and 2 * abs(dr * (c - a[1]) - dc * (r - a[0])) < abs(dr) + abs(dc):
                    return False
        return True

    def delete(self, path):
        """Delete, once along the path, every point between two that see each other."""
        kept = [path[0]]
        for i in range(1, len(path) - 1):
            if not self.sees(kept[-1], path[i + 1]):
                kept.append(path[i])
        return [*kept, path[-1]]

    @staticmethod
    def length(path):
        return sum(math.dist(a, b) for a, b in pairwise(path))

    @staticmethod
    def turns(path):
        """Yield |cross| and dot of the two directions at each turn."""
        for a, b, c in zip(path, path[1:], path[2:], strict=False):
            before, after = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
            cross = before[0] * after[1] - before[1] * after[0]
            dot = before[0] * after[0] + before[1] * after[1]
            if cross != 0 or dot < 0:
                yield abs(cross), dot

    def roulette(self, fits):
        return self.random.choices(range(len(fits)), weights=fits, k=len(fits))

    def vary(self, paths, crossing, mutating, fits):
        """Cross random pairs with the probability of the fitter, and mutate each child with that of its parent."""
        order = list(range(len(paths)))
        self.random.shuffle(order)
        children = list(paths)
        for i, j in zip(order[::2], order[1::2], strict=False):
            if self.random.random() < crossing[i if fits[i] >= fits[j] else j]:
                children[i], children[j] = self.cross(paths[i], paths[j])
        return [
            self.mutate(p) if self.random.random() < rate else p for p, rate in zip(children, mutating, strict=True)
        ]

    @staticmethod
    def keep_best(paths, fits, children, grown):
        """Put the best parent in the place of the worst child."""
        best, worst = fits.index(max(fits)), grown.index(min(grown))
        children[worst], grown[worst] = paths[best], fits[best]
