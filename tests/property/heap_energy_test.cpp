#include "tests/flight.h"
#include "tests/heap.h"
#include "tests/thorough.h"

#include <algorithm>

/// No energy from nothing where figures of any kinds fall on each other.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct HeapEnergy : ::testing::Test {};
TYPED_TEST_SUITE(HeapEnergy, Everywhere, Names);

/// Largest rise of kinetic and potential energy above all energy at the start; in kinetic energy and that of springs,
/// or weight times a metre.
template <int D, class Real> double gain_of(Stepped<D, Real>& world, int steps) {
    const auto begun = energy(world);
    const double put_in = begun.kinetic + begun.potential + begun.stored;
    const double scale = std::max(begun.kinetic + begun.stored, total_mass(world) * gravity);
    double most = 0;
    for (int i = 0; i < steps; ++i) {
        step(world, Real(1) / 60);
        const auto now = energy(world);
        const double rise = (now.kinetic + now.potential - put_in) / scale;
        if (!(rise < most)) most = rise;
        if (!(most < 1e3)) break;
    }
    return most;
}

TYPED_TEST(HeapEnergy, NeverRisesAboveWhatWasPutIn) {
    constexpr double slight = 1e-3;
    const int cases = few_or_many(5, 100), steps = 120;
    for (int seed = 1; seed <= cases; ++seed) {
        Heap<TypeParam::dimension, typename TypeParam::Real> heap{std::uint64_t(seed)};
        EXPECT_LE(gain_of(heap.world(), steps), slight) << "seed " << seed << ":" << heap.text();
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
