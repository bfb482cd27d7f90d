#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sinew::cli {

/// A set of files, each with the state at the time of adding.
class WatchedFiles {
  public:
    /// Adds a file. Call before reading: a change during the read is then detected.
    void add(const std::filesystem::path& path);

    /// Returns once a file has been written, replaced, removed or created, and all have been stable for one polling
    /// interval (0.1 s); or on Ctrl-C.
    void wait_for_change() const;

  private:
    struct State {
        std::filesystem::file_time_type written;
        std::uintmax_t size = 0;
        bool exists = false;
        bool operator==(const State&) const = default;
    };
    struct File {
        std::filesystem::path path;
        State state;
    };

    static State state_of(const std::filesystem::path& path);
    std::vector<State> states() const;

    std::vector<File> files_;
};

} // namespace sinew::cli
