#include "sinew/collide/bounding_box.h"

#include "tests/prefab/make.h"
#include "tests/sheets.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <optional>

/// Balls and sticks on the faces of cloth: none passes through.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class RealT> struct Faces : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Faces, Precisions);

using Point = Vec3<double>;
using Corners = std::array<Point, 4>;

double volume(const Point& a, const Point& b, const Point& c) {
    return dot(a, cross(b, c));
}
/// Six times the volume of a vertex and a face, or of two edges: zero where the corners are in a plane.
double volume(const Corners& corner) {
    return volume(corner[1] - corner[0], corner[2] - corner[0], corner[3] - corner[0]);
}
Corners between(const Corners& from, const Corners& to, double share) {
    Corners at;
    for (std::size_t i = 0; i < 4; ++i) at[i] = from[i] + (to[i] - from[i]) * share;
    return at;
}
/// True if corners in a plane meet: the first is within the face of the others, or the first two cross the last two.
bool meet(const Corners& c, bool is_face) {
    if (is_face) {
        const auto normal = cross(c[2] - c[1], c[3] - c[1]);
        for (std::size_t i = 1; i < 4; ++i)
            if (!(volume(normal, c[i % 3 + 1] - c[i], c[0] - c[i]) > 0)) return false;
        return true;
    }
    const auto e = c[1] - c[0], f = c[3] - c[2], normal = cross(e, f);
    const double s = volume(c[2] - c[0], f, normal), t = volume(c[2] - c[0], e, normal), square = dot(normal, normal);
    return s > 0 && s < square && t > 0 && t < square;
}
/// True if an axis parts the boxes around the motions of two features.
bool are_apart(const Corners& from, const Corners& to, std::size_t first_side) {
    std::array<collide::BoundingBox<3, double>, 2> box;
    for (std::size_t i = 0; i < 4; ++i)
        for (const auto* at : {&from, &to}) box[i < first_side ? 0 : 1].include((*at)[i]);
    return !box[0].overlaps(box[1]);
}
/// Crossings in linear motions, by the roots of the volume.
bool crosses(const Corners& from, const Corners& to, bool is_face) {
    constexpr int parts = 24;
    if (are_apart(from, to, is_face ? 1 : 2)) return false;
    for (int part = 0; part < parts; ++part) {
        double low = double(part) / parts, high = double(part + 1) / parts;
        const bool is_positive = volume(between(from, to, low)) > 0;
        if ((volume(between(from, to, high)) > 0) == is_positive) continue;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (low + high);
            ((volume(between(from, to, middle)) > 0) == is_positive ? low : high) = middle;
        }
        if (meet(between(from, to, low), is_face)) return true;
    }
    return false;
}

struct Throw {
    ClothContactKind cloth = ClothContactKind::spheres;
    bool only_corners = false; ///< pinned there, not all around
    bool is_stick = false;
    double radius = 0.015, mass = 0.05, speed = 5; ///< metres, kilograms, metres a second
};

