"""`python -m gale`: the command, as this package brings it."""
import os
import sys

from . import Error


def main() -> None:
    """Becomes the command `gale`, with this process's arguments."""
    command = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "gale")
    if not os.path.exists(command):
        raise Error(f"this package was built without the command gale: there is no {command}")
    sys.stdout.flush()
    sys.stderr.flush()
    os.execv(command, ["gale", *sys.argv[1:]])


if __name__ == "__main__":
    main()
