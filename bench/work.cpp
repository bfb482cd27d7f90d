#include "bench/work.h"

#include "sinew/world/edit.h"

#include <algorithm>
#include <limits>

namespace sinew::bench {

template <class Real> Work work_of(const World<3, Real>& world) {
    Work work;
    const auto& particles = world.particles;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        work.positions.push_back(cast<float>(particles.position[i]));
        work.velocities.push_back(cast<float>(particles.velocity[i]));
        work.inverse_masses.push_back(float(particles.inverse_mass[i]));
    }
    for (const auto& pin : world.pins)
        if (const auto row = row_of(world, pin.particle)) work.inverse_masses[*row] = 0;
    for (const auto& force : world.forces)
        if (const auto* gravity = std::get_if<Gravity<3, Real>>(&force))
            work.gravity += cast<float>(gravity->acceleration);
    const auto& distances = std::get<kind_number<Distance, 3>>(world.constraints);
    for (Row row = 0; row < distances.size(); ++row) {
        const auto ends = distances.members[row];
        if (ties(distances, row))
            work.sticks.push_back({ends[0], ends[1], double(distances.high(row))});
        else
            work.struts.push_back({ends[0], ends[1], double(distances.low(row))});
    }
    return work;
}

Strain strain_of(const Work& work, std::span<const Found> positions) {
    Strain strain;
    for (const auto& stick : work.sticks) {
        const double length = distance(positions[stick.a], positions[stick.b]);
        const double off = absolute(length / stick.rest - 1);
        if (!is_finite(off)) {
            constexpr double lost = std::numeric_limits<double>::quiet_NaN();
            return {lost, lost, lost};
        }
        strain.max = std::max(strain.max, off);
        strain.mean += off;
    }
    if (!work.sticks.empty()) strain.mean /= double(work.sticks.size());
    strain.last = strain.max;
    return strain;
}

template Work work_of(const World<3, float>&);
template Work work_of(const World<3, double>&);

} // namespace sinew::bench
