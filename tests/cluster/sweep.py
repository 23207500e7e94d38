"""A sweep in a folder, run by the program `shadowstep` of this tree, and how its results are compared."""

import os
import subprocess
from pathlib import Path

from processes import Failed, descendants, words

BUILT = Path(os.environ.get("CARGO_TARGET_DIR", Path(__file__).parents[2] / "target"))
PROGRAM = Path(os.environ.get("SHADOWSTEP", BUILT / "debug/shadowstep")).absolute()
CHUNKS = 16


def say(text):
    print(f"   {text}", flush=True)


class Sweep:
    """A folder with `map.toml`, in which commands are run; its results are in `map`."""

    def __init__(self, folder, text, environment=None):
        self.folder, self.results = Path(folder), Path(folder) / "map"
        self.folder.mkdir()
        (self.folder / "map.toml").write_text(text)
        self.environment = dict(environment or os.environ)
        self.environment["PATH"] = f"{PROGRAM.parent}:{self.environment['PATH']}"

    def start(self, line):
        """Starts a line of the shell."""
        return subprocess.Popen(
            line, shell=True, cwd=self.folder, env=self.environment, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, start_new_session=True)

    def run(self, line, status=0):
        """The output of a line of the shell, which must end with an exit status."""
        process = self.start(line)
        output, errors = process.communicate()
        if process.returncode != status:
            raise Failed(f"`{line}`: exit status {process.returncode}, not {status}\n{output}{errors}")
        return output

    def chunks(self):
        """The chunks that are complete."""
        return {int(path.name[:5]) for path in (self.results / "chunks").glob(f"?????-of-{CHUNKS:05}")}

    def chunk(self, number):
        """The file of a chunk."""
        return self.results / f"chunks/{number:05}-of-{CHUNKS:05}"

    def has_begun(self, number):
        """Whether a program is computing a chunk, or was killed while it did."""
        return any((self.results / "chunks").glob(f"{number:05}-of-{CHUNKS:05}.partial-*"))

    def missing(self):
        return set(range(1, CHUNKS + 1)) - self.chunks()

    def programs(self, root=None):
        """The running processes that compute a chunk."""
        return [pid for pid in descendants(root) if any(Path(word).name == PROGRAM.name for word in words(pid)[:2])]

    def table(self):
        return (self.results / "results.csv").read_bytes()

    def compare(self, reference):
        """Results and every chunk must have the bytes of the reference."""
        if self.table() != reference.table():
            raise Failed(f"{self.results}/results.csv differs from {reference.results}/results.csv")
        for number in range(1, CHUNKS + 1):
            own, other = self.chunk(number), reference.chunk(number)
            if own.read_bytes() != other.read_bytes():
                raise Failed(f"{own} differs from {other}")
        say(f"results.csv and all {CHUNKS} chunks have the same bytes as those of one machine")


def list_of(tasks):
    """Numbers as `3,7-9`."""
    text, tasks = [], sorted(tasks)
    while tasks:
        last = next(number for number in range(tasks[0], tasks[-1] + 1) if number + 1 not in tasks)
        text.append(str(tasks[0]) if last == tasks[0] else f"{tasks[0]}-{last}")
        tasks = [number for number in tasks if number > last]
    return ",".join(text)
