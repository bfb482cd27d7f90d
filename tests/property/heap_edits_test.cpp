#include "sinew/topology/cut.h"
#include "sinew/world/measure.h"

#include "tests/crates.h"
#include "tests/heap.h"
#include "tests/thorough.h"

#include <array>
#include <limits>
#include <string>
#include <string_view>

/// Whatever decides a step is state, or can be thrown away: after an edit of any kind at any step of a heap, a copy
/// goes where the original goes.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct HeapEdits : ::testing::Test {};
TYPED_TEST_SUITE(HeapEdits, Everywhere, Names);

/// Edits of a world, each at something drawn.
template <int D, class Real> class Edits {
  public:
    using V = Vec<D, Real>;
    static constexpr std::array names = {"throw",   "nudge",  "velocity", "limits",   "compliance", "radius",
                                         "mass",    "freeze", "pin",      "cut",      "remove",     "remove a figure",
                                         "carry",   "drive",  "force",    "teleport", "add",        "join",
                                         "contact", "gravity"};

    Edits(World<D, Real>& world, Dice& dice) : world_(world), dice_(dice) {}

    void make(std::string_view name) {
        if (world_.particles.size() == 0) return;
        const auto id = any();
        if (name == "throw") return throw_some();
        if (name == "nudge") set_position(world_, id, *position_of(world_, id) + place() * Real(0.02));
        if (name == "velocity") set_velocity(world_, id, place() * Real(3));
        if (name == "limits") set_limits(world_, link(), dice_.one_of(2) ? at_most(length()) : exactly(length()));
        if (name == "compliance") set_compliance(world_, link(), Real(dice_.one_of(2) ? 0 : dice_.scale(1e-8, 1e-2)));
        if (name == "radius") set_radius(world_, id, Real(dice_.scale(0.01, 0.3)));
        if (name == "mass") set_mass(world_, id, Real(dice_.scale(0.001, 100)));
        if (name == "freeze") set_mass(world_, id, std::numeric_limits<Real>::infinity());
        if (name == "pin") pin(world_, id, {.target = place()});
        if (name == "cut") cut(world_, std::array{link()});
        if (name == "remove") remove_particles(world_, std::array{id});
        if (name == "remove a figure") remove_figure(world_, figure());
        if (name == "carry") carry_collider();
        if (name == "drive") drive(world_, link(), Real(-0.3));
        if (name == "force") set_max_force(world_, link(), Real(dice_.scale(0.1, 1000)));
        if (name == "teleport") teleport(world_, figure(), place());
        if (name == "add") add_particle(world_, {.position = place(), .figure = figure()});
        if (name == "join") add<Distance>(world_, {id, any()});
        if (name == "contact")
            set_contact(world_, figure(), {.figures = dice_.one_of(2), .itself = dice_.one_of(2), .bounce = 0.5});
        if (name == "gravity") world_.forces = {Gravity<D, Real>{place()}};
    }

  private:
    World<D, Real>& world_;
    Dice& dice_;

    ParticleId any() { return world_.particles.handles.id_of(Row(dice_.below(int(world_.particles.size())))); }
    FigureIndex figure() { return FigureIndex(dice_.below(int(world_.figures.size()))); }
    V place() {
        return V::map([&](int) { return Real(dice_.between(-3, 5)); });
    }
    Real length() { return Real(dice_.scale(0.05, 2)); }
    ConstraintId link() {
        constexpr int kind = kind_number<Distance, D>;
        const auto& table = std::get<kind>(world_.constraints);
        if (table.size() == 0) return {};
        return {kind, table.handles.id_of(Row(dice_.below(int(table.size()))))};
    }
    /// Particles far from their links, and areas turned over.
    void throw_some() {
        for (int left = 1 + dice_.below(3); left > 0; --left) set_position(world_, any(), place());
    }
    void carry_collider() {
        if (!world_.colliders.empty()) move_collider(world_, world_.collider_handles.id_of(0), {.position = place()});
    }
};

template <int D, class Real> void expect_copy_follows(Stepped<D, Real>& original, const std::string& text) {
    for (int after = 0; after < 4; ++after) {
        auto copy = original;
        step(copy, Real(1) / 60);
        step(original, Real(1) / 60);
        ASSERT_EQ(state_hash(copy), state_hash(original)) << text << ", " << after << " steps, copy, a step";
    }
}

TYPED_TEST(HeapEdits, LeaveNothingBehindThatACopyLacks) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    const int cases = few_or_many(2, 60);
    for (int seed = 1; seed <= cases; ++seed)
        for (std::size_t i = 0; i < Edits<D, Real>::names.size(); ++i) {
            Heap<D, Real> heap{std::uint64_t(seed)};
            auto& original = heap.world();
            Dice dice(100 * std::uint64_t(seed) + i);
            for (int left = dice.below(40); left > 0; --left) step(original, Real(1) / 60);
            Edits<D, Real>(original, dice).make(Edits<D, Real>::names[i]);
            expect_copy_follows(original,
                                std::string(Edits<D, Real>::names[i]) + ", seed " + std::to_string(seed) + heap.text());
            if (this->HasFatalFailure()) return;
        }
}

// A rigid cluster keeps the sides of its particles, and an area the side on which it is solid, only while they are so.
TEST(HeapEdits, ACrateIsTurnedOverByACorner) {
    FlatWorld<double> world;
    add_ground(world);
    const auto crate = add_crate(world, 0, 0.5, 1, 4);
    add_crate(world, 0.2, 1.55, 1, 4);
    run(world, 0.5);
    set_position(world, crate[0], V2<double>{{1.4, 1.3}});
    expect_copy_follows(world, "a corner beyond the opposite one");
    set_position(world, crate[0], V2<double>{{-1.4, -0.3}});
    expect_copy_follows(world, "and back");
}
// A particle is on the far side of the link that it touched before.
TEST(HeapEdits, ABallIsPutBehindTheRodOnWhichItLay) {
    FlatWorld<double> world;
    fall(world, 10);
    const auto rod = add_touching(world, 0.3), ball = add_touching(world, 0.3);
    Stepped<2, double>& w = world;
    const auto a = add_particle(w, {.position = {{-1, 0}}, .mass = 1, .radius = 0.05, .figure = rod});
    const auto b = add_particle(w, {.position = {{1, 0}}, .mass = 1, .radius = 0.05, .figure = rod});
    add<Distance>(w, {a, b}, {.figure = rod});
    for (const auto end : {a, b}) pin(w, end);
    world.figures[rod].particles = {a, b};
    world.figures[rod].pieces.push_back({.mark = Mark::stroke, .particles = {a, b}});
    const auto c = add_particle(w, {.position = {{0.1, 0.15}}, .mass = 1, .radius = 0.1, .figure = ball});
    world.figures[ball].particles = {c};
    run(world, 0.5);
    ASSERT_NEAR((*position_of(w, c))[1], 0.15, 0.01);
    set_position(w, c, V2<double>{{0.1, -0.17}});
    expect_copy_follows(world, "just behind");
    EXPECT_LT((*position_of(w, c))[1], -0.17) << "what does not touch is not pulled through";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
