#!/bin/bash
# The folders that the recipe for Conan exports are enough to configure, and every source of the libraries is among them;
# versions of both recipes are that of the tree, and the packages that they ask for those that the build looks for.
set -euo pipefail
command -v cmake >/dev/null && command -v ninja >/dev/null || { echo "cmake or ninja is not installed: skipped"; exit 77; }
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
fail() { printf 'FAILED: %s\n' "$1" >&2; exit 1; }

version=$(sed -n 's/.*define SINEW_VERSION "\(.*\)".*/\1/p' sinew/version.h)
for recipe in packaging/conan/conanfile.py packaging/vcpkg/vcpkg.json; do
    grep -qE "version\"?( =|:) \"$version\"" $recipe || fail "$recipe is not of version $version"
done
python3 -m py_compile packaging/conan/conanfile.py
rm -rf packaging/conan/__pycache__

patterns=$(sed -n '/for pattern in (/,/):/p' packaging/conan/conanfile.py | grep -oE '"[^"]+"' | tr -d '"')
set -f
for pattern in $patterns; do cp -r "${pattern%/*}" "$tree/"; done
set +f
cmake -G Ninja -S "$tree" -B "$tree/build" -D SINEW_COMMAND=OFF -D SINEW_SHARED=ON >"$tree/log" 2>&1 || { tail -n 20 "$tree/log"; fail "the exported tree"; }
# Headers that a source includes are of folders that are exported, too.
folders=$(cd "$tree" && find . -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | paste -sd '|')
included=$(grep -rhoE '^#include "[a-z_]+/' "$tree"/{sinew,player,canvas,files,bindings} | grep -oE '[a-z_]+/' | tr -d / | sort -u)
for folder in $included; do [[ "|$folders|" == *"|$folder|"* ]] || fail "headers of $folder are included, and not exported"; done
echo 'recipes: tests passed'
