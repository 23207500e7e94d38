"""Runs that a file describes."""

from __future__ import annotations

import csv
import io
import json
import os
import warnings
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from . import _shadowstep
from .arguments import check, naming, path_of
from .progress import bar


@dataclass(frozen=True, repr=False)
class Outcome:
    """What the run of a scene gave."""

    columns: dict[str, np.ndarray] | None
    """The columns of its rows by their names: doubles in double precision, else decimal texts; None if the scene names a file."""
    text: str | None
    """The rows as they would be written."""
    summary: dict[str, Any] | None
    """What the run has shown: the verdict, the error of H, close encounters, …; None for an ensemble, and for a file that was complete."""
    summary_text: str | None
    """The same as lines."""
    notes: list[str]
    """What should be known of the run; each was a warning, too."""

    def to_dataframe(self) -> Any:
        """The rows as a table of pandas."""
        import pandas

        return pandas.DataFrame(self.columns)

    def __repr__(self) -> str:
        rows = "a file" if self.columns is None else f"columns {', '.join(self.columns)}"
        return f"Outcome({rows})"


def run(scene: Union[str, os.PathLike[str]], *, restart: bool = False, allow_outside: bool = False, progress: bool | None = None) -> Outcome:
    """Runs a scene: a file, or a text, which has line breaks.

    A scene with a ``file`` in [output] is written there under a temporary name, which it keeps until it is complete; after an interruption the same
    call resumes it from its last checkpoint. Others give their rows. The files that the file of a scene names lie in its own folder or below, unless
    ``allow_outside`` is true; a text can name any.

    Examples
    --------
    >>> import shadowstep
    >>> outcome = shadowstep.run('''
    ... problem.name = "kepler"
    ... run = { scheme = "yoshida4", step = "1/20", steps = 400, digits = "double" }
    ... output = { trajectory = { every = 200 }, energy = { every = 200 } }
    ... ''')
    >>> list(outcome.columns), outcome.columns["t"].tolist()
    (['n', 't', 'energy', 'x', 'y', 'px', 'py'], [0.0, 10.0, 20.0])
    >>> outcome.summary["verdict"]
    'bounded'
    """
    check(run, locals())
    path = path_of(scene, "scene")
    text = path if "\n" in path else None
    with bar(None, "steps", progress) as reach:
        rows, summary, notes = _shadowstep.run_scene("scene.toml" if text else path, text, restart, allow_outside, reach)
    for note in notes:
        warnings.warn(note, stacklevel=2)
    readable, record = summary or (None, None)
    return Outcome(None if rows is None else columns_of(rows), rows, record, readable, notes)


def scene(name: str) -> str:
    """The text of a shipped scene, or of a scene of a shipped problem, with what its keys mean.

    >>> scene("kepler").splitlines()[0]
    "# Kepler's problem in the plane: H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)"
    """
    check(scene, locals())
    with naming("name"):
        return _shadowstep.scene_text(name)


def columns_of(rows: str) -> dict[str, np.ndarray]:
    """The columns of rows as CSV or JSON lines."""
    lines = [line for line in rows.splitlines() if not line.startswith("#")]
    if lines and lines[0].startswith("{"):  # JSON lines
        records = [json.loads(line) for line in lines]
        names = list(dict.fromkeys(name for record in records for name in record))
        return {name: np.array([record.get(name) for record in records]) for name in names}
    head, *table = csv.reader(io.StringIO("\n".join(lines)))
    return {name: _numbers([row[i] for row in table]) for i, name in enumerate(head)}


def _numbers(texts: list[str]) -> np.ndarray:
    # the mark of a text that a spreadsheet would compute
    texts = [text.removeprefix("'") for text in texts]
    # more digits than a double has stay texts
    doubles = all(len(text) <= 24 for text in texts)
    try:
        return np.array([float(text) if text else np.nan for text in texts]) if doubles else np.array(texts, dtype=object)
    except ValueError:
        return np.array(texts, dtype=object)
