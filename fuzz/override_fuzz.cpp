#include "sinew/scene/document.h"
#include "sinew/session/session.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace sinew;

constexpr const char* scene = R"({"sinew": 1, "dimension": 2, "world": {"gravity": [0, -10]},
    "figures": [{"prefab": "rope", "name": "rope", "segments": 5}, {"prefab": "box", "name": "box", "at": [1, 1]}],
    "events": [{"at": 0.1, "grab": "box/corner_0", "to": [1, 2], "over": 0.1}]})";

bool is_finite_world(const AnyWorld& any) {
    return std::visit(
        [](const auto& world) {
            return std::all_of(world.particles.position.begin(), world.particles.position.end(),
                               [](const auto& position) { return is_finite(position); });
        },
        any);
}

} // namespace

/// Lines of key=value change a scene into one that steps on, finite, or are refused with a message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::vector<Override> overrides;
    for (std::size_t begin = 0; begin < text.size() && overrides.size() < 8;) {
        const auto end = std::min(text.find('\n', begin), text.size());
        overrides.push_back({text.substr(begin, end - begin)});
        begin = end + 1;
    }
    auto document = load(scene, "fuzz.json", overrides);
    document.limits.particles = std::min<std::int64_t>(document.limits.particles, 2000);
    auto opened = open_scene(document);
    if (!opened) {
        if (document.diagnostics.ok()) std::abort();
        return 0;
    }
    if (opened->scene.solver.substeps > 32 || opened->scene.solver.iterations > 8) return 0; // takes too long
    Session session(std::move(*opened));
    for (int i = 0; i < 12; ++i) session.step();
    if (!is_finite_world(session.world())) std::abort();
    return 0;
}
