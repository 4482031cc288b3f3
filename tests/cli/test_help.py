"""Help is there for every command, and costs nothing."""

import subprocess
import sys

COMMANDS = ["", "plan", "pareto", "studio", *(f"maps {c}" for c in ("", "list", "show", "check", "make"))]
COMMANDS += [f"policy {c}" for c in ("", "train", "evaluate", "drive")]
COMMANDS += [f"plugins {c}" for c in ("", "list", "show", "schema", "cite")]

HEAVY = [
    "numba",
    "scipy",
    "numpy",
    "matplotlib",
    "pluggy",
    "rich",
    "PIL",
    "sklearn",
    "pymoo",
    "moocore",
    "starlette",
    "uvicorn",
]
HEAVY += ["pathloom_imga", "pathloom_baselines", "pathloom_maps", "pathloom.kernel", "pathloom.compiled"]

SCRIPT = f"""
import sys
from pathloom.cli import main

for command in {COMMANDS!r}:
    sys.argv = ["pathloom", *command.split(), "--help"]
    try:
        main()
    except SystemExit as left:
        assert not left.code, command
    loaded = [name for name in {HEAVY!r} if name in sys.modules]
    assert not loaded, (command, loaded)
"""


def test_help_of_every_command_works_and_loads_nothing_heavy() -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False, timeout=60)
    assert done.stderr == ""
    assert done.returncode == 0
    assert [line for line in done.stdout.splitlines() if line.startswith("Usage: ")] == [
        line for line in done.stdout.splitlines() if line.startswith("Usage: pathloom")
    ]
    assert done.stdout.count("Usage: ") == len(COMMANDS)


def test_help_of_plan_names_every_option_of_the_interface(cli) -> None:
    shown = cli("plan", "--help").out
    for option in (
        *("--planner", "--map", "--scenario", "--case", "--start", "--goal", "--world", "--corners", "--radius"),
        *("--unknown", "--threshold", "--seed", "--set", "--time-limit", "--optimum", "--freeze", "--plot"),
        *("--out", "--export", "--json", "--quiet"),
    ):
        assert option in shown


def test_the_version_is_told(cli) -> None:
    from importlib.metadata import version

    assert version("pathloom") in cli("--version").out


def test_help_goes_to_standard_output(cli) -> None:
    done = cli("plan", "-h")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("Usage: pathloom plan")
