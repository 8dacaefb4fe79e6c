"""What a run with a fault must be: right, or ended by one line and without files."""
import os
import re
import time
import unittest

import commands
import faults

# Lines of others that are as good: they end the process before we can say anything, or we say it once more.
OTHERS = r"\nlibgomp: [^\n]+(\ngale: [^\n]+)?\n"

# What Kokkos says by itself before it throws, where it has no memory for a message either.
KOKKOS = r'Kokkos failed to allocate memory for label [^\n]+\n\n?'


def of_all(calls, share, offset):
    """Which calls fail: all with GALE_ALL_FAULTS set, else every so-many-th."""
    return range(1, calls + 1) if os.environ.get("GALE_ALL_FAULTS") else range(1 + offset % share, calls + 1, share)


class FaultTest(unittest.TestCase):
    def check(self, command, right, run, kind):
        """That the run was as `right`, the names and contents of files, or complained."""
        if (run.how, run.code) == ("exit", 0):
            self.assertEqual(run.output, "")
            self.assertEqual(run.names, sorted(right))
            for name in run.names:
                if name != "report.json":  # it has times
                    self.assertEqual(command.content(name), right[name], name)
        else:
            self.assertEqual((run.how, run.code), ("exit", 1), run.output)
            self.assertRegex(run.output, rf"\A({KOKKOS})?(gale: [^\n]+|{OTHERS})\n?\Z")
            self.assertEqual(run.names, sorted(command.files), "files that stayed behind")

    def try_all(self, kind, share, **fault):
        for number, line in enumerate(commands.commands()):
            begun = time.process_time()
            files = {name: content for name, content in commands.INPUTS.items() if name in line}
            with self.subTest(line=" ".join(line)), faults.FaultyCommand(line, files) as command:
                clean = command.run()
                self.assertEqual((clean.how, clean.code, clean.output), ("exit", 0, ""))
                right = {name: command.content(name) for name in clean.names}
                calls = command.run(kind, at=10**9).calls
                self.assertGreater(calls, 0) if kind == "allocation" else None
                for at in of_all(calls, share, 7 * number):
                    with self.subTest(at=at):
                        self.check(command, right, command.run(kind, at, **fault), kind)
            if os.environ.get("GALE_ALL_FAULTS"):
                print(f"{kind} {fault}: {calls} calls of gale {' '.join(line)}", flush=True)
