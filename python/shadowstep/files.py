"""Runs that a file has."""

from __future__ import annotations

import builtins
import csv
import json
import os
import warnings
from collections.abc import Iterator
from typing import Any, Union

import numpy as np

from ._shadowstep import InputError
from .integration import Trajectory

_INDICATORS = ("lyapunov", "megno", "mean_megno", "sali")
_FIXED = ("n", "t", "energy", "modified_energy", "estimate", "order", *_INDICATORS)


def open(path: Union[str, os.PathLike[str]]) -> Trajectory:
    """The rows of a file that `shadowstep run` has written: CSV, or JSON lines or records of NumPy with the file of their metadata beside them.

    Records of NumPy are mapped into memory: what is not used of them is not read. What a row does not have is NaN: energies, positions and modified energies can have different periods. `Trajectory.metadata` is what determined the run.

    Raises
    ------
    InputError
        A file that is not one of a run, with its line.
    OSError
        A file that cannot be read.

    Examples
    --------
    >>> import pathlib, tempfile, shadowstep
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> scene = '''
    ... problem.name = "pendulum"
    ... run = { scheme = "yoshida4", step = "1/10", steps = 30, digits = "double" }
    ... output = { file = "pendulum.csv", trajectory = true, energy = { every = 10 } }
    ... '''
    >>> _ = (folder / "pendulum.toml").write_text(scene)
    >>> _ = shadowstep.run(folder / "pendulum.toml")
    >>> run = shadowstep.open(folder / "pendulum.csv")
    >>> run.q.shape, run.metadata["scheme"], int(np.isfinite(run.energy).sum())
    ((31, 1), 'yoshida4', 4)
    """
    name = os.fspath(path)
    if name.endswith(".npy"):
        return _numpy(name)
    metadata, rows, momenta = _json_lines(name) if name.endswith(".jsonl") else _csv(name)
    _warn_of_missing(name, metadata, rows)
    coordinates = metadata["coordinates"]
    doubles = metadata.get("digits") in ("double", "compensated")

    def array(column: str, texts: bool = False) -> np.ndarray:
        values = [row.get(column) or "nan" for row in rows]
        return np.array(values, dtype=object) if texts and not doubles else np.array([float(value) for value in values])

    def states(names: list[str]) -> np.ndarray:
        if not any(row.get(names[0]) for row in rows):
            return np.full((len(rows), len(names)), np.nan)
        return np.stack([array(name, texts=True) for name in names], axis=1)

    def there(column: str) -> bool:
        return any(row.get(column) for row in rows)

    return Trajectory(
        n=array("n").astype(np.int64),
        t=array("t", texts=True),
        q=states(coordinates),
        p=states(momenta),
        energy=array("energy", texts=True),
        coordinates=coordinates,
        momenta=momenta,
        force_evaluations=None,
        modified_energy=array("modified_energy", texts=True) if there("modified_energy") else None,
        modified_energy_error=array("estimate", texts=True) if there("modified_energy") else None,
        order=array("order") if there("modified_energy") else None,
        metadata=metadata,
        indicators={name: array(name) for name in _INDICATORS if there(name)},
        values={name: array(name, texts=True) for name in metadata.get("values", {})},
    )


def _warn_of_missing(name: str, metadata: dict[str, Any], rows: list[dict[str, str]]) -> None:
    """Warns where rows have been cut off at the end of a line: from n = 0 on, rows are never farther from each other than the first two."""
    if len(rows) < 2 or "section" in metadata:
        return
    first, second, last = (int(rows[i]["n"]) for i in (0, 1, -1))
    if first == 0 and last + second <= int(metadata["steps"]):
        message = f"{name} ends at n = {last}, and its run has {metadata['steps']} steps: copy the file again, or run its scene again"
        warnings.warn(message, stacklevel=3)


def _csv(name: str) -> tuple[dict[str, Any], list[dict[str, str]], list[str]]:
    metadata: dict[str, Any] = {}
    with builtins.open(name, newline="") as file:
        lines = _without_head(name, file, metadata)
        reader = csv.DictReader(lines)
        columns = reader.fieldnames
        if columns is None or list(columns[:2]) != ["n", "t"] or "coordinates" not in metadata:
            raise InputError(f"{name} is no file of `shadowstep run`, which begins with lines of metadata and has columns n, t, …: read a file of `trace` with pandas.read_csv")
        rows = list(reader)
    for key in ("coordinates", "values"):
        if key in metadata:
            metadata[key] = json.loads(metadata[key])
    state = [column for column in columns if column not in _FIXED and column not in metadata.get("values", {})]
    written = [coordinate for coordinate in metadata["coordinates"] if coordinate in state]
    return metadata, rows, state[len(written) :] or [f"p{name}" for name in metadata["coordinates"]]


def _without_head(name: str, file: Any, metadata: dict[str, Any]) -> Iterator[str]:
    for number, line in enumerate(file, 1):
        if not line.endswith("\n"):
            raise InputError(f"{name}:{number}: the line is incomplete, and what follows is missing: copy the file again, or run its scene again")
        if not line.startswith("#"):
            yield line
            continue
        key, _, value = line[1:].strip().partition(": ")
        metadata[key] = value


def _numpy(name: str) -> Trajectory:
    metadata = _metadata(name)
    try:
        rows = np.load(name, mmap_mode="r", max_header_size=1 << 24)
    except ValueError as error:
        raise InputError(f"{name} cannot be read as records of NumPy ({error}): if it is incomplete, copy it again, or run its scene again") from None
    fields = rows.dtype.names or ()

    def field(column: str, *shape: int) -> np.ndarray:
        # one NaN for all rows, which takes no memory
        return rows[column] if column in fields else np.broadcast_to(np.nan, (len(rows), *shape))

    momenta = metadata.get("momenta") or [f"p{coordinate}" for coordinate in metadata["coordinates"]]
    estimated = "modified_energy" in fields
    return Trajectory(
        n=rows["n"],
        t=rows["t"],
        q=field("q", len(momenta)),
        p=field("p", len(momenta)),
        energy=field("energy"),
        coordinates=metadata["coordinates"],
        momenta=momenta,
        force_evaluations=None,
        modified_energy=rows["modified_energy"] if estimated else None,
        modified_energy_error=rows["estimate"] if estimated else None,
        order=rows["order"] if estimated else None,
        metadata=metadata,
        indicators={name: rows[name] for name in _INDICATORS if name in fields},
        values={name: rows[name] for name in metadata.get("values", {})},
    )


def _metadata(name: str) -> dict[str, Any]:
    with builtins.open(f"{name}.metadata.json") as file:
        metadata: dict[str, Any] = json.load(file)["metadata"]
    return metadata


def _json_lines(name: str) -> tuple[dict[str, Any], list[dict[str, str]], list[str]]:
    metadata = _metadata(name)
    momenta = metadata.get("momenta") or [f"p{coordinate}" for coordinate in metadata["coordinates"]]
    rows = []
    with builtins.open(name) as file:
        for number, line in enumerate(file, 1):
            try:
                row = json.loads(line)
            except ValueError:
                raise InputError(f"{name}:{number}: this line is not JSON") from None
            state = zip([*metadata["coordinates"], *momenta], [*row.pop("q", []), *row.pop("p", [])])
            rows.append({**{key: str(value) for key, value in row.items() if value is not None}, **dict(state)})
    return metadata, rows, momenta
