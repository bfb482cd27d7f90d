#pragma once

#include "sinew/math/random.h"
#include "sinew/math/trig.h"
#include "sinew/world/colliders.h"
#include "sinew/world/crossings.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include "tests/stepped.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

/// Sheets of cloth that collide, for tests and measurements.
namespace sinew::test {

template <class Real> using Space = Stepped<3, Real>;

struct SheetSpec {
    int size = 40;       ///< particles a side
    double cell = 0.01;  ///< metres
    double mass = 0.001; ///< of a particle, kilograms
    FigureContactSpec contact{.itself = true, .friction = 0.3};
};

struct Sheet {
    FigureIndex figure = no_figure;
    std::vector<ParticleId> particles;
    int size = 0;

    ParticleId at(int i, int k) const { return particles[std::size_t(k * size + i)]; }
};

template <class Real> Vec3<Real> point(double x, double y, double z) {
    return {{Real(x), Real(y), Real(z)}};
}

/// Adds a sheet with links along both axes and both diagonals; place(i, k) is where a particle begins.
template <class Real, class Position> Sheet add_sheet(Space<Real>& world, const SheetSpec& spec, Position&& position) {
    Sheet sheet{add_figure(world, "sheet" + std::to_string(world.figures.size())), {}, spec.size};
    set_contact(world, sheet.figure, spec.contact);
    for (int k = 0; k < spec.size; ++k)
        for (int i = 0; i < spec.size; ++i) {
            sheet.particles.push_back(add_particle(world, {.position = position(i, k),
                                                           .mass = Real(spec.mass),
                                                           .radius = Real(0.1 * spec.cell),
                                                           .figure = sheet.figure}));
            world.figures[sheet.figure].particles.push_back(sheet.particles.back());
        }
    const auto link = [&](int di, int dk, double length) {
        for (int k = 0; k + dk < spec.size; ++k)
            for (int i = std::max(0, -di); i + std::max(0, di) < spec.size; ++i)
                add<Distance>(world, {sheet.at(i, k), sheet.at(i + di, k + dk)},
                              {.limits = between(Real(length), Real(length)), .figure = sheet.figure});
    };
    link(1, 0, spec.cell);
    link(0, 1, spec.cell);
    link(1, 1, spec.cell * square_root(2.0));
    link(-1, 1, spec.cell * square_root(2.0));
    for (int k = 0; k + 1 < spec.size; ++k)
        for (int i = 0; i + 1 < spec.size; ++i)
            world.figures[sheet.figure].pieces.push_back(
                {.mark = Mark::surface,
                 .particles =
                     std::vector{sheet.at(i, k), sheet.at(i + 1, k), sheet.at(i + 1, k + 1), sheet.at(i, k + 1)}});
    return sheet;
}

inline double uneven(int i, int k) {
    return 2e-4 * random::symmetric<double>(7, std::uint64_t(i), std::uint64_t(k));
}

template <class Real> void add_floor(Space<Real>& world) {
    world.forces.push_back(Gravity<3, Real>{point<Real>(0, -9.81, 0)});
    world.bounds.push_back({point<Real>(0, 1, 0), 0, 0, Real(0.5)});
}

/// A sheet dropped flat on a ball, its hem on the floor.
template <class Real> struct Drape {
    static constexpr const char* name = "drape";
    Space<Real> world;
    Sheet sheet;
    explicit Drape(const SheetSpec& spec) {
        add_floor(world);
        const double half = 0.5 * (spec.size - 1) * spec.cell, ball = 0.4 * half;
        add_collider(world, collide::Collider<3, Real>{.shape = collide::Sphere<3, Real>{Real(ball)},
                                                       .target = {point<Real>(0, ball, 0)},
                                                       .friction = Real(0.3)});
        sheet = add_sheet(world, spec, [&](int i, int k) {
            return point<Real>(i * spec.cell - 0.98 * half, 2.1 * ball + 0.05 + uneven(i, k),
                               k * spec.cell - 0.99 * half);
        });
    }
    void advance() { step(world, Real(1.0 / 60)); }
};

/// A sheet dropped edge-on.
template <class Real> struct Fold {
    static constexpr const char* name = "fold";
    Space<Real> world;
    Sheet sheet;
    explicit Fold(const SheetSpec& spec) {
        add_floor(world);
        const double half = 0.5 * (spec.size - 1) * spec.cell;
        sheet = add_sheet(world, spec, [&](int i, int k) {
            const double x = i * spec.cell - half, y = k * spec.cell;
            return point<Real>(x, y + 0.05, 0.3 * spec.cell * sine(9 * (y - half) + 2 * x) + uneven(i, k));
        });
    }
    void advance() { step(world, Real(1.0 / 60)); }
};

/// Lists of pairs are made when needed, yet a world goes on alike whether they were made before or not, in each of four
/// seconds' steps.
template <class Real> void expect_copies_to_go_alike(Fold<Real>& show) {
    auto& world = show.world;
    for (int i = 0; i < 240; ++i) {
        Space<Real> copy = world;
        copy.solver.options.threads = 3;
        step(world, Real(1.0 / 60));
        step(copy, Real(1.0 / 60));
        ASSERT_EQ(state_hash(copy), state_hash(world)) << i;
    }
}

/// A sheet wrung at both ends, then let go.
template <class Real> struct Twist {
    static constexpr const char* name = "twist";
    Space<Real> world;
    Sheet sheet;
    struct Grip {
        PinId pin;
        Real x = 0, radius = 0;
    };
    std::vector<Grip> grips;
    double half, height;
    explicit Twist(const SheetSpec& spec) : half(0.5 * (spec.size - 1) * spec.cell), height(1.25 * half) {
        add_floor(world);
        sheet = add_sheet(world, spec, [&](int i, int k) {
            return point<Real>(i * spec.cell - half, height + uneven(i, k), k * spec.cell - half);
        });
        for (int k = spec.size * 3 / 8; k < spec.size * 5 / 8; ++k)
            for (const int i : {0, spec.size - 1})
                if (const auto held = pin(world, sheet.at(i, k)))
                    grips.push_back({*held, Real(i ? half : -half), Real(k * spec.cell - half)});
    }
    void advance() {
        const double time = world.time + 1.0 / 60, share = std::min(1.0, time / 2);
        for (const auto& grip : grips) {
            const double side = grip.x > 0 ? 1 : -1, angle = pi<double> * share * side;
            const double r = double(grip.radius);
            move_pin(world, grip.pin,
                     point<Real>(side * half * (1 - 0.095 * share), height + r * sine(angle), r * cosine(angle)));
            if (time >= 2.5) unpin(world, grip.pin);
        }
        if (time >= 2.5) grips.clear();
        step(world, Real(1.0 / 60));
    }
};

} // namespace sinew::test
