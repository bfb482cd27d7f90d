#pragma once

#include "sinew/session/session.h"

#include "canvas/partial_file.h"
#include "files/out/trace_rows.h"

#include <cstdio>
#include <memory>
#include <string>

/// Positions and velocities of particles, frame by frame, in a file: `--trace FILE`.
namespace sinew::cli {

class Trace {
  public:
    /// `path`: a table if the name ends in .csv, otherwise a JSON object per row; - is standard output. `names`:
    /// particles (figure/name), stems (figure/stem_*) or figures, separated by commas; empty means all. Throws
    /// CommandError.
    Trace(const std::string& path, const std::string& names, const Session& session);

    /// Writes a row for each remaining particle.
    void write(const Session& session);
    /// Gives the file its name. Throws CommandError if a row could not be written.
    void close();

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::string path_;
    std::unique_ptr<canvas::PartialFile> partial_; ///< null for standard output, a device and a pipe
    std::unique_ptr<std::FILE, Close> file_;       ///< null for standard output
    files::TraceRows rows_;
    bool all_ = false; ///< true: particles added by tearing cloth are traced too
    std::string text_; ///< rows of the present frame

    void open();
    void choose(const std::string& names, const Session& session);
    void flush();
};

} // namespace sinew::cli
