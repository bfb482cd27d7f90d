#include "sinew/math/hash.h"
#include "sinew/scene/reader.h"
#include "sinew/scene/text.h"
#include "sinew/session/session_snapshot.h"
#include "sinew/snapshot/frame.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include "tests/dice.h"
#include "tests/paths.h"
#include "tests/thorough.h"

#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

/// Controls of characters and cars as state of a session: saved, restored, copied, checked.
namespace sinew::SINEW_TEST_FILE {
namespace {

using test::Dice;
using Bytes = std::vector<std::byte>;

std::optional<Opened> opened_scene(const std::string& text, const std::string&) {
    auto document = load(text, "steering");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics) << text;
    return opened;
}

/// Hills, a rope to hang on, and a figure of each prefab that steers.
std::string scene_text(const std::string& precision) {
    return R"({"sinew": 1, "world": {"gravity": [0, -9.81]}, "solver": {"precision": ")" + precision + R"("},
        "colliders": [{"shape": "box", "size": [90, 1], "at": [0, -0.5]}, {"shape": "sphere", "radius": 3, "at": [6, -2.5]}],
        "figures": [{"prefab": "character", "name": "hero"}, {"prefab": "car", "name": "racer", "at": [12, 0]},
                    {"prefab": "rope", "name": "rope", "at": [1, 4], "length": 3, "angle": -90, "segments": 8}],
        "events": [{"at": 0.3, "steer": "hero", "along": -1, "duration": 1},
                   {"at": 0.2, "every": 0.5, "steer": "racer", "along": 1, "up": 1, "duration": 0.3}]})";
}

Session session_with(const std::string& precision) {
    return Session(std::move(*opened_scene(scene_text(precision), {})));
}

FigureId id_of(const Session& session, std::string_view name) {
    return std::visit([&](const auto& world) { return figure_id(world, *find_figure(world, name)); }, session.world());
}

/// A figure that is not of the scene, as a program adds it.
template <class Prefab> void add(Session& session, const Prefab& prefab, const std::string& name, double x) {
    FigureSection section;
    section.made = prefab;
    section.name = name;
    section.at[0] = x;
    add_figure(session.scene(), section, session.world());
    session.steering().know({id_of(session, name), prefab, {}});
}

std::uint64_t hash_of(const Session& session) {
    return std::visit([](const auto& world) { return state_hash(world); }, session.world());
}

Session restored(const Bytes& bytes) {
    SnapshotError error;
    auto session = session_of(bytes, opened_scene, error);
    EXPECT_TRUE(session) << error.text();
    return session ? std::move(*session) : session_with("double");
}

/// A program and a player that change controls at random, add figures that can be steered, and remove them.
class Steersman {
  public:
    explicit Steersman(std::uint64_t seed) : dice_(seed) {}
    int below(int count) { return dice_.below(count); }

    /// Does the same to both sessions.
    void act(Session& one, Session& other) {
        const int what = dice_.below(12);
        const auto figure = figures_[std::size_t(dice_.below(int(figures_.size())))];
        const Controls controls{dice_.between(-1, 1), dice_.between(-1, 1), dice_.one_of(3), dice_.one_of(2)};
        const auto walker = Character{.height = dice_.between(1.2, 2), .speed = dice_.between(2, 6)};
        const auto driver = Car{.torque = dice_.between(60, 200), .top_speed = dice_.between(5, 15)};
        const auto added = "added" + std::to_string(number_++);
        const double x = dice_.between(-40, 40);
        for (auto* session : {&one, &other}) {
            if (what == 0) session->steering().play(controls);
            if (what == 1) session->steering().set(id_of(*session, figure), std::nullopt);
            if (what == 2) add(*session, walker, added, x);
            if (what == 3) add(*session, driver, added, x);
            if (what == 4 && figures_.size() > 1)
                std::visit([&](auto& world) { remove_figure(world, *find_figure(world, figure)); }, session->world());
            if (what > 4) session->steering().set(id_of(*session, figure), controls);
        }
        if (what == 2 || what == 3) figures_.push_back(added);
        if (what == 4 && figures_.size() > 1) std::erase(figures_, figure);
    }

  private:
    Dice dice_;
    std::vector<std::string> figures_{"hero", "racer"};
    int number_ = 0;
};

// Controls held and let go, figures added and removed, saved at any step: by bytes and as a copy.
TEST(Steering, GoesOnAfterASnapshotAtAnyStep) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(12, 200)); ++seed) {
        Steersman steersman(seed);
        auto session = session_with(seed % 2 ? "float" : "double"), copy = session;
        for (int round = 0; round < 3; ++round) {
            for (int i = steersman.below(40); i >= 0; --i) {
                if (steersman.below(4) == 0) steersman.act(session, copy);
                session.step();
                copy.step();
            }
            const auto bytes = save(session);
            auto opened = restored(bytes);
            ASSERT_EQ(save(opened), bytes) << "seed " << seed;
            copy = session;
            for (int i = 0; i < 20; ++i) {
                ASSERT_EQ(hash_of(opened), hash_of(session)) << "seed " << seed << ", step " << i;
                ASSERT_EQ(hash_of(copy), hash_of(session)) << "seed " << seed << ", step " << i;
                for (auto* one : {&session, &opened, &copy}) one->step();
            }
            session = std::move(opened);
        }
    }
}

