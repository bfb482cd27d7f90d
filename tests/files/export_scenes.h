#pragma once

#include "sinew/scene/reader.h"
#include "sinew/session/session.h"

#include "files/out/export_formats.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

/// Scenes to export, and where their particles are.
namespace sinew::test {

using Positions = std::vector<Vec3<float>>;

inline Session started(const std::string& text) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

/// A sheet of 3 x `rows` particles that falls off its two pins' line.
inline Session sheet(const std::string& more = {}, int rows = 2) {
    return started(
        R"({"sinew": 1, "dimension": 3, "solver": {"precision": "double"}, "world": {"gravity": [1, -9.81, 2]},
                    "figures": [{"prefab": "cloth", "name": "silk", "columns": 3, "rows": )" +
        std::to_string(rows) + R"(, "plane": "horizontal",
                                 "pins": "corners", "drawn": "fill"})" +
        more + "]}");
}

/// A scene in px with y downwards: a ball that falls, and a rope.
inline Session falling() {
    return started(R"({"sinew": 1, "units": {"length": "px", "time": "frame", "up": "-y"},
                    "world": {"gravity": [0, 0.1]}, "solver": {"precision": "double"}, "view": {"size": [64, 48], "plain": true},
                    "figures": [{"prefab": "ball", "name": "ball", "at": [32, 10], "radius": 5},
                                {"prefab": "rope", "name": "rope", "at": [10, 10], "turn": 60, "length": 20, "segments": 2}]})");
}

template <int D> Positions positions(const Session& session, bool y_down = false, double per_metre = 1) {
    Positions all;
    const auto& world = std::get<World<D, double>>(session.world());
    for (Row row = 0; row < world.particles.size(); ++row) {
        Vec3<float> p{};
        for (int i = 0; i < D; ++i)
            p[i] = float(world.particles.position[row][i] / per_metre * (i > 0 && y_down ? -1 : 1));
        all.push_back(p);
    }
    return all;
}

/// Exports so many frames, a step each, and returns what the particles' positions were.
template <int D>
std::vector<Positions> export_frames(Session session, const files::ExportRequest& request, int frames) {
    const auto* const format = files::export_format_of(request.path);
    EXPECT_NE(format, nullptr);
    const auto exporter = format->open(request);
    std::vector<Positions> seen;
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(exporter->frame(session), std::nullopt);
        seen.push_back(positions<D>(session));
        session.step();
    }
    EXPECT_EQ(exporter->finish(), std::nullopt);
    return seen;
}

} // namespace sinew::test
