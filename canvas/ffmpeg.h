#pragma once

#include "canvas/failure.h"

#include <cstddef>
#include <span>
#include <string>
#include <sys/types.h>
#include <vector>

namespace sinew::canvas {

/// A running ffmpeg that reads from this process. No shell is involved. A process group of the child's own keeps a
/// terminal's Ctrl-C from the child: this process alone decides the fate of the file. Standard error is kept for error
/// messages.
class Ffmpeg {
  public:
    Ffmpeg() = default;
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;
    ~Ffmpeg() { abandon(); }

    /// Starts ffmpeg, found on PATH. `purpose` names the feature that needs ffmpeg (".mp4") in the message if ffmpeg is
    /// not installed. The arguments read the input from `pipe:0`.
    [[nodiscard]] Failure start(const std::vector<std::string>& arguments, const std::string& purpose);

    /// Writes bytes to the child's standard input; blocks while the child is busy. Returns early, with success, after
    /// an interruption: callers poll interrupted().
    [[nodiscard]] Failure send(std::span<const std::byte> bytes);

    /// Closes the child's input and waits for the child to end.
    [[nodiscard]] Failure finish();

    /// Kills the child at once; the output is incomplete.
    void abandon();

    bool running() const { return child > 0; }
    pid_t id() const { return child; }

  private:
    Failure spawn(const std::vector<std::string>& arguments, const std::string& purpose, int input);
    std::string last_words() const;
    int reap();

    pid_t child = 0;
    int socket = -1; ///< write end of the child's standard input
    int words = -1;  ///< unnamed file for the child's standard error
};

} // namespace sinew::canvas
