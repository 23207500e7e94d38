"""A picture of a problem: error against time, for each rival what its best method reaches."""

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

from contestants import HERE, RIVALS

matplotlib.rcParams |= {"svg.hashsalt": "shadowstep", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 11}

# the colours of Okabe and Ito, which the colour blind can tell apart, and a marker for each rival; Shadowstep's other ways have its colour and hollow markers
COLOURS = ["#D55E00", "#D55E00", "#D55E00", "#D55E00", "#000000", "#0072B2", "#009E73", "#56B4E9", "#CC79A7", "#E69F00", "#7F7F7F", "#8B4513", "#5D3A9B", "#0072B2", "#009E73"]
MARKERS = "ovDosD^v<>PX*hd"
DARK = "@media screen and (prefers-color-scheme: dark) { svg { filter: invert(0.93) hue-rotate(180deg); } }"
HOLLOW = ("Shadowstep, planets", "Shadowstep, logarithmic time", "Shadowstep, lanes")


def front(results, rival, error):
    """The runs that are more exact than every faster one, of all methods of the rival."""
    points = sorted(point for method in rival.methods for point in results.curve(rival, method.name, error))
    best = []
    for seconds, size in points:
        if size < 1 and (not best or size < best[-1][1]):
            best.append((seconds, size))
    return best


def label_of(value, _):
    """1e-3, 2e-3 and 5e-3 as in the tables, with the minus of ASCII."""
    digit, exponent = f"{value:.0e}".split("e")
    return f"{digit}e{int(exponent)}" if digit in "125" else ""


def save(figure, path):
    """Writes a picture on white, which on dark screens has light and dark exchanged and keeps its hues."""
    figure.savefig(path, metadata={"Date": None}, bbox_inches="tight", facecolor="white")
    before, metadata, after = path.read_text().partition(" <metadata>")
    path.write_text(f"{before} <style>{DARK}</style>\n{metadata}{after}")


def draw(results, error, label):
    figure, axes = plt.subplots(figsize=(8, 5))
    for rival in results.rivals:
        place = RIVALS.index(rival)
        points = front(results, rival, error)
        if points:
            axes.loglog(*zip(*points), marker=MARKERS[place], color=COLOURS[place], markersize=5,
                        markerfacecolor="white" if rival.name in HOLLOW else COLOURS[place], linewidth=1.3,
                        linestyle="--" if rival.many else "-", label=rival.name)
    axes.set_xlabel("seconds")
    axes.set_ylabel(label)
    for axis in (axes.xaxis, axes.yaxis):
        least, most = axis.get_view_interval()
        axis.set_major_formatter(label_of)
        axis.set_minor_formatter(label_of if most < 100 * least else "")
    axes.grid(True, color="#DDDDDD", linewidth=0.6)
    axes.set_title(results.problem.title)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False)
    path = HERE.parents[1] / "docs" / "pictures" / f"rivals-{results.problem.key}.svg"
    save(figure, path)
    plt.close(figure)
    return path.name