struct HeldControls : ::testing::TestWithParam<const char*> {};

// Each prefab that steers, of the scene and added: controls held when a session is saved make a difference.
TEST_P(HeldControls, AreHeldAfterASnapshot) {
    auto session = session_with("double");
    add(session, Character{.speed = 3}, "walker", -8);
    add(session, Car{.torque = 90}, "driver", -14);
    const bool jumps = std::string_view("hero walker").find(GetParam()) != std::string_view::npos;
    session.steering().set(id_of(session, GetParam()), Controls{.along = 0.7, .jump = jumps});
    for (int i = 0; i < 30; ++i) session.step();
    auto opened = restored(save(session)), free = session;
    free.steering().set(id_of(free, GetParam()), std::nullopt);
    for (int i = 0; i < 60; ++i)
        for (auto* one : {&session, &opened, &free}) one->step();
    EXPECT_EQ(hash_of(opened), hash_of(session));
    EXPECT_NE(hash_of(free), hash_of(session));
}
INSTANTIATE_TEST_SUITE_P(Every, HeldControls, ::testing::Values("hero", "racer", "walker", "driver"),
                         [](const auto& test) { return std::string(test.param); });

// The id of a figure that was removed is given to none in the process that restores: controls stay with their figure.
TEST(Steering, OfARemovedFigureIsNotTakenOver) {
    auto session = session_with("double");
    add(session, Character{}, "walker", -8);
    auto id = id_of(session, "walker");
    id.generation += 1000; // as another process might have drawn
    session.steering().know({id, Character{}, {}});
    session.steering().set(id, Controls{.along = 1});
    auto opened = restored(save(session));
    std::visit([](auto& world) { remove_figure(world, *find_figure(world, "walker")); }, opened.world());
    add(opened, Character{}, "next", -8);
    EXPECT_GT(id_of(opened, "next").generation, id.generation);
}

// One walk a step, at the speed of the figure that is there.
TEST(Steering, OfAFigureInPlaceOfOneOfTheSceneIsItsOwn) {
    auto session = session_with("double");
    std::visit([](auto& world) { remove_figure(world, *find_figure(world, "hero")); }, session.world());
    add(session, Character{.speed = 2}, "hero", -20);
    session.steering().set(id_of(session, "hero"), Controls{.along = -1});
    for (int i = 0; i < 60; ++i) session.step();
    const auto& world = std::get<World<2, double>>(session.world());
    EXPECT_NEAR((*velocity_of(world, *find_particle(world, "hero/feet")))[0], -2, 0.05);
}

// A copy by an event drives as its original does by the events of that one, and on its own keys.
TEST(Steering, OfTheOriginalIsThatOfItsCopies) {
    const std::string text = R"({"sinew": 1, "world": {"gravity": [0, -9.81]},
        "colliders": [{"shape": "box", "size": [900, 1], "at": [0, -0.5]}],
        "figures": [{"prefab": "car", "name": "racer"}, {"prefab": "character", "name": "hero", "at": [-20, 0]}],
        "events": [{"at": 0.1, "add": "racer", "to": [40, 0]}, {"at": 0.1, "add": "hero", "to": [-40, 0]},
                   {"at": 1, "steer": "racer", "along": 1, "duration": 2},
                   {"at": 1, "steer": "hero", "along": -1, "duration": 2}]})";
    Session session(std::move(*opened_scene(text, {})));
    const auto speed = [&](const std::string& figure) {
        const auto& world = std::get<World<2, double>>(session.world());
        return (*velocity_of(world, world.figures[*find_figure(world, figure)].particles[0]))[0];
    };
    session.run_until(0.9);
    EXPECT_NEAR(speed("racer_1"), 0, 0.05);
    session = restored(save(session));
    session.run_until(2.5);
    EXPECT_GT(speed("racer"), 2);
    EXPECT_NEAR(speed("racer_1"), speed("racer"), 0.1) << "the fall from the place of the copy is another";
    EXPECT_LT(speed("hero_1"), -1);
    session.become(session.scene());
    session.run_until(2.6);
    EXPECT_GT(speed("racer_1"), 2);
    session.steering().play({.along = -1});
    session.run_until(7);
    EXPECT_LT(speed("racer_1"), -1);
}

