"""The same seed gives the same bytes, whoever runs it and beside whom."""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import pathloom as pl

SEEDS = range(8)


def outcome(seed):
    problem = pl.PathProblem(pl.load_map("blocks-20:20%:s2"))
    result = pl.plan(problem, "imga", seed=seed)
    return result.path.tobytes(), dict(result.metrics), dict(result.history)


def test_four_threads_give_what_one_gives():
    alone = [outcome(seed) for seed in SEEDS]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(outcome, SEEDS)) == alone


def test_two_new_processes_give_what_one_gives():
    alone = [outcome(seed) for seed in SEEDS]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert list(pool.map(outcome, SEEDS)) == alone
