#!/bin/bash
# docs/catalogue.md says what the scenes say.
set -euo pipefail
if "$SINEW" list --markdown | diff docs/catalogue.md - | head -20; then exit 0; fi
echo "docs/catalogue.md is out of date: build/bin/sinew list --markdown > docs/catalogue.md" >&2
exit 1
