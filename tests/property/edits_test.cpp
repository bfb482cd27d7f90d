#include "sinew/math/random.h"
#include "sinew/topology/cut.h"
#include "sinew/world/measure.h"

#include "tests/scene/scene_runs.h"
#include "tests/thorough.h"

/// Whatever decides a step is state, or can be thrown away: in every scene, after an edit of any kind at a random step,
/// a copy goes where the original goes.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::uint64_t hash_of(const Session& session) {
    return std::visit([](const auto& world) { return state_hash(world); }, session.world());
}

/// Edits of a session, each at something chosen by a seed.
struct Edits {
    Session& session;
    std::uint64_t seed = 0;

    std::size_t below(std::size_t count, std::uint64_t which) const {
        return std::size_t(random::whole(0, std::int64_t(count) - 1, seed, 0, which));
    }
    template <class WorldT> ParticleId any(const WorldT& world, std::uint64_t which = 0) const {
        return world.particles.handles.id_of(Row(below(world.particles.size(), which)));
    }
    template <class WorldT> ConstraintId link(const WorldT& world) const {
        constexpr int kind = kind_number<Distance, WorldT::dimension>;
        const auto& table = std::get<kind>(world.constraints);
        return table.size() == 0 ? ConstraintId{}
                                 : ConstraintId{kind, table.handles.id_of(Row(below(table.size(), 2)))};
    }
    template <class F> void in_world(F&& edit) const {
        std::visit([&](auto& world) { edit(world); }, session.world());
    }

    static constexpr std::array names = {"pin",  "cut",   "remove", "weigh", "join",    "unpin", "add",
                                         "move", "drive", "freeze", "blade", "impulse", "grab",  "teleport"};
    void make(std::string_view name) const {
        if (name == "blade") return void(session.cut({session.focus()[0], session.focus()[1]}));
        if (name == "grab") return grab();
        in_world([&]<int D, class Real>(World<D, Real>& world) {
            if (world.particles.size() == 0) return;
            const auto id = any(world);
            if (name == "pin") pin(world, id);
            if (name == "cut") cut(world, std::array{link(world)});
            if (name == "remove") remove_particles(world, std::array{id});
            if (name == "weigh") set_mass(world, id, Real(2));
            if (name == "join") add<Distance>(world, {id, any(world, 1)});
            if (name == "unpin" && !world.pins.empty()) unpin(world, world.pin_handles.id_of(0));
            if (name == "add") add_particle(world, {.position = *position_of(world, id)});
            if (name == "move") set_position(world, id, *position_of(world, id) * Real(1.001));
            if (name == "drive") drive(world, link(world), Real(-0.1));
            if (name == "freeze") set_mass(world, id, std::numeric_limits<Real>::infinity());
            if (name == "impulse") apply_impulse(world, id, Vec<D, Real>::axis(1));
            if (name == "teleport") teleport(world, 0, Vec<D, Real>::axis(0) * Real(0.01));
        });
    }
    void grab() const {
        std::array<ParticleId, 1> ids{};
        Point at;
        in_world([&]<int D, class Real>(World<D, Real>& world) {
            if (world.particles.size() == 0) return;
            ids[0] = any(world);
            for (int i = 0; i < D; ++i) at[i] = double((*position_of(world, ids[0]))[i]);
        });
        session.grab(ids, at);
    }
};

struct EditsOf : ::testing::TestWithParam<std::string> {};

TEST_P(EditsOf, LeaveNothingBehindThatACopyLacks) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(1, 4)); ++seed) {
        auto session = open(GetParam(), "physical");
        ASSERT_TRUE(session);
        for (auto left = random::whole(5, 60, 5, seed, 0); left > 0; --left) session->step();
        for (const auto* name : Edits::names) {
            auto original = *session;
            Edits{original, seed}.make(name);
            for (int after = 0; after <= 2; ++after) {
                auto copy = original;
                copy.step();
                original.step();
                ASSERT_EQ(hash_of(copy), hash_of(original)) << name << ", " << after << " steps, copy, a step";
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Every, EditsOf, ::testing::ValuesIn(scene_names()),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace sinew::SINEW_TEST_FILE
