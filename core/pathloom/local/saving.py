"""Saving and loading models: skops instead of pickle, and a manifest of what was trained on what with what.

A file is a zip of ``manifest.json`` and ``model.skops``. Loading builds only types that are trusted by skops, trees,
which are checked afterwards, and what the policy's own class names. The digest in the manifest finds accidents; it is
no signature: somebody who forges a model forges its digest as well. Such a model decides what it likes, and may make
scikit-learn fail, but it runs no code of its maker's.
"""

import hashlib
import io
import json
import zipfile
from collections.abc import Iterator
from importlib.metadata import version
from typing import Any

import numpy as np

from pathloom.errors import ConfigError, PathloomError
from pathloom.files import FilePath, content, refusal, replace, shown
from pathloom.kernel.compose import build, freeze
from pathloom.kernel.registry import default_registry
from pathloom.local.actions import Action
from pathloom.local.examples import Examples
from pathloom.local.policy import LearnedPolicy, Model, Policy, first_line
from pathloom.local.sectors import WIDTHS
from pathloom.zips import UNREADABLE

SCHEMA = "pathloom.policy-model/1"
MEMBERS = ("manifest.json", "model.skops")
LARGEST = 1 << 28
"""Bytes (256 MiB) of a model, unpacked, beyond which it is refused."""
TRUSTED = frozenset({"sklearn.tree._tree.Tree"})
"""What is built beyond skops' own list: compiled trees, of which `Forest` uses checked copies only."""
KINDS = frozenset({
    "CachedNode", "DictNode", "DTypeNode", "FunctionNode", "JsonNode", "ListNode", "LossNode", "NdArrayNode",
    "ObjectNode", "SliceNode", "TreeNode", "TupleNode", "TypeNode",
})  # fmt: skip
"""Kinds of parts that models need. Others, such as states of generators, are built by skops without a look at them."""
ONLY_FOR_TRAINING = ("_optimizer", "_random_state")
"""Attributes of networks that predictions do not need, and that would not be loaded."""


def save_model(model: Model, path: FilePath, examples: Examples, seed: int) -> dict[str, Any]:
    """Write a model with its manifest, and return the manifest.

    Raises
    ------
    PathloomError
        If the classifier has parts that would not be loaded again, or the file cannot be written.
    """
    import skops.io

    for part in _estimators(model.classifier):
        for name in ONLY_FOR_TRAINING:
            vars(part).pop(name, None)
    try:
        packed: bytes = skops.io.dumps(model.classifier, compression=zipfile.ZIP_DEFLATED)
        _check_parts(packed, model.policy, str(path))
    except PathloomError as error:
        raise ConfigError(
            f"{path}: not written, for it could not be loaded again: {model.policy.name}: {error}"
        ) from error
    manifest = {
        "schema": SCHEMA,
        "policy": freeze(model.policy, default_registry()),
        "distances": model.width,
        "examples": {"name": examples.name, "sha256": examples.sha256, "rows": len(examples)},
        "seed": seed,
        "versions": _versions(),
        "sha256": hashlib.sha256(packed).hexdigest(),
    }
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in zip(MEMBERS, (json.dumps(manifest, indent=1).encode(), packed), strict=True):
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), data)  # the same bytes at any time
    replace(path, buffer.getvalue())
    return manifest


def load_model(path: FilePath) -> tuple[Model, dict[str, Any]]:
    """Return the model in a file, and its manifest.

    Raises
    ------
    PathloomError
        If it is no model, was changed, comes from another version of scikit-learn or of this format, or
        holds anything that is not trusted.
    """
    manifest, packed = _unpacked(path)
    _check_manifest(manifest, path)
    if hashlib.sha256(packed).hexdigest() != manifest["sha256"]:
        raise refusal(path, "model.skops", "a model other than the manifest's, changed since", "one as it was written")
    try:
        policy = build(Policy, manifest["policy"], default_registry(), "policy")
    except PathloomError as error:
        raise ConfigError(f"{path}: manifest.json: {error}") from error
    if not isinstance(policy, LearnedPolicy):
        raise refusal(path, "manifest.json: policy", policy.name, "a policy that learns")
    trusted = _check_parts(packed, policy, str(path))
    import skops.io

    try:
        classifier = skops.io.loads(packed, trusted=sorted(trusted))
    except Exception as error:  # whatever forged parts make of skops and scikit-learn
        raise refusal(
            path, "model.skops", f"what cannot be built ({first_line(error)})", "a model as it was written"
        ) from error
    width = int(manifest["distances"])
    if type(classifier) is not type(policy.estimator(0)) or getattr(classifier, "n_features_in_", None) != width:
        raise refusal(path, "model.skops", "another classifier than the manifest's", f"one of {policy.name}")
    model = Model(policy, classifier, width)
    try:
        _ = model.forest  # its trees are checked before anything walks them
        actions = {*np.asarray(classifier.classes_).tolist(), *model(np.ones((1, width))).tolist()}
    except PathloomError as error:
        raise ConfigError(f"{path}: {error}") from error
    except Exception as error:  # whatever forged numbers make of scikit-learn
        raise refusal(
            path, "model.skops", f"what cannot decide ({first_line(error)})", "a model as it was written"
        ) from error
    if not actions <= set(Action):
        raise refusal(path, "model.skops", "actions that there are not", f"0 to {len(Action) - 1}")
    return model, manifest


