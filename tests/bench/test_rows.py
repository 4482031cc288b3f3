"""The command with which the numbers on the pages of the plugins are measured."""

import pytest

from pathloom.bench.rows import HEADS, rows


def measured(planners, maps, *, corners="allow", seeds=2):
    return [list(line) for line in rows(maps, planners, corners, range(seeds))]


def test_every_planner_is_measured_on_every_map():
    found = measured("iga,aco", "iga-map1,random-12:20")
    assert [row[:3] for row in found] == [
        ["iga-map1", "iga", "2 of 2"], ["iga-map1", "aco", "2 of 2"],
        ["random-12:20", "iga", "2 of 2"], ["random-12:20", "aco", "2 of 2"],
    ]  # fmt: skip
    assert found[0][3:7] == ["13.7901", "13.7901", "-4.8 %", "0.0 %"]
    assert found[1][3:7] == ["14.4853", "14.4853", "0.0 %", "5.0 %"]
    assert all(len(row) == len(HEADS) for row in found)


@pytest.mark.parametrize("ends", ["@top-left@bottom-right", "@0;0@8;8"])
def test_a_planner_may_be_a_table_and_a_map_have_other_ends(ends):
    (row,) = measured('{use = "imga", population = 9}', f"empty-9{ends}", seeds=1)
    assert row[1] == "{use: imga, population: 9}"
    assert row[3] == "11.3137"


def test_what_is_not_found_is_said():
    (row,) = measured("imga", "maze-41:1:s1", corners="strict", seeds=1)
    assert row[2:8] == ["0 of 1", *["–"] * 5]
