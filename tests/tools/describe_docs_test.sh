#!/bin/bash
# The tables of the documentation say what the command says, and its examples are scenes.
set -euo pipefail
tools/describe_docs --check
sed -n '/^```json$/,/^```$/ { /^```/d; p }' docs/scene-format.md | "$SINEW" check -
