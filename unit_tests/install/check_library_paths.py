"""Where programs and libraries load code from: only folders named as a whole, or from $ORIGIN on. An empty entry, as CMake
pads with, stands for the folder that a program is run in, and a relative one is below that.
usage check_library_paths.py READELF --in FOLDER... [--never FOLDER...]: no entry is in one of the latter; what was
installed doesn't name where it was built."""
import argparse
import re
import subprocess
import sys
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("readelf")
parser.add_argument("--in", dest="folders", type=Path, nargs="+", required=True)
parser.add_argument("--never", type=Path, nargs="+", default=[])
options = parser.parse_args()


def is_linked(file):
    """Programs and shared libraries, but no objects."""
    if file.is_symlink() or not file.is_file() or file.suffix == ".o":
        return False
    with file.open("rb") as content:
        return content.read(4) == b"\x7fELF"


def wrong_entries(file):
    shown = subprocess.run([options.readelf, "--dynamic", "--wide", file], capture_output=True, text=True, check=True, env={"LC_ALL": "C"})
    for kind, value in re.findall(r"\((RPATH|RUNPATH|NEEDED)\).*\[(.*)\]", shown.stdout):
        for entry in value.split(":") if kind != "NEEDED" else [value] if "/" in value else []:
            if not re.match(r"/|(\$ORIGIN|\$\{ORIGIN\})(/|$)", entry):
                yield f"{file}: its {kind} [{value}] has the entry '{entry}', which is below the folder it is run in"
            elif any(f"{entry}/".startswith(f"{folder}/") for never in options.never for folder in (never, never.resolve())):
                yield f"{file}: its {kind} [{value}] names {entry}, where it was built"


files = [file for folder in options.folders for file in folder.rglob("*") if is_linked(file)]
if not files:
    sys.exit(f"there are no programs or libraries in {options.folders}")
wrong = dict.fromkeys(line for file in files for line in wrong_entries(file))
print(len(files), "programs and libraries")
sys.exit("\n".join(wrong) or 0)
