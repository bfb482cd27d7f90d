#!/bin/bash
# docs/reference says what the command says, and the examples of its pages are scenes.
set -euo pipefail
tools/describe_docs --check
page=docs/reference/scene-format.md
for number in $(seq "$(grep -c '^```json$' "$page")"); do
    awk -v wanted="$number" '/^```json$/ { block++; inside = 1; next } /^```/ { inside = 0 } inside && block == wanted' \
        "$page" | "$SINEW" check -
done
