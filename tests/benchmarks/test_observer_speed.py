"""What observers cost: where nobody watches next to nothing, and a log little beside a generation."""

import time
from dataclasses import dataclass, replace

import pytest

import pathloom as pl
from pathloom.kernel.json_lines import JsonLines
from pathloom.kernel.planner import Outcome
from pathloom.kernel.run import iterate, run


@dataclass(frozen=True, kw_only=True)
class Idle(pl.Planner):
    """Do nothing but count generations."""

    def start(self, problem, rng):
        return pl.State(problem, {})

    def step(self, state):
        return replace(state, generation=state.generation + 1)

    def result(self, state):
        return Outcome(None)


IDLE = pl.compose(Idle(), termination={"use": "max-generations", "limit": 3000})
IMGA = pl.compose("imga")


@pytest.fixture(scope="module")
def problem():
    return pl.PathProblem(pl.load_map("random-20:75:s3"), corners="allow")


def bare(problem, planner):
    state = planner.start(problem, None)
    while not planner.done(state):
        state = planner.step(state)


def seconds(work):
    began = time.process_time()
    work()
    return time.process_time() - began


def least(*works, rounds=15):
    """Return the shortest processor time of each, measured in turn, so that a busy machine is busy for all."""
    return [min(times) for times in zip(*([seconds(work) for work in works] for _ in range(rounds)), strict=True)]


def test_a_generation_that_nobody_watches(benchmark, problem):
    benchmark(lambda: list(iterate(problem, IDLE)))


def test_where_nobody_watches_a_generation_costs_less_than_a_hundredth_of_one_of_imga_more(problem):
    run(problem, IMGA, 0)
    driven, alone, imga = least(
        lambda: list(iterate(problem, IDLE)), lambda: bare(problem, IDLE), lambda: run(problem, IMGA, 1)
    )
    more = (driven - alone) / 3000
    print(f"{1e6 * more:.3f} µs a generation of {1e6 * imga / 50:.0f}")
    assert more / (imga / 50) < 0.01


def test_a_log_takes_less_time_than_the_generation_that_it_tells_of(tmp_path, problem):
    logged = replace(IMGA, observers=(JsonLines(file=str(tmp_path / "log.jsonl")),))
    run(problem, logged, 0)
    with_it, without = least(lambda: run(problem, logged, 1), lambda: run(problem, IMGA, 1))
    print(f"{1e6 * (with_it - without) / 50:.1f} µs a generation of {1e6 * without / 50:.0f}")
    assert with_it < 2 * without
