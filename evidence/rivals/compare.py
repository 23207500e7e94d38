"""What follows from the results: time at equal error, steps per second at the same scheme, and who is the fastest."""

import csv
from itertools import groupby
from math import exp, inf, log

from contestants import HERE, RIVALS
from problems import PROBLEMS

RESULTS = HERE / "results"
OURS = RIVALS[0].name


def is_ours(name):
    """Shadowstep, also with other parts or in another time."""
    return name.split(",")[0] == OURS


# Times whose ratio is less are not told apart.
TIE = 1.1


class Results:
    """The results of one problem."""

    def __init__(self, problem):
        self.problem = problem
        lines = (RESULTS / f"{problem.key}.csv").read_text().splitlines()
        self.uncertainty = float(lines.pop(0).rsplit(" ", 1)[1]) if lines[0].startswith("#") else None
        self.rows = list(csv.DictReader(lines))

    @property
    def rivals(self):
        """Those that took part, in the order of the contestants."""
        names = {row["rival"] for row in self.rows}
        return [rival for rival in RIVALS if rival.name in names]

    def curve(self, rival, method, error):
        """(seconds, error) from coarse to fine."""
        chosen = [row for row in self.rows if row["rival"] == rival.name and row["method"] == method]
        return confirmed([(float(row["seconds"]), float(row[error])) for row in chosen if float(row[error]) > 0])

    def time_at(self, rival, error, target):
        """The least time at which a rival's methods meet the error, and the method; infinite if none does."""
        candidates = [(time_on(self.curve(rival, method.name, error), target), method.name) for method in rival.methods]
        return min(candidates)

    def steps_per_second(self, rival, scheme):
        """Of the longest runs of the rival's methods that are the scheme, the fastest; none if it does not have the scheme."""
        speeds = []
        for method in rival.methods:
            rows = [row for row in self.rows if row["rival"] == rival.name and row["method"] == method.name]
            if method.scheme == scheme and rows:
                speeds.append(float(rows[-1]["parameter"]) / float(rows[-1]["seconds"]))
        return max(speeds, default=None)


def same_schemes(results):
    """Sentences: how many steps a second Shadowstep makes beside each rival that has some of its schemes."""
    ours, *others = results.rivals
    sentences = []
    for rival in others:
        ratios = []
        for scheme in {method.scheme: None for method in ours.methods if method.scheme}:
            speed = results.steps_per_second(rival, scheme)
            if speed:
                ratios.append(results.steps_per_second(ours, scheme) / speed)
        if ratios:
            sentences.append(f"{rival.name}: {between(ratios)}")
    return f"{OURS} makes this many times the steps a second of the same scheme as " + "; ".join(sentences) + "."


def confirmed(curve):
    """Each run with the largest error of it and the next two finer ones, without the last run, which no finer one confirms:
    an error that is small by accident, as among round-off, does not count."""
    return [(seconds, max(error for _, error in curve[i : i + 3])) for i, (seconds, _) in enumerate(curve[:-1])]


def time_on(curve, target):
    """Interpolated between a larger and a smaller error, in logarithms; or of a run whose error is smaller."""
    times = [seconds for seconds, error in curve if error <= target]
    for (t0, e0), (t1, e1) in zip(curve, curve[1:]):
        if e0 > target >= e1:
            part = log(e0 / target) / log(e0 / e1)
            times.append(exp(log(t0) + part * log(t1 / t0)))
    return min(times, default=inf)


def winners(times):
    """The fastest of rival → (seconds, method), and those that are as fast."""
    least = min(seconds for seconds, _ in times.values())
    return tuple(name for name, (seconds, _) in times.items() if seconds <= TIE * least and seconds < inf)


def verdicts(results, error):
    """Sentences: who is the fastest from which error to which, and how much more time Shadowstep needs or another one."""
    single = [rival for rival in results.rivals if not rival.many]
    first, last = results.problem.decades
    rows = []
    for decade in range(first, last + 1):
        times = {rival.name: results.time_at(rival, error, 10.0**-decade) for rival in single}
        rows.append((decade, times, winners(times)))
    sentences, reasons = [], []
    for names, group in groupby(rows, key=lambda row: row[2]):
        group = list(group)
        span = f"At 1e-{group[0][0]}" if len(group) == 1 else f"From 1e-{group[0][0]} to 1e-{group[-1][0]}"
        if not names:
            sentences.append(f"{span}: no contestant reaches it.")
            continue
        sentences.append(f"{span}: {listed(names)} {'is' if len(names) == 1 else 'are'} the fastest{lag(group, names)}.")
        reasons += [(name, times[name][1]) for _, times, _ in group for name in names]
    return sentences, reasons_of(single, reasons)


def reasons_of(rivals, fastest):
    """Rival → why, each reason once, for the fastest (rival, method)."""
    found = {}
    for rival in rivals:
        methods = [method for method in rival.methods if (rival.name, method.name) in fastest]
        found[rival.name] = list(dict.fromkeys(method.why or rival.why for method in methods))
    return found


def lag(group, names):
    """How far behind Shadowstep is, or how far behind the next one is if Shadowstep is among the fastest."""
    if not any(map(is_ours, names)):
        of_ours = [min(seconds for name, (seconds, _) in times.items() if is_ours(name)) for _, times, _ in group]
        ratios = [seconds / min(times[name][0] for name in names) for seconds, (_, times, _) in zip(of_ours, group)]
        if min(ratios) == inf:
            return f"; {OURS} does not reach it"
        reached = [ratio for ratio in ratios if ratio < inf]
        part = "" if len(reached) == len(ratios) else " where it reaches that error"
        return f"; {OURS} needs {between(reached)} times the time{part}"
    ratios = []
    for _, times, _ in group:
        best = min(times[name][0] for name in names)
        ratios.append(min((seconds / best for name, (seconds, _) in times.items() if name not in names), default=inf))
    reached = [ratio for ratio in ratios if ratio < inf]
    return f"; the next one needs {between(reached)} times the time" if reached else "; no other reaches it"


def between(ratios):
    low, high = f"{min(ratios):.2g}", f"{max(ratios):.2g}"
    return low if low == high else f"{low} to {high}"


def listed(names):
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]


def all_results():
    return [Results(problem) for problem in PROBLEMS if (RESULTS / f"{problem.key}.csv").exists()]
