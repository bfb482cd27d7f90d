#pragma once

#include "sinew/solver/simd/kernel.h"

#include "tests/worlds.h"

/// Laws of figures that are solved side by side in lanes. `add(world, i)` adds figure number i.
namespace sinew::test {

template <class World, class Add> World crowd(int first, int last, Add&& add) {
    World world;
    fall(world, 9.81);
    for (int i = first; i < last; ++i) add(world, i);
    return world;
}

template <class World> void expect_same(const World& a, Row first, const World& b) {
    for (Row row = 0; row < b.particles.size(); ++row) {
        ASSERT_EQ(a.particles.position[first + row], b.particles.position[row]) << row;
        ASSERT_EQ(a.particles.residual[first + row], b.particles.residual[row]) << row;
        ASSERT_EQ(a.particles.velocity[first + row], b.particles.velocity[row]) << row;
    }
}

template <class World, class Add> void expect_alone_as_in_a_crowd(int figures, double seconds, Add&& add) {
    auto all = crowd<World>(0, figures, add);
    run(all, seconds);
    Row first = 0;
    for (int i = 0; i < figures; ++i) {
        SCOPED_TRACE(i);
        auto alone = crowd<World>(i, i + 1, add);
        run(alone, seconds);
        expect_same(all, first, alone);
        first += Row(alone.particles.size());
    }
}

template <class World, class Add> void expect_alike_in_any_lanes_and_threads(int figures, double seconds, Add&& add) {
    auto expected = crowd<World>(0, figures, add);
    run(expected, seconds);
    for (const Simd simd : {Simd::one, Simd::sse2, Simd::avx2, Simd::avx512})
        for (const int threads : {1, 3}) {
            if (!has_simd(simd)) continue;
            SCOPED_TRACE(name_of(simd));
            auto world = crowd<World>(0, figures, add);
            world.solver.options.simd = simd;
            world.solver.options.threads = threads;
            run(world, seconds);
            expect_same(expected, 0, world);
            EXPECT_EQ(expected.energy_lost, world.energy_lost);
        }
}

template <class World, class Add> void expect_nothing_needed_but_the_world(int figures, int steps, Add&& add) {
    auto kept = crowd<World>(0, figures, add), thrown_away = crowd<World>(0, figures, add);
    for (int i = 0; i < steps; ++i) {
        run(kept, 1 / 60.0);
        thrown_away.solver = {};
        run(thrown_away, 1 / 60.0);
    }
    expect_same(kept, 0, thrown_away);
}

} // namespace sinew::test
