#include "sinew/math/random.h"
#include "sinew/prefab/ragdoll.h"

#include "bench/cases.h"

#include <array>
#include <string>

namespace sinew::bench {
namespace {

/// Least distance between the ends of a bent arm or leg, as a fraction of the straight length.
constexpr double folded = 0.5;
constexpr std::array<std::array<const char*, 3>, 4> joints = {{{"left_shoulder", "left_elbow", "left_hand"},
                                                               {"right_shoulder", "right_elbow", "right_hand"},
                                                               {"left_hip", "left_knee", "left_foot"},
                                                               {"right_hip", "right_knee", "right_foot"}}};

/// The fifteen points and twenty-one segments of classic mode, as in tutorials.
template <class Real> World<2, Real> model() {
    World<2, Real> flat;
    flat.settings.mode = Mode::classic;
    build(flat, Ragdoll{}, "bob");
    return flat;
}

template <class Real> void tumble(World<3, Real>& world, int ragdolls) {
    const auto flat = model<Real>();
    const auto& segments = std::get<kind_number<Distance, 2>>(flat.constraints);
    const std::size_t points = flat.particles.size();
    reserve(world, {.particles = points * std::size_t(ragdolls),
                    .constraints = (segments.size() + joints.size()) * std::size_t(ragdolls)});
    for (int i = 0; i < ragdolls; ++i) {
        const auto figure = add_figure(world, "ragdoll_" + std::to_string(i));
        std::vector<ParticleId> ids;
        for (Row row = 0; row < points; ++row) {
            const auto at = flat.particles.position[row];
            // Random velocities: ragdolls tumble into the limits of the joints.
            const auto throw_along = [&](int axis) {
                return Real(3 * random::symmetric(1, std::uint64_t(axis), std::uint64_t(i) * points + row));
            };
            ids.push_back(add_particle(
                world,
                {.position = {{at[0], at[1], Real(i)}}, .velocity = Vec<3, Real>::map(throw_along), .figure = figure}));
            world.figures[figure].particles.push_back(ids.back());
        }
        const auto keep = [&](Row a, Row b, Interval<Real> limits) {
            const auto id = add<Distance>(world, {ids[a], ids[b]}, {.limits = limits, .figure = figure});
            world.figures[figure].constraints.push_back(*id);
        };
        for (Row row = 0; row < segments.size(); ++row)
            keep(segments.members[row][0], segments.members[row][1], exactly(segments.high(row)));
        for (const auto& joint : joints) {
            const auto row = [&](const char* name) {
                return *row_of(flat, *find_particle(flat, std::string("bob/") + name));
            };
            const auto position = [&](const char* name) { return flat.particles.position[row(name)]; };
            const Real straight =
                distance(position(joint[0]), position(joint[1])) + distance(position(joint[1]), position(joint[2]));
            keep(row(joint[0]), row(joint[2]), at_least(Real(folded) * straight));
        }
    }
}

} // namespace

CaseFamily family::ragdolls() {
    return {.name = "ragdolls",
            .about = "SIZE ragdolls of 15 points, 21 distances and 4 limits, tumbling freely",
            .sizes = {"1000"},
            .max = 1e6,
            .has_direct = true,
            .build_float = tumble<float>,
            .build_double = tumble<double>};
}

} // namespace sinew::bench
