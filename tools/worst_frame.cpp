#include "tools/scene_of_file.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

// worst_frame FOLDER: prints, for every scene of a folder in both modes, the median and the longest step after the
// first second, as a table in Markdown, the worst first. Exit code 1 if any is longer than four medians. Times are of
// the processor, by one thread. A step that seems long is taken again, up to six times from the start of the scene: the
// least of its times counts, because what disturbs a run falls on another step in the next.

namespace {

using namespace sinew;

constexpr double allowed = 4; // medians
constexpr int max_runs = 6;

Session opened(const std::filesystem::path& path, const std::string& mode) {
    const Override choice{"mode=" + mode};
    auto scene = tools::scene_of_file(path, std::span(&choice, 1));
    if (!scene) std::exit(1);
    return Session(std::move(*scene));
}

/// Time of the processor, milliseconds.
double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

struct Frames {
    std::string scene, mode;
    double median = 0, longest = 0; ///< milliseconds
    double at = 0;                  ///< of the longest, seconds
    double ratio() const { return median > 0 ? longest / median : 0; }
};

/// Times of all steps, where shorter than those known.
void run(const Session& begun, std::vector<double>& milliseconds) {
    auto session = begun;
    session.set_options({.threads = 1});
    for (auto& least : milliseconds) {
        const double begin = now();
        session.step();
        least = std::min(least, now() - begin);
    }
}

Frames measure(const std::filesystem::path& path, const std::string& mode) {
    const auto begun = opened(path, mode);
    const double rate = begun.scene().solver.rate, seconds = std::clamp(begun.scene().seconds, 2.0, 10.0);
    std::vector<double> milliseconds(std::size_t(seconds * rate), 1e9);
    Frames frames{path.stem().string(), mode};
    for (int count = 0; count < max_runs; ++count) {
        run(begun, milliseconds);
        const auto first = milliseconds.begin() + std::ptrdiff_t(rate); // after a second
        const auto longest = std::max_element(first, milliseconds.end());
        frames.longest = *longest, frames.at = double(longest - milliseconds.begin()) / rate;
        auto sorted = std::vector(first, milliseconds.end());
        std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
        frames.median = sorted[sorted.size() / 2];
        if (frames.ratio() < allowed) break;
    }
    return frames;
}

} // namespace

int main(int count, char** words) {
    if (count != 2) return std::fputs("usage: worst_frame FOLDER\n", stderr), 2;
    std::vector<Frames> all;
    for (const auto& entry : std::filesystem::directory_iterator(words[1]))
        if (entry.path().extension() == ".json")
            for (const auto mode : modes) all.push_back(measure(entry.path(), std::string(mode)));
    std::sort(all.begin(), all.end(), [](const Frames& a, const Frames& b) { return a.ratio() > b.ratio(); });
    std::puts("| scene | mode | median, ms | longest, ms | at, s | medians |\n|---|---|---|---|---|---|");
    const auto even =
        std::find_if(all.begin(), all.end(), [](const Frames& frames) { return frames.ratio() < allowed / 2; });
    for (const auto& [scene, mode, median, longest, at] : std::span(all.begin(), even))
        std::printf("| %s | %s | %.4f | %.4f | %.2f | %.1f |\n", scene.c_str(), mode.c_str(), median, longest, at,
                    longest / median);
    const auto beyond =
        std::count_if(all.begin(), all.end(), [](const Frames& frames) { return frames.ratio() > allowed; });
    std::printf(
        "\n%td of %zu runs have a step longer than %.0f medians; the %td that are not listed have none of %.0f.\n",
        beyond, all.size(), allowed, all.end() - even, allowed / 2);
    return beyond > 0 ? 1 : 0;
}
