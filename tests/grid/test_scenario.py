import math
from pathlib import Path

import pytest

from pathloom.grid import OccupancyGrid, read_map, read_scenario

GOOD = "version 1\n0\tmaps/dao/a.map\t4\t3\t0\t1\t3\t2\t3.41421\n1\ta.map\t4\t3\t1\t1\t1\t1\t5\n"


def written(folder: Path, text: str) -> Path:
    path = folder / "a.map.scen"
    path.write_bytes(text.encode())
    return path


@pytest.mark.parametrize(
    "text",
    [
        GOOD,
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("\t", " ").replace("version 1", "version 1.0"),
        GOOD.rstrip("\n"),
    ],
    ids=["tabs", "CRLF", "blanks", "no last line end"],
)
def test_x_is_the_column_and_lines_count_from_zero(tmp_path: Path, text: str) -> None:
    scenario = read_scenario(written(tmp_path, text))
    first = scenario.case(0)
    assert (first.map_name, first.bucket) == ("maps/dao/a.map", 0)
    assert (first.height, first.width) == (3, 4)
    assert (first.start, first.goal) == ((1, 0), (2, 3))
    assert first.optimum == 3.41421
    assert len(scenario.cases) == 2


def test_a_length_printed_short_is_as_precise_as_the_others(tmp_path: Path) -> None:
    first, second = read_scenario(written(tmp_path, GOOD)).cases
    assert first.tolerance == pytest.approx(0.5e-5, rel=0.1)
    assert second.tolerance == pytest.approx(0.5e-5, rel=0.1)


def test_fixed_decimals_bound_the_tolerance(tmp_path: Path) -> None:
    text = GOOD.replace("3.41421", "3.41").replace("\t5\n", "\t50.00\n")
    assert [c.tolerance for c in read_scenario(written(tmp_path, text)).cases] == pytest.approx([5e-3] * 2, rel=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("version 1", "version 2", "line 1: found 'version 2', allowed 'version 1'"),
        ("\t5\n", "\n", "line 3: found 8 fields, allowed 9: bucket, map"),
        ("\t5\n", "\t5\t6\n", "line 3: found 10 fields"),
        ("\t5\n", "\tnan\n", "line 3, optimal length: found 'nan'"),
        ("\t5\n", "\t-5\n", "line 3, optimal length: found '-5'"),
        ("\t5\n", "\t1_0\n", "line 3, optimal length"),
        ("0\tmaps", "x\tmaps", "line 2, bucket: found 'x', allowed a whole number from 0"),
        ("\t3\t2\t", "\t4\t2\t", "line 2, goal x: found 4, allowed less than the map width 4"),
        ("\t3\t2\t", "\t3\t3\t", "line 2, goal y: found 3, allowed less than the map height 3"),
        ("\t3\t2\t", "\t-3\t2\t", "line 2, goal x: found '-3'"),
    ],
)
def test_a_malformed_line_is_named(tmp_path, refused, old, new, says) -> None:
    path = written(tmp_path, GOOD.replace(old, new, 1))
    message = refused(read_scenario, path)
    assert message.startswith(f"{path}: {says}")


def test_a_scenario_without_cases_is_refused(tmp_path, refused) -> None:
    assert "found the end of the file, allowed one case" in refused(read_scenario, written(tmp_path, "version 1\n"))


@pytest.mark.parametrize("index", [-1, 2])
def test_a_case_out_of_range_names_the_range(tmp_path, refused, index: int) -> None:
    scenario = read_scenario(written(tmp_path, GOOD))
    assert f"found case {index}, allowed 0 to 1" in refused(scenario.case, index)


def test_the_map_is_sought_beside_the_scenario(tmp_path, refused) -> None:
    scenario = read_scenario(written(tmp_path, GOOD.replace("maps/dao/a.map", "maps\\dao\\a.map", 1)))
    case = scenario.case(0)
    (tmp_path / "b.map").touch()
    assert "no file 'a.map' beside the scenario" in refused(scenario.map_path, case)
    assert "did you mean 'b.map'?" in refused(scenario.map_path, case)
    (tmp_path / "a.map").touch()
    assert scenario.map_path(case) == tmp_path / "a.map"


def test_a_map_of_another_size_is_noticed(tmp_path, refused) -> None:
    scenario = read_scenario(written(tmp_path, GOOD))
    scenario.check(scenario.case(0), OccupancyGrid([[0] * 4] * 3))
    message = refused(scenario.check, scenario.case(0), OccupancyGrid([[0] * 3] * 4, name="a.map"))
    assert "found a map a.map of 4 x 3 cells (height x width), allowed 3 x 4" in message


@pytest.mark.data
def test_real_scenarios_fit_their_maps(data: Path) -> None:
    files = sorted(data.glob("movingai/*/*.scen"))
    assert len(files) == 38
    for file in files:
        scenario = read_scenario(file)
        cases = file.read_text().strip().count("\n")
        grid = read_map(scenario.map_path(scenario.case(0)))
        assert len(scenario.cases) == cases
        for case in scenario.cases:
            scenario.check(case, grid)


@pytest.mark.data
def test_real_lengths_are_sums_of_ones_and_roots_within_their_tolerance(data: Path) -> None:
    for file in sorted(data.glob("movingai/*/*.scen")):
        for case in read_scenario(file).cases[::97]:
            diagonals = range(int(case.optimum / math.sqrt(2) + 0.01) + 1)
            rests = (case.optimum - k * math.sqrt(2) for k in diagonals)
            assert min(abs(rest - round(rest)) for rest in rests) <= case.tolerance, (file, case)
