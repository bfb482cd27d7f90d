#include "sinew/math/random.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"
#include "tests/thorough.h"

#include <cstdio>
#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr Placement<2, double> y_down{.at = {}, .turn = 0, .up = -1};

struct Spot {
    std::string_view name;
    double x, y;
};

/// The Roblox ragdoll's points, pixels, y down, in the order in which they were made.
constexpr Spot original_points[] = {
    {"left_shoulder", -10, 0}, {"right_shoulder", 10, 0}, {"left_hip", -10, 40},   {"right_hip", 10, 40},
    {"center", 0, 0},          {"head_left", -10, -30},   {"head_right", 10, -30}, {"left_elbow", -45, 5},
    {"right_elbow", 45, 5},    {"left_hand", -70, 20},    {"right_hand", 70, 20},  {"left_knee", -25, 80},
    {"right_knee", 25, 80},    {"left_foot", -20, 130},   {"right_foot", 20, 130},
};

struct Segment {
    std::string_view from, to;
    bool visible;
};

constexpr Segment original_segments[] = {
    {"left_shoulder", "right_shoulder", true}, {"left_hip", "right_hip", true},
    {"left_shoulder", "left_hip", true},       {"right_shoulder", "right_hip", true},
    {"head_left", "head_right", true},         {"left_shoulder", "head_left", true},
    {"right_shoulder", "head_right", true},    {"left_shoulder", "left_elbow", true},
    {"left_elbow", "left_hand", true},         {"right_shoulder", "right_elbow", true},
    {"right_elbow", "right_hand", true},       {"left_hip", "left_knee", true},
    {"left_knee", "left_foot", true},          {"right_hip", "right_knee", true},
    {"right_knee", "right_foot", true},        {"left_shoulder", "right_hip", false},
    {"right_shoulder", "left_hip", false},     {"right_shoulder", "head_left", false},
    {"left_shoulder", "head_right", false},    {"left_hip", "left_foot", false},
    {"right_hip", "right_foot", false},
};

TEST(Ragdoll, InClassicModeHasTheOriginalsPointsInTheirOrder) {
    const auto made = make(Ragdoll{}, Mode::classic, y_down);
    ASSERT_EQ(made.particles(), std::size(original_points));
    Row row = 0;
    for (const auto& [name, x, y] : original_points) {
        EXPECT_EQ(row_of(made.world, find_particle(made.world, "it/" + std::string(name)).value()), row++) << name;
        EXPECT_NEAR(made.position(name)[0] * 100, x, 1e-12) << name;
        EXPECT_NEAR(made.position(name)[1] * 100, y, 1e-12) << name;
    }
}

TEST(Ragdoll, InClassicModeHasTheOriginalsSegmentsInTheirOrderVisibleOrNot) {
    const auto made = make(Ragdoll{}, Mode::classic, y_down);
    const auto& rods = std::get<kind_number<Distance, 2>>(made.world.constraints);
    ASSERT_EQ(rods.size(), std::size(original_segments));
    ASSERT_EQ(made.constraints(), std::size(original_segments));
    ASSERT_EQ(made.figure().pieces.size(), std::size(original_segments));
    for (Row i = 0; i < rods.size(); ++i) {
        const auto& [from, to, visible] = original_segments[i];
        const auto& piece = made.figure().pieces[i];
        const std::vector ends{find_particle(made.world, "it/" + std::string(from)).value(),
                               find_particle(made.world, "it/" + std::string(to)).value()};
        EXPECT_EQ(rods.members[i][0], row_of(made.world, ends[0])) << from << " " << to;
        EXPECT_EQ(rods.members[i][1], row_of(made.world, ends[1])) << from << " " << to;
        EXPECT_NEAR(rods.low(i), distance(made.position(from), made.position(to)), 1e-12);
        EXPECT_EQ(rods.low(i), rods.high(i));
        EXPECT_EQ(piece.particles, ends);
        EXPECT_EQ(piece.hidden, !visible) << from << " " << to;
        EXPECT_NEAR(piece.width * 100, visible ? 7 : 0, 1e-12);
    }
}

TEST(Ragdoll, GrowsWithItsHeight) {
    const auto small = make(Ragdoll{.height = 1.6}, Mode::classic), large = make(Ragdoll{.height = 3.2}, Mode::classic);
    EXPECT_NEAR(large.position("left_hand")[0], 2 * small.position("left_hand")[0], 1e-12);
    EXPECT_NEAR(large.position("head_left")[1] - large.position("left_foot")[1], 3.2, 1e-12);
    EXPECT_EQ(large.figure().pieces[0].width, 2 * small.figure().pieces[0].width);
}

