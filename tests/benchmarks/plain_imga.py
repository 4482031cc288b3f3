"""IMGA in plain Python, operator by operator the same method: what the compiled one is measured against."""

import math

from benchmarks.plain import STEPS, PlainPlanner


class PlainImga(PlainPlanner):
    def __init__(self, occupied, start, goal, seed):
        super().__init__(occupied, start, goal, seed)
        self.middle = sorted(self.free - {start, goal})
        self.unsafe = {
            (r, c)
            for r, c in self.free
            if any(
                0 <= r + i < self.rows and 0 <= c + j < self.cols and (r + i, c + j) not in self.free for i, j in STEPS
            )
        }

    def sample(self):
        through = self.random.choice(self.middle)
        first = self.connect(self.start, through)
        second = first is not None and self.connect(through, self.goal)
        return self.without_loops([self.start, *first, *second]) if second else None

    def cost(self, path):
        safety = sum(5 for cell in path[:-1] if cell in self.unsafe)
        energy = 0
        for a, b, c in zip(path, path[1:], path[2:], strict=False):
            before, after = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
            if before[0] * after[1] != before[1] * after[0] or before[0] * after[0] + before[1] * after[1] < 0:
                energy += 1 if min(after) >= 0 else 10 if max(after) <= 0 else 3
        return 6 * self.length(path) + safety + 3 * energy

    def cross(self, mother, father):
        common = sorted(set(mother[1:-1]) & set(father[1:-1]))
        if not common:
            return mother, father
        cell = self.random.choice(common)
        i, j = mother.index(cell), father.index(cell)
        return self.without_loops(mother[: i + 1] + father[j + 1 :]), self.without_loops(
            father[: j + 1] + mother[i + 1 :]
        )

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
                best = min(best, self.length(path))
        return best
