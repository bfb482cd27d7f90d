#!/bin/bash
# ./dev doctor counts the compilers that ninja starts, and asks for their memory, of the four largest files at most.
set -euo pipefail
fail() { printf 'FAILED: %s\n' "$1" >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
said() { # said JOBS FREE: what doctor says of compilers and memory, with so many jobs and kB
    printf '#!/bin/sh\necho "  -j N     run N jobs in parallel (0 means infinity) [default=%s on this system]"; exit 1\n' "$1" >"$scratch/ninja"
    printf 'MemTotal: 64000000 kB\nMemAvailable: %s kB\n' "$2" >"$scratch/meminfo"
    chmod +x "$scratch/ninja"
    PATH=$scratch:$PATH MEMINFO=$scratch/meminfo ./dev doctor | grep -E '^(compilers|memory) '
}
case "$(said 3 6500000)" in *'TOO LITTLE: 6500 MB, 6600 wanted: a compiler takes up to 2.2 GB, and ninja starts 3'*) ;; *) fail 'three at once' ;; esac
case "$(said 3 6700000)" in *'TOO LITTLE'*) fail 'enough for three' ;; *'3 at once, each up to 2.2 GB'*) ;; *) fail 'the row of compilers' ;; esac
case "$(said 66 8900000)" in *'TOO LITTLE'*) fail 'four large files' ;; esac
