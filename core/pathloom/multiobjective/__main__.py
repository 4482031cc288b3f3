"""``python -m pathloom.multiobjective``: what the claims about fronts rest on, as tables in Markdown."""

import argparse
import sys

from pathloom.errors import PathloomError
from pathloom.multiobjective.dominance import MAPS, PAPERS, dominance
from pathloom.multiobjective.dominance import markdown as table_of_dominance
from pathloom.multiobjective.quality import MAPS as TIMED
from pathloom.multiobjective.quality import markdown as table_of_quality
from pathloom.multiobjective.quality import quality
from pathloom.multiobjective.running import DEFAULT_PLANNER
from pathloom.multiobjective.sweep import markdown as table_of_sweeps
from pathloom.multiobjective.sweep import sweeps

OBJECTIVES = "length,unsafe-cells,turns"


def main() -> None:
    """Print one of the tables; without a word, that of dominance."""
    parser = argparse.ArgumentParser(prog="python -m pathloom.multiobjective", description=__doc__)
    tables = parser.add_subparsers(dest="table", metavar="TABLE")
    one = tables.add_parser("dominance", help="how often the papers' weighted-sum planners land behind the front")
    one.add_argument("--maps", default=",".join(MAPS), help="with commas between (default: %(default)s)")
    one.add_argument("--planners", default=",".join(PAPERS), help="(default: %(default)s)")
    one.add_argument("--corners", default="allow", help="(default: %(default)s, as in the papers)")
    one.add_argument("--objectives", default=OBJECTIVES, help="(default: %(default)s)")
    two = tables.add_parser("quality", help="how much of the exact front is found in a given time")
    two.add_argument("--maps", default=",".join(TIMED), help="with commas between (default: %(default)s)")
    two.add_argument("--seconds", type=float, help="processor time of a run; by default as the map is large")
    two.add_argument("--objectives", default=OBJECTIVES, help="(default: %(default)s)")
    three = tables.add_parser("sweep", help="the front beside 66 exact searches, of length, clearance and turn angle")
    three.add_argument("files", nargs="+", help="Moving AI scenarios (.scen) and maps")
    for table, runs in ((one, 10), (two, 10), (three, 5)):
        table.add_argument("--algorithm", default=DEFAULT_PLANNER, help="finds the front (default: %(default)s)")
        table.add_argument("--runs", type=int, default=runs, help="seeds (default: %(default)s)")
    asked = parser.parse_args(sys.argv[1:] or ["dominance"])
    try:
        {"dominance": _dominance, "quality": _quality, "sweep": _sweep}[asked.table](asked)
    except PathloomError as error:
        parser.exit(2, f"{parser.prog}: {error}\n")


def _dominance(asked: argparse.Namespace) -> None:
    standings = dominance(
        asked.maps.split(","), asked.planners.split(","), algorithm=asked.algorithm,
        objectives=asked.objectives.split(","), corners=asked.corners, runs=asked.runs,
    )  # fmt: skip
    sys.stdout.write(table_of_dominance(list(standings)))


def _quality(asked: argparse.Namespace) -> None:
    rows = quality(
        asked.maps.split(","), asked.algorithm, objectives=asked.objectives.split(","), seconds=asked.seconds,
        runs=asked.runs,
    )  # fmt: skip
    sys.stdout.write(table_of_quality(list(rows)))


def _sweep(asked: argparse.Namespace) -> None:
    sys.stdout.write(table_of_sweeps(list(sweeps(asked.files, asked.algorithm, runs=asked.runs))))


if __name__ == "__main__":
    main()
