#include "sinew/world/measure.h"

#include "bench/cases.h"
#include "bench/measure.h"
#include "tests/stepped.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

/// The worlds that are measured are what they say.
namespace sinew::bench::SINEW_TEST_FILE {
namespace {

double strain_at_first(const Work& work) {
    std::vector<Found> positions;
    for (const auto& position : work.positions) positions.push_back(cast<double>(position));
    return strain_of(work, positions).max;
}

TEST(Cases, AreFoundByFamilyAndSize) {
    for (const auto& chosen : all_cases()) EXPECT_EQ(find_case(chosen.name)->name, chosen.name);
    EXPECT_EQ(find_case("scale-4e6")->size, 4'000'000);
    EXPECT_TRUE(find_case("ropes-5-direct")->direct);
    for (const auto* bad : {"", "cloth", "cloth-", "cloth-1", "cloth-x", "cloth-8.5", "cloth-8x", "cloth--8",
                            "cloth-1e9", "cloth-nan", "silk-8", "cloth-8-direct", "ropes-5-", "-8"})
        EXPECT_FALSE(find_case(bad)) << bad;
}

TEST(Timing, APercentileIsTheLeastTimeThatEnoughStepsDoNotExceed) {
    std::vector<double> times; // 200 down to 1
    for (int i = 200; i > 0; --i) times.push_back(i);
    EXPECT_EQ(percentile(times, 0.99), 198);
    EXPECT_EQ(percentile(times, 0.991), 199);
    EXPECT_EQ(percentile(times, 1), 200);
    EXPECT_EQ(percentile({7, 5}, 0.99), 7);
    EXPECT_EQ(percentile({}, 0.99), 0);
}

TEST(Cases, TheClothHangsFromTwoCornersWithAKilogramAParticle) {
    const auto work = work_of(*find_case("cloth-256"));
    EXPECT_EQ(work.sticks.size(), 260'610U);
    EXPECT_EQ(std::ranges::count(work.inverse_masses, 0), 2);
    EXPECT_EQ(std::ranges::count(work.inverse_masses, 1), 256 * 256 - 2);
    EXPECT_EQ(work.inverse_masses[255], 0);
    EXPECT_LT(strain_at_first(work), 1e-5);
}

/// Its sides, in grid cells, whatever points they join.
std::vector<std::array<float, 7>> segments(const Work& work) {
    std::vector<std::array<float, 7>> all;
    for (const auto& stick : work.sticks) {
        auto a = work.positions[stick.a], b = work.positions[stick.b];
        const auto across = work.positions[0][0]; // where its left corner is differs
        const auto position = [&](const Position& p) {
            return std::array{std::round((p[0] - across) / 0.03F), std::round(p[1] / 0.03F)};
        };
        auto from = position(a), to = position(b);
        if (to < from) std::swap(from, to);
        all.push_back({from[0], from[1], to[0], to[1], float(std::round(stick.rest * 1e4))});
    }
    std::ranges::sort(all);
    return all;
}

TEST(Cases, TheMeshIsTheClothInNoOrder) {
    const auto cloth = work_of(*find_case("cloth-9")), mesh = work_of(*find_case("mesh-9"));
    EXPECT_EQ(segments(cloth), segments(mesh));
    EXPECT_EQ(std::ranges::count(mesh.inverse_masses, 0), 2);
    std::size_t neighbours = 0;
    for (const auto& stick : mesh.sticks) neighbours += absolute(float(stick.a) - float(stick.b)) == 1;
    EXPECT_LT(neighbours, mesh.sticks.size() / 10);
}

TEST(Cases, RagdollsAreFifteenPointsTwentyOneSticksAndLimits) {
    const auto work = work_of(*find_case("ragdolls-3"));
    EXPECT_EQ(work.positions.size(), 3U * 15);
    EXPECT_EQ(work.sticks.size(), 3U * 21);
    EXPECT_EQ(work.struts.size(), 3U * 4);
    EXPECT_LT(strain_at_first(work), 1e-5);
    for (const auto& strut : work.struts)
        EXPECT_GT(distance(work.positions[strut.a], work.positions[strut.b]), strut.min);
}

TEST(Cases, AreSweptAsTheTextbookDoesUnlessTheyAreDirect) {
    for (const auto* name : {"ropes-3", "ragdolls-3"}) {
        test::Stepped<3, float> swept = world_of<float>(*find_case(name)),
                                direct = world_of<float>(*find_case(std::string(name) + "-direct"));
        prepare(swept), prepare(direct);
        EXPECT_TRUE(swept.solver.blocks.nodes.empty());
        EXPECT_FALSE(direct.solver.blocks.nodes.empty());
        EXPECT_EQ(swept.settings.substeps, 10);
    }
}

TEST(Measuring, GivesTheEngineAndTheTextbookTheSameFrames) {
    for (const auto* name : {"cloth-6", "mesh-6", "ragdolls-2", "ropes-2", "ropes-2-direct"})
        for (const bool single : {true, false}) {
            const auto chosen = *find_case(name);
            const auto work = work_of(chosen);
            const auto measured = measure(chosen, work, {.threads = 1, .single = single}, 3);
            EXPECT_GT(measured.milliseconds, 0) << name;
            EXPECT_GT(measured.build_ms, measured.prepare_ms);
            EXPECT_LT(measured.strain.max, 0.1) << name;
            EXPECT_LE(measured.strain.mean, measured.strain.max);
        }
}

} // namespace
} // namespace sinew::bench::SINEW_TEST_FILE