/// A ball or a stick thrown at a cloth of a kilogram with cells of 5 cm, in steps of one substep.
template <class Real> struct Shot {
    static constexpr int size = 13;
    static constexpr double cell = 0.05;
    Space<Real> world;
    Sheet sheet;
    std::vector<ParticleId> ends;

    explicit Shot(const Throw& how, bool is_pinned = true) {
        world.settings.substeps = 1;
        const FigureContactSpec contact{.figures = true, .itself = true, .cloth = how.cloth, .friction = 0.3};
        sheet = add_sheet(world, {.size = size, .cell = cell, .mass = 1.0 / (size * size), .contact = contact},
                          [](int i, int k) { return point<Real>(cell * (i - 6), 0, cell * (k - 6)); });
        const auto is_end = [](int i) { return i == 0 || i == size - 1; };
        for (int i = 0; is_pinned && i < size; ++i)
            for (int k = 0; k < size; ++k)
                if (how.only_corners ? is_end(i) && is_end(k) : is_end(i) || is_end(k)) pin(world, sheet.at(i, k));
        add_striker(how);
    }
    void add_striker(const Throw& how) {
        const auto figure = add_figure(world, "striker");
        set_contact(world, figure, {.figures = true, .friction = 0.3});
        for (int i = 0; i < (how.is_stick ? 2 : 1); ++i)
            ends.push_back(add_particle(world, {.position = point<Real>(0.013 + 0.17 * i, 0.2 + 0.11 * i, 0.017),
                                                .velocity = point<Real>(0, -how.speed, 0),
                                                .mass = Real(how.mass),
                                                .radius = Real(how.radius),
                                                .figure = figure}));
        world.figures[figure].particles = ends;
        if (!how.is_stick) return;
        add<Distance>(world, {ends[0], ends[1]}, {.figure = figure});
        world.figures[figure].pieces.push_back({.mark = Mark::stroke, .particles = ends});
    }

    std::vector<Point> places() const {
        std::vector<Point> all;
        for (const auto id : sheet.particles) all.push_back(cast<double>(*position_of(world, id)));
        for (const auto id : ends) all.push_back(cast<double>(*position_of(world, id)));
        return all;
    }
    /// True if something crosses the cloth within a time.
    bool crosses_within(double seconds) {
        for (int i = 0; i < int(seconds * 960); ++i) {
            const auto before = places();
            step(world, Real(1.0 / 960));
            if (crossed(before, places())) return true;
        }
        return false;
    }
    static bool crossed(const std::vector<Point>& before, const std::vector<Point>& after) {
        const auto test = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d, bool is_face) {
            return crosses({before[a], before[b], before[c], before[d]}, {after[a], after[b], after[c], after[d]},
                           is_face);
        };
        const std::size_t ball = std::size_t(size) * size;
        for (std::size_t k = 0; k + 1 < size; ++k)
            for (std::size_t i = 0; i + 1 < size; ++i) {
                const std::size_t a = k * size + i, b = a + 1, c = b + size, d = a + size;
                for (auto end = ball; end < before.size(); ++end)
                    if (test(end, a, b, c, true) || test(end, a, c, d, true)) return true;
                if (before.size() == ball + 2)
                    for (const auto to : {b, c, d})
                        if (test(ball, ball + 1, a, to, false)) return true;
            }
        return false;
    }
    Point momentum() const {
        Point sum{};
        for (Row row = 0; row < world.particles.size(); ++row)
            sum += cast<double>(world.particles.velocity[row]) * (1 / double(world.particles.mobility[row]));
        return sum;
    }
    ParticleId ball() const { return ends[0]; }
    /// Damped motion under gravity.
    void go_on(double seconds) {
        if (world.forces.empty()) world.forces.push_back(Gravity<3, Real>{point<Real>(0, -9.81, 0)});
        world.settings.substeps = 16;
        world.settings.damping = Real(2);
        for (int i = 0; i < int(60 * seconds); ++i) {
            step(world, Real(1.0 / 60));
            for (const auto& event : world.events)
                began += event.type == EventType::touched, ended += event.type == EventType::parted;
            for (const auto& touch : world.contacts.figures) impulse += touch.strength.impulse;
        }
    }
    int began = 0, ended = 0; ///< touches since the start
    double impulse = 0;       ///< of all touches, newton seconds

    double energy() const {
        double sum = 0;
        for (Row row = 0; row < world.particles.size(); ++row) {
            const auto& v = world.particles.velocity[row];
            sum += 0.5 * double(dot(v, v)) / double(world.particles.mobility[row]);
        }
        return sum;
    }
};

/// Throws of everything at cloth of both sorts.
template <class Visit> void each_throw(bool is_stick, Visit&& visit) {
    int number = 0;
    for (const auto cloth : {ClothContactKind::spheres, ClothContactKind::thin})
        for (const bool only_corners : {true, false})
            for (const double radius : {0.015, 0.05, 0.15})
                for (const double mass : {0.001, 0.05, 10.0})
                    for (const double speed : {1.0, 5.0, 50.0, 1000.0})
                        if (number++ % one_of(13) == 0)
                            visit(Throw{cloth, only_corners, is_stick, radius, mass, speed});
}
/// Time in which the throw has reached the cloth, and has been held or thrown back.
double time_of(const Throw& how) {
    return 0.22 / how.speed + 0.08;
}

