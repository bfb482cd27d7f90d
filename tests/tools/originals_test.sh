#!/bin/bash
# Classic mode is where the tutorials' own rules are, frame by frame.
set -euo pipefail
command -v python3 > /dev/null || { echo "python3 is not installed: skipped"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
python3 tests/originals/compare.py --check
python3 tests/originals/compare.py
