#include "sinew/prefab/prefabs.h"
#include "sinew/world/measure.h"

#include "tests/dice.h"
#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>
#include <limits>

/// Laws of blocks that are joined to a sweep: any figure of ropes, trees, skeletons, cloth, jelly and beads, masses
/// over six decades, joined anywhere; hung, thrown, dragged and released. Figures without a port have tests of their
/// own.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// Over six decades, kg.
double any_mass(Dice& dice) {
    return std::pow(10.0, dice.between(-3, 3));
}

template <int D> struct Joined {
    using World = test::Stepped<D, double>;
    using Vector = typename World::Vector;

    World world;
    Dice dice;
    double size = 0;
    std::vector<std::vector<ParticleId>> figures;

    explicit Joined(std::uint64_t seed) : dice(seed) {
        const int count = 2 + dice.below(4);
        for (int i = 0; i < count; ++i) add_any();
        let_go(); // trees come rooted
    }
    bool has_ports() {
        prepare(world);
        return !world.solver.blocks.ports.list.empty();
    }

    /// Another figure, a little beside the particle that it is joined to.
    void add_any() {
        Vector position{};
        const bool first = figures.empty();
        const auto to = first ? ParticleId{} : any_particle();
        for (int i = 0; i < D; ++i) position[i] = (first ? 0 : (*position_of(world, to))[i]) + dice.between(-0.1, 0.1);
        position[1] -= 0.1;
        const auto before = world.particles.size();
        build_any("figure_" + std::to_string(figures.size()), position);
        auto& ids = figures.emplace_back();
        for (auto row = Row(before); row < world.particles.size(); ++row)
            ids.push_back(world.particles.handles.id_of(row));
        if (first) return;
        const auto from = ids[std::size_t(dice.below(int(ids.size())))];
        const auto shift = position - *position_of(world, from);
        for (const auto id : ids) set_position(world, id, *position_of(world, id) + shift);
        const double length = distance(*position_of(world, from), *position_of(world, to));
        add<Distance>(world, {to, from}, {.limits = dice.below(2) ? at_most(length) : exactly(length)});
    }

    void build_any(const std::string& name, const Vector& at) {
        const int kind = dice.below(D == 2 ? 7 : 4);
        const double mass = any_mass(dice);
        if (kind == 0) {
            add_particle(world, {.position = at, .mass = mass});
            size += 0.2;
        } else if (kind == 1) {
            const Rope rope{.length = dice.between(0.2, 1.5),
                            .segments = 1 + dice.below(20),
                            .angle = dice.between(-2, 2),
                            .pinned = "none",
                            .mass = mass};
            build(world, rope, name, {.at = at});
            size += rope.length;
        } else if (kind < 4) {
            const int columns = 3 + dice.below(6), rows = 3 + dice.below(6);
            build(world, Cloth{.columns = columns, .rows = rows, .pins = "none", .mass = mass}, name, {.at = at});
            size += 0.1 * (columns + rows);
        } else if constexpr (D == 2) {
            if (kind == 4)
                build(world, Tree{}, name, {.at = at});
            else if (kind == 5)
                build(world, Polygon{.sides = 5 + dice.below(6), .radius = 0.2, .braced = "area", .mass = mass}, name,
                      {.at = at});
            else
                build(world, Ragdoll{.height = 1, .mass = mass}, name, {.at = at});
            size += 2;
        }
    }

    ParticleId any_particle() {
        const auto& ids = figures[std::size_t(dice.below(int(figures.size())))];
        return ids[std::size_t(dice.below(int(ids.size())))];
    }
    void let_go() {
        while (!world.pins.empty()) unpin(world, world.pin_handles.id_of(0));
    }
    double weight() const { return total_mass(world) * gravity; }

    /// The worst link of the blocks that are joined to what is swept.
    double worst_direct_stretch() {
        const auto& table = std::get<kind_number<Distance, D>>(world.constraints);
        double worst = 0;
        for (const auto& block : world.solver.blocks.attached_trees)
            for (std::uint32_t i = 0; i < block.links - block.load_tethers; ++i) {
                const auto ends = table.members.rows[world.solver.blocks.links[block.first_link + i].constraint];
                const auto row = world.solver.blocks.links[block.first_link + i].constraint;
                const double length = distance(world.particles.position[ends[0]], world.particles.position[ends[1]]);
                worst = std::max(worst, length / table.high(row) - 1);
                if (table.low(row) > 0) worst = std::max(worst, 1 - length / table.low(row));
            }
        return worst;
    }
    bool is_finite_everywhere() const {
        for (Row row = 0; row < world.particles.size(); ++row)
            if (!is_finite(world.particles.position[row]) || !is_finite(world.particles.velocity[row])) return false;
        return true;
    }
};

/// The most energy it gains in so many seconds, as a part of its weight times its size.
template <int D> double max_gain(Joined<D>& joined, double seconds) {
    const double before = energy(joined.world).total();
    double worst = 0;
    for (int frame = 0; frame < int(60 * seconds); ++frame) {
        step(joined.world, 1.0 / 60);
        if (!joined.is_finite_everywhere()) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, energy(joined.world).total() - before);
    }
    return worst / (joined.weight() * joined.size);
}

template <class Type> struct JoinedThings : ::testing::Test {};
using Doubles = ::testing::Types<In<2, double>, In<3, double>>;
TYPED_TEST_SUITE(JoinedThings, Doubles, Names);

constexpr int few = 8, many = 2000;
constexpr double slight = 1e-3; // of weight times size