TEST(Ragdoll, IsTheSameOnBothSides) {
    for (const auto mode : {Mode::classic, Mode::physical}) {
        const auto made = make(Ragdoll{}, mode);
        for (const std::string part : {"shoulder", "elbow", "hand", "hip", "knee", "foot"}) {
            const auto left = made.position("left_" + part), right = made.position("right_" + part);
            EXPECT_EQ(left[0], -right[0]) << part;
            EXPECT_EQ(left[1], right[1]) << part;
            EXPECT_EQ(made.mass("left_" + part), made.mass("right_" + part)) << part;
        }
        for (const auto& [name, id] : made.figure().constraint_names)
            if (name.starts_with("left_")) {
                const auto left = made.constraint(name), right = made.constraint("right" + name.substr(4));
                EXPECT_NEAR(std::abs(left.measure), std::abs(right.measure), 1e-12) << name;
            }
    }
}

TEST(Ragdoll, InPhysicalModeWeighsMostInItsTrunk) {
    const auto made = make(Ragdoll{.mass = 80});
    EXPECT_NEAR(whole_mass(made.world), 80, 1e-12);
    EXPECT_GT(made.mass("left_hip"), made.mass("left_knee"));
    EXPECT_GT(made.mass("left_knee"), made.mass("left_foot"));
    EXPECT_GT(made.mass("left_elbow"), made.mass("left_hand"));
}

/// The turn at a joint in degrees, counter-clockwise as seen.
template <class Real> double turn_at(const Made<2, Real>& made, std::string_view name, int up) {
    return up * made.constraint(name).measure * 180 / pi<double>;
}

TEST(Ragdoll, BendsItsKneesAndElbowsOneWayWhicheverWayYPoints) {
    const auto classic = make(Ragdoll{}, Mode::classic);
    EXPECT_EQ(std::get<(kind_number<Angle, 2>)>(classic.world.constraints).size(), 0U);
    for (const int up : {-1, 1}) {
        const auto made = make<2, double>(Ragdoll{}, Mode::physical, {.at = {}, .turn = 0, .up = up});
        const auto& bends = std::get<kind_number<Angle, 2>>(made.world.constraints);
        EXPECT_EQ(bends.size(), 10U);
        EXPECT_NEAR(turn_at(made, "left_knee", up), 26.27, 0.01); // atan2(950, 1925) from the table
        EXPECT_NEAR(turn_at(made, "right_knee", up), -26.27, 0.01);
        EXPECT_NEAR(turn_at(made, "left_elbow", up), 22.83, 0.01); // atan2(400, 950)
        EXPECT_NEAR(turn_at(made, "right_elbow", up), -22.83, 0.01);
        for (const auto* name : {"left_knee", "right_knee", "left_elbow", "right_elbow", "left_hip", "right_hip"})
            EXPECT_EQ(made.constraint(name).error, 0) << name;
    }
}

/// A room 8 wide and 6 high, and a ragdoll in it that was thrown in a way of its own.
template <class Real> Made<2, Real> thrown(std::uint64_t seed, double speed, double spin) {
    constexpr std::uint64_t stream = 2;
    const auto turns = [&](std::uint64_t n) { return 2 * pi<double> * random::uniform(seed, stream, n); };
    auto made = make<2, Real>(Ragdoll{}, Mode::physical, {.at = {{0, 3}}, .turn = turns(0)});
    made.world.forces.push_back(Gravity<2, Real>{{{0, Real(-9.81)}}});
    for (const auto& [normal, offset] : std::initializer_list<std::pair<Vec<2, Real>, Real>>{
             {{{0, 1}}, 0}, {{{0, -1}}, -6}, {{{1, 0}}, -4}, {{{-1, 0}}, -4}})
        made.world.bounds.push_back({normal, offset, Real(0.3), Real(0.5)});

    const double heading = turns(1);
    for (const auto id : made.figure().particles) {
        const auto arm = cast<double>(position_of(made.world, id).value()) - Vec<2, double>{{0, 3}};
        const auto velocity = Vec<2, double>{{cosine(heading), sine(heading)}} * speed + perpendicular(arm) * spin;
        set_velocity(made.world, id, cast<Real>(velocity));
    }
    return made;
}

struct Worst {
    double strain = 0; ///< of a bone, as a fraction of its length
    double turn = 0;   ///< degrees beyond a joint's limits
};

