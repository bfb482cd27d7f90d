#include "sinew/world/colliders.h"

#include "bench/cases.h"
#include "tests/sheets.h"
#include "tests/worlds.h"

#include <atomic>
#include <cstdlib>
#include <new>

/// Counts every allocation of the test program: through the sanitizer where there is one, else by replacing the C++
/// heap.
namespace {
std::atomic<long> allocations{0};
}

#if defined(__SANITIZE_ADDRESS__)
#define SINEW_SANITIZED 1
#elif defined(__has_feature)
#define SINEW_SANITIZED __has_feature(address_sanitizer)
#endif

#if SINEW_SANITIZED
#include <sanitizer/allocator_interface.h>
namespace {
const int hooked = __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { ++allocations; },
                                                             [](const volatile void*) {});
}
#else
namespace {
void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, whole > 0 ? whole : alignment);
    if (!memory) std::abort();
    return memory;
}
} // namespace

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete" // with both replaced by malloc and free they do match
#endif
void* operator new(std::size_t size) {
    return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, std::size_t(alignment));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
#endif

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Allocation : ::testing::Test {};
TYPED_TEST_SUITE(Allocation, Everywhere, Names);

TYPED_TEST(Allocation, TheCounterCounts) {
    const long before = allocations;
    ::operator delete(::operator new(1)); // called as functions: a new-expression may be optimized away
    EXPECT_EQ(allocations - before, 1);
}

TYPED_TEST(Allocation, AStepAllocatesNothing) {
    using Real = typename TypeParam::Real;
    for (const Mode mode : {Mode::physical, Mode::classic})
        for (const PassOrder order : {PassOrder::sweeps_last, PassOrder::walls_each_pass, PassOrder::walls_last}) {
            auto world = menagerie<TypeParam::dimension, Real>(mode);
            world.events.reserve(events_per_step); // a copy starts without room for them
            world.settings.classic.order = order;
            auto& distances = std::get<kind_number<Distance, TypeParam::dimension>>(world.constraints);
            for (Row row = 0; row < distances.size(); ++row) // what can tear tears soon
                if (distances.may_tear(row)) distances.breaking_strain.set(row, Real(1e-7));
            prepare(world);
            world.particles.velocity[3][0] = std::numeric_limits<Real>::quiet_NaN(); // quarantined in the first step
            std::size_t torn = 0, quarantined = 0;
            const long before = allocations;
            for (int i = 0; i < 120; ++i) {
                step(world, Real(1.0 / 60));
                for (const auto& event : world.events) ++(event.type == EventType::torn ? torn : quarantined);
            }
            EXPECT_EQ(allocations - before, 0);
            EXPECT_GE(torn, 1U);
            EXPECT_EQ(quarantined, 1U);
        }
}

/// Balls and a rope that fall on shapes, and on each other where `touching`.
template <class World> World obstacle_course(bool touching) {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    World world;
    fall(world, 10);
    add_collider(world, collide::Collider<World::dimension, Real>{
                            .shape = collide::HalfSpace<World::dimension, Real>{Vector::axis(1), -2}});
    add_collider(
        world, collide::Collider<World::dimension, Real>{.shape = collide::Sphere<World::dimension, Real>{Real(0.5)}});
    chain(world, 12, at<Vector>(-1, 0.6), at<Vector>(0.2, 0));
    const auto figure = add_figure(world, "balls");
    set_contact(world, figure, {.itself = touching});
    for (int i = 0; i < 40; ++i)
        add_particle(
            world,
            {.position = at<Vector>(-1 + 0.21 * (i % 10), 1 + 0.3 * (i / 10)), .radius = Real(0.1), .figure = figure});
    return world;
}

TYPED_TEST(Allocation, AStepWithContactsAllocatesNothingOnceWarm) {
    using Real = typename TypeParam::Real;
    for (const bool touching : {false, true}) {
        auto world = obstacle_course<typename TypeParam::World>(touching);
        world.events.reserve(events_per_step);
        run(world, touching ? 3 : 0.1);
        const long before = allocations;
        for (int i = 0; i < 60; ++i) step(world, Real(1.0 / 60));
        EXPECT_EQ(allocations - before, 0) << touching;
    }
}

// A sheet thrown onto the floor crumples: lists of pairs grow to the most that was near, and stay.
TEST(Allocation, AViolentStepOfThinClothAllocatesNothingOnceWarm) {
    Fold<float> show({.size = 24, .contact = {.itself = true, .cloth = ClothContactKind::thin, .friction = 0.3}});
    const auto run_at = [&](float speed) {
        for (const auto id : show.sheet.particles) set_velocity(show.world, id, point<float>(2, -speed, 0));
        const long before = allocations;
        for (int i = 0; i < 40; ++i) show.advance();
        return allocations - before;
    };
    for (int i = 0; i < 10; ++i) show.advance();
    run_at(25);
    EXPECT_EQ(run_at(15), 0);
}

TEST(Allocation, AStepOfWhatIsMeasuredAllocatesNothing) {
    for (const auto* name : {"cloth-12", "mesh-12", "ragdolls-5", "ragdolls-5-direct", "ropes-5", "ropes-5-direct"}) {
        test::Stepped<3, float> world = bench::world_of<float>(*bench::find_case(name));
        world.solver.options.threads = 1;
        prepare(world);
        const long before = allocations;
        for (int i = 0; i < 30; ++i) step(world, 1.0F / 60);
        EXPECT_EQ(allocations - before, 0) << name;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
