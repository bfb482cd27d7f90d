#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

namespace sinew::canvas {

/// A line such as `ragdoll.mp4  [###########--------]  57 %  0:04 left`, redrawn in place and wiped at the end. Writes
/// nothing if the stream is not a terminal.
class Progress {
  public:
    explicit Progress(std::string label, std::size_t total, std::FILE* stream = stderr);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    /// Reports `done` of `total`. Cheap: redraws at most ten times a second.
    void update(std::size_t done);

  private:
    using Clock = std::chrono::steady_clock;
    std::string label;
    std::size_t total;
    std::FILE* stream;
    bool visible;
    Clock::time_point begin = Clock::now(), next_redraw = begin;
};

} // namespace sinew::canvas
