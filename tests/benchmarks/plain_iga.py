"""IGA in plain Python."""

import math

from benchmarks.plain import PlainPlanner


class PlainIga(PlainPlanner):
    def __init__(self, occupied, start, goal, seed):
        super().__init__(occupied, start, goal, seed)
        lines = [[(r, c) for c in range(self.cols) if not occupied[r][c]] for r in range(start[0] + 1, goal[0])]
        self.lines = [line for line in lines if line]

    def sample(self):
        while True:
            path = [self.start]
            for line in self.lines:
                for _ in range(20):
                    joint = self.connect(path[-1], self.random.choice(line))
                    if joint is not None:
                        path += joint
                        break
                else:
                    break
            else:
                joint = self.connect(path[-1], self.goal)
                if joint is not None:
                    return path + joint

    def values(self, path):
        return (self.length(path),)

    @staticmethod
    def sinc(fits, low, high):
        """Return rates that fall from the mean to ``low`` at the best; ``high`` under the mean."""
        mean, top = sum(fits) / len(fits), max(fits)
        if top == min(fits):
            return [high] * len(fits)
        rates = []
        for f in fits:
            x = math.pi * (f - mean) / (top - mean)
            wave = math.sin(x) / x if x else 1
            rates.append(high if f < mean else low + wave * mean / top * (high - low))
        return rates

    def cross(self, mother, father):
        place = {cell: i for i, cell in enumerate(mother[1:-1], 1)}
        common = [j for j, cell in enumerate(father[1:-1], 1) if cell in place]
        if not common:
            return mother, father
        j = self.random.choice(common)
        i = place[father[j]]
        return mother[: i + 1] + father[j + 1 :], father[: j + 1] + mother[i + 1 :]

    def mutate(self, path):
        if len(path) < 3:
            return path
        for _ in range(10):
            first, last = sorted(self.random.sample(range(len(path) - 1), 2))
            joint = self.connect(path[first], path[last + 1])
            if joint is not None:
                return path[: first + 1] + joint + path[last + 2 :]
        return path

    def advance(self, deme):
        """Return the next generation of pairs (length, path)."""
        fits = [1 / length + 0.01 for length, _ in deme]
        chosen = self.roulette(fits)
        parents, theirs = [deme[k][1] for k in chosen], [fits[k] for k in chosen]
        children = self.vary(parents, self.sinc(theirs, 0.5, 0.8), self.sinc(theirs, 0.01, 0.1), theirs)
        return self.measured(self.delete(self.without_loops(p)) for p in children)

    def measured(self, paths):
        return [(self.length(p), p) for p in paths]

    def run(self, population=300, generations=150):
        demes = [self.measured(self.sample() for _ in range(population)) for _ in range(2)]
        best = min(min(deme)[0] for deme in demes)
        for generation in range(1, generations + 1):
            demes = [self.advance(deme) for deme in demes]
            if generation % 3 == 0 and generation <= 100:
                n = max(1, round(0.05 * population))
                a, b = (sorted(deme) for deme in demes)
                demes = [a[:-n] + b[:n], b[:-n] + a[:n]]
            best = min(best, *(min(deme)[0] for deme in demes))
        return best