/// Hangs a figure on one or two pins, and throws it.
template <int D> void hang_and_throw(Joined<D>& joined) {
    fall(joined.world, gravity);
    const int pins = 1 + joined.dice.below(2);
    for (int i = 0; i < pins; ++i) pin(joined.world, joined.any_particle());
    for (int i = 0; i < 3; ++i)
        set_velocity(joined.world, joined.any_particle(), at<Vec<D, double>>(joined.dice.between(-3, 3), 2));
}

TYPED_TEST(JoinedThings, HungThrownAndReleasedGainNoEnergy) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(few, many)); ++seed) {
        Joined<TypeParam::dimension> joined(seed);
        if (!joined.has_ports()) continue;
        hang_and_throw(joined);
        EXPECT_LE(max_gain(joined, 1), slight) << "hung and thrown, seed " << seed;
        joined.let_go();
        EXPECT_LE(max_gain(joined, 0.5), slight) << "released, seed " << seed;
    }
}

// Cloths of grams that a load has drawn out contract once they are let go, and would turn the whole faster and faster.
TYPED_TEST(JoinedThings, DrawnOutByALoadTheyGainNothingWhenLetGo) {
    for (const std::uint64_t seed : {12, 136, 143}) {
        Joined<TypeParam::dimension> joined(seed);
        if (!joined.has_ports()) continue;
        hang_and_throw(joined);
        run(joined.world, 1);
        joined.let_go();
        EXPECT_LE(max_gain(joined, 0.5), slight) << "seed " << seed;
    }
}

TYPED_TEST(JoinedThings, LooseKeepTheirMomentum) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(few, many)); ++seed) {
        Joined<TypeParam::dimension> joined(seed);
        if (!joined.has_ports()) continue;
        for (int i = 0; i < 3; ++i)
            set_velocity(joined.world, joined.any_particle(),
                         at<typename TypeParam::Vector>(joined.dice.between(-3, 3), 2));
        const auto before = momentum(joined.world);
        double amount = 0;
        for (Row row = 0; row < joined.world.particles.size(); ++row)
            amount += norm(joined.world.particles.velocity[row]) / joined.world.particles.inverse_mass[row];
        run(joined.world, 0.5);
        EXPECT_LE(norm(momentum(joined.world) - before) / amount, 1e-10) << "seed " << seed;
    }
}

/// The worst of the links solved at once in a second, of a figure that swings on one pin.
template <int D> double worst_direct_stretch(Joined<D>& joined) {
    fall(joined.world, gravity);
    pin(joined.world, joined.any_particle());
    double worst = 0;
    for (int frame = 0; frame < 60; ++frame) {
        step(joined.world, 1.0 / 60);
        worst = std::max(worst, joined.worst_direct_stretch());
    }
    return worst;
}

TYPED_TEST(JoinedThings, LinksSolvedAtOnceKeepTheirLengths) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(few, many)); ++seed) {
        Joined<TypeParam::dimension> joined(seed);
        if (!joined.has_ports()) continue;
        EXPECT_LE(worst_direct_stretch(joined), 1e-3) << "seed " << seed;
    }
}

// Cloths of grams between loads of kilograms: their motion multiplies, and is held back.
TYPED_TEST(JoinedThings, LinksSolvedAtOnceKeepTheirLengthsWhereMotionIsHeldBack) {
    for (const std::uint64_t seed : {93, 144, 384, 450, 552}) {
        Joined<TypeParam::dimension> joined(seed);
        if (!joined.has_ports()) continue;
        EXPECT_LE(worst_direct_stretch(joined), 1e-3) << "seed " << seed;
    }
}

/// A pin carries one particle about at 2 m/s and stops: from then on no energy comes in.
template <int D> void expect_no_gain_after_a_drag(std::uint64_t seed) {
    Joined<D> joined(seed);
    if (!joined.has_ports()) return;
    fall(joined.world, gravity);
    const auto carried = joined.any_particle();
    const auto from = *position_of(joined.world, carried);
    const auto held = *pin(joined.world, carried);
    for (int frame = 1; frame <= 30; ++frame) {
        move_pin(joined.world, held, from + at<typename Joined<D>::Vector>(frame / 30.0, 0));
        step(joined.world, 1.0 / 60);
        ASSERT_TRUE(joined.is_finite_everywhere()) << "seed " << seed << ", frame " << frame;
    }
    step(joined.world, 1.0 / 60);
    EXPECT_LE(max_gain(joined, 0.5), slight) << "seed " << seed;
}

TYPED_TEST(JoinedThings, DraggedGainNothingOnceTheyAreHeld) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(few, many)); ++seed)
        expect_no_gain_after_a_drag<TypeParam::dimension>(seed);
}

// The pin holds a jelly by a corner of its own, and parts it from all else: it has no port any more.
TYPED_TEST(JoinedThings, AJellyPartedByThePinGainsNothing) {
    if constexpr (TypeParam::dimension == 2)
        for (const std::uint64_t seed : {1517, 1609, 1731, 1833, 1963}) expect_no_gain_after_a_drag<2>(seed);
}

TYPED_TEST(JoinedThings, ACopyStepsAsItsOriginalOnAnyNumberOfThreads) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(few, many)); ++seed) {
        Joined<TypeParam::dimension> joined(seed);
        fall(joined.world, gravity);
        pin(joined.world, joined.any_particle());
        run(joined.world, 0.2);
        auto copy = joined.world;
        copy.solver.options.threads = 3;
        ASSERT_EQ(state_hash(copy), state_hash(joined.world)) << "seed " << seed;
        run(joined.world, 0.2);
        run(copy, 0.2);
        ASSERT_EQ(state_hash(copy), state_hash(joined.world)) << "seed " << seed;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
