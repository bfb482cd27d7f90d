#pragma once

#include "sinew/world/stencil.h"

#include <array>
#include <span>
#include <type_traits>
#include <vector>

/// Terms of the mechanical energy of a world: potentials of force fields, and measures of springs.
namespace sinew {

template <int D, class Real> double mass_of(const Particles<D, Real>& p, Row row) {
    return p.inverse_mass[row] > Real(0) ? 1.0 / double(p.inverse_mass[row]) : 0.0;
}

/// Moment of inertia about the centre of a particle that rolls.
template <int D, class Real> double inertia_of(const Particles<D, Real>& p, Row row) {
    return double(p.inertia[row]) * mass_of(p, row) * square(double(p.radius[row]));
}

template <int D, class Real> struct PotentialOf {
    double mass;
    Vec<D, double> position;
    FigureIndex figure;
    double operator()(const Gravity<D, Real>& gravity) const {
        return -mass * dot(cast<double>(gravity.acceleration), position);
    }
    double operator()(const Attractor<D, Real>& attractor) const {
        if (!pulls(attractor, figure)) return 0;
        const auto offset = position - cast<double>(attractor.center);
        return -mass * double(attractor.strength) *
               inverse_or_zero(square_root(dot(offset, offset) + square(double(attractor.softness))));
    }
    template <class Other> double operator()(const Other&) const { return 0; }
};

/// Measure of a constraint, and its response to a unit multiplier: the sum of w |grad C|^2.
struct Measured {
    double value = 0, response = 0;
};

/// Measures a constraint at the positions point(row); `room` for kinds of any arity.
template <class Table, class Point, class Weight, class Vector = std::decay_t<std::invoke_result_t<Point, Row>>>
Measured measure_row(const Table& table, Row row, std::vector<Vector>& room, Point&& point, Weight&& weight) {
    using Kind = typename Table::Kind;
    const auto members = table.members[row];
    using Real = std::decay_t<decltype(Vector{}[0])>;
    const auto measured = [&](Real value, const auto& gradient) {
        Measured all{.value = value};
        for (std::size_t i = 0; i < members.size(); ++i)
            all.response += weight(members[i]) * dot(gradient[i], gradient[i]);
        return all;
    };
    if constexpr (Kind::arity == any_arity) {
        room.resize(2 * members.size());
        const auto points = std::span(room).first(members.size()), gradient = std::span(room).subspan(members.size());
        for (std::size_t i = 0; i < members.size(); ++i) points[i] = point(members[i]);
        const Real value = Kind::template evaluate<Real>(std::span<const Vector>(points), gradient);
        return measured(value, gradient);
    } else {
        std::array<Vector, std::size_t(Kind::arity)> points;
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = point(members[i]);
        const auto evaluated = Kind::evaluate(points);
        return measured(evaluated.value, evaluated.gradient);
    }
}
template <class Table, class Point> double measure_row(const Table& table, Row row, Point&& point) {
    std::vector<std::decay_t<std::invoke_result_t<Point, Row>>> room;
    return measure_row(table, row, room, point, [](Row) { return 0.0; }).value;
}

/// True for a spring too stiff for an iteration of the sweep: its length then differs from the length that belongs to
/// its force, by errors that the next substeps remove. compliance / h^2 against the response of the measure.
inline bool is_beyond_sweep(double compliance, double response, double substep) {
    constexpr double resolved = 4;
    return substep > 0 && compliance < resolved * response * square(substep);
}

/// Energy stored in a spring of the sweep that is too stiff for it, J: that of the force which the multiplier gave in a
/// substep of the given length.
template <class Table> double energy_of_force(const Table& table, Row row, double multiplier, double substep) {
    return 0.5 * double(table.compliance[row]) * square(multiplier * inverse_or_zero(square(substep)));
}

} // namespace sinew
