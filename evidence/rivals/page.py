"""Writes docs/speed-against-error.md from the results. Every number and every verdict on it is computed here."""

import json
from math import inf

from compare import all_results, listed, same_schemes, verdicts
from contestants import HERE, RIVALS, SCHEMES
from picture import draw
from readme import write_readme

PAGE = HERE.parents[1] / "docs" / "speed-against-error.md"
MACHINE = HERE / "results" / "machine.json"
ERRORS = {"position_error": "error of the position", "energy_error": "error of H"}

INTRODUCTION = """<!-- Written by `make rivals`; do not edit. -->

# Speed against error: other programs

The same problems, solved by Shadowstep and by what one would use instead, in one run on one machine, with pinned versions. All
contestants start from the same bits; their errors are measured by the same code. The contestants take turns in an order that changes
from round to round. The times are medians of {rounds}, in seconds of the processor, so that other programs on the machine count
little. They are those of the bare integration: programs are started, imported and compiled before; heyoka compiles for up to
{jit} for a problem and a tolerance. Where two times differ by less than 10 %, neither is called faster.

- The *error of the position* is the distance of all coordinates at the end from the exact ones.
- The *error of H* is max |H − H(0)| as a part of |H(0)|, at 100 equally spaced times (argon: 10).
- *Time at equal error* is interpolated between the runs of a sweep over steps or tolerances. Each rival has the best of its methods,
  which is named. An error counts as reached only if the next two finer runs have no larger one; "–" means that no run reaches it.

A sweep ends with the first run of more than {longest} s, so that slow contestants do not reach small errors. Every number and verdict is
computed from the [results](../evidence/rivals/results) by the program that writes this page; [*Measuring other programs again*](speed.md#measuring-other-programs-again) has the programs.

{machine}
"""


def milliseconds(seconds):
    return f"{1000 * seconds:.3g}"


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def time_table(results, error):
    """Milliseconds at each second decade, with the method; the fastest one of single trajectories is bold."""
    first, last = results.problem.decades
    decades = range(first, last + 1, 2)
    best = {}
    for decade in decades:
        best[decade] = min(results.time_at(rival, error, 10.0**-decade)[0] for rival in results.rivals if not rival.many)
    rows = []
    for rival in results.rivals:
        cells = [rival.name]
        for decade in decades:
            seconds, method = results.time_at(rival, error, 10.0**-decade)
            text = milliseconds(seconds) if seconds < inf else "–"
            text = f"**{text}**" if seconds == best[decade] < inf else text
            cells.append(text if seconds == inf else f"{text} {method}")
        rows.append(cells)
    return table([f"ms at {ERRORS[error]}", *(f"1e-{decade}" for decade in decades)], rows)


def speed_table(results):
    schemes = [method.scheme for method in SCHEMES]
    rows = []
    for scheme in schemes:
        speeds = [results.steps_per_second(rival, scheme) for rival in results.rivals]
        if sum(speed is not None for speed in speeds) > 1:
            rows.append([scheme, *(f"{speed:.3g}" if speed else "–" for speed in speeds)])
    used = [i for i in range(len(results.rivals)) if any(row[i + 1] != "–" for row in rows)]
    header = ["steps a second", *(results.rivals[i].name for i in used)]
    return table(header, [[row[0], *(row[i + 1] for i in used)] for row in rows])


def who_wins(results, error):
    sentences, reasons = verdicts(results, error)
    lines = [f"- {sentence}" for sentence in sentences]
    return "\n".join(lines), reasons


def section(results):
    problem = results.problem
    errors = [error for error in ERRORS if error == "energy_error" and problem.energy
              or error == "position_error" and problem.reference_steps is not None]
    parts = [f"## {problem.title}", problem.description]
    if results.uncertainty:
        own = results.uncertainty / (2**10 - 1)
        parts[-1] += f" The reference solution is of order 10 at 40 digits; from the one with twice the step its error is about {own:.0e}."
    parts.append(f"![Error against time](pictures/{draw(results, errors[0], ERRORS[errors[0]])})")
    why = {}
    for error in errors:
        text, reasons = who_wins(results, error)
        parts += [time_table(results, error), f"Who is the fastest, by the {ERRORS[error]}:\n\n{text}"]
        for name, texts in reasons.items():
            why.setdefault(name, {}).update(dict.fromkeys(texts))
    lines = [f"- {name}: {'. '.join(texts)}." for name, texts in why.items() if texts]
    parts.append("Why:\n\n" + "\n".join(lines))
    parts += ["The same scheme, in steps a second of the longest run:", speed_table(results), same_schemes(results)]
    return "\n\n".join(parts)


def contestants():
    rows = [[rival.name, rival.how, listed([f"`{method.name}`" for method in rival.methods])] for rival in RIVALS]
    return "## The contestants\n\n" + table(["contestant", "how", "methods"], rows)


def page(every, machine):
    introduction = INTRODUCTION.format(**machine)
    sections = [section(results) for results in every]
    missing = "## Not measured\n\n" + (HERE / "missing.md").read_text()
    return "\n\n".join([introduction.strip(), *sections, contestants(), missing.strip()]) + "\n"


if __name__ == "__main__":
    write_readme()
    PAGE.write_text(page(all_results(), json.loads(MACHINE.read_text())))
    print(f"written: {PAGE}")
