"""What the guide to plugins shows works as shown: its files make a plugin, its commands and scripts use it."""

import json
import tomllib
from pathlib import Path

import jsonschema
import pages
import pytest

from pathloom.kernel.component import Component
from pathloom.kernel.registry import default_registry
from pathloom.schema import schema_of_config

GUIDE = Path(__file__).parents[2] / "plugins" / "README.md"
BLOCKS = pages.blocks_of(GUIDE)

AND_THEN = """
import pytest

from pathloom.kernel.registry import default_registry
from pathloom.schema import schema_of_config

Path("schema.json").write_text(json.dumps(schema_of_config(default_registry())))
print("contract:", int(pytest.main(["-q", "-p", "no:cacheprovider", "-k", "not process", "tests"])), flush=True)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with all files that the guide shows, its plugin installed there."""
    folder = tmp_path_factory.mktemp("guide")
    pages.write_files(BLOCKS, folder)
    project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
    info = folder / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
    points = project["entry-points"]["pathloom"]
    (info / "entry_points.txt").write_text("[pathloom]\n" + "".join(f"{k} = {v}\n" for k, v in points.items()))
    (folder / "fresh").mkdir()
    return folder


@pytest.fixture(scope="module")
def ran(folder):
    """What the commands and scripts of the guide said, in their order."""
    assert sum(language == "console" for language, _ in BLOCKS) >= 4
    return pages.run(BLOCKS, folder, AND_THEN)


def test_every_block_is_a_file_a_command_or_a_script():
    assert {language for language, _ in BLOCKS} == {"console", "python", "toml"}
    assert all(pages.FILE.match(text) for language, text in BLOCKS if language == "toml")


def test_the_commands_and_scripts_run(ran, folder):
    assert "acme/jitter, mutation, plugin 'acme' (acme-pathloom 1.0)" in ran
    assert "@article{acme2030," in ran
    assert "@article{li2021imga," in ran
    assert {"diary.txt", "fresh"} <= {path.name for path in folder.iterdir()}
    assert (folder / "fresh" / "nova" / "pyproject.toml").is_file()


def test_the_contract_of_the_guide_holds(ran):
    assert "\ncontract: 0\n" in ran, ran


def test_the_configs_of_the_pages_satisfy_the_schema_as_an_editor_sees_it(ran, folder):
    readme = GUIDE.parents[1] / "README.md"
    (shown,) = (text for language, text in pages.blocks_of(readme) if language == "toml")
    validator = jsonschema.Draft202012Validator(schema_of_config(default_registry()))
    assert validator.is_valid(tomllib.loads(shown))
    validator = jsonschema.Draft202012Validator(json.loads((folder / "schema.json").read_text()))
    config = (folder / "plan.toml").read_text()
    validator.validate(tomllib.loads(config))
    assert not validator.is_valid(tomllib.loads(config.replace("price", "prize")))


def test_the_table_of_the_surface_names_every_kind_that_there_is():
    table = GUIDE.read_text(encoding="utf-8").split("| kind (slot) |")[1].split("\n\n")[0]
    ours = {
        base
        for e in default_registry().all_entries(Component)
        for base in e.component.__mro__
        if vars(base).get("kind")
    }
    assert {kind.kind for kind in ours if kind.__module__.startswith("pathloom.") and kind.kind not in table} == set()
