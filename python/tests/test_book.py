"""The page of the Python package names all of it."""

from pathlib import Path

import shadowstep

PAGE = Path(__file__).resolve().parents[2] / "docs" / "book" / "python-api.md"


def test_the_book_has_every_public_name():
    page = PAGE.read_text(encoding="utf-8")
    missing = [name for name in shadowstep.__all__ if name != "__version__" and f":: {name}" not in page]
    assert not missing
