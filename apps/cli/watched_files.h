#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sinew::cli {

/// Files as they were when they were added.
class WatchedFiles {
  public:
    /// Added before it is read, a change while it is read is seen too.
    void add(const std::filesystem::path& path);

    /// Returns once one of them was written, replaced, removed or made, and nothing more happened to them for a moment;
    /// or on Ctrl+C.
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
