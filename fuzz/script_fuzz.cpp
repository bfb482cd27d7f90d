#include "player/script.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using namespace sinew;

constexpr const char* scene = R"({"sinew": 1, "world": {"gravity": [0, -10]}, "solver": {"substeps": 2},
    "figures": [{"prefab": "rope", "name": "rope", "segments": 5, "at": [0, 2]},
                {"prefab": "box", "name": "box", "at": [1, 1]}]})";

play::Fetched opened(const std::string& text) {
    auto document = load(text, "fuzz.json");
    document.limits.particles = std::min<std::int64_t>(document.limits.particles, 2000);
    play::Fetched fetched{open_scene(document), "", {}};
    if (!fetched.opened) fetched.problem = to_text(document.diagnostics, {});
    return fetched;
}

/// A catalogue of one scene.
const play::SceneLibrary library{
    {"fuzz"},
    {},
    [](const std::string&, std::span<const Override>) { return opened(scene); },
    [](const std::string& text, const std::string&, const std::filesystem::path&) { return opened(text); }};

/// A few seconds of small pictures, and no line that names a file.
bool is_modest(const play::Script& script) {
    constexpr std::array<std::string_view, 7> of_files = {"save", "shot", "state", "choose", "paste", "open", "drop"};
    constexpr std::string_view costly[] = {"solver.substeps", "solver.iterations", "solver.rate"};
    constexpr double max_seconds = 2, max_fps = 120;
    constexpr int max_pixels = 1000;
    if (script.fps > max_fps || script.width > max_pixels || script.height > max_pixels) return false;
    return std::ranges::none_of(script.lines, [&](const play::ScriptLine& line) {
        const bool is_costly = std::ranges::any_of(costly, [&](std::string_view word) {
            return !line.words.empty() && line.words[0].find(word) != std::string::npos;
        });
        return line.at > max_seconds || is_costly || std::ranges::find(of_files, line.action) != of_files.end();
    });
}

bool is_finite_world(const AnyWorld& any) {
    return std::visit(
        [](const auto& world) {
            return std::ranges::all_of(world.particles.position, [](const auto& p) { return is_finite(p); });
        },
        any);
}

} // namespace

/// Any text is a script of a pointer, keys and fingers, or is refused with its line; what it does leaves worlds finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto read = play::read_script(std::string(reinterpret_cast<const char*>(data), size));
    if (!read.problem.empty()) return 0;
    if (!is_modest(read.script)) return 0;
    play::Play play(library, "fuzz");
    constexpr double max_seconds = 6; // a movement goes on for as long as its line says
    run_script(read.script, play, [&](double now) {
        if (now > max_seconds) play.quit = true;
    });
    if (!is_finite_world(play.session().world())) std::abort();
    return 0;
}
