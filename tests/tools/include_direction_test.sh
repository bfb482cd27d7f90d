#!/bin/bash
# The include check accepts a tree that only points down and names each line that does not.
set -euo pipefail
tool=$PWD/tools/include_direction
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

file() { mkdir -p "$tree/$(dirname "$1")" && printf '%s\n' "${@:2}" > "$tree/$1"; }
fail() { printf 'FAILED: %s\n' "$1" >&2; exit 1; }
passes() { "$tool" "$tree" || fail "$1 should pass"; }
refuses() {
    local said
    if said=$("$tool" "$tree"); then fail "$1 should be refused"; fi
    case "$said" in *"$2"*) ;; *) fail "$1: '$2' is not in: $said" ;; esac
}

passes "an empty tree"
file sinew/math/vec.h '#include <cmath>'
file sinew/world/world.h '#include "sinew/math/vec.h"' '// #include "canvas/raster.h"'
file sinew/sinew.h '#include "sinew/world/world.h"'
file canvas/raster.cpp '#include "sinew/session/picture.h"' '#include <cairo.h>'
file apps/cli/main.cpp '#include "apps/cli/commands.h"' '#include "canvas/raster.h"'
file tests/any_test.cpp '#include "apps/cli/commands.h"'
passes "a tree that points down"

file sinew/math/bad.h '#pragma once' '#include "sinew/world/world.h"'
refuses "maths that includes the solver" 'sinew/math/bad.h:2: error: sinew/math may not include sinew/solver'
rm "$tree/sinew/math/bad.h"
file sinew/session/bad.cpp ' #  include <canvas/raster.h>'
refuses "a session that draws" 'sinew/session/bad.cpp:1: error: sinew/session may not include canvas'
rm "$tree/sinew/session/bad.cpp"
file sinew/solver/bad.h '#include "sinew/sinew.h"'
refuses "a room that includes the whole" 'sinew/solver may not include sinew ("sinew/sinew.h")'
rm "$tree/sinew/solver/bad.h"
file canvas/bad.h '#include "raster.h"'
refuses "a path that is not from the root" 'names no room'
rm "$tree/canvas/bad.h"
file canvas/bad.h '#include "tests/any.h"'
refuses "a room that includes the tests" 'names no room'
rm "$tree/canvas/bad.h"
file player/bad.cpp '#include "apps/cli/commands.h"'
refuses "a room that includes the one around it" 'player may not include apps ("apps/cli/commands.h")'
rm "$tree/player/bad.cpp"
file sinew/attic/old.h 'struct Old {};'
refuses "a folder that is no room" 'not in the list of rooms'
