#!/bin/bash
# tools/progress shows the share that is done and the time left, and lets warnings through.
set -euo pipefail
fail() { printf 'FAILED: %s\n' "$1" >&2; exit 1; }
said=$(printf '%s\n' '[50 100 60.20] Building CXX object a.dir/b.cpp.o' 'b.cpp:1: warning: unused' '[100 100 130.0] Linking CXX executable bin/c' |
    TERM=dumb tools/progress)
case "$said" in *'[ 50 %] 1 min 0 s left  b.cpp.o'*'b.cpp:1: warning: unused'*'[100 %]  c'*) ;; *) fail "$said" ;; esac
