#!/bin/bash
# The window as a person uses it: on a display of its own, by pointer and keys; what happens is read from --json.
set -euo pipefail
skip() { echo "skipped: $1"; exit 77; }
for program in Xvfb xdotool; do command -v "$program" >/dev/null || skip "$program is not installed (packages.apt, window-test)"; done

folder=$(mktemp -d)
server= game=
trap 'kill $game $server 2>/dev/null; wait 2>/dev/null; rm -rf "$folder"' EXIT

number=$folder/display
exec 3<>"$number"
# Without a reset: else the server refuses who comes just when the last client has gone.
Xvfb -displayfd 3 -screen 0 1600x1000x24 -nolisten tcp -noreset >/dev/null 2>&1 &
server=$!
for _ in $(seq 100); do [ -s "$number" ] && break; sleep 0.1; done
[ -s "$number" ] || skip "Xvfb does not start here"
export DISPLAY=:$(head -1 "$number")
export XDG_CONFIG_HOME=$folder/config XDG_STATE_HOME=$folder/state LIBGL_ALWAYS_SOFTWARE=1
events=$folder/events

cat >"$folder/rope.json" <<'JSON'
{"sinew": 1, "view": {"center": [0, 0], "height": 6}, "world": {"gravity": [0, -9.8]},
 "figures": [{"prefab": "rope", "name": "rope", "at": [0, 2], "length": 3}]}
JSON

fail() { echo "$1"; echo "--- what happened:"; tail -30 "$events"; cat "$folder/errors"; exit 1; }
# Waits until the events say so, so many times.
until_said() {
    for _ in $(seq 600); do
        [ "$(grep -c "$1" "$events" || true)" -ge "${2:-1}" ] && return
        kill -0 $game 2>/dev/null || fail "the window is gone while waiting for $1"
        sleep 0.05
    done
    fail "not in 30 s: $1"
}
key() { xdotool key --clearmodifiers "$1"; sleep 0.1; }
hashes() { grep "\"what\": \"$1\"" "$events" | sed 's/.*"hash": "\([^"]*\)".*/\1/'; }

# Opens a window with a scene and waits until it is there.
open_window() {
    (trap - INT; exec "$SINEW" play "$1" --json) >"$events" 2>"$folder/errors" &
    game=$!
    for _ in $(seq 200); do
        window=$(xdotool search --onlyvisible --name Sinew 2>/dev/null | head -1) && [ -n "$window" ] && break
        if ! kill -0 $game 2>/dev/null; then
            grep -q 'OpenGL' "$folder/errors" && skip "no OpenGL 3.3 here"
            fail "no window"
        fi
        sleep 0.05
    done
    [ -n "$window" ] || fail "no window"
    xdotool windowfocus "$window" 2>/dev/null || true
    eval "$(xdotool getwindowgeometry --shell "$window")"
    sleep 0.5
}

cd "$folder"
open_window rope.json

# Escape ends the tour of a first start.
key Escape; sleep 0.3

# The scene lies between the tools (56) and the panel (340), between the menu (28) and the bar (64); its middle is the
# middle of the view.
middle_x=$((X + 56 + (WIDTH - 396) / 2)) middle_y=$((Y + 28 + (HEIGHT - 92) / 2))

# The first press in the scene after a tool was chosen with the pointer is the tool's; the measure is the 13th of 15
# buttons in a column as high as the window allows.
button=$(((HEIGHT - 92 - 26) / 15))
xdotool mousemove $((X + 28)) $((Y + 28 + 10 + 12 * button + button / 2)); sleep 0.4
xdotool mousedown 1; sleep 0.1; xdotool mouseup 1; sleep 0.3
xdotool mousemove $((middle_x - 100)) $middle_y mousedown 1; sleep 0.1
xdotool mousemove $middle_x $middle_y; sleep 0.1; xdotool mouseup 1; until_said '"what": "measure"'
key a; until_said '"what": "tool"'

# A rope that is taken by its middle goes where the pointer goes.
xdotool mousemove $middle_x $middle_y; sleep 0.2
xdotool mousedown 1; until_said '"what": "grab"'
for i in 1 2 3 4 5; do xdotool mousemove $((middle_x + 20 * i)) $middle_y; sleep 0.05; done
sleep 0.3
xdotool mouseup 1; until_said '"what": "let_go"'
moved=$(grep '"what": "let_go"' "$events" | sed 's/.*"at": \[\([^,]*\),.*/\1/')
awk -v x="$moved" 'BEGIN { exit !(x > 0.5) }' || fail "the rope did not follow the pointer: $moved m"

# Paused, a step forward and back is the same state.
key p; until_said '"what": "pause"'
key o; until_said '"what": "step"'
key b; until_said '"what": "back"'
[ "$(hashes pause)" = "$(hashes back)" ] || fail "back is another state"
[ "$(hashes pause)" != "$(hashes step)" ] || fail "a step changes nothing"
key p; until_said '"what": "resume"'

