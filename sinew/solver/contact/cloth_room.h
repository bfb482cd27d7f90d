#pragma once

#include "sinew/solver/contact/sphere_grid.h"
#include "sinew/world/figure.h"
#include "sinew/world/world_types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::detail {

/// Pair of particles of cloth, by their numbers in the room; first < second.
struct ClothPair {
    std::uint32_t first = 0, second = 0;
};

/// Particle of cloth in a substep.
template <int D, class Real> struct ClothParticle {
    Vec<D, Real> position{}, displacement{}; ///< start of the substep, displacement in it
    Real mobility = 0;
    Real friction = 0;
};

/// Sphere that keeps layers of cloth apart.
template <int D, class Real> struct ClothSphere {
    Vec<D, Real> center{}; ///< predicted
    Real radius = 0;       ///< half the distance of layers, metres
};

/// Cloth that collides, during a step; in three dimensions only.
template <int D, class Real> struct ClothRoom {
    std::vector<Row> slots; ///< of the sweep, in order: particle number i of cloth is slots[i]
    std::vector<Real> radius, friction;
    std::vector<FigureIndex> figure;
    bool any_spheres = false;   ///< some figure keeps its layers apart by spheres
    std::vector<char> is_cloth; ///< per row of the world

    /// Neighbours in the sheet, nearer in its rest shape than layers: of particle i the numbers above i, in order.
    std::vector<std::uint32_t> first_near, near;

    SphereGrid<D, Real> grid;
    std::vector<ClothPair> found;              ///< scratch
    std::vector<std::uint32_t> first, second;  ///< candidates of particle i: second[first[i]] to second[first[i + 1]]
    std::vector<Vec<D, Real>> listed, step_at; ///< places when the list was made, and early in the step
    int listed_in = 0;                         ///< number of the substep
    bool is_calm = false;                      ///< the list of an earlier step may still hold

    std::vector<ClothParticle<D, Real>> particles;
    std::vector<ClothSphere<D, Real>> spheres;
    std::vector<Vec<D, Real>> points;
    std::vector<ClothPair> touching;

    bool empty() const { return slots.empty(); }
    std::size_t size() const { return slots.size(); }
    std::span<const std::uint32_t> candidates_of(std::size_t i) const {
        return std::span(second).subspan(first[i], first[i + 1] - first[i]);
    }
    std::span<const std::uint32_t> near_of(std::size_t i) const {
        return std::span(near).subspan(first_near[i], first_near[i + 1] - first_near[i]);
    }

    void clear() {
        slots.clear();
        listed.clear();
        is_cloth.clear();
    }
    /// Reserves for layers of cloth in contact with two others everywhere.
    void reserve() {
        constexpr std::size_t pairs_each = 24;
        for (auto* column : {&listed, &step_at, &points}) column->reserve(size());
        grid.reserve(size());
        particles.reserve(size());
        spheres.reserve(size());
        first.reserve(size() + 1);
        for (auto* pairs : {&found, &touching}) pairs->reserve(pairs_each * size());
        second.reserve(pairs_each * size());
    }
};

} // namespace sinew::detail
