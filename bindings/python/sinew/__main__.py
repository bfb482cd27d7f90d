"""python3 -m sinew study FILE"""

import sys

from .study.command import main

if __name__ == "__main__":
    if sys.argv[1:2] != ["study"]:
        print("usage: python3 -m sinew study FILE [OPTION...]; python3 -m sinew study --help", file=sys.stderr)
        sys.exit(2)
    sys.exit(main(sys.argv[2:]))
