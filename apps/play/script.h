#pragma once

#include "apps/play/play.h"

#include <functional>
#include <string>
#include <vector>

/// A game that plays itself from a file: what a player would do, and when. A line is a second and an action, in the
/// order of time:
///
///     0.5 move bob/right_hand          the pointer, over 0.2 s where nothing is said
///     0.7 press                        left; or: press right, press middle
///     1.0 move 900 200 over 0.5        pixels
///     1.6 release
///     1.8 touch 1 600 300              a finger comes down there, or is moved there, over 0 s where nothing is said
///     1.9 lift 1
///     2.0 scroll 3                     notches of the wheel
///     2.0 key ctrl+z                   down and up
///     2.1 where bob/right_hand         tells where it is
///     2.2 set solver.substeps=16       a slider
///     2.3 open rope                    a scene
///     2.4 drop mine.json               a file
///     2.5 go 120                       the timeline, to a step
///     2.6 save mine.json
///     2.6 state run.json               the running state; `open` restores it
///     2.7 paste mine.json              its text, as from the clipboard
///     2.7 answer discard               a question
///     2.7 choose mine.json             a path that was asked for
///     2.7 shot mine.png
///     3.0 end
///
/// Before them may stand `size 1280x720` and `fps 60`. Everything after # is a remark.
namespace sinew::play {

struct ScriptLine {
    double at = 0;
    std::string action;
    std::vector<std::string> words;
    std::size_t number = 0; ///< in the file, from 1
};

struct Script {
    int width = 1280, height = 720;
    double fps = 60;
    std::vector<ScriptLine> lines;
};

/// A script, or what is wrong with it: "line 3: ...".
struct ReadScript {
    Script script;
    std::string problem;
};
ReadScript read_script(const std::string& text);

/// Plays it, frame by frame, in the script's own time. `frame` is called after each with the second that it is.
/// What cannot be done ends it: the answer is the problem, empty where there is none.
std::string run_script(const Script& script, Play& play, const std::function<void(double)>& frame = {});

} // namespace sinew::play
