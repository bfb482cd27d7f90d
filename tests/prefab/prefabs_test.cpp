#include "tests/prefab/make.h"
#include "tests/stepped.h"

#include <gtest/gtest.h>
#include <set>

namespace sinew::SINEW_TEST_FILE {
namespace {

Mode any_mode() {
    return *rc::gen::element(Mode::physical, Mode::classic);
}

/// How much rounding a coordinate of this world may carry.
template <class Real, class WorldT> double rounding(const WorldT& world) {
    double largest = 1e-6;
    for (const auto& position : world.particles.position) largest = std::max(largest, double(norm(position)));
    return 8 * double(std::numeric_limits<Real>::epsilon()) * largest;
}

TEST(EveryPrefab, MakesNoMoreThanItsSizesSay) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        const auto made = make<D, Real>(prefab, any_mode());
        RC_ASSERT(made.particles() <= prefab.sizes().particles);
        RC_ASSERT(made.constraints() <= prefab.sizes().constraints);
        RC_ASSERT(made.figure().particles.size() == made.particles());
    });
}

double shortest_leg(const auto& world, std::span<const Row> members) {
    double shortest = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < members.size(); ++i)
        shortest = std::min(
            shortest, double(distance(world.particles.position[members[i - 1]], world.particles.position[members[i]])));
    return shortest;
}

TEST(EveryPrefab, StandsInWorldsOfEitherUpWithEveryRigidConstraintMet) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        const int up = *rc::gen::element(-1, 1);
        const double turn = *rc::gen::inRange(-180, 180) * pi<double> / 180;
        const auto made = make<D, Real>(prefab, any_mode(), {.at = {}, .turn = turn, .up = up});
        const double length_error = rounding<Real>(made.world);
        for_each_table(made.world, [&](const auto& table) {
            using Kind = typename std::decay_t<decltype(table)>::Kind;
            for (Row row = 0; row < table.size(); ++row) {
                if (table.compliance[row] > Real(0))
                    continue; // a stiff rope that is built in an arc strives to be straight
                const auto state =
                    constraint_state(made.world, {Kinds<D>::template index_of<Kind>, table.handles.id_of(row)}).value();
                double allowed = length_error;
                if (Kind::length_power == 0) // radians; short pieces in a float world
                    allowed = 1e-3 + 4 * length_error / shortest_leg(made.world, table.members[row]);
                if (Kind::length_power == 2) allowed *= std::sqrt(std::abs(state.measure)) * 10;
                RC_ASSERT(std::abs(state.error) <= allowed);
            }
        });
    });
}

TEST(EveryPrefab, MirrorsBetweenYUpAndYDown) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        const auto mode = any_mode();
        const auto up = make<D, Real>(prefab, mode, {.at = {}, .turn = 0.3, .up = 1});
        const auto down = make<D, Real>(prefab, mode, {.at = {}, .turn = 0.3, .up = -1});
        RC_ASSERT(up.particles() == down.particles());
        for (std::size_t row = 0; row < up.particles(); ++row) {
            auto mirrored = down.world.particles.position[row];
            mirrored[1] = -mirrored[1];
            RC_ASSERT(mirrored == up.world.particles.position[row]);
        }
    });
}

TEST(EveryPrefab, WeighsItsMassInPhysicalModeAndOneAParticleInClassic) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        double mass = prefab.mass;
        if constexpr (requires { prefab.weight; }) mass += prefab.weight;
        RC_ASSERT(std::abs(whole_mass(make<D, Real>(prefab, Mode::physical).world) - mass) <= 1e-5 * mass);
        if constexpr (requires { prefab.weighs_in_classic; }) return;
        const auto classic = make<D, Real>(prefab, Mode::classic);
        for (const auto inverse : classic.world.particles.inverse_mass) RC_ASSERT(inverse == Real(1));
    });
}

