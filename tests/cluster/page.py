"""The section of docs/many-runs.md on clusters: its files and commands, which the tests use as they are written there."""

import re
from pathlib import Path

from processes import Failed

PAGE = Path(__file__).parents[2] / "docs/many-runs.md"


class Page:
    """The blocks of code of the section; `command` notes what was used, `unused` is what no test has run."""

    def __init__(self):
        self.blocks = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text().partition("\n## On clusters\n")[2], re.MULTILINE | re.DOTALL)
        lines = "".join(text for kind, text in self.blocks if kind == "sh").replace("\\\n", "").splitlines()
        self.commands = [re.sub(r" +(# .*)?$", "", re.sub(r" {2,}", " ", line)) for line in lines if line.strip()]
        self.used = set()

    def file(self, kind):
        """The text of the only block of its kind."""
        texts = [text for own, text in self.blocks if own == kind]
        if len(texts) != 1:
            raise Failed(f"{PAGE} has {len(texts)} blocks of {kind}, not one")
        return texts[0]

    def command(self, line):
        """A line that must be on the page."""
        if line not in self.commands:
            raise Failed(f"{PAGE} has no command `{line}`")
        self.used.add(line)
        return line

    def unused(self):
        return [line for line in self.commands if line not in self.used]
