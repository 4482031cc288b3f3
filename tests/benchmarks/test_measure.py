"""The command with which the numbers on the pages are measured."""

import sys

from benchmarks import measure


def rows(monkeypatch, capsys, *words):
    monkeypatch.setattr(sys, "argv", ["measure.py", *words])
    measure.main()
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == measure.HEAD
    assert all(line.count("|") == measure.HEAD.count("|") for line in lines)
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def test_every_planner_is_measured_on_every_map(monkeypatch, capsys):
    found = rows(monkeypatch, capsys, "iga,aco", "iga-map1,random-12:20", "--seeds", "2")
    assert [row[:3] for row in found] == [
        ["iga-map1", "iga", "2 of 2"], ["iga-map1", "aco", "2 of 2"],
        ["random-12:20", "iga", "2 of 2"], ["random-12:20", "aco", "2 of 2"],
    ]  # fmt: skip
    assert found[0][3:7] == ["13.7901", "13.7901", "-4.8 %", "0.0 %"]
    assert found[1][3:7] == ["14.4853", "14.4853", "0.0 %", "5.0 %"]


def test_a_planner_may_be_a_table_and_a_map_have_other_ends(monkeypatch, capsys):
    (row,) = rows(
        monkeypatch, capsys, '{use = "imga", population = 9}', "empty-9@top-left@bottom-right", "--seeds", "1"
    )
    assert row[1] == "{use: imga, population: 9}"
    assert row[3] == "11.3137"


def test_what_is_not_found_is_said(monkeypatch, capsys):
    (row,) = rows(monkeypatch, capsys, "imga", "maze-41:1:s1", "--seeds", "1", "--corners", "strict")
    assert row[2:8] == ["0 of 1", *["–"] * 5]