TEST(EveryPrefab, HasNamesThatLeadToItsParticlesAndNoTwoAlike) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        const auto made = make<D, Real>(prefab, any_mode());
        const auto& figure = made.figure();
        std::set<std::string> seen;
        const auto called = [&](const std::string& name, ParticleId id) {
            RC_ASSERT(seen.insert(name).second);
            RC_ASSERT(find_particle(made.world, "it/" + name) == id);
        };
        for (const auto& [name, id] : figure.particle_names) called(name, id);
        for (std::size_t i = 0; i < figure.particles.size(); ++i)
            if (const auto name = name_of(i, figure.particle_numbers); !name.empty()) called(name, figure.particles[i]);
    });
}

TEST(EveryPrefab, NamesEachOfItsConstraintsOnce) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        const auto made = make<D, Real>(prefab, any_mode());
        const auto& figure = made.figure();
        std::set<std::string> seen;
        const auto called = [&](const std::string& name, ConstraintId id) {
            RC_ASSERT(seen.insert(name).second);
            RC_ASSERT(find_constraint(made.world, "it/" + name) == id);
        };
        for (const auto& [name, id] : figure.constraint_names) called(name, id);
        for (std::size_t i = 0; i < figure.constraints.size(); ++i)
            if (const auto name = name_of(i, figure.constraint_numbers); !name.empty())
                called(name, figure.constraints[i]);
        RC_ASSERT(seen.size() == figure.constraints.size());
    });
}

TEST(EveryPrefab, DrawsPiecesOfItsOwnParticles) {
    for_every_prefab([]<int D, class Real>(const auto& prefab) {
        const auto made = make<D, Real>(prefab, any_mode());
        RC_ASSERT(!made.figure().pieces.empty());
        for (const auto& piece : made.figure().pieces) {
            RC_ASSERT(!piece.part.empty());
            RC_ASSERT(!piece.particles.empty());
            for (const auto id : piece.particles) RC_ASSERT(row_of(made.world, id).has_value());
        }
    });
}

/// Fails where a default is outside of its own field's range.
struct InRange {
    void operator()(double value, const Field& field) const {
        EXPECT_GE(value, field.low) << field.name;
        EXPECT_LE(value, field.high) << field.name;
    }
    void operator()(const std::string& value, const Field& field) const {
        if (field.choices.empty()) return; // any text
        EXPECT_NE(std::find(field.choices.begin(), field.choices.end(), value), field.choices.end()) << field.name;
    }
    void operator()(const std::vector<double>&, const Field&) const {}
};

TEST(EveryPrefab, HasDefaultsThatItsFieldsAllowAndAHelpForEach) {
    Prefabs::for_each([]<class Prefab>(std::type_identity<Prefab>) {
        Prefab prefab;
        std::set<std::string_view> names;
        Prefab::fields(prefab, [&](auto& value, const Field& field) {
            InRange{}(value, field);
            EXPECT_FALSE(field.help.empty()) << field.name;
            EXPECT_TRUE(names.insert(field.name).second) << field.name;
        });
        for (int d = Prefab::dimensions.lowest; d <= Prefab::dimensions.highest; ++d)
            EXPECT_EQ(problem_of(prefab, d), std::nullopt) << Prefab::name;
    });
}

TEST(EveryPrefab, IsFoundByItsName) {
    Prefabs::for_each([]<class Prefab>(std::type_identity<Prefab>) {
        const auto found = make_prefab(Prefab::name);
        ASSERT_TRUE(found);
        EXPECT_TRUE(std::holds_alternative<Prefab>(*found));
        EXPECT_EQ(name_of(*found), Prefab::name);
        EXPECT_EQ(sizes_of(*found).particles, Prefab{}.sizes().particles);
    });
    EXPECT_FALSE(make_prefab("ragdol"));
}

