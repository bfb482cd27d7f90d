#!/bin/bash
# The tables of the documentation say what the command says, and its examples are scenes.
set -euo pipefail
tools/describe_docs --check
for number in $(seq "$(grep -c '^```json$' docs/reference/scene-format.md)"); do
    awk -v wanted="$number" '/^```json$/ { block++; inside = 1; next } /^```/ { inside = 0 } inside && block == wanted' \
        docs/reference/scene-format.md | "$SINEW" check -
done
