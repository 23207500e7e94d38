"""Runs that a file has."""

from __future__ import annotations

import builtins
import csv
import json
import os
import re
import warnings
from collections.abc import Callable, Sequence
from typing import Any, Union

import numpy as np

from ._shadowstep import InputError, fixed_names
from .arguments import path_of
from .integration import Trajectory

_FIXED = fixed_names()
_INDICATORS = [name for name in _FIXED if name not in ("n", "t", "energy", "modified_energy", "estimate", "order")]


def open(path: Union[str, os.PathLike[str]]) -> Trajectory:
    """The rows of a file that `shadowstep run` has written: CSV, or JSON lines or records of NumPy with the file of their metadata beside them.

    Records of NumPy are mapped into memory: what is not used of them is not read. What a row does not have is NaN: energies, positions and modified energies can have different periods. `Trajectory.metadata` is what determined the run.

    Raises
    ------
    InputError
        A file that is not one of a run, or is damaged, with its line or byte.
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
    name = path_of(path, "path")
    if name.endswith(".npy"):
        return _numpy(name)
    metadata, rows, momenta = _json_lines(name) if name.endswith(".jsonl") else _csv(name)
    _warn_of_missing(name, metadata, rows)
    coordinates = metadata["coordinates"]
    doubles = metadata.get("digits") in ("double", "compensated")

    def there(column: str) -> bool:
        return any(row.get(column) for row in rows)

    def array(column: str) -> np.ndarray:
        values = [row.get(column) or "nan" for row in rows]
        is_text = not (doubles or column == "order" or column in _INDICATORS)
        return np.array(values, dtype=object) if is_text else np.array([float(value) for value in values])

    def states(names: list[str]) -> np.ndarray:
        return np.stack([array(name) for name in names], axis=1) if there(names[0]) else np.full((len(rows), len(names)), np.nan)

    n = np.array([int(row["n"]) for row in rows], dtype=np.int64)
    return _trajectory(metadata, momenta, n, states(coordinates), states(momenta), array, there)


def _trajectory(
    metadata: dict[str, Any],
    momenta: list[str],
    n: np.ndarray,
    q: np.ndarray,
    p: np.ndarray,
    column: Callable[[str], np.ndarray],
    there: Callable[[str], bool],
) -> Trajectory:
    estimated = there("modified_energy")
    return Trajectory(
        n=n,
        t=column("t"),
        q=q,
        p=p,
        energy=column("energy"),
        coordinates=metadata["coordinates"],
        momenta=momenta,
        force_evaluations=None,
        modified_energy=column("modified_energy") if estimated else None,
        modified_energy_error=column("estimate") if estimated else None,
        order=column("order") if estimated else None,
        metadata=metadata,
        indicators={name: column(name) for name in _INDICATORS if there(name)},
        values={name: column(name) for name in metadata.get("values", {})},
    )


_AGAIN = "copy the file again, or run its scene again"
_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?|nan|-?inf")
# the columns that a state at a physical end does not have
_AT_STEPS = {"n", "t", "modified_energy", "estimate", "order", *_INDICATORS}
_WHOLE = re.compile(r"-?[0-9]{1,18}")


def _warn_of_missing(name: str, metadata: dict[str, Any], rows: list[dict[str, str]]) -> None:
    """Warns where rows have been cut off at the end of a line: from n = 0 on, rows are never farther from each other than the first two. Where a condition ends
    the run, its end is not known before."""
    if len(rows) < 2 or "section" in metadata or "end" in metadata:
        return
    if "steps" not in metadata:
        t, until = rows[-1]["t"], metadata["until"]
        if float(t) != float(until) and not _AT_STEPS.issuperset(rows[0]):
            warnings.warn(f"{name} ends at t = {t}, and its run at t = {until}: {_AGAIN}", stacklevel=3)
        return
    first, second, last = (int(rows[i]["n"]) for i in (0, 1, -1))
    if first == 0 and last + second <= int(metadata["steps"]):
        message = f"{name} ends at n = {last}, and its run has {metadata['steps']} steps: {_AGAIN}"
        warnings.warn(message, stacklevel=3)


def _text(name: str) -> str:
    with builtins.open(name, "rb") as file:
        content = file.read()
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise InputError(f"{name}:{line}: byte {error.start} is not of a text in UTF-8: {_AGAIN}") from None


def _lines(name: str) -> list[str]:
    """The lines of a text, each of which ends with a line feed."""
    lines = _text(name).split("\n")
    if lines[-1]:
        raise InputError(f"{name}:{len(lines)}: the line is incomplete, and what follows is missing: {_AGAIN}")
    return lines[:-1]


def _check_metadata(metadata: Any, place: dict[str, str], otherwise: str) -> None:
    """Refuses metadata of another form; each key has a place, and keys that are missing another one."""
    texts = lambda value: isinstance(value, list) and bool(value) and all(isinstance(text, str) for text in value)  # noqa: E731
    known: dict[str, tuple[Any, str]] = {
        "coordinates": (texts, "a list of names"),
        "momenta": (lambda value: texts(value) and len(value) == len(metadata["coordinates"]), "a name for each coordinate"),
        "values": (lambda value: isinstance(value, dict), "formulas by their names"),
        "steps": (lambda value: _WHOLE.fullmatch(str(value)) is not None, "a number of steps"),
    }
    # what ends the run otherwise
    is_open = "end" in metadata or {"time", "until"} <= metadata.keys()
    for key, (is_right, what) in known.items():
        if key not in metadata:
            if key == "coordinates" or (key == "steps" and not is_open):
                raise InputError(f"{otherwise}: `{key}` is missing from the metadata: {_AGAIN}")
        elif not is_right(metadata[key]):
            raise InputError(f"{place.get(key, otherwise)}: `{key}` is not {what}: {_AGAIN}")


def _check_cells(cells: dict[str, Any], at: str) -> None:
    """Refuses cells that are no numbers; those that are empty are not due."""
    if not cells.get("t"):
        raise InputError(f"{at}: `t` is missing: {_AGAIN}")
    for column, cell in cells.items():
        if cell and not (_WHOLE if column == "n" else _NUMBER).fullmatch(cell):
            raise InputError(f"{at}: {column} is {cell[:40]!r}, not a number: {_AGAIN}")


def _csv(name: str) -> tuple[dict[str, Any], list[dict[str, str]], list[str]]:
    metadata: dict[str, Any] = {}
    place: dict[str, str] = {}
    table: list[tuple[int, list[str]]] = []
    for number, line in enumerate(_lines(name), 1):
        if line.startswith("#"):
            key, _, value = line[1:].strip().partition(": ")
            metadata[key], place[key] = value, f"{name}:{number}"
            continue
        try:
            table.append((number, next(csv.reader([line], strict=True), [])))
        except csv.Error as error:
            raise InputError(f"{name}:{number}: the row is damaged ({error}): {_AGAIN}") from None
    at = f"{name}:{table[0][0] if table else 1}"
    columns = table[0][1] if table else []
    if columns[:2] != ["n", "t"] or not metadata:
        raise InputError(f"{at}: this is no file of `shadowstep run`, which begins with lines of metadata and has columns n, t, …: read a file of `trace` with pandas.read_csv")
    for key in ("coordinates", "momenta", "values"):
        if key in metadata:
            try:
                metadata[key] = json.loads(metadata[key])
            except ValueError:
                raise InputError(f"{place[key]}: `{key}` is not JSON: {_AGAIN}") from None
    _check_metadata(metadata, place, at)
    momenta = _momenta(columns, metadata, at)
    rows = []
    for number, cells in table[1:]:
        if len(cells) != len(columns):
            raise InputError(f"{name}:{number}: the row has {len(cells)} cells, and there are {len(columns)} columns: {_AGAIN}")
        row = dict(zip(columns, cells))
        _check_cells({**row, "n": row["n"] or "?"}, f"{name}:{number}")
        rows.append(row)
    return metadata, rows, momenta


def _momenta(columns: Sequence[str], metadata: dict[str, Any], at: str) -> list[str]:
    """The names of the momenta: of the columns of states, those after the coordinates."""
    coordinates, values = metadata["coordinates"], metadata.get("values", {})
    missing = [value for value in values if value not in columns]
    if missing or len(set(columns)) < len(columns):
        raise InputError(f"{at}: the columns are not those of the metadata: {f'`{missing[0]}` is missing' if missing else 'one is there twice'}: {_AGAIN}")
    state = [column for column in columns if column not in _FIXED and column not in values]
    if not state:
        return [f"p{name}" for name in coordinates]
    # t has its column already, where it is a coordinate
    written = [name for name in coordinates if name not in _FIXED]
    if state[: len(written)] != written or len(state) != len(written) + len(coordinates):
        raise InputError(f"{at}: the columns {', '.join(state)} are not those of the coordinates {', '.join(coordinates)} and their momenta: {_AGAIN}")
    return state[len(written) :]


def _numpy(name: str) -> Trajectory:
    metadata = _metadata(name)
    size = os.path.getsize(name)
    try:
        rows = np.load(name, mmap_mode="r", max_header_size=1 << 24)
        offset: int = rows.offset
    except OSError:
        raise
    except Exception as error:  # noqa: BLE001, whatever the bytes of its head are
        raise InputError(f"{name}: byte 0 of {size}: the file cannot be read as records of NumPy ({error}): if it is incomplete, copy it again, or run its scene again") from None
    dimension = len(metadata["coordinates"])
    fields = rows.dtype.names or ()
    expected = {field: np.dtype("<i8") if field == "n" else np.dtype(("<f8", (dimension,))) if field in ("q", "p") else np.dtype("<f8") for field in fields}
    known = {*_FIXED, "q", "p", *metadata.get("values", {})}
    wrong = [field for field in fields if field not in known or rows.dtype[field] != expected[field]]
    missing = [field for field in ("n", "t", *metadata.get("values", {})) if field not in fields]
    if rows.ndim != 1 or wrong or missing:
        raise InputError(f"{name}: byte 0 of {size}: the records are not those of a run{f': `{(wrong + missing)[0]}`' if wrong + missing else ''}: {_AGAIN}")
    if offset + rows.nbytes != size:
        raise InputError(f"{name}: byte {offset + rows.nbytes} of {size}: {len(rows)} records should end there: {_AGAIN}")

    def field(column: str, *shape: int) -> np.ndarray:
        # one NaN for all rows, which takes no memory
        return rows[column] if column in fields else np.broadcast_to(np.nan, (len(rows), *shape))

    momenta = metadata.get("momenta") or [f"p{coordinate}" for coordinate in metadata["coordinates"]]
    q, p = field("q", len(momenta)), field("p", len(momenta))
    return _trajectory(metadata, momenta, rows["n"], q, p, field, fields.__contains__)


def _metadata(name: str) -> dict[str, Any]:
    path = f"{name}.metadata.json"
    text = _text(path)
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(f"{path}:{error.lineno}: this is not JSON ({error.msg}): {_AGAIN}") from None
    metadata = content.get("metadata") if isinstance(content, dict) else None
    if not isinstance(metadata, dict):
        raise InputError(f"{path}:1: these are no metadata of a run: {_AGAIN}")
    _check_metadata(metadata, {}, f"{path}:{_line_of(text, 'metadata')}")
    return metadata


def _line_of(text: str, key: str) -> int:
    return text[: max(text.find(f'"{key}"'), 0)].count("\n") + 1


def _json_lines(name: str) -> tuple[dict[str, Any], list[dict[str, str]], list[str]]:
    metadata = _metadata(name)
    coordinates = metadata["coordinates"]
    momenta = metadata.get("momenta") or [f"p{coordinate}" for coordinate in coordinates]
    known = {*_FIXED, "q", "p", *metadata.get("values", {})}
    rows = []
    for number, line in enumerate(_lines(name), 1):
        at = f"{name}:{number}"
        try:
            row = json.loads(line)
        except ValueError:
            raise InputError(f"{at}: this line is not JSON: {_AGAIN}") from None
        if not isinstance(row, dict) or row.keys() - known or not isinstance(row.get("n"), int):
            others = sorted(row.keys() - known) if isinstance(row, dict) else []
            raise InputError(f"{at}: this is no row of the run{f': it has `{others[0]}`' if others else ''}: {_AGAIN}")
        state = {}
        for half, names in (("q", coordinates), ("p", momenta)):
            numbers = row.pop(half, None)
            if numbers is not None and not (isinstance(numbers, list) and len(numbers) == len(names)):
                raise InputError(f"{at}: `{half}` has not a number for each of {', '.join(names)}: {_AGAIN}")
            state.update({name: str(value) for name, value in zip(names, numbers or [])})
        cells = {key: str(value) for key, value in row.items() if value is not None}
        _check_cells({**state, **cells}, at)
        rows.append({**state, **cells})
    return metadata, rows, momenta