TEST(EveryPrefab, IsRefusedInADimensionItDoesNotExistIn) {
    test::Stepped<3, double> world;
    EXPECT_EQ(problem_of(StickFigure{}, 3), "there is no stick_figure in 3 dimensions");
    EXPECT_EQ(build(world, AnyPrefab(StickFigure{}), "bob"), std::nullopt);
    EXPECT_TRUE(world.figures.empty());
    EXPECT_EQ(build(world, AnyPrefab(Rope{}), "rope"), FigureIndex(0));
}

TEST(EveryPrefab, IsRefusedIfItsParticlesWouldBeLighterThanAParticleCanBe) {
    EXPECT_EQ(problem_of(Balls{.columns = 1000, .rows = 1000, .mass = 1e-6}, 2), std::nullopt);
    EXPECT_EQ(problem_of(Balls{.columns = 1001, .rows = 1000, .mass = 1e-6}, 2),
              "a mass of 1e-6 is too little for 1001000 particles: each weighs 1e-12 at least");
}

TEST(EveryPrefab, TellsItsSizesForBillionsWithoutMakingAny) {
    constexpr int billion = 1'000'000'000;
    EXPECT_EQ(Rope{.segments = billion}.sizes().particles, std::size_t(billion) + 1);
    EXPECT_EQ(Chain{.links = billion}.sizes().constraints, 2 * std::size_t(billion) - 1);
    EXPECT_EQ(Polygon{.sides = billion}.sizes().constraints, 2 * std::size_t(billion));
    const Cloth cloth{.columns = billion, .rows = billion, .bend = true};
    EXPECT_EQ(cloth.sizes().particles, std::size_t(billion) * billion);
    EXPECT_EQ(cloth.sizes().constraints, 6 * std::size_t(billion) * billion);
}

TEST(EveryPrefab, HasTheSameLengthsHoweverFarOutItStands) {
    const auto near = make<2, float>(Rope{.segments = 50});
    const auto far = make<2, float>(Rope{.segments = 50}, Mode::physical, {.at = {{10'000, 10'000}}});
    const auto lengths = [](const auto& made) { return std::get<0>(made.world.constraints).limits.highs(); };
    EXPECT_EQ(lengths(near), lengths(far));
}

TEST(NamesByNumber, CountFromTheFirstInRowsOrNot) {
    const std::vector<Numbered> rules{{"corner", 2, 3}, {"particle", 5, 12, 4}};
    EXPECT_EQ(number_called("corner_0", rules), 2U);
    EXPECT_EQ(number_called("corner_2", rules), 4U);
    EXPECT_EQ(number_called("particle_3_2", rules), 5U + 2 * 4 + 3);
    EXPECT_EQ(name_of(4, rules), "corner_2");
    EXPECT_EQ(name_of(16, rules), "particle_3_2");
    EXPECT_EQ(name_of(1, rules), "");
    EXPECT_EQ(name_of(17, rules), "");
}

TEST(NamesByNumber, AreWrittenInOneWayOnly) {
    const std::vector<Numbered> rules{{"corner", 0, 20}, {"particle", 20, 12, 4}};
    for (const auto* name : {"corner", "corner_", "corner_20", "corner_01", "corner_-1", "corner_+1", "corner_1 ",
                             "corner_1_1", "corner_99999999999999999999", "particle_1", "particle_4_0", "particle_0_3",
                             "particle_0_00", "particle_0_0_0", "article_0_0", ""})
        EXPECT_EQ(number_called(name, rules), std::nullopt) << name;
}

TEST(NamesByNumber, StayWithTheirParticlesWhenOthersAreRemoved) {
    auto made = make(Rope{.segments = 5});
    const auto third = find_particle(made.world, "it/particle_3");
    const auto first = find_particle(made.world, "it/particle_1").value();
    remove_particles(made.world, std::span(&first, 1));
    EXPECT_EQ(find_particle(made.world, "it/particle_3"), third);
    EXPECT_EQ(find_particle(made.world, "it/particle_1"), std::nullopt);
    EXPECT_EQ(find_constraint(made.world, "it/link_0"), std::nullopt);
    EXPECT_TRUE(find_constraint(made.world, "it/link_2"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
