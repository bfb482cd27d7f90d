#!/bin/bash
# The scenes of docs/concepts are right, and their pictures are as they would be drawn.
set -euo pipefail
command -v ffmpeg >/dev/null || { echo "ffmpeg is not installed: skipped"; exit 77; }
docs/concepts/render --check
for picture in docs/concepts/*.png docs/concepts/*.svg; do
    size=$(stat -c %s "$picture")
    [ "$size" -lt 60000 ] || { echo "$picture: $size bytes; a page's picture has less than 60000"; exit 1; }
    grep -q "$(basename "$picture")" docs/concepts/*.md || { echo "$picture is on no page"; exit 1; }
done
