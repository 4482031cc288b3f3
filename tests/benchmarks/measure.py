"""Measure planners on maps: `python tests/benchmarks/measure.py aco,hga-aco random-20:75,blocks-50:20% --seeds 10`.

Prints, for each map and planner, in Markdown: runs that found a path, mean and best length, the mean gap to the octile
and to the any-angle optimum over the paths found, the mean generation that found the best, and milliseconds a run (best
and median processor time, loading of kernels left out). The pages of the plugins were made with it. A map is a name or a
file; MAP@START@GOAL sets other ends than from the lower left to the upper right; a planner may be a table in TOML:
`'{use = "gwo", decoder = "rows"}'`.
"""

import argparse
import time
import tomllib

import numpy as np

import pathloom as pl
from pathloom.kernel.run import run

HEAD = "| map | planner | found | mean length | best | over octile | over any-angle | best after | ms, best | median |"


def main() -> None:
    ask = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    ask.add_argument("planners", help="names, or tables in TOML, with commas")
    ask.add_argument("maps", help="names or files, with commas")
    ask.add_argument("--corners", default="allow", choices=("allow", "no-squeeze", "strict"))
    ask.add_argument("--seeds", type=int, default=10)
    ask.add_argument("--first", type=int, default=0, help="the first seed")
    given = ask.parse_args()
    print(HEAD)
    print("| --- " * 10 + "|")
    for name in given.maps.split(","):
        problem = problem_on(name, given.corners)
        optima = pl.octile_path(problem)[0], pl.any_angle_path(problem)[0]
        for planner in tomllib.loads(f"of = [{quoted(given.planners)}]")["of"]:
            print(row(name, planner, problem, optima, range(given.first, given.first + given.seeds)), flush=True)


def quoted(planners: str) -> str:
    """Return a list for TOML of names, which need no quotation marks, and of tables."""
    if "{" in planners:
        return planners
    return ", ".join(f'"{planner}"' for planner in planners.split(","))


def problem_on(name: str, corners: str) -> pl.PathProblem:
    source, *ends = name.split("@")
    start, goal = ends or ("bottom-left", "top-right")
    return pl.PathProblem(pl.load_map(source, corners=corners), start=start, goal=goal, corners=corners)


def row(name: str, planner: object, problem: pl.PathProblem, optima: tuple[float, float], seeds: range) -> str:
    composed = pl.compose(planner)
    results = [pl.plan(problem, composed, seed=seed) for seed in seeds]
    lengths = np.array([result.length for result in results if result.found])
    times = []
    for seed in seeds:
        began = time.process_time()
        run(problem, composed, seed)
        times.append(1000 * (time.process_time() - began))
    shown = planner if isinstance(planner, str) else str(planner).replace("'", "")
    cells = [name, shown, f"{len(lengths)} of {len(results)}"]
    if len(lengths):
        gaps = [f"{100 * (lengths / optimum - 1).mean():.1f} %" for optimum in optima]
        settled = np.mean([result.convergence for result in results if result.found])
        cells += [f"{lengths.mean():.4f}", f"{lengths.min():.4f}", *gaps, f"{settled:.1f}"]
    else:
        cells += ["–"] * 5
    cells += [f"{min(times):.1f}", f"{np.median(times):.1f}"]
    return "| " + " | ".join(cells) + " |"


if __name__ == "__main__":
    main()
