#pragma once

#include "player/script.h"
#include "tests/paths.h"
#include "tests/text_of.h"

#include <algorithm>
#include <gtest/gtest.h>

/// A game that tests can play: scenes of the catalogue and files, and an ear.
namespace sinew::play::games {

inline Fetched read(const std::string& text, const std::string& name, const std::filesystem::path& = {}) {
    auto document = load(text, name);
    Fetched fetched{open_scene(document), "", {}};
    if (!fetched.opened) fetched.problem = to_text(document.diagnostics, {});
    return fetched;
}

inline Fetched fetch(const std::string& word, std::span<const Override> overrides) {
    const bool file = word.find('/') != std::string::npos;
    const std::filesystem::path path = file ? word : test::scenes_dir() + "/" + word + ".json";
    auto document = load(sinew::text_of(path), path.string(), overrides);
    Fetched fetched{open_scene(document), "", path};
    if (!fetched.opened) fetched.problem = to_text(document.diagnostics, {});
    return fetched;
}

inline const SceneLibrary library{{"chains", "ragdoll", "rope"}, {}, fetch, read};

struct Listening {
    explicit Listening(Play& play) {
        play.listener = [this](const Told& one) { told.push_back(one); };
    }
    std::size_t count(std::string_view what) const {
        return std::size_t(std::count_if(told.begin(), told.end(), [&](const Told& one) { return one.what == what; }));
    }
    std::string value(std::string_view what, std::string_view key, std::size_t number = 0) const {
        for (const auto& one : told)
            if (one.what == what && number-- == 0) {
                const auto* member = json::find(one.more, key);
                const auto* text = member ? member->value.as<std::string>() : nullptr;
                return text ? *text : "";
            }
        return "";
    }
    std::vector<Told> told;
};

inline void run(const std::string& text, Play& play) {
    const auto read = read_script(text);
    ASSERT_EQ(read.problem, "");
    ASSERT_EQ(run_script(read.script, play), "");
}

inline Vec2<double> pixel_of(const Play& play, std::string_view particle) {
    const auto id =
        std::visit([&](const auto& world) { return find_particle(world, particle); }, play.session().world());
    const auto position = id ? position_of(play.session().world(), {&*id, 1}) : std::nullopt;
    return position ? cast<double>(play.view().see(position->as<3, double>())->pixel) : Vec2<double>{};
}

} // namespace sinew::play::games
