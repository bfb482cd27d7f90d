#!/bin/bash
# The picture of the rooms is that of the #include lines, and another tree has another picture.
set -euo pipefail
command -v python3 >/dev/null || { echo "python3 is not installed: skipped"; exit 77; }
tools/draw_rooms --check

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{tools,docs/concepts,ground,house/upper,house/attic}
cp tools/draw_rooms tools/include_direction "$tree/tools"
printf '%s\n' 'ground  one & all' 'house' 'house/upper' 'house/attic' 'nowhere' >"$tree/tools/rooms"
echo '#include "ground/floor.h"' >"$tree/house/wall.h"
printf '#include "house/wall.h"\n#include "ground/floor.h"\n' >"$tree/house/upper/bed.h"
echo '#include "house/wall.h"' >"$tree/house/attic/trunk.h"
touch "$tree/ground/floor.h"

fail() { printf 'FAILED: %s\n' "$1" >&2; exit 1; }
if "$tree/tools/draw_rooms" --check 2>/dev/null; then fail "a picture that is not there is current"; fi
"$tree/tools/draw_rooms"
"$tree/tools/draw_rooms" --check || fail "a picture just drawn is out of date"
picture=$tree/docs/concepts/rooms.svg
[ "$(grep -c '^<path' "$picture")" = 3 ] || fail "three lines are left when implied ones are not drawn"
[ "$(grep -c 'rx="7"' "$picture")" = 4 ] || fail "a room whose folder does not exist is drawn"
grep -q 'one &amp; all' "$picture" || fail "a description is not drawn"
echo '#include "house/upper/bed.h"' >"$tree/house/attic/trunk.h"
if "$tree/tools/draw_rooms" --check 2>/dev/null; then fail "a new include leaves the picture current"; fi
