#pragma once

#include "sinew/solver/step/energy_gain.h"
#include "sinew/solver/step/sleep_bodies.h"
#include "sinew/table/row_lists.h"
#include "sinew/world/slack_links.h"
#include "sinew/world/world.h"

#include <array>
#include <vector>

namespace sinew {

/// State before a step, by which its energy is measured, and room to work in.
template <int D, class Real> struct EnergyRoom {
    bool noted = false; ///< the state before this step is here
    double last_substep = 0;
    std::vector<Vec<D, Real>> position, velocity;
    std::vector<char> at_end;
    std::vector<Vec<spins<D>, Real>> spin;                                   ///< empty where nothing rolls
    std::array<std::vector<Real>, std::size_t(Kinds<D>::size)> multiplier{}; ///< of kinds with springs
    std::vector<double> in_pins;                                             ///< by body, in soft pins
    std::vector<double> stored, next;                                        ///< by body, in springs; after the step
    std::vector<char> springs, risks;                                        ///< by body: whether there are any

    SleepRoom<D, Real> found;                    ///< the bodies, and islands of them
    std::vector<std::array<Real, 2>> mobilities; ///< by body: the least and the largest
    bool any_rows = false;
    RowLists<Row> rows; ///< by body: the particles that move
    std::vector<EnergyGain<D>> bodies;
    std::vector<IslandGain<D>> islands;
    std::vector<char> is_judged, may_have_gained; ///< by island, by body
    std::vector<Vec<D, double>> points;
    std::vector<SlackLink> links;

    /// Room for the bodies found, and, where constraints may tear, for as many as there are particles.
    void reserve(const World<D, Real>& world) {
        const auto particles = world.particles.size(), colliders = world.colliders.size();
        bool may_tear = false;
        int kind = 0;
        for_each_table(world, [&](const auto& table) {
            may_tear = may_tear || table.may_tear();
            auto& kept = multiplier[std::size_t(kind++)];
            if (!table.compliance.any_of([](Real compliance) { return compliance > Real(0); })) return;
            kept.reserve(table.size());
            links.reserve(std::get<kind_number<Distance, D>>(world.constraints).size());
            for (Row row = 0; row < table.size(); ++row)
                if (points.capacity() < 2 * table.members[row].size()) points.reserve(2 * table.members[row].size());
        });
        if (!any_rows && !may_tear) return;
        const auto count = may_tear ? particles : found.bodies.size();
        found.reserve(world, count);
        position.reserve(particles), velocity.reserve(particles), at_end.reserve(particles), spin.reserve(particles);
        rows.reserve(count, particles);
        for (auto* energies : {&in_pins, &stored, &next}) energies->reserve(count);
        for (auto* flags : {&springs, &risks, &may_have_gained}) flags->reserve(count);
        bodies.reserve(count), mobilities.reserve(count);
        islands.reserve(count + colliders), is_judged.reserve(count + colliders);
    }
};

} // namespace sinew
