"""The program ``shadowstep``: ``python -m shadowstep --help``."""

import shutil
import signal
import sys

from ._shadowstep import command


def main() -> None:
    """Runs the program with the arguments of this process, and ends it with the exit code."""
    # the program has its own handler, which saves what is complete
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # job scripts call what pip has installed
    sys.exit(command(["shadowstep", *sys.argv[1:]], shutil.which("shadowstep")))


if __name__ == "__main__":
    main()
