"""Writes the first picture and four lines of numbers into the README, between two comments."""

from math import inf

from compare import OURS, Results, is_ours
from contestants import HERE
from problems import PROBLEMS

README = HERE.parents[1] / "README.md"
BEGIN, END = "<!-- rivals: written by `make rivals` -->", "<!-- /rivals -->"

# problem, error, its value, and what the line says of it
LINES = [
    ("kepler", "position_error", 1e-6, "Kepler, e = 0.6, 100 periods, position to 1e-6"),
    ("henon-heiles", "position_error", 1e-6, "Hénon–Heiles to t = 10⁴, position to 1e-6"),
    ("outer-200000", "position_error", 1e-6, "outer planets, 200 000 days, position to 1e-6"),
    ("fput", "position_error", 1e-6, "chain of 32 bodies to t = 1000, position to 1e-6"),
]
# Like is compared with like: schemes on T(p) + U(q) in plain time have a column of their own.
COLUMNS = {OURS: f"{OURS}, T + U", "other": f"{OURS}, other parts or time", **{name: name for name in ("C by hand", "REBOUND", "heyoka", "odeint", "SUNDIALS", "scipy")}}


def cell(results, name, error, target):
    """The least time of a rival, with its method."""
    same = [rival for rival in results.rivals if not rival.many and (rival.name == name or name == "other" and is_ours(rival.name) and rival.name != OURS)]
    if not same:
        return ""
    seconds, method = min(results.time_at(rival, error, target) for rival in same)
    return f"{float(f'{1000 * seconds:.2g}'):g}, {method}" if seconds < inf else "–"


def block():
    problems = {problem.key: problem for problem in PROBLEMS}
    lines = ["| milliseconds | " + " | ".join(COLUMNS.values()) + " |", "| --- " * (len(COLUMNS) + 1) + "|"]
    for key, error, target, text in LINES:
        results = Results(problems[key])
        lines.append(f"| {text} | " + " | ".join(cell(results, name, error, target) for name in COLUMNS) + " |")
    return "\n".join(["![Error against time on Kepler's problem](docs/pictures/rivals-kepler.svg)", "", *lines])


def write_readme():
    before, rest = README.read_text().split(BEGIN)
    after = rest.split(END)[1]
    README.write_text(f"{before}{BEGIN}\n{block()}\n{END}{after}")
