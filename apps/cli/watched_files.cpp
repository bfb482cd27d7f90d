#include "apps/cli/watched_files.h"

#include "canvas/interrupt.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

/// How often they are looked at: editors replace files in many ways, which all show here, on every file system.
constexpr std::chrono::milliseconds between_looks{100};

} // namespace

WatchedFiles::State WatchedFiles::state_of(const fs::path& path) {
    std::error_code gone, unknown;
    const auto written = fs::last_write_time(path, gone);
    return gone ? State{} : State{written, fs::file_size(path, unknown), true};
}

std::vector<WatchedFiles::State> WatchedFiles::states() const {
    std::vector<State> states;
    for (const auto& file : files_) states.push_back(state_of(file.path));
    return states;
}

void WatchedFiles::add(const fs::path& path) {
    if (std::ranges::find(files_, path, &File::path) == files_.end()) files_.push_back({path, state_of(path)});
}

void WatchedFiles::wait_for_change() const {
    std::vector<State> last;
    for (const auto& file : files_) last.push_back(file.state);
    for (bool changed = false; !canvas::interrupted();) {
        const auto now = states();
        if (changed && now == last) return;
        changed = changed || now != last;
        last = now;
        std::this_thread::sleep_for(between_looks);
    }
}

} // namespace sinew::cli
