#!/bin/bash
# The window's packages, installed after a first build without them: the next build sees them. Where pkg-config looks is
# a folder of this test, so nothing is installed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
skip() { echo "skipped: $1"; exit 77; }
command -v ninja >/dev/null || skip "ninja is not installed"

package() { printf 'Name: %s\nDescription: a stand-in\nVersion: 9\n' "$1" >"$folder/pc/$1.pc"; }
has_window() { ninja -C "$folder/build" -t targets all | grep '^libwindow.a:' >/dev/null; }
fail() { cat "$folder/log"; echo "$1"; exit 1; }

mkdir "$folder/pc"
for needed in cairo libxxhash; do package $needed; done
export PKG_CONFIG_LIBDIR=$folder/pc
unset PKG_CONFIG_PATH
cmake -G Ninja -S . -B "$folder/build" -D SINEW_TESTS=OFF >"$folder/log" 2>&1 || fail "does not configure"
if has_window; then fail "a window without its packages"; fi

package sdl2
package imgui
ninja -C "$folder/build" build.ninja >"$folder/log" 2>&1 || fail "does not configure again"
if has_window; then fail "a window without one of its packages"; fi

package epoxy
ninja -C "$folder/build" build.ninja >"$folder/log" 2>&1 || fail "does not configure again"
has_window || fail "packages that have come are not seen"
