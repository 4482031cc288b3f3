"""``pathloom maps``."""

from pathlib import Path

import pytest

from .conftest import listing, moving_ai, one_line, write


def test_list_shows_registered_maps_and_families(cli) -> None:
    document = cli("maps", "list", "--json").document
    names = {row["name"] for row in document["maps"]}
    assert {"iga-map1", "imaga-fig1", "random-SIZE:20%"} <= names
    assert all(set(row) == {"name", "plugin", "about", "source"} for row in document["maps"])


def test_the_table_lists_the_same_names(cli) -> None:
    shown = cli("maps", "list").out
    assert all(row["name"] in shown for row in cli("maps", "list", "--json").document["maps"])


def test_show_says_what_a_map_consists_of(cli, ring) -> None:
    document = cli("maps", "show", ring, "--json").document
    assert len(document.pop("sha256")) == 64
    assert document == {
        "map": "ring.map",
        "height": 3,
        "width": 3,
        "obstacles": 1,
        "free": 8,
        "resolution": 1.0,
        "origin": None,
        "regions": 1,
        "largest_region": 8,
    }


def test_regions_depend_on_the_corner_policy(cli, folder: Path) -> None:
    write(folder / "gap.map", moving_ai("@.", ".@"))
    regions = [
        cli("maps", "show", "gap.map", "--corners", c, "--json").document["regions"] for c in ("strict", "allow")
    ]
    assert regions == [2, 1]


def test_show_draws_the_map(cli, ring) -> None:
    shown = cli("maps", "show", ring).out
    assert shown.startswith("┌")
    assert "3 × 3 cells, 1 obstacles (11.1 %)" in shown
    assert "1 connected regions under 'strict', the largest of 8 cells" in shown


def test_show_and_plan_mean_the_same_map(cli) -> None:
    show = cli("maps", "show", "random-20:75:s3", "--json").document["sha256"]
    assert show == cli("plan", "--map", "random-20:75:s3", "--json").document["problem"]["map_sha256"]


def test_check_of_good_files_says_what_they_hold(cli, ring) -> None:
    done = cli("maps", "check", ring)
    assert (done.code, done.out, done.err) == (0, "ring.map: ok, 3 × 3 cells, 8 free\n", "")


def test_check_goes_on_after_a_bad_file(cli, ring, folder: Path) -> None:
    write(folder / "bad.map", "type octile\nheight 3\n")
    done = cli("maps", "check", "bad.map", "gone.map", ring)
    assert done.code == 2
    assert done.out == "ring.map: ok, 3 × 3 cells, 8 free\n"
    assert [line.split(": ")[1] for line in done.err.splitlines()] == ["bad.map", "gone.map"]


def test_check_holds_a_scenario_against_its_map(cli, ring, folder: Path) -> None:
    write(folder / "good.scen", "version 1\n0\tring.map\t3\t3\t0\t2\t2\t0\t4\n")
    assert cli("maps", "check", "good.scen").out == "good.scen: ok, 1 cases\n"
    write(folder / "bad.scen", "version 1\n0\tring.map\t4\t3\t0\t2\t2\t0\t4\n")
    assert one_line(cli("maps", "check", "bad.scen"), code=2).startswith("bad.scen: ")


def test_make_prints_a_map_that_plan_can_read(cli, folder: Path) -> None:
    text = cli("maps", "make", "random", "--size", 20, "--density", 0.2, "--seed", 1).out
    write(folder / "made.map", text)
    document = cli("maps", "show", "made.map", "--json").document
    assert (document["height"], document["width"], document["obstacles"]) == (20, 20, 80)
    assert cli("plan", "--map", "made.map").code == 0


def test_make_gives_the_map_of_the_same_name(cli, folder: Path) -> None:
    write(folder / "made.map", cli("maps", "make", "blocks", "--size", 15, "--obstacles", "30%", "--seed", 4).out)
    hashes = {cli("maps", "show", name, "--json").document["sha256"] for name in ("made.map", "blocks-15:30%:s4")}
    assert len(hashes) == 1


@pytest.mark.parametrize("suffix", [".map", ".csv", ".txt", ".npy"])
def test_make_writes_what_show_reads(cli, folder: Path, suffix) -> None:
    done = cli("maps", "make", "random", "--size", 12, "--out", f"made{suffix}")
    assert (done.code, done.out, done.err) == (0, "", "")
    hashes = {cli("maps", "show", name, "--json").document["sha256"] for name in (f"made{suffix}", "random-12")}
    assert len(hashes) == 1


WRONG = {
    "randm": "did you mean 'random-20'?",
    "random --density 1.5": "--density: found 1.5, allowed a share from 0 to 1",
    "random --density -0.1": "--density: found -0.1",
    "random --density nan": "--density: found nan",
    "random --density 1": "none of 1000 draws is connected from bottom-left to top-right under the corner policy 'strict'",
    "random --density 0.2 --obstacles 3": "--density and --obstacles: found both",
    "random --obstacles many": "found 'many'",
    "random --size 0": "--size: found 0, allowed an integer from 1 on",
    "random --size 100000": "--size: found 100000, allowed an integer up to 8192",
    "random --seed -1": "--seed: found -1, allowed an integer from 0 on",
    "random --corners strickt": "--corners: found 'strickt'; did you mean 'strict'?",
    "random --out gone/a.map": "gone/a.map: found no such folder",
    "random --out a.foo": "a.foo: found the suffix '.foo', allowed .map .csv .txt .npy",
}


@pytest.mark.parametrize("options", WRONG)
def test_make_refuses_what_it_cannot_make(refused, options) -> None:
    assert WRONG[options] in refused("maps", "make", *options.split())


def test_show_and_check_write_nothing(cli, ring, folder: Path) -> None:
    before = listing(folder)
    cli("maps", "show", ring)
    cli("maps", "check", ring)
    assert listing(folder) == before


@pytest.mark.parametrize(("option", "value"), [("--corners", "strickt"), ("--unknown", "fre"), ("--threshold", "256")])
def test_show_refuses_a_bad_option(refused, ring, option, value) -> None:
    assert option in refused("maps", "show", ring, option, value)
