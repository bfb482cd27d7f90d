#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "tests/paths.h"
#include "tests/stepped.h"
#include "tests/text_of.h"

#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

/// The first frames of each tutorial, worked out from its text by the scripts of tests/originals: classic mode is there
/// to a millionth of a pixel.
namespace sinew::SINEW_TEST_FILE {
namespace {

struct Line {
    std::string scene, overrides, name;
    int frame = 0;
    Point position{};
};

/// Fields are separated by commas; those that hold one are in double quotes.
std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[i++];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

/// The lines of each scene with its overrides, in their order.
std::map<std::pair<std::string, std::string>, std::vector<Line>> frames() {
    std::map<std::pair<std::string, std::string>, std::vector<Line>> all;
    std::ifstream file(test::source_dir() + "/tests/originals/frames.csv");
    for (std::string text; std::getline(file, text);) {
        const auto f = fields_of(text);
        all[{f.at(0), f.at(1)}].push_back(
            {f[0], f[1], f.at(3), std::stoi(f.at(2)), {{std::stod(f.at(4)), std::stod(f.at(5)), 0}}});
    }
    return all;
}

Session session_of(const std::string& scene, const std::string& overrides) {
    const auto path = test::scenes_dir() + "/" + scene + ".json";
    std::vector<Override> words{{"mode=classic"}};
    if (!overrides.empty()) words.push_back({overrides});
    auto document = load(text_of(path), path, words);
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

void play(Session& session, const std::vector<Line>& lines) {
    auto& world = std::get<World<2, double>>(session.world());
    int frame = 0;
    for (const auto& line : lines) {
        if (line.name == "mouse") {
            session.point_at(line.position);
            continue;
        }
        for (; frame < line.frame; ++frame) session.step();
        const auto id = find_particle(world, line.name);
        ASSERT_TRUE(id) << line.name;
        EXPECT_LE(distance(*position_of(world, *id), line.position.as<2, double>()), 1e-6)
            << line.name << " in frame " << line.frame;
    }
}

TEST(Originals, FirstFramesAreTheTutorials) {
    const auto all = frames();
    EXPECT_EQ(all.size(), 11u);
    for (const auto& [scene, lines] : all) {
        SCOPED_TRACE(scene.first + " " + scene.second);
        auto session = session_of(scene.first, scene.second);
        play(session, lines);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
