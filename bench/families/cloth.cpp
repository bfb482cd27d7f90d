#include "sinew/prefab/cloth.h"

#include "sinew/math/random.h"

#include "bench/cases.h"

#include <cmath>

namespace sinew::bench {
namespace {

constexpr double cell = 0.03; // metres

/// A square cloth pinned at two corners, 1 kg per particle. Random offsets of up to a thousandth of a cell out of the
/// plane break the symmetry.
template <class Real> void hold(World<3, Real>& world, int side, const char* plane, int across) {
    build(world,
          Cloth{.columns = side,
                .rows = side,
                .spacing = cell,
                .plane = plane,
                .pins = "corners",
                .mass = double(side) * side},
          "cloth");
    auto& particles = world.particles;
    for (Row row = 0; row < particles.size(); ++row) {
        const auto id = particles.handles.id_of(row);
        set_mass(world, id, Real(1));
        if (particles.mobility[row] == 0) continue;
        auto position = particles.position[row];
        position[across] = Real(1e-3 * cell * random::symmetric(1, 0, row));
        set_position(world, id, position);
    }
}

template <class Real> void hang(World<3, Real>& world, int side) {
    hold(world, side, "vertical", 2);
}
template <class Real> void let_go(World<3, Real>& world, int side) {
    hold(world, side, "horizontal", 1);
}

/// Cloth of about `constraints` constraints: 4 per particle.
template <class Real> void hang_for(World<3, Real>& world, int constraints) {
    hang(world, int(std::ceil(0.5 * std::sqrt(double(constraints)) + 0.75)));
}

} // namespace

CaseFamily family::cloth() {
    return {.name = "cloth",
            .about = "the cloth prefab, SIZE particles wide and high, on two corners",
            .sizes = {"64", "256", "1024"},
            .max = 4096,
            .build_float = hang<float>,
            .build_double = hang<double>};
}

CaseFamily family::swing() {
    return {.name = "swing",
            .about = "the same let go level: it swings down and snaps taut",
            .sizes = {"64", "256"},
            .max = 4096,
            .build_float = let_go<float>,
            .build_double = let_go<double>};
}

CaseFamily family::scale() {
    return {.name = "scale",
            .about = "the cloth of about SIZE constraints: what one costs when there are many",
            .sizes = {"1e3", "1e4", "1e5", "1e6", "4e6"},
            .max = 6e7,
            .build_float = hang_for<float>,
            .build_double = hang_for<double>};
}

} // namespace sinew::bench
