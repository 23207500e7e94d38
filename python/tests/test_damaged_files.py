"""Files of runs that are damaged: each is refused with its line or byte, or read where nothing shows the damage."""

import random
import re

import pytest

import shadowstep
from shadowstep import InputError

SCENE = """
problem.name = "kepler"
run = {{ scheme = "yoshida4", step = "1/10", steps = 12, digits = {digits} }}
output = {{ file = "run.{ending}", trajectory = {{ every = 2 }}, energy = true, modified_energy = {{ order = 4, every = 5 }}, values = {{ r = "x^2 + y^2", every = 4 }}, summary = false }}
"""
FORMATS = [("csv", '"double"'), ("csv", "30"), ("jsonl", '"double"'), ("jsonl", "30"), ("npy", '"double"')]


def truncated(content, random):
    return content[: random.randrange(len(content))]


def flipped(content, random):
    place = random.randrange(len(content))
    return content[:place] + bytes([content[place] ^ (1 << random.randrange(8))]) + content[place + 1 :]


def without_a_line(content, random):
    lines = content.split(b"\n")
    del lines[random.randrange(len(lines))]
    return b"\n".join(lines)


def with_a_line_twice(content, random):
    lines = content.split(b"\n")
    lines.insert(random.randrange(len(lines)), random.choice(lines))
    return b"\n".join(lines)


def without_a_piece(content, random):
    place = random.randrange(len(content))
    return content[:place] + content[place + random.randrange(1, 9) :]


def with_other_bytes(content, random):
    place = random.randrange(len(content))
    return content[:place] + random.choice([b"\0", b"\xff\xfe", b'"', b",", b"{", b"\n", b"\r", b"#", b"1_0", b"nan", "é".encode()]) + content[place:]


def encoded_anew(content, random):
    encoding = random.choice(["utf-16", "utf-32", "utf-8-sig", "cp500"])
    return content.decode("latin-1").encode(encoding)


def of_something_else(content, random):
    return random.choice([b"", b"\n", b"a,b\n1,2\n", b"{}\n", b"[]\n", b"null\n", b"\x93NUMPY\x01\x00v\x00{'descr': 3}", b"PK\x03\x04", b"n,t\n", b"# scheme: yoshida4\nn,t\n0,0\n"])


DAMAGES = [truncated, flipped, without_a_line, with_a_line_twice, without_a_piece, with_other_bytes, encoded_anew, of_something_else]


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The files of a run in each format, by their ending and digits."""
    found = {}
    for ending, digits in FORMATS:
        folder = tmp_path_factory.mktemp("runs")
        (folder / "scene.toml").write_text(SCENE.format(ending=ending, digits=digits))
        shadowstep.run(folder / "scene.toml", progress=False)
        found[ending, digits] = {path.name: path.read_bytes() for path in folder.iterdir() if path.name.startswith("run.")}
    return found


@pytest.mark.filterwarnings("ignore:.*ends at n =")
@pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: damage.__name__)
def test_a_damaged_file_is_refused_with_its_place(damage, files, tmp_path):
    draw = random.Random(damage.__name__)
    others, refused = [], 0
    for form, content in files.items():
        for name in content:
            if ".checkpoint" in name:
                continue
            for _ in range(25):
                damaged = damage(content[name], draw)
                for file, kept in content.items():
                    (tmp_path / file).write_bytes(damaged if file == name else kept)
                try:
                    read = shadowstep.open(tmp_path / f"run.{form[0]}")
                    assert read.q.shape[1:] == (2,) and len(read.n) == len(read.t) == len(read.q) == len(read.p) == len(read.energy)
                except InputError as error:
                    refused += 1
                    # where records and metadata differ, either may be the damaged one
                    if not re.search(rf"{re.escape(str(tmp_path))}/run\.[a-z.]*(:\d+: |: byte \d+ of \d+: )", str(error)):
                        others.append(f"{form} {name}: {error}")
                except Exception as error:  # noqa: BLE001
                    others.append(f"{form} {name}: {type(error).__name__}: {error}")
    assert not others, f"{len(others)} others:\n" + "\n".join(others[:40])
    # a flipped bit of a digit, or a line of metadata that is missing, shows nowhere
    assert refused >= (40 if damage in (flipped, without_a_line, with_a_line_twice) else 80)


def test_digits_of_another_kind_are_no_numbers(files, tmp_path):
    """Python takes 1_0 for 10."""
    for name, kept in files["csv", '"double"'].items():
        (tmp_path / name).write_bytes(kept)
    text = (tmp_path / "run.csv").read_text()
    row = next(i for i, line in enumerate(text.splitlines(), 1) if line.startswith("10,"))
    (tmp_path / "run.csv").write_text(text.replace("\n10,", "\n1_0,"))
    with pytest.raises(InputError, match=rf"run\.csv:{row}: n is '1_0', not a number"):
        shadowstep.open(tmp_path / "run.csv")
