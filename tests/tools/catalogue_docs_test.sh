#!/bin/bash
# docs/reference/catalogue.md says what the scenes say.
set -euo pipefail
if "$SINEW" list --markdown | diff docs/reference/catalogue.md - | head -20; then exit 0; fi
echo "docs/reference/catalogue.md is out of date: build/bin/sinew list --markdown > docs/reference/catalogue.md" >&2
exit 1
