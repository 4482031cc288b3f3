"""IMGA in plain Python, operator by operator the same method: what the compiled one is measured against."""

import math
import random
from itertools import pairwise

STEPS = [(r, c) for r in (-1, 0, 1) for c in (-1, 0, 1) if (r, c) != (0, 0)]


class PlainImga:
    """The paper's algorithm on a set of free cells, corner policy ``allow``, start above and left of the goal."""

    def __init__(self, occupied, start, goal, seed):
        self.rows, self.cols = len(occupied), len(occupied[0])
        self.free = {(r, c) for r in range(self.rows) for c in range(self.cols) if not occupied[r][c]}
        self.start, self.goal = start, goal
        self.middle = sorted(self.free - {start, goal})
        self.unsafe = {
            (r, c)
            for r, c in self.free
            if any(
                0 <= r + i < self.rows and 0 <= c + j < self.cols and (r + i, c + j) not in self.free for i, j in STEPS
            )
        }
        self.random = random.Random(seed)

    def connect(self, a, b):
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
                near = [(cell[0] + i, cell[1] + j) for i, j in STEPS]
                near = [n for n in near if n in self.free and n not in (a, target)]
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

    def sample(self):
        through = self.random.choice(self.middle)
        first = self.connect(self.start, through)
        second = first is not None and self.connect(through, self.goal)
        return self.without_loops([self.start, *first, *second]) if second else None

    def cost(self, path):
        length = sum(math.hypot(a[0] - b[0], a[1] - b[1]) for a, b in pairwise(path))
        safety = sum(5 for cell in path[:-1] if cell in self.unsafe)
        energy = 0
        for a, b, c in zip(path, path[1:], path[2:], strict=False):
            before, after = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
            if before[0] * after[1] != before[1] * after[0] or before[0] * after[0] + before[1] * after[1] < 0:
                energy += 1 if min(after) >= 0 else 10 if max(after) <= 0 else 3
        return 6 * length + safety + 3 * energy

    def cross(self, mother, father):
        common = sorted(set(mother[1:-1]) & set(father[1:-1]))
        if not common:
            return mother, father
        cell = self.random.choice(common)
        i, j = mother.index(cell), father.index(cell)
        return self.without_loops(mother[: i + 1] + father[j + 1 :]), self.without_loops(
            father[: j + 1] + mother[i + 1 :]
        )

    def mutate(self, path):
        if len(path) < 3:
            return path
        i = self.random.randrange(1, len(path) - 1)
        near = [(path[i][0] + r, path[i][1] + c) for r, c in STEPS]
        near = [n for n in near if n in self.free and n not in (path[i - 1], path[i + 1])]
        if not near:
            return path
        cell = self.random.choice(near)
        before, after = self.connect(path[i - 1], cell), self.connect(cell, path[i + 1])
        if before is None or after is None:
            return path
        return self.without_loops(path[:i] + before + after + path[i + 2 :])

    def sees(self, a, b):
        dr, dc = b[0] - a[0], b[1] - a[1]
        for r in range(min(a[0], b[0]), max(a[0], b[0]) + 1):
            for c in range(min(a[1], b[1]), max(a[1], b[1]) + 1):
                if (r, c) not in self.free and 2 * abs(dr * (c - a[1]) - dc * (r - a[0])) < abs(dr) + abs(dc):
                    return False
        return True

    def delete(self, path):
        kept = [path[0]]
        for i in range(1, len(path) - 1):
            if not self.sees(kept[-1], path[i + 1]):
                kept.append(path[i])
        return [*kept, path[-1]]

    def run(self, population=100, generations=50):
        paths, seen = [], set()
        while len(paths) < population:
            path = self.sample()
            if path is not None and tuple(path) not in seen:
                seen.add(tuple(path))
                paths.append(path)
        costs, best = [], math.inf
        for generation in range(generations + 1):
            if generation:
                ranked = [p for _, p in sorted(zip(costs, paths, strict=True), key=lambda pair: pair[0])]
                third = population // 3
                paths = ranked[:third] + ranked[: 2 * third + population % 3]
                self.random.shuffle(paths)
                for k in range(0, population - 1, 2):
                    if self.random.random() < 0.8:
                        paths[k], paths[k + 1] = self.cross(paths[k], paths[k + 1])
                paths = [self.mutate(p) if self.random.random() < 0.2 else p for p in paths]
            costs = [self.cost(p) for p in paths]
            for path in map(self.delete, paths):
                best = min(best, sum(math.dist(a, b) for a, b in pairwise(path)))
        return best
