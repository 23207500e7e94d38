#!/usr/bin/env python3
"""Work-precision diagrams as PDF, or PGF for LaTeX, from work-precision.csv beside this script, by Matplotlib.

    python3 plot.py [FORMAT ...]      # pdf png svg, and pgf where xelatex is installed; pdf if none is named
"""

import csv
import pathlib
import sys
from math import inf, log, nan

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = ["#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#777777", "#B5A500"]
MARKERS = "os^Dxv+.*pPX"
COSTS = {"evaluations": "evaluations of the gradient", "seconds": "time of the steps in seconds"}
ERRORS = {"position_error": "error of the position at the end", "energy_error": "largest error of $H$"}


# The number of curves that can be told apart.
MOST_CURVES = 12


def read(path):
    """Of each scheme its rows, in their order; and the largest errors that are drawn: what is larger is lost."""
    lines = path.read_text(encoding="utf-8").splitlines()
    schemes = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        schemes.setdefault(row["scheme"], []).append(row)
    size = next(line.split()[-1].rstrip(".") for line in lines if line.startswith("# The largest coordinate"))
    return schemes, {"position_error": 10 * float(size), "energy_error": 10.0}


def curve(rows, cost, error, largest):
    points = [(float(row[cost]), float(row[error])) for row in rows if row[error] not in ("", "0")]
    return [point for point in points if point[1] <= largest]


def cost_of(points, error):
    """What a scheme pays for an error."""
    return next((cost for cost, found in points if found <= error), inf)


def best(charts):
    """The schemes, in their order, that need the least for errors of 1e-1, 1e-2, ... in the mean of all charts."""
    extra = dict.fromkeys(next(iter(charts.values())), 0.0)
    for curves in charts.values():
        for error in (10.0**-decade for decade in range(1, 300)):
            costs = {name: cost_of(points, error) for name, points in curves.items()}
            lowest = min(costs.values())
            if lowest == inf:
                break
            for name, cost in costs.items():
                extra[name] += log(min(cost / lowest, 100.0))
    chosen = sorted(extra, key=extra.get)[:MOST_CURVES]
    return [name for name in extra if name in chosen]


def plot(curves, names, cost, error):
    """A scheme looks the same in all charts."""
    figure, axes = plt.subplots(figsize=(6.3, 4.2))
    for n, name in enumerate(names):
        dashes = "-" if n < len(COLOURS) else "--"
        style = {"color": COLOURS[n % len(COLOURS)], "marker": MARKERS[n % len(MARKERS)], "linestyle": dashes}
        points = curves[name] or [(nan, nan)]
        axes.plot(*zip(*points), label=name, markersize=4, linewidth=1, fillstyle="none", **style)
    axes.set(xscale="log", yscale="log", xlabel=COSTS[cost], ylabel=ERRORS[error])
    axes.grid(True, linewidth=0.3)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure


def main():
    folder = pathlib.Path(__file__).resolve().parent
    schemes, largest = read(folder / "work-precision.csv")
    each = [(cost, error) for cost in COSTS for error in ERRORS]
    charts = {(cost, error): {name: curve(rows, cost, error, largest[error]) for name, rows in schemes.items()} for cost, error in each}
    names = best(charts)
    for (cost, error), curves in charts.items():
        figure = plot(curves, names, cost, error)
        for kind in sys.argv[1:] or ["pdf"]:
            name = folder / f"{error.split('_')[0]}-{'forces' if cost == 'evaluations' else 'time'}.{kind}"
            figure.savefig(name, bbox_inches="tight")
            print(name)
        plt.close(figure)


if __name__ == "__main__":
    main()
