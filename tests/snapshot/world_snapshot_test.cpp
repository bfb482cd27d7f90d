#include "sinew/math/hash.h"
#include "sinew/simulation.h"
#include "sinew/snapshot/snapshot.h"
#include "sinew/world/environment.h"
#include "sinew/world/fields.h"

#include "tests/random_calls.h"
#include "tests/thorough.h"

#include <cstring>

/// A world as bytes, and back.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;
using Bytes = std::vector<std::byte>;

template <class Type> struct WorldSnapshots : ::testing::Test {};
TYPED_TEST_SUITE(WorldSnapshots, Everywhere, Names);

TYPED_TEST(WorldSnapshots, HaveTheSameFutureAfterAnyCalls) {
    using Real = typename TypeParam::Real;
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(8, 80)); ++seed) {
        RandomCalls<typename TypeParam::World> calls(seed);
        for (int round = 0; round < 12; ++round) {
            for (int i = calls.below(4); i > 0; --i) calls.call();
            const Bytes saved = save(calls.world);
            typename TypeParam::World restored;
            const auto error = restore(restored, saved);
            ASSERT_FALSE(error) << error->text() << ", seed " << seed << ", round " << round;
            ASSERT_EQ(state_hash(restored), state_hash(calls.world)) << "seed " << seed << ", round " << round;
            ASSERT_EQ(save(restored), saved) << "saving what was restored gives the same bytes";
            for (int i = calls.below(3); i >= 0; --i) {
                step(calls.world, Real(1.0 / 60));
                step(restored, Real(1.0 / 60));
                ASSERT_EQ(state_hash(restored), state_hash(calls.world)) << "seed " << seed << ", round " << round;
            }
            for (const auto id : calls.particles)
                ASSERT_EQ(row_of(restored, id), row_of(calls.world, id)) << "ids hold in what is restored";
        }
    }
}

TYPED_TEST(WorldSnapshots, HandOutNoIdTwice) {
    typename TypeParam::World world;
    const auto first = add_particle(world, {});
    const Bytes saved = save(world);
    typename TypeParam::World restored;
    ASSERT_FALSE(restore(restored, saved));
    const auto second = add_particle(restored, {}), other = add_particle(world, {});
    EXPECT_TRUE(row_of(restored, first));
    EXPECT_NE(second.generation, other.generation);
    EXPECT_FALSE(row_of(world, second)) << "of a world that has parted";
}

