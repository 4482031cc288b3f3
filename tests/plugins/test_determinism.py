"""The same seed gives the same bytes, whoever runs it and beside whom."""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import pathloom as pl

RUNS = [(planner, seed) for planner in ("imga", "loom", "nsga2") for seed in range(4)]


def outcome(run):
    planner, seed = run
    problem = pl.PathProblem(pl.load_map("blocks-20:20%:s2"))
    result = pl.plan(problem, planner, seed=seed)
    return result.path.tobytes(), dict(result.metrics), dict(result.history)


def test_four_threads_give_what_one_gives():
    alone = [outcome(run) for run in RUNS]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(outcome, RUNS)) == alone


def test_two_new_processes_give_what_one_gives():
    alone = [outcome(run) for run in RUNS]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert list(pool.map(outcome, RUNS)) == alone
