#include "sinew/prefab/rope.h"
#include "sinew/world/edit.h"

#include "tests/crowds.h"

#include <cmath>
#include <cstddef>

/// Ropes of plain links, solved side by side in lanes.
namespace sinew::test::SINEW_TEST_FILE {
namespace {

template <class In> class Chains : public ::testing::Test {};
TYPED_TEST_SUITE(Chains, Everywhere, Names);

/// A rope in a crowd in which lengths, masses, starts and numbers of links differ; some whip, some hang.
template <class World> void add_rope(World& world, int i) {
    constexpr int links[] = {20, 20, 7, 20, 12};
    const Rope rope{.length = 1 + 0.13 * (i % 4),
                    .segments = links[i % 5],
                    .angle = i % 3 == 0 ? pi<double> / 2 : 0.31 * i,
                    .mass = 1.0 + i % 2,
                    .weight = i % 4 == 1 ? 3.0 : 0,
                    .links = i % 6 == 5 ? "at_most" : "exact"};
    build(world, rope, "rope_" + std::to_string(i));
}
constexpr int ropes = 23;
constexpr double seconds = 1.5;

const auto add_one = [](auto& world, int i) { add_rope(world, i); };

TYPED_TEST(Chains, MoveAloneAsInACrowd) {
    expect_alone_as_in_a_crowd<typename TypeParam::World>(ropes, seconds, add_one);
}

TYPED_TEST(Chains, MoveAlikeInAnyNumberOfLanesAndThreads) {
    expect_alike_in_any_lanes_and_threads<typename TypeParam::World>(ropes, seconds, add_one);
}

TYPED_TEST(Chains, NeedNothingThatIsNotInTheWorld) {
    expect_nothing_needed_but_the_world<typename TypeParam::World>(ropes, 60, add_one);
}

TYPED_TEST(Chains, FollowRowsThatMoveWhileAFieldKeepsThemOutOfTheLanes) {
    using World = typename TypeParam::World;
    using Real = typename TypeParam::Real;
    auto kept = crowd<World>(0, ropes, add_one), thrown_away = crowd<World>(0, ropes, add_one);
    for (auto* world : {&kept, &thrown_away}) {
        const auto go_on = [&](int steps) {
            for (int i = 0; i < steps; ++i) {
                if (world == &thrown_away) world->solver = {};
                run(*world, 1 / 60.0);
            }
        };
        go_on(3);
        world->forces.push_back(Drag<TypeParam::dimension, Real>{Real(0.1)});
        remove_figure(*world, 0);
        go_on(3);
        world->forces.remove(world->forces.id_of(Row(world->forces.size() - 1)));
        go_on(20);
    }
    expect_same(kept, 0, thrown_away);
}

TYPED_TEST(Chains, AreRopesOfPlainLinksHeldAtOneEnd) {
    using World = typename TypeParam::World;
    World world;
    const auto add = [&](const Rope& rope) { build(world, rope, "rope_" + std::to_string(world.figures.size())); };
    add({.segments = 9});
    add({.segments = 4, .links = "exact"});
    add({.segments = 5, .pinned = "both"});
    add({.segments = 6, .pinned = "none"});
    add({.segments = 7, .elasticity = {.compliance = 1e-3}});
    add({.segments = 8, .bend_stiffness = 1});
    prepare(world);
    const auto& chains = world.solver.blocks.chains;
    ASSERT_EQ(chains.turns.size(), 2U);
    EXPECT_EQ(chains.turns[0].links, 4U);
    EXPECT_EQ(chains.turns[1].links, 9U);
}

/// Energy per weight and length, of one rope let go level.
TYPED_TEST(Chains, KeepTheirEnergyAndLengths) {
    using World = typename TypeParam::World;
    if (!TypeParam::precise) return;
    World world;
    fall(world, 9.81);
    build(world, Rope{.angle = pi<double> / 2, .mass = 20, .links = "exact"}, "rope");
    const double begun = energy(world).total(), scale = 20 * 9.81 * 2;
    double longest = 0, drift = 0;
    for (int i = 0; i < 1800; ++i) {
        run(world, 1 / 60.0);
        longest = std::max(longest, double(stretch(world).max));
        drift = std::max(drift, std::abs(energy(world).total() - begun) / scale);
    }
    EXPECT_LT(longest, 1e-7);
    EXPECT_LT(drift, 1e-5);
}

/// A pack of chains of three links, in motion.
template <int D> struct ThreeLinks {
    static constexpr std::size_t per_node = sizeof(ChainNode<D, double>) / sizeof(double);
    std::vector<double> numbers = std::vector<double>(4 * per_node * max_block_lanes + 8);
    ChainPack<D> pack;

    explicit ThreeLinks(int width) {
        pack.links = 3, pack.width = width, pack.longest = 1.0 / 120;
        pack.nodes = numbers.data() + (8 - reinterpret_cast<std::uintptr_t>(numbers.data()) / 8 % 8) % 8;
        for (int l = 0; l < width; ++l) {
            const auto lane = std::size_t(l);
            pack.active.lane[lane] = 1, pack.fresh.lane[lane] = 1;
            pack.h.lane[lane] = pack.longest, pack.keep.lane[lane] = 1, pack.yield.lane[lane] = 1;
            pack.acceleration[1].lane[lane] = -10;
            for (int k = 0; k < D; ++k) pack.low[k].lane[lane] = -100, pack.high[k].lane[lane] = 100;
            pack.total_length.lane[lane] = 3, pack.weight_length.lane[lane] = 3 * 6 * 10;
            for (std::size_t i = 1; i < 4; ++i) {
                const double turn = 0.5 * double(i) + 0.1 * l;
                for (std::size_t k = 0; k < D; ++k)
                    at(lane, i, offsetof(Node, start), k) =
                        at(lane, i - 1, offsetof(Node, start), k) + (k == 0   ? std::cos(turn)
                                                                     : k == 1 ? std::sin(turn)
                                                                              : 0);
                at(lane, i, offsetof(Node, mass), 0) = double(i);
                at(lane, i, offsetof(Node, length2), 0) = at(lane, i, offsetof(Node, per_length2), 0) = 1;
            }
        }
    }
    using Node = ChainNode<D, double>;
    double& at(std::size_t lane, std::size_t node, std::size_t offset, std::size_t k) {
        return pack.nodes[(node * per_node + offset / sizeof(double) + k) * std::size_t(pack.width) + lane];
    }
};

/// Newton's law at the midpoint: m (v1 - v0) / h = m g + tensions along the means of the old and the new links, with
/// (v0 + v1) / 2 = (x1 - x0) / h, and lengths kept. The iteration ends with a move of at most 3e-5 m; the error left
/// goes with its square, times 2 m / h^2.
template <int D> void expect_midpoint_rule(int width, void (*swing)(ChainPack<D>&)) {
    ThreeLinks<D> begun(width), moved(width);
    using Node = typename ThreeLinks<D>::Node;
    swing(moved.pack);
    const double h = begun.pack.longest;
    for (std::size_t l = 0; l < std::size_t(width); ++l) {
        ASSERT_EQ(moved.pack.good.lane[l], 1);
        for (std::size_t i = 1; i < 4; ++i) {
            const auto link = [&](auto& chains, std::size_t node, std::size_t k) {
                const auto start = offsetof(Node, start);
                return node > 3 ? 0 : chains.at(l, node, start, k) - chains.at(l, node - 1, start, k);
            };
            const auto force = [&](std::size_t node, std::size_t k) {
                const double tension = node > 3 ? 0 : moved.at(l, node, offsetof(Node, tension), 0);
                return tension * (link(begun, node, k) + link(moved, node, k)) / 2;
            };
            double length2 = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const double gained = moved.at(l, i, offsetof(Node, velocity), k);
                const double went = moved.at(l, i, offsetof(Node, start), k) - begun.at(l, i, offsetof(Node, start), k);
                EXPECT_NEAR(double(i) * gained / h, (k == 1 ? -10.0 * double(i) : 0) - force(i, k) + force(i + 1, k),
                            1e-5);
                EXPECT_NEAR(gained / 2, went / h, 1e-12);
                length2 += link(moved, i, k) * link(moved, i, k);
            }
            EXPECT_NEAR(length2, 1, 1e-9);
        }
    }
}

TEST(ChainKernel, FollowsTheMidpointRule) {
    for (const Simd simd : {Simd::one, Simd::sse2, Simd::avx2, Simd::avx512}) {
        if (!has_simd(simd)) continue;
        SCOPED_TRACE(name_of(simd));
        const auto& flat = kernels<2, float>(simd);
        const auto& spatial = kernels<3, float>(simd);
        expect_midpoint_rule<2>(flat.block_lanes, flat.swing_chains);
        expect_midpoint_rule<3>(spatial.block_lanes, spatial.swing_chains);
        expect_midpoint_rule<3>(1, spatial.swing_chain);
    }
}

/// Strings at rest, upright in every second lane and hanging in the others: those fall freely, and these pull.
template <int D> void expect_slack_by_lane(int width, void (*swing)(ChainPack<D>&)) {
    ThreeLinks<D> chains(width);
    using Node = typename ThreeLinks<D>::Node;
    const auto up = [](std::size_t lane) { return lane % 2 == 0 ? 1.0 : -1.0; };
    for (std::size_t l = 0; l < std::size_t(width); ++l)
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = 0; k < D; ++k)
                chains.at(l, i, offsetof(Node, start), k) = k == 1 ? up(l) * double(i) : 0;
            chains.at(l, i, offsetof(Node, pulls_only), 0) = 1;
        }
    swing(chains.pack);
    const double fall = 10 * chains.pack.longest;
    for (std::size_t l = 0; l < std::size_t(width); ++l) {
        ASSERT_EQ(chains.pack.good.lane[l], 1) << l;
        double below = 0;
        for (std::size_t i = 3; i > 0; --i) {
            below += up(l) > 0 ? 0 : 10.0 * double(i);
            EXPECT_NEAR(chains.at(l, i, offsetof(Node, tension), 0), below, 1e-6) << l << ' ' << i;
            EXPECT_NEAR(chains.at(l, i, offsetof(Node, velocity), 1), up(l) > 0 ? -fall : 0, 1e-9) << l << ' ' << i;
        }
    }
}

TEST(ChainKernel, LetsStringsGoSlackInEachLaneByItself) {
    for (const Simd simd : {Simd::one, Simd::sse2, Simd::avx2, Simd::avx512}) {
        if (!has_simd(simd)) continue;
        SCOPED_TRACE(name_of(simd));
        expect_slack_by_lane<2>(kernels<2, float>(simd).block_lanes, kernels<2, float>(simd).swing_chains);
        expect_slack_by_lane<3>(kernels<3, float>(simd).block_lanes, kernels<3, float>(simd).swing_chains);
    }
}

} // namespace
} // namespace sinew::test::SINEW_TEST_FILE
