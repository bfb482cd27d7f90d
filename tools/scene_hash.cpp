#include "tools/scene_of_file.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>

// scene_hash LENGTH SCENE [KEY=VALUE...]: prints the hash of the final world, and nothing else. LENGTH is in seconds
// ("5"), or in steps ("600steps"). SINEW_THREADS and SINEW_SIMD of the environment choose threads and instruction set;
// one that the program or the processor lacks is an error. Needs the library alone: a cross compiler without other
// libraries can build the program (tools/same_bits, tools/renew_determinism).

namespace {

using namespace sinew;

int fail(const char* what, const std::string& which) {
    std::fprintf(stderr, "scene_hash: %s %s\n", what, which.c_str());
    return 1;
}

/// Steps of a length, "5" or "600steps", at `rate` steps a second.
std::uint64_t steps_of(std::string_view length, double rate) {
    double number = 0;
    const auto [end, problem] = std::from_chars(length.data(), length.data() + length.size(), number);
    if (problem != std::errc()) return 0;
    if (std::string_view(end, length.data() + length.size()) == "steps") return std::uint64_t(number);
    return std::uint64_t(std::ceil(number * rate - 1e-9));
}

/// Options named by the environment; nothing for an unknown or missing instruction set.
std::optional<SolverOptions> wanted_options() {
    SolverOptions options;
    if (const char* const threads = std::getenv("SINEW_THREADS")) options.threads = std::atoi(threads);
    if (const char* const name = std::getenv("SINEW_SIMD")) {
        const auto simd = simd_called(name);
        if (!simd || !has_simd(*simd)) return std::nullopt;
        options.simd = *simd;
    }
    return options;
}

} // namespace

int main(int count, char** words) {
    if (count < 3) return fail("usage: scene_hash LENGTH", "SCENE [KEY=VALUE...]");
    const auto options = wanted_options();
    if (!options) return fail("has not", std::getenv("SINEW_SIMD"));
    const std::string path = words[2];
    std::vector<Override> overrides;
    for (const char* word : std::span(words, std::size_t(count)).subspan(3)) overrides.push_back({word});

    auto opened = tools::scene_of_file(path, overrides);
    if (!opened) return fail("cannot open", path);
    const auto steps = steps_of(words[1], opened->scene.solver.rate);
    Session session(std::move(*opened));
    session.set_options(*options);
    for (std::uint64_t step = 0; step < steps; ++step) session.step();
    std::printf("%016llx\n", static_cast<unsigned long long>(session.report().hash));
}
