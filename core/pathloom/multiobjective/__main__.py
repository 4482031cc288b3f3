"""``python -m pathloom.multiobjective``: how often the papers' weighted-sum planners land behind the front."""

import argparse
import sys

from pathloom.multiobjective.dominance import MAPS, PAPERS, dominance, markdown
from pathloom.multiobjective.running import DEFAULT_PLANNER


def main() -> None:
    """Print the table in Markdown."""
    parser = argparse.ArgumentParser(prog="python -m pathloom.multiobjective", description=__doc__)
    parser.add_argument("--maps", default=",".join(MAPS), help="names, with commas between (default: %(default)s)")
    parser.add_argument("--planners", default=",".join(PAPERS), help="(default: %(default)s)")
    parser.add_argument("--algorithm", default=DEFAULT_PLANNER, help="what finds the front (default: %(default)s)")
    parser.add_argument("--objectives", default="length,unsafe-cells,turns", help="(default: %(default)s)")
    parser.add_argument("--corners", default="allow", help="(default: %(default)s, as in the papers)")
    parser.add_argument("--runs", type=int, default=10, help="seeds for each planner (default: %(default)s)")
    asked = parser.parse_args()
    standings = dominance(
        asked.maps.split(","), asked.planners.split(","), algorithm=asked.algorithm,
        objectives=asked.objectives.split(","), corners=asked.corners, runs=asked.runs,
    )  # fmt: skip
    sys.stdout.write(markdown(list(standings)))


if __name__ == "__main__":
    main()