template <class Real> Worst worst_of(const Made<2, Real>& made) {
    Worst worst;
    for (const auto& id : made.figure().constraints) {
        const auto state = constraint_state(made.world, id).value();
        EXPECT_TRUE(is_finite(state.measure));
        if (id.kind == kind_number<Distance, 2>)
            worst.strain = std::max(worst.strain, std::abs(state.strain));
        else
            worst.turn = std::max(worst.turn, std::abs(state.error) * 180 / pi<double>);
    }
    return worst;
}

void keep(Worst& worst, const Worst& now) {
    worst = {std::max(worst.strain, now.strain), std::max(worst.turn, now.turn)};
}

/// What happened to a crowd of ragdolls.
struct Crowd {
    Worst ever, last_second;
    int longest_wrong = 0;               ///< frames that a joint was beyond its limits without a break
    std::size_t crushed = 0, frames = 0; ///< frames with a bone more than a tenth off its length
};

template <class Real> Crowd throw_crowd(int throws, double speed, double spin, int seconds) {
    constexpr int fps = 60;
    constexpr double wrong = 5; // degrees
    Crowd crowd;
    for (int seed = 0; seed < throws; ++seed) {
        auto made = thrown<Real>(std::uint64_t(seed), speed, spin);
        int wrong_since = 0;
        for (int frame = 0; frame < seconds * fps; ++frame) {
            step(made.world, Real(1.0 / fps));
            const auto now = worst_of(made);
            keep(crowd.ever, now);
            if (frame >= (seconds - 1) * fps) keep(crowd.last_second, now);
            wrong_since = now.turn > wrong ? wrong_since + 1 : 0;
            crowd.longest_wrong = std::max(crowd.longest_wrong, wrong_since);
            crowd.crushed += now.strain > 0.1;
            ++crowd.frames;
            for (const auto& position : made.world.particles.position) EXPECT_LT(norm(position), 10) << "seed " << seed;
        }
    }
    return crowd;
}

// A particle that strikes the floor at 7 m/s is stopped within a substep of 1 ms, 7 mm before its bones have heard of
// it: a twelfth of the shortest bone's 10 cm at the most, for a frame. Then they hold.
TEST(Ragdoll, DroppedKeepsItsBonesAndJoints) {
    const auto holds = [](const Crowd& crowd) {
        EXPECT_LT(crowd.ever.strain, 0.12);
        EXPECT_LT(crowd.ever.turn, 5);
        EXPECT_LT(crowd.last_second.strain, 0.003);
        EXPECT_LT(crowd.last_second.turn, 0.2);
    };
    holds(throw_crowd<double>(10, 0, 0, 5));
    holds(throw_crowd<float>(10, 0, 0, 5));
}

// At 50 m/s it is 5 cm a substep, half the shortest bone: what strikes a wall is crushed for a frame. But no joint is
// beyond its limits for longer than two, and all of it comes back to its shape.
void recovers(const Crowd& crowd) {
    std::printf("worst bone %.2f, frames with a bone off by a tenth %.2f %%, worst joint %.0f degrees, longest "
                "beyond its limits %d frames; at the end bone %.4f, joint %.2f degrees\n",
                crowd.ever.strain, 100 * double(crowd.crushed) / double(crowd.frames), crowd.ever.turn,
                crowd.longest_wrong, crowd.last_second.strain, crowd.last_second.turn);
    EXPECT_LE(crowd.longest_wrong, 2);
    EXPECT_LT(crowd.ever.strain, 4);
    EXPECT_LT(double(crowd.crushed), 0.01 * double(crowd.frames));
    EXPECT_LT(crowd.last_second.strain, 0.01);
    EXPECT_LT(crowd.last_second.turn, 0.5);
}

TEST(Ragdoll, ThrownAtWallsAtFiftyMetresASecondNeverStaysInverted) {
    recovers(throw_crowd<double>(few_or_many(40, 1000), 50, 5, 8));
}

TEST(Ragdoll, InFloatNeverStaysInvertedEither) {
    recovers(throw_crowd<float>(few_or_many(10, 1000), 50, 5, 8));
}

