#pragma once

#include "sinew/session/session.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

/// Positions and velocities of particles, frame by frame, into a file: `--trace FILE`.
namespace sinew::cli {

class Trace {
  public:
    /// `path` ends in .csv for a table, otherwise each row is a JSON object; - is standard output. `names` are
    /// particles (figure/name), stems (figure/stem_*) or figures, between commas; empty means all. Throws GiveUp.
    Trace(const std::string& path, const std::string& names, const Session& session);

    /// One row for each particle that is still there.
    void write(const Session& session);
    /// Throws GiveUp where a row could not be written.
    void close();

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    struct Traced {
        ParticleId particle;
        std::string name; ///< as it is written
    };

    std::string path_;
    std::unique_ptr<std::FILE, Close> file_; ///< none for standard output
    bool is_table_ = false;
    bool all_ = false; ///< further particles may come: those of torn cloth
    std::vector<Traced> traced_;
    std::string text_; ///< the rows of one frame

    void choose(const std::string& names, const Session& session);
    void choose_all(const Session& session);
    void trace(ParticleId particle, const Session& session);
    void put_row(double time, const std::string& name, std::span<const double> position,
                 std::span<const double> velocity);
    void flush();
};

} // namespace sinew::cli