# The right button cuts what hangs; undo makes it whole.
key r; until_said '"what": "restart"'
sleep 0.2
xdotool mousemove $((middle_x - 250)) $middle_y mousedown 3; sleep 0.1
for i in $(seq 10); do xdotool mousemove $((middle_x - 250 + 50 * i)) $((middle_y + i)); sleep 0.02; done
xdotool mouseup 3
until_said '"constraints":'
key ctrl+z; until_said '"what": "undo"'
key ctrl+s; until_said '"what": "saved"'
"$SINEW" check rope.json >/dev/null || fail "what was saved is no scene"

# The menu asks for a path; Escape leaves it.
xdotool mousemove $((X + 22)) $((Y + 14)) click 1; sleep 0.4
xdotool mousemove $((X + 60)) $((Y + 142)); sleep 0.2; xdotool click 1; until_said '"purpose": "save"'
sleep 0.2; key Escape; sleep 0.2

# Pictures, the scene as text, and all that led to here: by menu and keys. The running state goes on with the same bits.
menu_entry() { # how far below the window's top
    xdotool mousemove $((X + 22)) $((Y + 14)) click 1; sleep 0.4
    xdotool mousemove $((X + 60)) $((Y + $1)); sleep 0.2; xdotool click 1
}
menu_entry 217; until_said '"purpose": "picture"'; sleep 0.3; key Return; until_said '"what": "screenshot"'
[ "$(head -c 4 rope.png | tail -c 3)" = PNG ] || fail "no picture"
sleep 0.5; key ctrl+c; until_said '"what": "copied"'
key p; until_said '"what": "pause"' 2
menu_entry 165; until_said '"purpose": "save_state"'; sleep 0.3; key Return; until_said '"what": "saved_state"'
key e; until_said '"what": "split", .*"on": true'; key e; until_said '"what": "split", .*"on": false'
key p; until_said '"what": "resume"' 2
"$SINEW" play rope.sinew --script /dev/stdin --json <<<"0 key p" >restored || fail "the running state is not opened"
grep -q "$(hashes saved_state)" restored || fail "the running state is another one"

# Escape closes a menu, and leaves a field of text: the window stays, though nothing would be lost.
xdotool mousemove $((X + 22)) $((Y + 14)) click 1; sleep 0.4; key Escape; sleep 0.3
xdotool mousemove $((X + WIDTH - 170)) $((Y + 182)) click 1; sleep 0.4; key x; sleep 0.2; key Escape; sleep 0.3
xdotool mousemove $middle_x $middle_y; sleep 0.2
key p; until_said '"what": "pause"' 3; key p; until_said '"what": "resume"' 3

# A file that is written again is read again; a wrong one leaves what runs, behind a message that Return closes.
sleep 1; sed -i 's/"length": 3/"length": 2.5/' rope.json; until_said '"what": "reloaded"'
sleep 1; echo '{' >rope.json; until_said '"what": "problem"'
sleep 0.3; key Return; sleep 0.3

# Any size.
for size in "1600 1000" "500 300" "40 40" "1280 720"; do xdotool windowsize "$window" $size; sleep 0.2; done
kill -0 $game 2>/dev/null || fail "the window is gone"

# Nothing to see, and letters twice as large.
for size in "1 1" "1280 720"; do xdotool windowsize "$window" $size; sleep 0.2; done
kill -0 $game 2>/dev/null || fail "the window is gone"

# Every scene, and out.
scenes=$("$SINEW" list --json | grep -o '"file":' | wc -l)
for i in $(seq "$scenes"); do xdotool key --clearmodifiers bracketright; until_said '"what": "scene"' "$i"; done
key Escape
for _ in $(seq 100); do kill -0 $game 2>/dev/null || break; sleep 0.05; done
code=0; wait $game || code=$?
game=
[ "$code" = 0 ] || fail "exit code $code"
[ -s "$folder/config/sinew/window.json" ] || fail "settings are not kept"

# Where an edit would be lost, Escape asks; what was not saved when the program was killed is offered the next time.
cat >rope.json <<'JSON'
{"sinew": 1, "world": {"gravity": [0, -9.8]}, "figures": [{"prefab": "rope", "name": "rope", "at": [0, 2], "length": 3}]}
JSON
open_window rope.json
key g; until_said '"what": "edit"'
key Escape; until_said '"what": "asks"'
key Escape; until_said '"answer": "cancel"'
until_said '"what": "draft"'
kill -9 $game; wait $game 2>/dev/null || true
open_window rope.json
until_said '"what": "asks"'
key Escape; until_said '"answer": "later"'

# At twice the scale the window is twice as large, as far as the display has room.
kill $game; wait $game 2>/dev/null || true
printf '{"width": 700, "height": 450}' >"$folder/config/sinew/window.json"
export SINEW_SCALE=2
open_window rope.json
[ "$WIDTH" = 1400 ] && [ "$HEIGHT" = 900 ] || fail "the window is $WIDTH x $HEIGHT at twice the scale"
key Escape; until_said '"what": "asks"'; key Escape; until_said '"answer": "later"'; key Escape
for _ in $(seq 100); do kill -0 $game 2>/dev/null || break; sleep 0.05; done
game=
grep -q '"width": 700' "$folder/config/sinew/window.json" || fail "the size of the window grows from start to start"
