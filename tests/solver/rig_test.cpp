#include "sinew/world/rig.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"
#include "tests/worlds.h"

/// What is wrong with a rig, by name.
namespace sinew::SINEW_TEST_FILE {
namespace {

using Plane = test::Stepped<2, double>;

/// A figure "rig" of particles a, b, c, ... at places, whose links can be given names.
struct Rig {
    Plane world;
    std::vector<ParticleId> p;

    explicit Rig(std::initializer_list<Vec2<double>> positions) {
        add_figure(world, "rig");
        for (const auto& position : positions) {
            p.push_back(add_particle(world, {.position = position, .figure = 0}));
            world.figures[0].particles.push_back(p.back());
            world.figures[0].particle_names.emplace_back(std::string(1, char('a' + p.size() - 1)), p.back());
        }
    }
    ConstraintId link(std::size_t a, std::size_t b, ConstraintSpec<double> spec = {}, std::string_view name = "") {
        return remember(*add<Distance>(world, {p[a], p[b]}, spec), name);
    }
    ConstraintId remember(ConstraintId id, std::string_view name) {
        visit_table(world, id.kind, [&](auto& table) { table.figure.set(table.size() - 1, 0); });
        world.figures[0].constraints.push_back(id);
        if (!name.empty()) world.figures[0].constraint_names.emplace_back(name, id);
        return id;
    }
    std::vector<std::string> faults() const {
        std::vector<std::string> texts;
        for (const auto& fault : rig_faults(world)) texts.push_back(fault.where + " " + fault.what);
        return texts;
    }
};

using Texts = std::vector<std::string>;

TEST(RigCheck, FindsLimitsThatNothingCanMeet) {
    Rig rig({{{0, 0}}, {{1, 0}}, {{2, 0}}});
    rig.link(0, 1, {}, "upper");
    rig.link(1, 2);
    auto& links = std::get<0>(rig.world.constraints);
    links.limits.set(0, 2, links.high(0)); // as only a program can say it: scenes are refused
    links.limits.set(1, -limit::measure<double>, -1);
    EXPECT_EQ(rig.faults(), (Texts{"rig/upper its low limit is above its high one: its limits are 2 to 1",
                                   "distance of rig/b, rig/c no distance is below 0: its limits are at most -1"}));
}

TEST(RigCheck, FindsLimitsThatThePoseBreaksUnlessTheyGive) {
    Rig rig({{{0, 0}}, {{1, 0}}, {{1, 1}}});
    rig.link(0, 1, {.limits = at_least(1.5)}, "bone");
    rig.link(1, 2, {.limits = exactly(0.9995)});
    rig.link(1, 2, {.limits = exactly(3.0), .compliance = 1e-6}, "spring");
    const double degree = pi<double> / 180;
    rig.remember(*add<Angle>(rig.world, {rig.p[0], rig.p[1], rig.p[2]}, {.limits = between(-5 * degree, 80 * degree)}),
                 "knee");
    EXPECT_EQ(rig.faults(), (Texts{"rig/bone stands at 1, its limits are at least 1.5",
                                   "rig/knee stands at 90, its limits are -5 to 80"}));
}

TEST(RigCheck, FindsWhatIsHeldOutOfReach) {
    Rig rig({{{0, 0}}, {{1, 0}}, {{2, 0}}, {{5, 0}}});
    rig.link(0, 1, {.limits = at_most(1.0)});
    rig.link(1, 2, {.limits = at_most(1.5)});
    rig.link(2, 3, {.limits = at_most(4.0)});
    pin(rig.world, rig.p[0]);
    pin(rig.world, rig.p[2]);
    EXPECT_EQ(rig.faults(), Texts{});
    pin(rig.world, rig.p[3]);
    EXPECT_EQ(rig.faults(), Texts{});
    set_position(rig.world, rig.p[3], {{8, 0}}); // where its pin has yet to bring it is not asked
    EXPECT_EQ(
        rig.faults(),
        (Texts{"distance of rig/c, rig/d stands at 6, its limits are at most 4, and none of its particles can move",
               "rig/a is held 8 from rig/d, but the links between them reach 6.5",
               "rig/c is held 6 from rig/d, but the links between them reach 4"}));
}

TEST(RigCheck, FindsATriangleThatCannotClose) {
    Rig rig({{{0, 0}}, {{1, 0}}, {{0.5, 0.1}}});
    rig.link(0, 1, {.limits = exactly(3.0)}, "long");
    rig.link(1, 2, {.limits = at_most(1.0)});
    rig.link(2, 0, {.limits = at_most(1.0)});
    const auto faults = rig.faults();
    ASSERT_EQ(faults.size(), 2U);
    EXPECT_EQ(faults[1], "rig/long is at least 3, but other links join its ends within 2");
    std::get<0>(rig.world.constraints).compliance.set(1, 1e-3); // what gives is no hindrance
    EXPECT_EQ(rig.faults().size(), 1U);
}

TEST(RigCheck, FindsALoopThatNothingMoves) {
    Rig rig({{{0, 0}}, {{1, 0}}, {{0, 1}}});
    for (const auto id : rig.p) set_mass(rig.world, id, std::numeric_limits<double>::infinity());
    rig.link(0, 1);
    rig.link(1, 2);
    EXPECT_EQ(rig.faults(), Texts{});
    rig.link(2, 0, {}, "last");
    EXPECT_EQ(rig.faults(), Texts{"rig/last closes a loop of particles without mass: nothing moves it"});
    set_mass(rig.world, rig.p[1], 1.0);
    EXPECT_EQ(rig.faults(), Texts{});
}

TEST(RigCheck, FindsNothingInTheEnginesOwnFiguresAndNoMoreThanAsked) {
    EXPECT_TRUE(rig_faults(make(Ragdoll{}).world).empty());
    EXPECT_TRUE((rig_faults(make<3, float>(Cloth{}).world).empty()));
    auto cloth = make(Cloth{.columns = 60, .rows = 60, .bend = true, .bend_elasticity = {.compliance = 0}});
    EXPECT_TRUE(rig_faults(cloth.world).empty());
    for (auto& position : cloth.world.particles.position) position *= 2;
    EXPECT_EQ(rig_faults(cloth.world, 7).size(), 7U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
