#pragma once

#include "canvas/failure.h"

#include <cstddef>
#include <span>
#include <string>
#include <sys/types.h>
#include <vector>

namespace sinew::canvas {

/// A running ffmpeg that reads from us. No shell is involved. It has a process group of its own, so that the Ctrl-C of
/// a terminal reaches us alone and we decide what becomes of the file; what it says on stderr is kept for error
/// messages.
class Ffmpeg {
  public:
    Ffmpeg() = default;
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;
    ~Ffmpeg() { abandon(); }

    /// Starts ffmpeg, found on PATH. `purpose` says what needs it (".mp4") where it is not installed.
    /// The arguments read the input from `pipe:0`.
    [[nodiscard]] Failure start(const std::vector<std::string>& arguments, const std::string& purpose);

    /// Hands bytes to its standard input; waits while it is busy. Comes back early, with success, when the process was
    /// asked to end: whoever sends polls interrupted().
    [[nodiscard]] Failure send(std::span<const std::byte> bytes);

    /// Ends its input and waits until it is done.
    [[nodiscard]] Failure finish();

    /// Ends it at once. What it was writing is worthless.
    void abandon();

    bool running() const { return child > 0; }
    pid_t id() const { return child; }

  private:
    Failure spawn(const std::vector<std::string>& arguments, const std::string& purpose, int input);
    std::string last_words() const;
    int reap();

    pid_t child = 0;
    int socket = -1; ///< our end of its standard input
    int words = -1;  ///< an unnamed file that takes its standard error
};

} // namespace sinew::canvas
