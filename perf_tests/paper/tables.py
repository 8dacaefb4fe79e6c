"""Writes each experiment as CSV, and all of them as one page of Markdown."""
import csv

TITLES = {
    "meshes": "The meshes", "algorithms": "Three algorithms on all meshes: seconds by phase, and memory",
    "consumers": "Scaling with consumers", "waiting": "What consumers wait for: seconds, the longest of any consumer",
    "queues": "A queue for each kernel or each relation", "segment_threads": "Threads for a segment (t_s): kernels alone",
    "block_threads": "Threads for a block (t_b): critical points", "blocks": "Blocks for a request (n_b): critical points",
    "ttk": "TTK's own modules on TTK's explicit triangulation and on GALE", "actopo": "ACTOPO's repository",
}
HIDDEN = {"of_each", "result", "runs"}


def flat(row, prefix=""):
    """A row with its nested numbers in columns of their own."""
    columns = {}
    for key, value in row.items():
        if key in HIDDEN:
            continue
        if isinstance(value, dict):
            columns.update(flat(value, f"{prefix}{key} "))
        else:
            columns[prefix + key] = value
    return columns


def with_spread(row):
    """A row for readers: median (least to most) in one column."""
    columns = {}
    for key, value in row.items():
        if key in HIDDEN:
            continue
        if isinstance(value, dict) and "median" in value and "least" in value:
            unit, scale = ("MB", 1e-6) if key.endswith("bytes") else ("", 1)
            number = lambda x: f"{x * scale:.4g}"
            spread = f" ({number(value['least'])} to {number(value['most'])})" if value["least"] != value["most"] else ""
            columns[key.replace("_bytes", "") + (f" {unit}" if unit else "")] = number(value["median"]) + spread
        elif isinstance(value, dict):
            columns.update({f"{key} {inner}" if key in ("queue_lengths",) else inner: text
                            for inner, text in with_spread(value).items()})
        else:
            columns[key] = f"{value:.4g}" if isinstance(value, float) else str(value)
    return columns


def markdown(rows):
    columns = list(dict.fromkeys(column for row in rows for column in row))
    lines = ["| " + " | ".join(column.replace("_", " ") for column in columns) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(row.get(column, "") for column in columns) + " |" for row in rows]
    return "\n".join(lines)


def write(machine, out):
    page = [f"# The paper's experiments, size {machine.size}\n",
            ", ".join(f"{key}: {value}" for key, value in machine.about.items()) +
            f"; {machine.cores} cores, {machine.threads} consumers unless said. Medians of runs (least to most).\n"]
    for name, rows in machine.rows.items():
        if not rows:
            continue
        flat_rows = [flat(row) for row in rows]
        columns = list(dict.fromkeys(column for row in flat_rows for column in row))
        with open(out / f"{name}.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, columns)
            writer.writeheader()
            writer.writerows(flat_rows)
        page += [f"## {TITLES[name]}\n", markdown([with_spread(row) for row in rows]) + "\n"]
    if machine.took:
        took = [{"experiment": name, **{key: f"{value:.0f}" for key, value in one.items()}} for name, one in machine.took.items()]
        total = {key: f"{sum(one[key] for one in machine.took.values()):.0f}" for key in ("seconds", "processor_seconds")}
        page += ["## What the experiments took\n", markdown(took + [{"experiment": "all", **total}]) + "\n"]
    if machine.missing:
        page += ["## Not run\n", markdown(machine.missing) + "\n"]
    (out / "results.md").write_text("\n".join(page))
