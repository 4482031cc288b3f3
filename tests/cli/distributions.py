"""Distributions made of a few files, as an installer would leave them."""

from collections.abc import Mapping, Sequence
from pathlib import Path


def distribution(
    site: Path,
    name: str,
    *,
    version: str = "1.0",
    points: Mapping[str, str],
    modules: Mapping[str, str],
    requires: Sequence[str] = (),
) -> None:
    """Put a distribution with entry points of pathloom, and its modules, into a folder for PYTHONPATH."""
    info = site / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir(parents=True)
    needs = "".join(f"Requires-Dist: {requirement}\n" for requirement in requires)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n{needs}")
    lines = "".join(f"{point} = {module}\n" for point, module in points.items())
    (info / "entry_points.txt").write_text(f"[pathloom]\n{lines}")
    for module, source in modules.items():
        (site / f"{module}.py").write_text(source)
