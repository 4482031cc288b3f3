"""IMAGA in plain Python."""

import heapq
import math

from benchmarks.plain import STEPS, STRAIGHT, PlainPlanner


class PlainImaga(PlainPlanner):
    steps = STRAIGHT

    def __init__(self, occupied, start, goal, seed):
        super().__init__(occupied, start, goal, seed)
        between = sum(goal) - sum(start) - 1  # diagonals
        self.libraries = [[] for _ in range((between + 1) // 2)]
        for cell in sorted(self.free):
            diagonal = sum(cell) - sum(start) - 1
            if 0 <= diagonal < between:
                self.libraries[diagonal // 2].append(cell)
        self.weights = [value or 1 for value in self.values(self.shortest())]

    def shortest(self):
        """Return a shortest path of single steps, by Dijkstra's algorithm."""
        before, queue = {}, [(0.0, self.start, self.start)]
        while self.goal not in before:
            far, cell, last = heapq.heappop(queue)
            if cell in before:
                continue
            before[cell] = last
            for r, c in STEPS:
                n = (cell[0] + r, cell[1] + c)
                if n in self.free:
                    heapq.heappush(queue, (far + math.hypot(r, c), n, cell))
        path = [self.goal]
        while path[-1] != self.start:
            path.append(before[path[-1]])
        return path[::-1]

    def nodes(self):
        """Draw a node from each library, less than 3 rows and columns from the one before."""
        nodes = [self.start]
        for library in filter(None, self.libraries):
            for _ in range(50):
                cell = self.random.choice(library)
                if self.close(nodes[-1], cell):
                    nodes.append(cell)
                    break
            else:
                return None
        return [*nodes, self.goal] if self.close(nodes[-1], self.goal) else None

    @staticmethod
    def close(a, b):
        return max(abs(a[0] - b[0]), abs(a[1] - b[1])) < 3

    def sample(self):
        while True:
            nodes = self.nodes()
            if nodes is None:
                continue
            path = [self.start]
            for node in nodes[1:]:
                joint = self.connect(path[-1], node)
                if joint is None:
                    break
                path += joint
            else:
                return self.without_loops(path)

    def values(self, path):
        length = self.length(path)
        safety = sum((r + i, c + j) not in self.free for r, c in path[:-1] for i, j in STRAIGHT)
        turns = sum(1 for _ in self.turns(path))
        return length, safety, turns / max(length, 1) + 1

    def fitness(self, path):
        length, safety, energy = self.values(path)
        return self.weights[0] / length + self.weights[1] / max(safety, 1) + self.weights[2] / energy

    @staticmethod
    def banded(fits, base):
        """Return more than ``base`` in the lowest third of the range, less in the highest."""
        low, high = min(fits), max(fits)
        if low == high:
            return [base] * len(fits)
        rates = []
        for f in fits:
            r = (high - f) / (high - low)
            rates.append(base + 0.2 * r if r > 2 / 3 else base * r if r < 1 / 3 else base)
        return rates

    def cross(self, mother, father):
        if mother == father or min(len(mother), len(father)) < 3:
            return mother, father
        at = self.random.randrange(1, min(len(mother), len(father)) - 1)
        return self.joined(mother, father, at), self.joined(father, mother, at)

    def joined(self, head, tail, at):
        joint = self.connect(head[at], tail[at + 1])
        return head if joint is None else self.without_loops(head[: at + 1] + joint + tail[at + 2 :])

    def delete(self, path):
        while True:
            shorter = super().delete(path)
            if len(shorter) == len(path):
                return shorter
            path = shorter

    def offspring(self, paths, fits, chosen):
        parents, theirs = [paths[k] for k in chosen], [fits[k] for k in chosen]
        children = self.vary(parents, self.banded(theirs, 0.8), self.banded(theirs, 0.2), theirs)
        return children, [self.fitness(p) for p in children]

    def run(self, population=100, generations=50):
        paths = [self.sample() for _ in range(population)]
        fits = [self.fitness(p) for p in paths]
        best = min(self.length(self.delete(p)) for p in paths)
        third = population // 3
        for _ in range(generations):
            top = max(fits)
            children, grown = self.offspring(paths, fits, [fits.index(top), *self.roulette(fits)[1:]])
            for _ in range(3):
                if max(grown) > top:
                    break
                ranked = sorted(range(population), key=grown.__getitem__, reverse=True)
                children, grown = self.offspring(children, grown, ranked[:third] + ranked[: 2 * third + population % 3])
            self.keep_best(paths, fits, children, grown)
            paths, fits = children, grown
            best = min(best, *(self.length(self.delete(p)) for p in paths))
        return best
