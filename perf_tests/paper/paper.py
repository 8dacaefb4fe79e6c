#!/usr/bin/env python3
"""Makes the tables and figures of the experiments of GALE's paper (IEEE VIS 2025, section 5 and appendices) on this
machine: CSV, Markdown and, where matplotlib is, pictures.

    perf_tests/paper/paper.py --build build --size small --out results

Beside the command it runs what there is of: relation_rates (built with -DGALE_ENABLE_PERF_TESTS=ON), ttk_modules
(perf_tests/ttk) and a driver of ACTOPO's (`actopo_driver MESH explicit|actopo cp|dg CONSUMERS PRODUCERS`). What can't be
run is named in the Markdown with the reason. --only names experiments; --from takes results.json of earlier runs
instead, also from a machine that can't draw.
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import experiments
import pictures
import tables
from runs import Machine
from sizes import SIZES

EXPERIMENTS = {"meshes": experiments.meshes, "algorithms": experiments.algorithms, "consumers": experiments.consumers,
               "waiting": experiments.waiting, "queues": experiments.queues, "segment_threads": experiments.segment_threads,
               "block_threads": experiments.block_threads, "blocks": experiments.blocks, "ttk": experiments.ttk,
               "actopo": experiments.actopo}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, help="a build folder, whose bin/ has the programs that aren't named")
    parser.add_argument("--gale", type=Path, help="the command")
    parser.add_argument("--relation-rates", type=Path, help="GALE's benchmark of that name")
    parser.add_argument("--ttk-modules", type=Path, help="TTK's modules on TTK's and GALE's triangulation")
    parser.add_argument("--actopo", type=Path, help="a driver of ACTOPO's")
    parser.add_argument("--size", choices=SIZES, default="small")
    parser.add_argument("--runs", type=int, help="of each (default: the size's)")
    parser.add_argument("--time-limit", type=float, metavar="SECONDS", help="begin no run after that; what is left is named")
    parser.add_argument("--threads", type=int, help="consumers of the comparison (default: the cores)")
    parser.add_argument("--only", nargs="+", choices=EXPERIMENTS, default=list(EXPERIMENTS), metavar="EXPERIMENT")
    parser.add_argument("--out", type=Path, required=True, help="a folder for what is made")
    parser.add_argument("--from", dest="earlier", type=Path, nargs="+",
                        help="results.json of earlier runs, taken together: nothing is run")
    parser.add_argument("--no-pictures", action="store_true")
    options = parser.parse_args()
    for name in ("gale", "relation_rates", "ttk_modules"):
        program = options.build and options.build / "bin" / name
        if program and getattr(options, name) is None and program.exists():
            setattr(options, name, program)
    if options.earlier is None and options.gale is None:
        parser.error("--gale, --build or --from is needed")

    options.out.mkdir(parents=True, exist_ok=True)
    if options.earlier:
        machine = Machine.load(options.earlier)
    else:
        machine = Machine(options)
        for name in options.only:
            print(f"{name} ...", flush=True)
            machine.do(name, EXPERIMENTS[name])
            print("  {seconds:.0f} s, {processor_seconds:.0f} s of processors".format(**machine.took[name]), flush=True)
            machine.save(options.out / "results.json")
    tables.write(machine, options.out)
    if not options.no_pictures:
        pictures.draw(machine, options.out)


if __name__ == "__main__":
    main()
