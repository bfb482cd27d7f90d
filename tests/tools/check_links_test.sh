#!/bin/bash
# check_links names each link that leads nowhere, with its line, and accepts the others.
set -euo pipefail
command -v python3 >/dev/null || { echo "python3 is not installed: skipped"; exit 77; }
tool=$PWD/tools/check_links
d=docs # written so, the pages of this test are no mentions in this file
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

fail() { printf 'FAILED: %s\n' "$1" >&2; exit 1; }
page() { mkdir -p "$tree/$(dirname "$1")" && printf '%s\n' "${@:2}" >"$tree/$1"; }
passes() { "$tool" "$tree" || fail "$1 should pass"; }
refuses() {
    local said
    if said=$("$tool" "$tree"); then fail "$1 should be refused"; fi
    case "$said" in *"$2"*) ;; *) fail "$1: '$2' is not in: $said" ;; esac
}

page $d/far.md '# The `far` page, again' '## Twice' '## Twice'
page tools/made '#!/bin/bash' "# writes $d/far.md"
page README.md '# Home' "A [page]($d/far.md), [a heading]($d/far.md#the-far-page-again), [another]($d/far.md#twice-1)," \
    '[here](#home), [the web](https://nowhere.invalid/x), `tools/made`' '```' '[no](link.md)' '```' '`tools/new.h`:'
passes "a tree whose links resolve"

page bad.md '' "[gone]($d/gone.md)"
refuses "a page that is gone" "bad.md:2: error: no file $d/gone.md"
page bad.md "![gone]($d/gone.svg)"
refuses "a picture that is gone" "bad.md:1: error: no file $d/gone.svg"
page bad.md "[gone]($d/far.md#thrice)"
refuses "a heading that is gone" "no heading #thrice in $d/far.md"
page bad.md 'see `tools/gone`'
refuses "a path that is gone" 'no file tools/gone'
rm "$tree/bad.md"
page tools/made '#!/bin/bash' "# writes $d/gone.md"
refuses "a comment about a page that is gone" "tools/made:2: error: no file $d/gone.md"
