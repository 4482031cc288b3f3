"""``pathloom plugins schema``: what editors complete from."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import referencing
from referencing.jsonschema import DRAFT202012

from .configs import ALL
from .conftest import write


@pytest.fixture
def schema(cli) -> dict[str, Any]:
    return cli("plugins", "schema").document


@pytest.fixture
def accepts(schema):
    validator = jsonschema.Draft202012Validator(schema)
    return lambda text: validator.is_valid(tomllib.loads(text))


def test_the_schema_is_a_valid_one_of_draft_2020_12(schema) -> None:
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    jsonschema.Draft202012Validator.check_schema(schema)


def test_every_reference_of_the_schema_leads_somewhere(schema) -> None:
    whole = referencing.Registry().with_resource("", DRAFT202012.create_resource(schema)).resolver()
    for reference in set(re.findall(r'"\$ref": "([^"]*)"', json.dumps(schema))):
        whole.lookup(reference)


@pytest.mark.parametrize("name", ALL)
def test_the_schema_accepts_every_good_config_and_its_frozen_form(cli, accepts, folder: Path, name) -> None:
    assert accepts(ALL[name])
    write(folder / "mine.toml", ALL[name])
    assert accepts(cli("plan", "mine.toml", "--freeze").out)


SHALLOW = {
    "a section": '[planer]\nuse = "imga"\n',
    "a key of problem": '[problem]\nmpa = "x"\n',
    "a key of run": "[run]\nsede = 1\n",
    "a negative seed": "[run]\nseed = -1\n",
    "no time": "[run]\ntime_limit = 0\n",
}


@pytest.mark.parametrize("text", SHALLOW.values(), ids=SHALLOW)
def test_the_schema_rejects_what_is_misspelt_or_out_of_range(accepts, text) -> None:
    assert not accepts(text)


DEEP = {
    "a planner": '[planner]\nuse = "imgaa"\n',
    "a slot": '[planner]\nuse = "imga"\nselektion = "roulette"\n',
    "a component": '[planner]\nuse = "imga"\nselection = "roulete"\n',
    "a component in a table": '[planner]\nuse = "imga"\n[planner.selection]\nuse = "roulete"\n',
    "a field": '[planner]\nuse = "imga"\n[planner.crossover]\nuse = "imga/common-node"\nraet = 0.5\n',
    "a termination": '[planner]\nuse = "imga"\n[[planner.termination]]\nuse = "max-generatons"\n',
    "a value out of range": '[planner]\nuse = "imga"\npopulation = 0\n',
    "a value of another type": '[planner]\nuse = "imga"\npopulation = "many"\n',
}


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP)
def test_the_schema_rejects_what_is_wrong_in_a_planner(accepts, text) -> None:
    assert not accepts(text)


LAX = {
    "a slot where no planner is named": '[planner]\nselektion = "roulette"\n',
    "a field of what the slot holds": '[planner]\nuse = "imga"\n[planner.crossover]\nraet = 0.5\n',
    "an objective": '[planner]\nuse = "imga"\n[planner.objectives]\nlenght = 1\n',
    "a field of an objective": (
        '[planner]\nuse = "imga"\n[planner.objectives]\nsafety = { use = "imga/unsafe-node", wieght = 1 }\n'
    ),
    "a corner policy": '[problem]\ncorners = "alow"\n',
    "a start": "[problem]\nstart = 3\n",
}


@pytest.mark.parametrize("text", LAX.values(), ids=LAX)
def test_the_schema_rejects_what_is_misspelt_in_refinements_and_terms(accepts, text) -> None:
    assert not accepts(text)


def test_the_schema_shows_an_editor_what_a_field_means_its_unit_and_its_default(schema) -> None:
    fields = schema["$defs"]["planner:hga-aco.rrt"]["properties"]
    assert fields["step_length"] == {
        "description": "Length of a branch in cells: δ [cells].",
        "default": 1.7,
        "type": "number",
        "exclusiveMinimum": 0.0,
    }
    assert fields["refinement"]["description"] == "Improves the answer at the end."
