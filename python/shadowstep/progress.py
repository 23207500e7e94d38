"""A progress bar on long work, if tqdm is installed and the output is a terminal or a notebook."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from time import monotonic
from typing import Any

# a bar is shown only for what takes longer
SHORT = 1.0


@contextmanager
def bar(total: int | None, unit: str, wanted: bool | None) -> Iterator[Callable[[int], None] | None]:
    """A function that takes how much is done, or None where no bar is wanted.

    ``wanted`` is None for a bar where someone can see it.
    """
    if wanted is False or (wanted is None and not (sys.stderr.isatty() or "ipykernel" in sys.modules)):
        yield None
        return
    try:
        if find_spec("ipywidgets"):  # without it, `tqdm.auto` warns in a notebook
            from tqdm.auto import tqdm
        else:
            from tqdm import tqdm
    except ImportError:
        yield None
        return
    begin = monotonic()
    shown: list[Any] = []

    def reach(done: int) -> None:
        if not shown:
            if monotonic() - begin < SHORT and not wanted:
                return
            shown.append(tqdm(total=total, unit=unit, unit_scale=True, leave=False))
        shown[0].update(done - shown[0].n)

    try:
        yield reach
    finally:
        for meter in shown:
            meter.close()
