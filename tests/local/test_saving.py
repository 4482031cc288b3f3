"""Models in files: the same decisions again, and one line for whatever is wrong with a file."""

import io
import json
import zipfile

import numpy as np
import pytest

import pathloom as pl
from pathloom.local import load_model, save_model
from pathloom.local.classifiers import Classifier
from pathloom.local.rules import FourLeaves

from .test_policies import PAPER, policy

NETWORK = Classifier(classifier="sklearn.neural_network.MLPClassifier", scaled=True, parameters=("max_iter=30",))


@pytest.fixture(scope="module")
def examples():
    return pl.generate(pl.load_map("blocks-20:15%"), 300, FourLeaves(), rng=np.random.default_rng(5))


@pytest.fixture
def saved(tmp_path, examples):
    model = policy("rf", trees=5).trained(examples, np.random.default_rng(0))
    save_model(model, tmp_path / "rf.skops", examples, 0)
    return tmp_path / "rf.skops"


@pytest.mark.parametrize("made", [*map(policy, PAPER), Classifier(), NETWORK], ids=lambda p: p.name)
def test_a_model_decides_the_same_after_it_was_saved(made, examples, tmp_path):
    model = made.trained(examples, np.random.default_rng(0))
    first = save_model(model, tmp_path / "a.skops", examples, 7)
    again, manifest = load_model(tmp_path / "a.skops")
    assert again.policy == made
    assert again(examples.distances).tolist() == model(examples.distances).tolist()
    assert manifest == first
    assert manifest["examples"]["sha256"] == examples.sha256


def changed(file, **members):
    """Write a model's file anew with some of its parts exchanged."""
    with zipfile.ZipFile(file) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in parts.items():
            change = members.get(name.partition(".")[0])
            archive.writestr(name, change(data) if change else data)


def in_manifest(**facts):
    return {"manifest": lambda data: json.dumps({**json.loads(data), **facts}).encode()}


def refusal(file):
    with pytest.raises(pl.PathloomError) as refused:
        load_model(file)
    assert "\n" not in str(refused.value)
    return str(refused.value)


def test_a_model_that_was_changed_is_refused(saved):
    changed(saved, model=lambda data: data[:-30] + b"?" + data[-29:])
    assert "changed since" in refusal(saved)


def test_a_model_of_another_version_is_refused(saved):
    changed(saved, **in_manifest(versions={"scikit-learn": "0.1"}))
    assert "found a model of scikit-learn 0.1, allowed one of" in refusal(saved)
    changed(saved, **in_manifest(schema="pathloom.policy-model/9"))
    assert "schema: found 'pathloom.policy-model/9'" in refusal(saved)


@pytest.mark.parametrize("facts", [{"examples": None}, {"examples": {"rows": 3}}, {"sha256": None}, {"distances": [4]}])
def test_a_manifest_that_lacks_something_is_refused_for_it(saved, facts):
    changed(saved, **in_manifest(**facts))
    assert f"manifest.json: {next(iter(facts))}: found" in refusal(saved)


def test_a_model_of_actions_that_there_are_not_or_of_too_few_numbers_is_refused(tmp_path, examples):
    file = tmp_path / "gnb.skops"
    for name, numbers, says in (
        ("classes_", np.array([0, 1, 2, 7]), "found actions that there are not, allowed 0 to 3"),
        ("theta_", np.ones((2, 2)), "found what cannot decide"),
    ):
        model = policy("gnb").trained(examples, np.random.default_rng(0))
        setattr(model.classifier, name, numbers)
        save_model(model, file, examples, 0)
        assert says in refusal(file)


@pytest.mark.parametrize(("at", "byte"), [(6, 1), (8, 99), (45, 255)], ids=["locked", "unknown packing", "damaged"])
def test_a_model_that_no_zip_reader_can_read_is_refused(saved, at, byte):
    with zipfile.ZipFile(saved) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(saved, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
    data = bytearray(saved.read_bytes())
    data[at] = byte
    if at < 30:  # the flags and the packing are told a second time, at the end
        data[data.index(b"PK\x01\x02") + at + 2] = byte
    saved.write_bytes(data)
    assert "found no zip file, or a damaged one" in refusal(saved)


def test_what_is_no_model_is_refused(tmp_path):
    file = tmp_path / "no.skops"
    for content in (b"", b"no zip", b"PK\x03\x04" + bytes(40)):
        file.write_bytes(content)
        refusal(file)
    assert "no such file" in refusal(tmp_path / "none.skops")
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("a.txt", "a")
    assert "other parts" in refusal(file)


def test_a_forged_model_is_refused_for_the_types_it_names_and_builds_none(saved):
    import hashlib

    def forged(data):
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = {name: archive.read(name) for name in archive.namelist()}
        schema = json.loads(parts["schema.json"])
        schema["__module__"], schema["__class__"] = "subprocess", "Popen"
        parts["schema.json"] = json.dumps(schema).encode()
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as archive:
            for name, content in parts.items():
                archive.writestr(name, content)
        digest.append(hashlib.sha256(packed.getvalue()).hexdigest())
        return packed.getvalue()

    digest = []
    changed(saved, model=forged)
    changed(saved, **in_manifest(sha256=digest[0]))
    assert "subprocess.Popen, which is not trusted" in refusal(saved)


def test_a_policy_that_is_not_installed_is_named(saved):
    changed(saved, **in_manifest(policy={"use": "hga-aco/rff"}))
    assert "did you mean 'hga-aco/rf'" in refusal(saved)
