"""Do the pictures show what the pages say? Draws those that take nothing but Python again, and looks for the table's times
in performance.svg. usage: check.py, beside the pictures"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

here = Path(__file__).parent
wrong = []
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, here / "draw_segments.py", folder], check=True)
    wrong += [f"{drawn.name} isn't what draw_segments.py draws" for drawn in Path(folder).iterdir() if drawn.read_text() != (here / drawn.name).read_text()]

page, picture = (here.parent / "performance.md").read_text(), (here / "performance.svg").read_text()
for row in re.findall(r"^\| [^|]+, `grid:\d+` \|(.*)\|[^|]*\|$", page, re.MULTILINE):
    times = [time.strip() for time in row.split("|")[:4]]
    wrong += [f"performance.svg lacks {time} s: run draw_performance.py" for time in times if time != "-" and f">{float(time):g} s<" not in picture]
sys.exit("\n".join(wrong) if wrong else 0)