TEST(Ragdoll, HoldsItsPosesInBothDimensionsWithoutStrain) {
    for (const auto pose : Ragdoll::poses) {
        const Ragdoll ragdoll{.pose = std::string(pose)};
        const auto flat = make<2, double>(ragdoll);
        const auto deep = make<3, double>(ragdoll);
        for (const auto& id : flat.figure().constraints)
            EXPECT_LT(std::abs(constraint_state(flat.world, id)->error), 1e-9) << pose;
        for (const auto& id : deep.figure().constraints)
            EXPECT_LT(std::abs(constraint_state(deep.world, id)->error), 1e-9) << pose;
        EXPECT_EQ(pose == "hands_up", flat.position("right_hand")[1] > 0.5) << pose;
        const double aside = deep.position("left_foot")[0] + deep.position("right_foot")[0];
        EXPECT_EQ(pose == "dancing", std::abs(aside) > 0.1) << pose;
    }
}

TEST(Ragdoll, IsAsBroadAsItsBuildAndNoHeavier) {
    const auto slim = make(Ragdoll{.stature = "slim"}), heavy = make(Ragdoll{.stature = "heavy"});
    EXPECT_EQ(whole_mass(slim.world), whole_mass(heavy.world));
    EXPECT_EQ(slim.position("left_foot"), heavy.position("left_foot"));
    const auto& thin = slim.figure().pieces;
    const auto& thick = heavy.figure().pieces;
    double more = 0;
    for (std::size_t i = 0; i < thin.size(); ++i) more = std::max(more, thick[i].width - thin[i].width);
    EXPECT_GT(more, 0.05);
}

/// In space, thrown at 50 m/s against the floor and the walls of a room: it comes to rest whole, and its knees have not
/// turned.
TEST(Ragdoll, InSpaceStaysWholeAndItsKneesBendBackwardsOnly) {
    for (int seed = 0; seed < few_or_many(5, 1000); ++seed) {
        auto made = make<3, double>(Ragdoll{}, Mode::physical, {.at = {{0, 2, 0}}, .turn = 1.3 * seed, .up = 1});
        made.world.forces.push_back(Gravity<3, double>{{{0, -9.81, 0}}});
        for (const auto& [normal, offset] : std::initializer_list<std::pair<Vec<3, double>, double>>{
                 {{{0, 1, 0}}, 0}, {{{1, 0, 0}}, -3}, {{{-1, 0, 0}}, -3}, {{{0, 0, 1}}, -3}, {{{0, 0, -1}}, -3}})
            made.world.bounds.push_back({normal, offset, 0.3, 0.5});
        const Vec<3, double> velocity{{50 * cosine(1.7 * seed), 3, 50 * sine(1.7 * seed)}};
        for (const auto id : made.figure().particles) set_velocity(made.world, id, velocity);
        for (int frame = 0; frame < 300; ++frame) step(made.world, 1.0 / 60);
        for (const auto& id : made.figure().constraints)
            if (id.kind == kind_number<Distance, 3>) {
                EXPECT_LT(std::abs(constraint_state(made.world, id)->strain), 0.01) << "seed " << seed;
            }
        for (const auto* knee : {"left_knee", "right_knee"}) {
            const double whole = 0.18 * 0.42 * 0.86 / 6; // of the pelvis, the thigh and the leg
            EXPECT_GT(made.constraint(knee).measure, -0.02 * whole) << knee << ", seed " << seed;
        }
    }
}

/// The angle between the thighs, degrees.
template <int D> double between_thighs(const Made<D, double>& made) {
    const auto left = direction(made.position("left_knee") - made.position("left_hip"));
    const auto right = direction(made.position("right_knee") - made.position("right_hip"));
    const double along = dot(left, right);
    return arctangent(square_root(std::max(0.0, 1 - along * along)), along) * 180 / pi<double>;
}

/// The widest angle while the feet are pulled apart with twice the weight each, degrees.
template <int D> double widest_split() {
    auto made = make<D, double>(Ragdoll{});
    if (D == 3) made.world.settings.damping = 1; // undamped, the steady pull whirls it about until its legs cross
    double widest = 0;
    for (int frame = 0; frame < 300; ++frame) {
        for (const double side : {-1.0, 1.0}) {
            Vec<D, double> force{};
            force[0] = side * 1400;
            apply_force(made.world, *find_particle(made.world, side < 0 ? "it/left_foot" : "it/right_foot"), force);
        }
        step(made.world, 1.0 / 60);
        widest = std::max(widest, between_thighs(made));
    }
    return widest;
}

// Seventy degrees from the trunk to either side, whose own sides lean by a few; in space 46 to either side, and a
// little more where one is in front.
TEST(Ragdoll, DoesNotDoTheSplits) {
    EXPECT_LT(widest_split<2>(), 150);
    EXPECT_GT(widest_split<2>(), 90);
    EXPECT_LT(widest_split<3>(), 135);
    EXPECT_GT(widest_split<3>(), 60);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