TEST(Steering, IsHeldWithinItsRange) {
    auto session = session_with("double");
    session.steering().set(id_of(session, "hero"), Controls{.along = 1e300, .up = std::nan("")});
    session.steering().play({.along = -7});
    EXPECT_EQ(session.steering().player(), Controls{.along = -1});
    EXPECT_EQ(save(restored(save(session))), save(session));
}

// --- bytes of others -------------------------------------------------------------------------------------------------

constexpr std::size_t head = 16, header = 64, session_part = 2;

/// Sets the length of the session's part to the end, and its checksum to the true one.
void mend(Bytes& bytes) {
    std::array<std::uint64_t, 2 * snapshot::parts> table{};
    std::memcpy(table.data(), bytes.data() + head, sizeof table);
    std::size_t at = header;
    for (std::size_t part = 0; part < snapshot::parts; ++part) {
        if (part == session_part) table[2 * part] = bytes.size() - at;
        Hash hash;
        hash.add(std::span(bytes).first(head));
        hash.add(std::span(bytes).subspan(at, std::size_t(table[2 * part])));
        table[2 * part + 1] = hash.value();
        at += std::size_t(table[2 * part]);
    }
    std::memcpy(bytes.data() + head, table.data(), sizeof table);
}

/// A session whose controls are the last bytes of its snapshot, and their number.
std::pair<Session, std::size_t> steered() {
    auto session = session_with("double");
    add(session, Character{}, "walker", -8);
    const auto before = save(session).size();
    session.steering().set(id_of(session, "walker"), Controls{.along = 1, .up = 0.5});
    session.steering().set(id_of(session, "racer"), Controls{.along = -1, .jump = true});
    session.steering().play({.along = 1, .hold = true});
    return {session, save(session).size() - before};
}

/// Last bytes of a session that is steered by nobody: no keys, and four empty lists.
constexpr std::size_t of_nothing = 5;

/// A snapshot by the program of version 2, after half a second; and the hash after two, of a run that never stopped.
Bytes of_version_2() {
    std::ifstream file(test::source_dir() + "/tests/session/version-2.sinew", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}
constexpr std::uint64_t hash_after_two_seconds = 0x9fc9cb93702870a7U;

// A file of version 1 says nothing of controls: it opens, and those of the scene's events count.
TEST(Steering, IsOfTheSceneInAFileOfVersion1) {
    auto bytes = of_version_2();
    bytes.resize(bytes.size() - 3); // no keys, no figure, no parameters
    bytes[8] = std::byte{1};
    mend(bytes);
    auto opened = restored(bytes);
    opened.run_until(2);
    EXPECT_EQ(hash_of(opened), hash_after_two_seconds);
}

// Forces of version 2 get ids; a gust that blows then ends when it is due.
TEST(Steering, GoesOnInAFileOfVersion2) {
    auto opened = restored(of_version_2());
    const auto forces = [&] { return std::get<World<2, double>>(opened.world()).forces.size(); };
    EXPECT_EQ(forces(), 3U);
    EXPECT_EQ(opened.become(opened.scene()), "");
    EXPECT_EQ(forces(), 3U) << "those of the scene are known as such";
    opened.run_until(2);
    EXPECT_EQ(forces(), 2U);
    opened = restored(of_version_2());
    opened.run_until(2);
    EXPECT_EQ(hash_of(opened), hash_after_two_seconds);
}

TEST(Steering, ThatAFileLacksIsRefused) {
    auto bytes = save(session_with("double"));
    bytes.resize(bytes.size() - of_nothing);
    mend(bytes);
    SnapshotError error;
    EXPECT_FALSE(session_of(bytes, opened_scene, error));
    EXPECT_NE(error.text().find("ends early"), std::string::npos) << error.text();
}

// Damage of the controls with checksums to match: refused, or a session that goes on.
TEST(Steering, ForgedWithCareDoesNoHarm) {
    const auto [session, size] = steered();
    const auto whole = save(session);
    int accepted = 0, refused = 0;
    for (std::uint64_t i = 0; i < std::uint64_t(few_or_many(1500, 30000)); ++i) {
        Dice dice(i);
        auto forged = whole;
        for (int k = dice.below(3); k >= 0; --k)
            forged[forged.size() - 1 - std::size_t(dice.below(int(size + 100)))] = std::byte(dice.below(256));
        if (dice.one_of(10)) forged.resize(forged.size() - std::size_t(dice.below(int(size))));
        mend(forged);
        SnapshotError error;
        auto opened = session_of(forged, opened_scene, error);
        ++(opened ? accepted : refused);
        if (!opened) continue;
        EXPECT_EQ(save(*opened), forged) << "forgery " << i;
        for (int k = 0; k < 2; ++k) opened->step();
        const auto& world = std::get<World<2, double>>(opened->world());
        for (const auto& position : world.particles.position) ASSERT_TRUE(is_finite(position)) << "forgery " << i;
    }
    EXPECT_GT(accepted, 50);
    EXPECT_GT(refused, 50);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
