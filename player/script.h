#pragma once

#include "player/play.h"

#include <functional>
#include <string>
#include <vector>

/// A script of player input. Each line is a time in seconds and an action; times never decrease:
///
///     0.5 move bob/right_hand          the pointer, over 0.2 s by default
///     0.7 press                        left; or: press right, press middle
///     1.0 move 900 200 over 0.5        pixels
///     1.6 release
///     1.8 touch 1 600 300              a finger comes down, or moves, over 0 s by default
///     1.9 lift 1
///     2.0 scroll 3                     notches of the wheel
///     2.0 key ctrl+z                   down and up
///     2.1 where bob/right_hand         reports the position
///     2.2 set solver.substeps=16       a slider
///     2.3 open rope                    a scene
///     2.4 drop mine.json               a file
///     2.5 go 120                       the timeline, to a step
///     2.6 save mine.json
///     2.6 state run.json               the running state; `open` restores it
///     2.7 paste mine.json              the file's text, as from the clipboard
///     2.7 answer discard               a question
///     2.7 choose mine.json             answers a path request
///     2.7 shot mine.png
///     3.0 end
///
/// Optional first lines: `size 1280x720` and `fps 60`. A # starts a remark.
namespace sinew::play {

struct ScriptLine {
    double at = 0;
    std::string action;
    std::vector<std::string> words;
    std::size_t number = 0; ///< line in the file, from 1
};

struct Script {
    int width = 1280, height = 720;
    double fps = 60;
    std::vector<ScriptLine> lines;
};

/// A script, or the reason why its text is invalid: "line 3: ...".
struct ReadScript {
    Script script;
    std::string problem;
};
ReadScript read_script(const std::string& text);

/// Runs a script frame by frame in the script's own time. `frame` is called after each frame with the time in seconds.
/// An action that fails ends the run; returns the reason, empty on success.
std::string run_script(const Script& script, Play& play, const std::function<void(double)>& frame = {});

} // namespace sinew::play