def _unpacked(path: FilePath) -> tuple[dict[str, Any], bytes]:
    allowed = "a model that pathloom wrote"
    try:
        with zipfile.ZipFile(io.BytesIO(content(path))) as archive:
            found = archive.infolist()
            if sorted(info.filename for info in found) != sorted(MEMBERS):
                raise refusal(path, "", "a zip file of other parts", allowed)
            if sum(info.file_size for info in found) > LARGEST:
                raise refusal(path, "", "a model larger than 256 MiB", "a smaller one")
            manifest, packed = (archive.read(name) for name in MEMBERS)
    except UNREADABLE as error:
        raise refusal(path, "", f"no zip file, or a damaged one ({first_line(error)})", allowed) from error
    try:
        document = json.loads(manifest)
    except (ValueError, RecursionError) as error:
        raise refusal(path, "manifest.json", "no JSON", allowed) from error
    if not isinstance(document, dict):
        raise refusal(path, "manifest.json", "no table", allowed)
    return document, packed


def _check_manifest(manifest: dict[str, Any], path: FilePath) -> None:
    if manifest.get("schema") != SCHEMA:
        raise refusal(path, "manifest.json: schema", shown(manifest.get("schema")), repr(SCHEMA))
    if not isinstance(manifest.get("policy"), dict):
        raise refusal(path, "manifest.json: policy", shown(manifest.get("policy")), "a table with 'use'")
    if manifest.get("distances") not in WIDTHS:
        raise refusal(path, "manifest.json: distances", shown(manifest.get("distances")), "2, 4 or 24")
    if not isinstance(manifest.get("sha256"), str):
        raise refusal(path, "manifest.json: sha256", shown(manifest.get("sha256")), "the model's digest")
    examples = manifest.get("examples")
    if not isinstance(examples, dict) or not isinstance(examples.get("name"), str):
        raise refusal(path, "manifest.json: examples", shown(examples), "a table with 'name'")
    used = manifest.get("versions")
    then = used.get("scikit-learn") if isinstance(used, dict) else None
    now = version("scikit-learn")
    if then != now:
        found = f"a model of scikit-learn {shown(then).strip(chr(39))}"
        raise refusal(path, "manifest.json: versions", found, f"one of {now}, the version here", "train it again")


def _check_parts(packed: bytes, policy: LearnedPolicy, name: str) -> set[str]:
    """Return the types that loading may build beyond skops' own, having seen that there are no others."""
    import skops.io

    try:
        with zipfile.ZipFile(io.BytesIO(packed)) as archive:
            if sum(info.file_size for info in archive.infolist()) > LARGEST:
                raise refusal(name, "model.skops", "a model larger than 256 MiB", "a smaller one")
            refused = set(_kinds(json.loads(archive.read("schema.json")))) - KINDS
        untrusted = set(skops.io.get_untrusted_types(data=packed))
    except PathloomError:
        raise
    except Exception as error:  # whatever forged parts make of skops
        raise refusal(
            name, "model.skops", f"what cannot be read ({first_line(error)})", "a model as it was written"
        ) from error
    refused |= untrusted - TRUSTED - policy.in_files
    if refused:
        raise refusal(name, "model.skops", f"{', '.join(sorted(refused))}, which is not trusted", "a model's own parts")
    return untrusted


def _kinds(node: Any) -> Iterator[str]:
    """Yield the kind of every part of a model."""
    stack = [node]
    while stack:
        part = stack.pop()
        if isinstance(part, dict):
            if isinstance(part.get("__loader__"), str):
                yield part["__loader__"]
            stack += part.values()
        elif isinstance(part, list):
            stack += part


def _estimators(classifier: Any) -> list[Any]:
    """Return a classifier, or the steps of a pipeline."""
    return [step for _, step in getattr(classifier, "steps", [("", classifier)])]


def _versions() -> dict[str, str]:
    return {name: version(name) for name in ("pathloom", "scikit-learn", "skops", "numpy")}
