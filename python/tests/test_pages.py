"""The pages that a newcomer follows: their Python blocks and commands run, and print what the pages show."""

import io
import re
import shlex
import subprocess
import sys
from contextlib import redirect_stdout
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = ["README.md", "docs/start-here.md", *(f"docs/how-to/{page.name}" for page in sorted((ROOT / "docs/how-to").glob("*.md")))]
# built or run elsewhere; advice takes seconds, and the Python blocks have it
NOT_HERE = ("make ", "cargo ", "git ", "pip ", "shadowstep advise ")
# a run that one has the time to stop
SHORTER = {"docs/how-to/resume.md": ("until = 2e9", "until = 1e7")}


def blocks(page):
    return re.findall(r"^```(\w+)\n(.*?)^```$", (ROOT / page).read_text(), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", [*PAGES, "docs/liquids.md"])
def test_python_blocks_run_one_after_the_other(page):
    names, printed = {}, io.StringIO()
    for kind, text in blocks(page):
        if kind == "python":
            with redirect_stdout(printed):
                exec(compile(text, page, "exec"), names)
    # verdicts that the page shows are printed; times of runs differ
    for kind, text in blocks(page):
        if kind == "text" and text.startswith("bounded - "):
            assert text in printed.getvalue()
        if kind == "text" and text.startswith("yoshida4, step 1/20, 20000 steps"):
            assert text in printed.getvalue()


@pytest.mark.parametrize("page", PAGES)
def test_commands_run(page, tmp_path):
    shown = blocks(page)
    for kind, text in shown:
        if kind == "toml" and "[run]" in text and "[axes]" not in text:
            if page in SHORTER:
                long, short = SHORTER[page]
                assert long in text
                text = text.replace(long, short)
            (tmp_path / re.search(r'^file = "(\w+)\.csv"', text, re.MULTILINE)[1]).with_suffix(".toml").write_text(text)
    for command in [line for kind, text in shown if kind == "sh" for line in text.splitlines() if not line.startswith(NOT_HERE)]:
        words = shlex.split(command, comments=True)
        assert words[0] == "shadowstep", command
        run = subprocess.run([sys.executable, "-m", *words], cwd=tmp_path, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
