"""Draws the figures, where matplotlib is."""
from experiments import ALGORITHMS, STAGES

STAGE_NAMES = {"push": "push", "queue": "in the queue", "preparation": "preparation", "kernel_and_transfer": "kernel and transfer",
               "integration": "integration"}


def draw(machine, out):
    try:
        import matplotlib
    except ImportError:
        print("no pictures: there is no matplotlib (scripts/dependencies.sh plots)")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    matplotlib.rcParams["savefig.dpi"] = 130
    drawn = {"algorithms": algorithms, "consumers": consumers, "waiting": waiting, "segment_threads": segment_threads,
             "block_threads": studied, "blocks": studied, "ttk": ttk}
    for name, rows in machine.rows.items():
        if rows and name in drawn:
            drawn[name](plt, rows, out / f"{name}.png")
    if machine.rows.get("waiting"):
        waiting_of_each(plt, machine.rows["waiting"], out / "waiting_of_each.png")


def finish(plt, figure, file):
    figure.savefig(file)
    plt.close(figure)


def unique(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def bars(plt, rows, file, series, label):
    """By algorithm: a group of bars for each mesh, one for each series, with how far runs differ; memory below."""
    titles = unique(rows, "algorithm")
    figure, axes = plt.subplots(2, len(titles), figsize=(4.4 * len(titles), 6), squeeze=False, layout="constrained")
    for column, title in enumerate(titles):
        here = [row for row in rows if row["algorithm"] == title]
        meshes, kinds = unique(here, "mesh"), unique(here, series)
        for k, kind in enumerate(kinds):
            mine = [row for row in here if row[series] == kind]
            places = [meshes.index(row["mesh"]) + 0.8 * (k + 0.5) / len(kinds) - 0.4 for row in mine]
            for axis, (values, scale) in zip(axes[:, column], ((label["time"], 1), (label["memory"], label["scale"]))):
                medians = [values(row)["median"] * scale for row in mine]
                off = [[abs(values(row)[end] - values(row)["median"]) * scale for row in mine] for end in ("least", "most")]
                axis.bar(places, medians, 0.8 / len(kinds), yerr=off, label=kind, error_kw={"linewidth": 0.7})
        axes[0, column].set(title=title, ylabel="seconds in all")
        axes[1, column].set(ylabel="peak, MB")
        for axis in axes[:, column]:
            axis.set_xticks(range(len(meshes)), meshes, fontsize=7)
    axes[0, 0].legend(fontsize=7)
    finish(plt, figure, file)


def algorithms(plt, rows, file):
    bars(plt, rows, file, "way", {"time": lambda row: row["seconds"]["total"], "memory": lambda row: row["peak_bytes"], "scale": 1e-6})


def ttk(plt, rows, file):
    bars(plt, rows, file, "triangulation", {"time": lambda row: row["total"], "memory": lambda row: row["peak"], "scale": 1})


def consumers(plt, rows, file):
    titles = unique(rows, "algorithm")
    figure, axes = plt.subplots(1, len(titles), figsize=(4.6 * len(titles), 3.4), squeeze=False, layout="constrained")
    for axis, title in zip(axes[0], titles):
        here = [row for row in rows if row["algorithm"] == title]
        for way in unique(here, "way"):
            mine = [row for row in here if row["way"] == way]
            axis.plot([row["consumers"] for row in mine], [row["seconds"]["total"]["median"] for row in mine], "o-", label=way)
        axis.set(title=title, xlabel="consumers", ylabel="seconds in all", ylim=(0, None))
    axes[0, 0].legend(fontsize=8)
    finish(plt, figure, file)


def stacked(axis, stages_of_places, places):
    below = [0] * len(places)
    for stage in STAGES:
        heights = [stages[stage] for stages in stages_of_places]
        axis.bar(range(len(places)), heights, 0.8, bottom=below, label=STAGE_NAMES[stage])
        below = [a + b for a, b in zip(below, heights)]
    axis.set_xticks(range(len(places)), places, fontsize=7)


def waiting(plt, rows, file):
    titles = [title for title in ALGORITHMS if any(row["algorithm"] == title for row in rows)]
    figure, axes = plt.subplots(1, len(titles), figsize=(4 * len(titles), 3.2), squeeze=False, layout="constrained")
    for axis, title in zip(axes[0], titles):
        mine = [row for row in rows if row["algorithm"] == title]
        stacked(axis, [{stage: row["stages"][stage]["median"] for stage in STAGES} for row in mine], [row["consumers"] for row in mine])
        axis.set(title=title, xlabel="consumers", ylabel="longest waiting, s")
    axes[0, 0].legend(fontsize=7)
    finish(plt, figure, file)


def waiting_of_each(plt, rows, file):
    titles, counts = unique(rows, "algorithm"), unique(rows, "consumers")
    figure, axes = plt.subplots(len(titles), len(counts), figsize=(2.6 * len(counts), 2.4 * len(titles)), squeeze=False, layout="constrained")
    for row in rows:
        axis = axes[titles.index(row["algorithm"]), counts.index(row["consumers"])]
        stacked(axis, row["of_each"], [str(i) if i % 8 == 0 else "" for i in range(len(row["of_each"]))])
        axis.set_title(f"{row['algorithm']}, {row['consumers']}", fontsize=8)
    axes[0, 0].legend(fontsize=6)
    finish(plt, figure, file)


def segment_threads(plt, rows, file):
    figure, axis = plt.subplots(figsize=(5, 3.4), layout="constrained")
    for relation in unique(rows, "relation"):
        mine = [row for row in rows if row["relation"] == relation]
        axis.plot([row["threads"] for row in mine], [row["milliseconds"] for row in mine], "o-", label=relation)
    axis.set(xscale="log", yscale="log", xlabel="threads for a segment", ylabel="ms")
    axis.legend(fontsize=7, ncol=2)
    finish(plt, figure, file)


def studied(plt, rows, file):
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.2), layout="constrained")
    for mesh in unique(rows, "mesh"):
        mine = [row for row in rows if row["mesh"] == mesh]
        places = [str(row["value"]) for row in mine]
        axes[0].plot(places, [row["seconds"]["median"] for row in mine], "o-", label=mesh)
        axes[1].plot(places, [row["peak_bytes"]["median"] / 1e6 for row in mine], "o-", label=mesh)
    axes[0].set(xlabel=file.stem.replace("_", " "), ylabel="seconds", ylim=(0, None))
    axes[1].set(xlabel=file.stem.replace("_", " "), ylabel="peak, MB", ylim=(0, None))
    axes[0].legend(fontsize=7)
    finish(plt, figure, file)
