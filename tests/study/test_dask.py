"""Studies on a Dask cluster: the scheduler and its workers are processes of their own."""

import subprocess
import sys
import time

import numpy as np
import pytest

import pathloom as pl
from pathloom.study import StudyError, Workers, carry_out
from pathloom.study.budget import Budget
from pathloom.study.design import Design, comparison
from pathloom.study.instances import instances_of
from study.conftest import timeless
from study.faulty import Hanging, Raising, Straight

pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning", "ignore::UserWarning")

SERVE = """
import sys, asyncio
from distributed import Scheduler, Worker
async def main():
    if sys.argv[1] == "scheduler":
        it = Scheduler(port=0, host="127.0.0.1", dashboard=False)
    else:
        it = Worker(sys.argv[1], nthreads=1, dashboard=False, host="127.0.0.1", local_directory=sys.argv[2])
    async with it:
        print(it.address, flush=True)
        await it.finished()
asyncio.run(main())
"""


class Cluster:
    """A scheduler and two workers."""

    def __init__(self, folder):
        self.folder, self.processes = folder, []
        self.address = self.start("scheduler")
        for _ in range(2):
            self.start(self.address)

    def start(self, what):
        process = subprocess.Popen(
            [sys.executable, "-W", "ignore", "-c", SERVE, what, str(self.folder)], stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, text=True, env={**__import__("os").environ, "PYTHONPATH": ":".join(sys.path)},
        )  # fmt: skip
        self.processes.append(process)
        return process.stdout.readline().strip()

    def stop(self):
        for process in self.processes:
            process.kill()
            process.wait()
            process.stdout.close()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    made = Cluster(tmp_path_factory.mktemp("dask"))
    yield made
    made.stop()


def test_a_cluster_finds_what_this_machine_finds_also_if_a_worker_is_killed(cluster, tmp_path):
    asked = {"swap": {"selection": ["roulette"]}, "maps": ["random-20:75:x2"], "runs": 6, "corners": "allow",
             "budget": "evaluations=10000"}  # fmt: skip
    here = pl.ablate("imga", **asked, workers=1)
    victim = cluster.processes[-1]

    def watch(pace, what):
        if what == "runs" and pace.done >= 5 and victim.poll() is None:
            victim.kill()
            victim.wait()

    there = pl.ablate("imga", **asked, dask=cluster.address, out=tmp_path / "s.db", watch=watch)
    assert victim.poll() is not None
    assert [timeless(row) for row in there.each()] == [timeless(row) for row in here.each()]
    assert len(there) == there.status.total == 24
    here.close()
    there.close()


def test_faults_are_recorded_on_a_cluster_too(cluster):
    cells = np.zeros((6, 6), bool)
    cells[2:4, 2:4] = True
    planners = {"raises": Raising(), "hangs": Hanging(), "collides": Straight(), "good": "dijkstra"}
    places = instances_of([pl.OccupancyGrid(cells)])
    design = Design("compare", comparison(planners), places, 1, 0, Budget("own"))
    with carry_out(design, workers=Workers(dask=cluster.address, longest=8.0)) as study:
        found = {row.variant: (row.status, row.error) for row in study.each()}
    assert found["raises"] == ("failed", "ValueError: no idea what to do")
    assert found["hangs"][0] == "timeout"
    assert found["collides"][0] == "not-found"
    assert found["good"] == ("found", None)


def test_a_planner_that_the_workers_do_not_have_is_told(cluster, monkeypatch):
    from pathloom.study import carrying_out, session

    real = session.environment([])
    for module in (session, carrying_out):
        monkeypatch.setattr(module, "environment", lambda configs: {**real, "plugins": {"acme": "acme 1.0"}})
    with pytest.raises(StudyError, match=r"found nothing as plugin 'acme' on tcp://.*, allowed acme 1.0 as here"):
        pl.compare(["dijkstra"], maps="iga-map1", runs=1, budget="own", dask=cluster.address)


def test_an_address_where_nobody_answers_is_told(monkeypatch):
    began = time.monotonic()
    with pytest.raises(StudyError, match="--dask tcp://127.0.0.1:9: no Dask scheduler answers there") as refused:
        pl.compare(["dijkstra"], maps="iga-map1", runs=1, budget="own", dask="tcp://127.0.0.1:9")
    assert "\n" not in str(refused.value)
    assert time.monotonic() - began < 60


def test_a_cluster_that_goes_away_ends_the_study_and_keeps_its_runs(tmp_path):
    cluster = Cluster(tmp_path)
    out = tmp_path / "s.db"

    def watch(pace, what):
        if what == "runs" and pace.done >= 3:
            cluster.stop()

    try:
        import dask

        with (
            dask.config.set({"distributed.comm.timeouts.connect": "3s"}),
            pytest.raises(StudyError, match="the cluster is gone; the runs so far are kept"),
        ):
            pl.ablate(
                "imga", swap={"selection": ["roulette"]}, maps=["random-20:75"], runs=30, corners="allow",
                budget="evaluations=20000", dask=cluster.address, out=out, watch=watch,
            )  # fmt: skip
    finally:
        cluster.stop()
    with pl.Study.open(out) as study:
        assert 3 <= len(study) < 60
