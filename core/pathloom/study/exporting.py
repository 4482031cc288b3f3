"""Export: the rows of a study as CSV or Parquet, a line at a time."""

import csv
import os
import secrets
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import fields
from itertools import islice
from pathlib import Path
from typing import Any

from pathloom.errors import ConfigError, MapError
from pathloom.files import reason
from pathloom.study.row import NAMES, Row

BATCH = 10_000
"""Rows of a group in a Parquet file."""


def values(row: Row) -> tuple[Any, ...]:
    """Return the values of a row in the order of `NAMES`."""
    return tuple(getattr(row, name) for name in NAMES)


def to_csv(rows: Iterable[Row], path: str | Path) -> int:
    """Write a table with a line of names and one line a run; return how many runs. What is unknown stays empty."""
    count = 0
    with _replacing(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(NAMES)
        for row in rows:
            writer.writerow(values(row))
            count += 1
    return count


def to_parquet(rows: Iterable[Row], path: str | Path) -> int:
    """Write a Parquet file with one line a run; return how many runs.

    Raises
    ------
    ConfigError
        If the package pyarrow is not installed.
    """
    try:
        import pyarrow as pa
        from pyarrow.parquet import ParquetWriter
    except ImportError:
        raise ConfigError("--parquet: needs the package pyarrow: pip install 'pathloom[parquet]'") from None
    kinds = {"int": pa.int64(), "float": pa.float64()}
    schema = pa.schema(
        [
            (f.name, next((kind for word, kind in kinds.items() if word in str(f.type)), pa.string()))
            for f in fields(Row)
        ]
    )
    count, rest = 0, iter(rows)
    with _replacing(path) as draft, ParquetWriter(draft, schema, compression="zstd") as writer:
        while batch := list(islice(rest, BATCH)):
            columns = zip(*map(values, batch), strict=True)
            arrays = [pa.array(column, kind) for column, kind in zip(columns, schema.types, strict=True)]
            writer.write_batch(pa.record_batch(arrays, schema=schema))
            count += len(batch)
    return count


@contextmanager
def _replacing(path: str | Path) -> Iterator[Path]:
    """Give a file beside the target, which takes its place when all of it is written."""
    target = Path(path)
    draft = target.with_name(f".{target.name}.{secrets.token_hex(4)}.part")
    try:
        if target.exists() and not target.is_file():
            raise MapError(f"{path}: found a folder or a device, allowed a file to write")
        yield draft
        os.replace(draft, target)  # noqa: PTH105
    except OSError as error:
        raise MapError(f"{path}: found a place not writable ({reason(error)}), allowed a writable folder") from error
    finally:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
