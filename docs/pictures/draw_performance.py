"""Draws performance.svg from the table of docs/performance.md. usage: draw_performance.py PERFORMANCE.md PICTURE.svg"""
import re
import sys

import matplotlib
import matplotlib.pyplot as plt

page, picture = sys.argv[1:]
matplotlib.rcParams["svg.hashsalt"] = "gale"
rows = re.findall(r"^\| ([^|]+), `grid:\d+` \| ([\d.]+) \| ([\d.]+) \| ([\d.]+|-) \| ([\d.]+) \|", open(page).read(), re.MULTILINE)
figure, axes = plt.subplots(figsize=(7, 3.4), layout="constrained")
kinds = ("GALE, consumers on the device", "GALE, consumers on cores", "GALE, cores alone", "explicit")
for kind, (name, color) in enumerate(zip(kinds, ("#1d3f9e", "#3f6ad8", "#8fb0ec", "#c9c9c9"))):
    times = [(place, float(row[1 + kind])) for place, row in enumerate(rows) if row[1 + kind] != "-"]
    bars = axes.barh([place + 0.21 * (kind - 1.5) for place, _ in times], [time for _, time in times], 0.19, color=color,
                     label=name)
    axes.bar_label(bars, fmt="%g s", padding=3, fontsize=8)
axes.set(xscale="log", yticks=range(len(rows)), yticklabels=[row[0] for row in rows], xlabel="seconds", xlim=(0.03, 150))
axes.invert_yaxis()
axes.legend(fontsize=8, loc="lower right")
figure.savefig(picture, metadata={"Date": None})