// Light and heavy, slow and fast, smaller and larger than a cell: a blow of ten times the momentum that the cloth could
// take stretches it a hundredfold, but nothing crosses a face.
TYPED_TEST(Faces, NoBallCrossesCloth) {
    each_throw(false, [](const Throw& how) {
        Shot<TypeParam> shot(how);
        EXPECT_FALSE(shot.crosses_within(time_of(how)))
            << int(how.cloth) << how.only_corners << ' ' << how.radius << ' ' << how.mass << ' ' << how.speed;
    });
}
TYPED_TEST(Faces, NoStickCrossesCloth) {
    each_throw(true, [](const Throw& how) {
        Shot<TypeParam> shot(how);
        EXPECT_FALSE(shot.crosses_within(time_of(how)))
            << int(how.cloth) << how.only_corners << ' ' << how.radius << ' ' << how.mass << ' ' << how.speed;
    });
}

// A free cloth takes the momentum of what strikes it: rows act and react, and nothing else does. Links and contacts
// lose energy, and never add any.
TYPED_TEST(Faces, ABlowKeepsTheMomentumAndAddsNoEnergy) {
    using Real = TypeParam;
    const double exact = sizeof(Real) == 8 ? 1e-12 : 1e-4;
    for (const double speed : {1.0, 5.0, 50.0, 1000.0}) {
        Shot<Real> shot({.speed = speed}, false);
        const double energy = shot.energy();
        EXPECT_FALSE(shot.crosses_within(time_of({.speed = speed}))) << speed;
        EXPECT_NEAR(norm(shot.momentum() - Point{{0, -0.05 * speed, 0}}), 0, 0.05 * speed * exact) << speed;
        EXPECT_LT(shot.energy(), 0.5 * energy) << speed;
        EXPECT_LT(double(norm(*velocity_of(shot.world, shot.ends[0]))), 0.5 * speed) << speed;
    }
}

// A ball at rest on cloth lies on its faces: as high over them as the radii say.
TYPED_TEST(Faces, ABallLiesOnCloth) {
    using Real = TypeParam;
    Shot<Real> shot({.radius = 0.03, .speed = 0});
    shot.world.settings.substeps = 16;
    shot.world.settings.damping = Real(2);
    shot.world.forces.push_back(Gravity<3, Real>{point<Real>(0, -9.81, 0)});
    for (int i = 0; i < 240; ++i) step(shot.world, Real(1.0 / 60));
    const auto places = shot.places();
    double nearest = 1;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) nearest = std::min(nearest, norm(places[i] - places.back()));
    EXPECT_GT(nearest, 0.9 * 0.035);
    EXPECT_LT(nearest, 0.035 + 0.5 * Shot<Real>::cell);
    EXPECT_LT(double(norm(*velocity_of(shot.world, shot.ends[0]))), 0.02);
}

// Links and rows are solved alike in all substeps, and faces that share corners agree on the load: nothing trembles.
TYPED_TEST(Faces, AHeavyBallOnLightClothComesToRest) {
    using Real = TypeParam;
    for (const bool only_corners : {true, false}) {
        Shot<Real> shot({.only_corners = only_corners, .radius = 0.08, .mass = 1.5, .speed = 0});
        shot.go_on(10);
        EXPECT_LT(mean_speed(shot.world), 1e-3) << only_corners;
        EXPECT_LT(double(norm(*velocity_of(shot.world, shot.ball()))), 1e-3) << only_corners;
    }
}

// A touch begins with the fall, goes on with the weight, and ends once the ball is thrown up. Its impulses are along
// normals that lean by a few degrees, and friction bears a part: hence two per cent.
TYPED_TEST(Faces, ATouchOfClothBeginsPersistsWithTheWeightAndEnds) {
    using Real = TypeParam;
    Shot<Real> shot({.radius = 0.03, .mass = 0.05, .speed = 0});
    shot.world.contacts.lists_figures = true;
    shot.go_on(4);
    EXPECT_GE(shot.began, 1);
    EXPECT_EQ(shot.ended, shot.began - 1) << "lies on it";
    const int began = shot.began, ended = shot.ended;
    shot.impulse = 0;
    shot.go_on(1);
    EXPECT_EQ(shot.began, began) << "goes on";
    ASSERT_EQ(shot.world.contacts.figures.size(), 1U);
    EXPECT_EQ(shot.world.contacts.figures[0].first, shot.sheet.figure);
    EXPECT_FALSE(shot.world.contacts.figures[0].strength.is_new);
    EXPECT_NEAR(shot.impulse, 0.05 * 9.81, 0.02 * 0.05 * 9.81) << "m g t";
    set_velocity(shot.world, shot.ball(), point<Real>(0, 3, 0));
    shot.go_on(0.2);
    EXPECT_EQ(shot.ended, ended + 1);
    EXPECT_TRUE(shot.world.contacts.figures.empty());
}

