"""The command `sinew` of the package: studies here, everything else by the command of C++."""

import os
import shutil
import sys
from typing import NoReturn

from .study.command import main as study

_about = """usage: sinew study FILE [OPTION...]

runs the cases of a study file; sinew study --help tells more. The other commands, sinew run, render and play among them, are
those of the command of C++, which is not installed here."""


def _command() -> str | None:
    """Path of the command of C++: the first `sinew` on the path that is not this program."""
    own = os.path.realpath(sys.argv[0])
    for folder in os.get_exec_path():
        found = shutil.which("sinew", path=folder)
        if found and os.path.realpath(found) != own:
            return found
    return None


def main() -> NoReturn:
    if sys.argv[1:2] == ["study"]:
        sys.exit(study(sys.argv[2:]))
    command = _command()
    if command:
        os.execv(command, [command, *sys.argv[1:]])
    print(_about, file=sys.stderr)
    sys.exit(2)


if __name__ == "__main__":
    main()
