#!/usr/bin/env python3
"""Work-precision diagrams as PDF, or PGF for LaTeX, from work-precision.csv beside this script, by Matplotlib.

    python3 plot.py [FORMAT ...]      # pdf png svg, and pgf where xelatex is installed; pdf if none is named
"""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = ["#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#777777", "#B5A500"]
MARKERS = "os^Dxv+.*pPX"
COSTS = {"evaluations": "evaluations of the gradient", "seconds": "time of the steps in seconds"}
ERRORS = {"position_error": "error of the position at the end", "energy_error": "largest error of $H$"}


def curves(path):
    """Of each scheme its rows, in their order."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    schemes = {}
    for row in rows:
        schemes.setdefault(row["scheme"], []).append(row)
    return schemes


def plot(schemes, cost, error):
    figure, axes = plt.subplots(figsize=(6.3, 4.2))
    for n, (name, rows) in enumerate(schemes.items()):
        points = [(float(row[cost]), float(row[error])) for row in rows if row[error] not in ("", "0")]
        dashes = "-" if n < len(COLOURS) else "--"
        style = {"color": COLOURS[n % len(COLOURS)], "marker": MARKERS[n % len(MARKERS)], "linestyle": dashes}
        axes.plot(*zip(*points), label=name, markersize=4, linewidth=1, fillstyle="none", **style)
    axes.set(xscale="log", yscale="log", xlabel=COSTS[cost], ylabel=ERRORS[error])
    axes.grid(True, linewidth=0.3)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure


def main():
    folder = pathlib.Path(__file__).resolve().parent
    schemes = curves(folder / "work-precision.csv")
    for cost in COSTS:
        for error in ERRORS:
            figure = plot(schemes, cost, error)
            for kind in sys.argv[1:] or ["pdf"]:
                name = folder / f"{error.split('_')[0]}-{'forces' if cost == 'evaluations' else 'time'}.{kind}"
                figure.savefig(name, bbox_inches="tight")
                print(name)
            plt.close(figure)


if __name__ == "__main__":
    main()
