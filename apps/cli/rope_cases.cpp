#include "apps/cli/rope_cases.h"

#include <cmath>

namespace sinew::cli {
namespace {

constexpr double rope_length = 10, gravity = 9.81;

template <class Real> void weigh_down(World<2, Real>& world, std::string_view particle, double by) {
    const auto id = find_particle(world, particle);
    const auto row = row_of(world, *id);
    set_mass(world, *id, inverse_or_zero(world.particles.inverse_mass[*row]) + Real(by));
}

Rope rope_of(const RopeCase& rope) {
    return {.length = rope_length,
            .segments = rope.links,
            .angle = rope.start == "level" ? pi<double> / 2 : 0,
            .mass = double(rope.links),
            .weight = rope.weight};
}

/// Three arms of links / 2 links each, from the first arm's pinned end.
template <class Real> void build_tree(World<2, Real>& world, const RopeCase& rope) {
    const double piece = rope_length / rope.links;
    const auto arm = [&](ParticleId from, double x, double y, double dx, double dy) {
        for (int i = 1; i <= rope.links / 2; ++i) {
            const double mass = i == rope.links / 2 ? rope.weight : 1;
            const auto next = add_particle(
                world, {.position = {{Real(x + dx * piece * i), Real(y + dy * piece * i)}}, .mass = Real(mass)});
            add<Distance>(world, {from, next}, {.limits = at_most(Real(piece))});
            from = next;
        }
        return from;
    };
    const auto nail = add_particle(world, ParticleSpec<2, Real>{});
    pin(world, nail);
    const auto fork = arm(nail, 0, 0, 1, 0);
    set_mass(world, fork, Real(1));
    arm(fork, rope_length / 2, 0, 0.8, 0.6);
    arm(fork, rope_length / 2, 0, 0.8, -0.6);
}

template <class Real> void build_necklace(World<2, Real>& world, const RopeCase& rope) {
    build(world,
          Polygon{.sides = rope.links,
                  .radius = rope_length / rope.links / (2 * std::sin(pi<double> / rope.links)),
                  .braced = "none",
                  .mass = double(rope.links)},
          "ring");
    pin(world, *find_particle(world, "ring/corner_0"));
    weigh_down(world, "ring/corner_" + std::to_string(rope.links / 2), rope.weight);
}

} // namespace

template <class Real> World<2, Real> world_of(const RopeCase& rope, double& scale) {
    World<2, Real> world;
    world.forces.push_back(Gravity<2, Real>{{{0, Real(-gravity)}}});
    if (rope.name == "pinned" || rope.name == "bridge") {
        auto made = rope_of(rope);
        made.weight = 0;
        made.slack = 0.02;
        made.pinned = "both";
        if (rope.name == "bridge") made.links = "exact";
        build(world, made, "rope");
        weigh_down(world, "rope/particle_" + std::to_string(rope.links / 2), rope.weight);
    } else if (rope.name == "tree") {
        build_tree(world, rope);
    } else if (rope.name == "necklace") {
        build_necklace(world, rope);
    } else if (rope.name == "ragdoll") {
        build(world, Ragdoll{}, "bob");
        pin(world, *find_particle(world, "bob/left_hand"));
        weigh_down(world, "bob/right_hand", rope.weight * Ragdoll{}.mass);
    } else if (rope.name == "ropes") {
        constexpr int mixed = 6;
        for (int i = 0; i < many_ropes; ++i) {
            auto one = rope;
            one.weight = std::pow(rope.weight, double(i % mixed) / (mixed - 1));
            build(world, rope_of(one), "rope_" + std::to_string(i), {.at = {{Real(i), 0}}});
        }
    } else {
        build(world, rope_of(rope), "rope");
    }
    scale = total_mass(world) * gravity * (rope.name == "ragdoll" ? Ragdoll{}.height : rope_length);
    return world;
}

template World<2, float> world_of(const RopeCase&, double&);
template World<2, double> world_of(const RopeCase&, double&);

} // namespace sinew::cli