/// Changes each field in turn that the list calls fixed or moving, and tells its name.
template <class WorldT, class Each> struct FieldSpoiler {
    WorldT& world;
    Each& each;
    std::string part;

    void enter(std::string_view name) { part = name; }
    template <class T> void fixed(std::string_view name, T& field) { spoil(name, field); }
    template <class T> void moving(std::string_view name, T& field) { spoil(name, field); }
    template <class T> void noted(std::string_view, T&) {}
    template <class T> void derived(std::string_view, T&) {}

    template <class T> void spoil(std::string_view name, T& field) {
        const auto before = field;
        if (change(field)) each(part + "." + std::string(name));
        field = before;
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    static bool change(T& field) {
        field = field == T(0) ? T(1) : T(0);
        return true;
    }
    template <class T>
    requires std::is_enum_v<T>
    static bool change(T& field) {
        field = field == T(0) ? T(1) : T(0);
        return true;
    }
    template <int N, class Real> static bool change(Vec<N, Real>& vector) {
        vector[0] += Real(1);
        return true;
    }
    template <int D, class Real> static bool change(collide::Rotation<D, Real>& turn) { return change(turn.number); }
    template <int D, class Real> static bool change(std::vector<Vec<D, Real>>& column) {
        if (column.empty()) return false;
        column.front()[0] += Real(1);
        return true;
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    static bool change(std::vector<T>& column) { return !column.empty() && change(column.front()); }
    template <class T> static bool change(Column<T>& column) {
        if (column.size() == 0) return false;
        T value = column[0];
        change(value);
        column.set(0, value);
        return true;
    }
    template <class Real> static bool change(LimitColumns<Real>& limits) {
        if (limits.size() == 0) return false;
        limits.set(0, limits.low(0) + 1, limits.high(0) + 1);
        return true;
    }
    template <int D, class Real> static bool change(std::vector<Pin<D, Real>>& pins) {
        if (!pins.empty()) pins.front().target[0] += Real(1);
        return !pins.empty();
    }
    template <int D, class Real> static bool change(std::vector<HalfSpace<D, Real>>& bounds) {
        if (!bounds.empty()) bounds.front().offset += Real(1);
        return !bounds.empty();
    }
    template <int D, class Real> static bool change(std::vector<KeptContact<D, Real>>& kept) {
        kept.push_back({.key = {{0, 1, 2, 3}}, .multiplier = Real(1)});
        return true;
    }
    static bool change(std::vector<Run>& sweep) {
        if (!sweep.empty()) ++sweep.front().count;
        return !sweep.empty();
    }
    template <class Real> static bool change(Settings<Real>& settings) {
        ++settings.substeps;
        return true;
    }
    template <int D, class Real> static bool change(ForceTable<D, Real>& forces) {
        forces.push_back(Gravity<D, Real>{});
        return true;
    }
    static bool change(std::vector<Figure>& figures) {
        if (!figures.empty()) figures.front().tethers = !figures.front().tethers;
        return !figures.empty();
    }
    template <class T> static bool change(T&) { return false; } // handles, names and members: by the calls above
};

// The columns that are hashed only where they are used are used here.
TYPED_TEST(WorldSnapshots, HoldNothingThatTheHashLeavesOut) {
    World<TypeParam::dimension, typename TypeParam::Real> world =
        menagerie<TypeParam::dimension, typename TypeParam::Real>();
    world.settings.sleep = {1, 1};
    std::size_t fields = 0;
    // The step and the hash read these where others ask for them.
    const std::array<std::string, 7> conditional = {
        "particles.any_force",    "particles.force",   "world.unused_figures", "contacts.kept_substep",
        "world.collider_handles", "contacts.touching", "particles.quarantined"};
    const auto hash = state_hash(world);
    const auto each = [&](const std::string& name) {
        ++fields;
        const bool is_motor = name.ends_with(".motor_speed") || name.ends_with(".damage") ||
                              name.ends_with(".damping_time") || name.ends_with(".damage_limit");
        if (std::ranges::find(conditional, name) != conditional.end() || is_motor) return;
        EXPECT_NE(state_hash(world), hash) << name << " is in a snapshot, but not in the hash";
    };
    visit_fields(world, FieldSpoiler<std::decay_t<decltype(world)>, decltype(each)>{world, each, {}});
    EXPECT_GT(fields, 40U);
    EXPECT_EQ(state_hash(world), hash);
}

Bytes some_world() {
    auto world = menagerie<2, float>();
    for (int i = 0; i < 5; ++i) step(world, 1.0F / 60);
    return save(world);
}

TEST(Snapshots, ThatEndEarlyAreRefused) {
    const auto whole = some_world();
    auto world = menagerie<2, float>();
    const auto hash = state_hash(world);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto error = restore(world, std::span(whole).first(size));
        ASSERT_TRUE(error) << size << " bytes of " << whole.size();
        ASSERT_LE(error->at, size);
    }
    EXPECT_EQ(state_hash(world), hash) << "nothing is half restored";
    auto longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_TRUE(restore(world, longer));
}

TEST(Snapshots, WithAFlippedBitAreRefused) {
    const auto whole = some_world();
    auto world = menagerie<2, float>();
    const auto hash = state_hash(world);
    for (std::size_t at = 0; at < whole.size(); ++at) {
        auto damaged = whole;
        damaged[at] ^= std::byte(1U << (at % 8));
        ASSERT_TRUE(restore(world, damaged)) << "byte " << at;
    }
    EXPECT_EQ(state_hash(world), hash);
}

TEST(Snapshots, OfOthersAreRefusedByName) {
    World<2, float> world;
    const auto text_of = [&](Bytes bytes) { return restore(world, bytes)->text(); };
    EXPECT_EQ(text_of({}), "byte 0: not a snapshot of Sinew");
    auto later = some_world();
    later[8] = std::byte{200};
    EXPECT_EQ(text_of(later), "byte 8: version 200 of the format; this program reads versions 1 to 3");
    World<3, float> other;
    EXPECT_EQ(restore(other, some_world())->text(), "byte 12: a world of another dimension or precision");
}

/// Sets the checksums to what the parts are.
void mend_checksums(Bytes& bytes) {
    std::size_t at = 64;
    for (std::size_t part = 0; part < 3; ++part) {
        std::uint64_t size = 0;
        std::memcpy(&size, bytes.data() + 16 + 16 * part, sizeof size);
        Hash hash;
        hash.add(std::span(bytes).first(16));
        hash.add(std::span(bytes).subspan(at, std::size_t(size)));
        const auto sum = hash.value();
        std::memcpy(bytes.data() + 24 + 16 * part, &sum, sizeof sum);
        at += std::size_t(size);
    }
}

// Damage with checksums to match: refused, or a world that goes on.
TEST(Snapshots, ForgedWithCareDoNoHarm) {
    const auto whole = some_world();
    int restored = 0, refused = 0;
    const SnapshotLimits limits{.memory = 100'000'000};
    for (std::uint64_t i = 0; i < std::uint64_t(few_or_many(3000, 30000)); ++i) {
        auto forged = whole;
        for (std::uint64_t k = 0; k <= i % 3; ++k) {
            const auto at = std::size_t(random::whole(64, std::int64_t(forged.size()) - 1, 1, i, 2 * k));
            forged[at] = std::byte(random::whole(0, 255, 1, i, 2 * k + 1));
        }
        mend_checksums(forged);
        test::Stepped<2, float> world;
        if (restore(world, forged, limits)) {
            ++refused;
            continue;
        }
        ++restored;
        for (int k = 0; k < 3; ++k) step(world, 1.0F / 60);
        for (const auto& position : world.particles.position) ASSERT_TRUE(is_finite(position)) << "forgery " << i;
        ASSERT_FALSE(save(world).empty());
    }
    EXPECT_GT(restored, 100);
    EXPECT_GT(refused, 100);
}

TEST(Snapshots, AreSmall) {
    Simulation<2, float> rope, cloth, ragdolls;
    build(rope.world, Rope{.length = 100, .segments = 5000}, "rope");
    build(cloth.world, Cloth{.columns = 64, .rows = 64}, "cloth");
    for (int i = 0; i < 100; ++i) build(ragdolls.world, Ragdoll{}, "ragdoll" + std::to_string(i));
    for (auto* one : {&rope, &cloth, &ragdolls}) {
        set_gravity(one->world, {0, -9.81F});
        for (int i = 0; i < 20; ++i) one->step(1.0F / 60);
        const double bytes = double(save(one->world).size()) / double(one->world.particles.size());
        const char* name = one == &rope ? "rope" : one == &cloth ? "cloth" : "ragdolls";
        RecordProperty(name, std::to_string(bytes));
        std::printf("%s: %zu particles, %.1f bytes each\n", name, one->world.particles.size(), bytes);
        EXPECT_LE(bytes, one == &ragdolls ? 300 : 60) << name << "; of ragdolls most is names and pieces";
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
