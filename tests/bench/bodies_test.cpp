#include "bench/bodies.h"

#include <cmath>
#include <gtest/gtest.h>

/// Figures as rigid bodies for other engines: nothing gets lost on the way.
namespace sinew::bench::SINEW_TEST_FILE {
namespace {

ContactWork work_of(std::string_view name) {
    const auto found = find_contact_case(name);
    return found->family->build(found->size);
}

/// Bodies that stay where they begin.
class AtRest final : public BodySimulation {
  public:
    explicit AtRest(const Bodies& bodies) : bodies_(bodies) {}
    void step() override {}
    Vector position(std::uint32_t body, const Vector& from_center) const override {
        return bodies_.bodies[body].center + from_center;
    }

  private:
    const Bodies& bodies_;
};

double mass_of(const Bodies& bodies) {
    double sum = 0;
    for (const auto& body : bodies.bodies) sum += body.mass;
    return sum;
}

TEST(Bodies, ARagdollIsATrunkAndEightLimbs) {
    const auto bodies = bodies_of(work_of("pile-1"));
    EXPECT_EQ(bodies.bodies.size(), 9U);
    EXPECT_EQ(bodies.bodies.front().points.size(), 7U);
    EXPECT_EQ(bodies.joints.size(), 8U);
    EXPECT_EQ(bodies.shapes.size(), 10U);
    EXPECT_NEAR(mass_of(bodies), 70.07, 1e-4);
    for (const auto& joint : bodies.joints) EXPECT_NE(joint.a, joint.b);
}

TEST(Bodies, ACrateIsOne) {
    const auto bodies = bodies_of(work_of("stack-3"));
    ASSERT_EQ(bodies.bodies.size(), 3U);
    EXPECT_TRUE(bodies.joints.empty());
    EXPECT_NEAR(bodies.bodies[1].mass, 1, 1e-6);
    EXPECT_NEAR(bodies.bodies[1].inertia, 2 * 0.48 * 0.48 + 0.02 * 0.02 / 2, 1e-6); // of four corners
    EXPECT_EQ(bodies.shapes[1].corners.size(), 4U);
}

TEST(Bodies, LooseDiscsStayApart) {
    const auto bodies = bodies_of(work_of("discs-20"));
    EXPECT_EQ(bodies.bodies.size(), 20U);
    EXPECT_EQ(bodies.shapes.size(), 20U);
    EXPECT_DOUBLE_EQ(bodies.shapes[0].radius, double(0.1F));
}

TEST(Bodies, ParticlesAreWhereTheWorkHasThem) {
    const auto work = work_of("pile-7");
    const auto bodies = bodies_of(work);
    const AtRest simulation(bodies);
    const auto positions = positions_of(work, bodies, simulation);
    for (std::size_t i = 0; i < positions.size(); ++i)
        EXPECT_LE(distance(positions[i], cast<double>(work.particles[i].position)), 1e-12);
    const auto state = look_at(work, bodies, simulation, positions);
    EXPECT_LE(state.longest, 1e-12);
    EXPECT_EQ(state.speed, 0);
    EXPECT_EQ(state.crossed, 0);
    EXPECT_FALSE(state.is_lost);
}

} // namespace
} // namespace sinew::bench::SINEW_TEST_FILE
