"""Draws performance.svg from the table of docs/performance.md. usage: draw_performance.py PERFORMANCE.md PICTURE.svg"""
import re
import sys

import matplotlib
import matplotlib.pyplot as plt

page, picture = sys.argv[1:]
matplotlib.rcParams.update({"svg.hashsalt": "gale", "svg.fonttype": "none", "font.family": "sans-serif"})
rows = re.findall(r"^\| ([^|]+), `(grid:\d+)` \| ([\d.]+) \| ([\d.]+) \| ([\d.]+|-) \| ([\d.]+) \|", open(page).read(), re.MULTILINE)
figure, axes = plt.subplots(figsize=(7.5, 4.4), layout="constrained")
kinds = ("GALE, consumers on the device", "GALE, consumers on the cores, workers on the device", "GALE, cores alone", "explicit structures, on the cores")
for kind, (name, color, marker) in enumerate(zip(kinds, ("#1d3f9e", "#3f86d8", "#2f9a57", "#777777"), "osD^")):
    shown = [(place + 0.2 * (kind - 1.5), row[2 + kind]) for place, row in enumerate(rows) if row[2 + kind] != "-"]
    axes.scatter([float(time) for _, time in shown], [height for height, _ in shown], s=45, color=color, marker=marker, label=name, zorder=3)
    for height, time in shown:  # a point, not a bar: an axis of powers has no zero
        axes.annotate(f"{float(time):g} s", (float(time), height), (9, 0), textcoords="offset points", va="center", fontsize=9)
for place in range(len(rows)):
    axes.axhspan(place - 0.45, place + 0.45, color="#f4f4f4", zorder=0)
axes.set(xscale="log", yticks=range(len(rows)), yticklabels=[f"{row[0]},\n{row[1]}" for row in rows], xlim=(0.04, 150))
axes.set_xticks([0.1, 1, 10, 100], ["0.1", "1", "10", "100"])
axes.set_xlabel("seconds, each line ten times the one before: further left is faster")
axes.grid(axis="x", color="#cccccc", zorder=1)
axes.tick_params(axis="y", length=0)
axes.spines[["top", "right", "left"]].set_visible(False)
axes.invert_yaxis()
figure.legend(loc="outside upper center", ncols=2, frameon=False, fontsize=9)
figure.savefig(picture, metadata={"Date": None})