/// A ragdoll dropped flat on a cloth that is pinned all around.
template <class Real> struct Net {
    static constexpr int size = 25;
    static constexpr double cell = 0.06;
    Space<Real> world;
    Sheet sheet;
    FigureIndex doll;

    Net() {
        world.forces.push_back(Gravity<3, Real>{point<Real>(0, -9.81, 0)});
        world.settings.damping = Real(2);
        const FigureContactSpec contact{.figures = true, .friction = 0.6};
        const double half = 0.5 * (size - 1) * cell;
        sheet = add_sheet(world, {.size = size, .cell = cell, .mass = 2.0 / (size * size), .contact = contact},
                          [&](int i, int k) { return point<Real>(cell * i - half, 0, cell * k - half); });
        const auto is_end = [](int i) { return i == 0 || i == size - 1; };
        for (int i = 0; i < size; ++i)
            for (int k = 0; k < size; ++k)
                if (is_end(i) || is_end(k)) pin(world, sheet.at(i, k));
        doll = build(world, Ragdoll{.height = 0.9, .mass = 5}, "doll", {});
        set_contact(world, doll, contact);
        for (const auto id : world.figures[doll].particles) lay(*row_of(world, id));
    }
    /// Turns a particle of a figure that stands onto its back, above the cloth.
    void lay(Row row) {
        const auto place = world.particles.position[row];
        world.particles.position[row] = point<Real>(double(place[0]), 0.4 + double(place[2]), -0.3 - double(place[1]));
        world.particles.radius[row] = Real(0.04);
    }
    /// Height of the cloth below a place; none outside of it.
    std::optional<double> height_below(const Point& at) const {
        std::optional<double> height;
        const auto corner = [&](int i, int k) { return cast<double>(*position_of(world, sheet.at(i, k))); };
        for (int k = 0; k + 1 < size; ++k)
            for (int i = 0; i + 1 < size; ++i)
                for (const auto& [b, c] : {std::pair{corner(i + 1, k), corner(i + 1, k + 1)},
                                           std::pair{corner(i + 1, k + 1), corner(i, k + 1)}}) {
                    const auto a = corner(i, k);
                    const double whole = area(a, b, c), to_c = area(a, b, at) / whole, to_b = area(a, at, c) / whole;
                    if (to_b >= 0 && to_c >= 0 && to_b + to_c <= 1)
                        height = std::max(height.value_or(-1), a[1] + to_b * (b[1] - a[1]) + to_c * (c[1] - a[1]));
                }
        return height;
    }
    /// Seen from above, twice.
    static double area(const Point& a, const Point& b, const Point& c) {
        return (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
    }
};

// Nothing of it is below the cloth in any second, and it rests.
TYPED_TEST(Faces, ARagdollDroppedOnClothLiesInIt) {
    Net<TypeParam> net;
    for (int i = 0; i < 600; ++i) {
        step(net.world, TypeParam(1.0 / 60));
        if (i % 60 != 59) continue;
        for (const auto id : net.world.figures[net.doll].particles) {
            const auto at = cast<double>(*position_of(net.world, id));
            const auto height = net.height_below(at);
            ASSERT_TRUE(height) << i;
            EXPECT_GT(at[1], *height) << i;
        }
    }
    EXPECT_LT(mean_speed(net.world), 5e-3);
}

// The same bits on any number of threads and in any lanes.
TYPED_TEST(Faces, ABlowHashesTheSameOnAnyThreadsAndLanes) {
    using Real = TypeParam;
    Shot<Real> one({.is_stick = true, .speed = 20});
    auto other = one;
    other.world.solver.options.threads = 3;
    other.world.solver.options.simd = Simd::sse2;
    for (int i = 0; i < 200; ++i) {
        step(one.world, Real(1.0 / 960));
        step(other.world, Real(1.0 / 960));
        ASSERT_EQ(state_hash(one.world), state_hash(other.world)) << i;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
