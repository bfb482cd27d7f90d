#include "sinew/solver/simd/kernel.h"

#include "tests/scene/scene_runs.h"

/// Bits of scenes, whatever computes them. tools/renew_determinism compares all scenes, and compilers too.
namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr Simd instruction_sets[] = {Simd::one, Simd::sse2, Simd::avx2, Simd::avx512};

/// Hash of a scene after so many steps.
std::uint64_t hash_of(const std::string& scene, const std::string& precision, const SolverOptions& options,
                      int steps = 8) {
    auto session = open(scene, "physical", precision);
    if (!session) return 0;
    session->set_options(options);
    for (int step = 0; step < steps; ++step) session->step();
    return session->report().hash;
}

// Ropes, cloth, jelly, direct and swept figures, contact of both sorts, wind, motors.
TEST(SceneBits, DoNotDependOnInstructionSetsOrThreads) {
    for (const std::string scene : {"ragdoll", "rope", "chains", "cloth_wind", "cloth_on_sphere", "crates", "car",
                                    "jelly_cube", "polygons", "marionette"})
        for (const std::string precision : {"float", "double"}) {
            const auto plain = hash_of(scene, precision, {.threads = 1, .simd = Simd::one});
            for (int threads = 1; const auto simd : instruction_sets) {
                threads = threads % 7 + 3; // 4, 7, 3, 6
                if (!has_simd(simd)) continue;
                EXPECT_EQ(hash_of(scene, precision, {.threads = threads, .simd = simd}), plain)
                    << scene << ' ' << precision << ", " << name_of(simd) << ", " << threads << " threads";
            }
        }
}

// Copies of a figure are solved side by side: a blow on one leaves the others alone.
TEST(SceneBits, OfBlowsDoNotDependOnInstructionSets) {
    for (const std::string scene : {"newtons_cradle", "polygons"}) {
        const auto plain = hash_of(scene, "double", {.threads = 1, .simd = Simd::one}, 120);
        for (const auto simd : instruction_sets) {
            if (!has_simd(simd)) continue;
            EXPECT_EQ(hash_of(scene, "double", {.threads = 1, .simd = simd}, 120), plain)
                << scene << ", " << name_of(simd);
        }
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
