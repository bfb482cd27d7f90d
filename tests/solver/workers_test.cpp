#include "sinew/sinew.h"
#include "sinew/solver/workers.h"

#include "tests/stepped.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(Workers, DoEveryPartOnce) {
    for (const int threads : {1, 2, 5})
        for (const int parts : {0, 1, 2, 7, 1000}) {
            std::vector<std::atomic<int>> done(std::size_t(parts + 1));
            Workers::run(threads, parts, [&](int part) { ++done[std::size_t(part)]; });
            for (int part = 0; part < parts; ++part) EXPECT_EQ(done[std::size_t(part)], 1);
            EXPECT_EQ(done.back(), 0);
        }
}

TEST(WavefrontScheduler, DoesEachTurnOnceAndAfterThoseItFollows) {
    constexpr int stages = 7, turns = 300;
    for (const int threads : {1, 2, 5}) {
        WavefrontScheduler relay(stages, turns);
        std::vector<std::atomic<int>> done(stages);
        std::atomic<int> wrong = 0;
        Workers::run(threads, threads, [&](int) {
            relay.help([&](int stage, int turn) {
                const auto at = std::size_t(stage);
                wrong += done[at] != turn || (stage > 0 && done[at - 1] <= turn);
                ++done[at];
            });
        });
        EXPECT_EQ(wrong, 0);
        for (const auto& each : done) EXPECT_EQ(each, turns);
    }
}

TEST(Workers, ServeSeveralCallersAtOnce) {
    constexpr int callers = 4, calls = 200, parts = 16;
    std::atomic<int> done = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < callers; ++i)
        threads.emplace_back([&] {
            for (int call = 0; call < calls; ++call) Workers::run(3, parts, [&](int) { ++done; });
        });
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(done, callers * calls * parts);
}

TEST(Workers, ThatDoWorkOfTheirOwnDoIt) {
    std::atomic<int> done = 0;
    Workers::run(3, 4, [&](int) { Workers::run(3, 5, [&](int) { ++done; }); });
    EXPECT_EQ(done, 20);
}

/// Ropes enough to be shared out, with all kinds of loads.
std::uint64_t hash_of_ropes(int threads) {
    test::Stepped<2, double> world;
    world.solver.options.threads = threads;
    world.forces.push_back(Gravity<2, double>{{{0, -9.81}}});
    for (int i = 0; i < 60; ++i)
        build(world, Rope{.length = 2, .segments = 12, .angle = 0.05 * i, .weight = 0.1 * i * i},
              "rope" + std::to_string(i), {.at = {{double(i), 0}}});
    for (int i = 0; i < 60; ++i) step(world, 1.0 / 60);
    return state_hash(world);
}

TEST(Workers, ChangeNoBit) {
    const auto alone = hash_of_ropes(1);
    for (const int threads : {2, 3, 4, 0}) EXPECT_EQ(hash_of_ropes(threads), alone) << threads << " threads";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
