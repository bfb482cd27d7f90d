#pragma once

#include "sinew/math/random.h"
#include "sinew/solver/block.h"
#include "sinew/solver/world.h"

/// Solution of one constraint: the same text for every kind, dimension, precision and mode.
///
///     error    the measure's distance from its limits
///     dlambda = -(error + alpha lambda) / (sum w g . d + alpha),   alpha = compliance / h^2
///     x_i    += w_i d_i dlambda
///
/// (XPBD: Macklin, Mueller and Chentanez 2016; alpha = 0 is PBD: Mueller et al. 2007). g is the gradient at the present
/// positions, d the direction of the correction. A Mover gives access to the particles: see step.cpp and classic.cpp.
namespace sinew::detail {

/// Gradient, clamped so that the square fits a float: the gradient of an angle grows without bound as the legs shrink.
template <class Kind, int D, class Real> Vec<D, Real> gentle(const Vec<D, Real>& gradient) {
    return Kind::length_power > 0 ? gradient : clamp_components(gradient, Real(1e15));
}

/// Room for one constraint's points and gradients, in `scratch` where the kind has no fixed arity. `each` visits the
/// members; for a fixed arity the loop is unrolled, and the stencil lives in registers.
template <class Kind, int D, class Real> struct Stencil {
    Points<Kind::arity, D, Real> points, gradient, direction;

    Stencil(std::span<Vec<D, Real>>, std::size_t) {}
    template <class Visit> static void each(Visit&& visit) {
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            (visit(I), ...);
        }
        (std::make_index_sequence<std::size_t(Kind::arity)>{});
    }
    static Real evaluate(const Points<Kind::arity, D, Real>& x, Points<Kind::arity, D, Real>& gradient) {
        const auto evaluated = Kind::evaluate(x);
        each([&](std::size_t i) { gradient[i] = gentle<Kind>(evaluated.gradient[i]); });
        return evaluated.value;
    }
};

template <class Kind, int D, class Real>
requires(Kind::arity == any_arity) struct Stencil<Kind, D, Real> {
    std::span<Vec<D, Real>> points, gradient, direction;

    Stencil(std::span<Vec<D, Real>> scratch, std::size_t n)
        : points(scratch.subspan(0, n)), gradient(scratch.subspan(n, n)), direction(scratch.subspan(2 * n, n)) {}
    template <class Visit> void each(Visit&& visit) const {
        for (std::size_t i = 0; i < points.size(); ++i) visit(i);
    }
    static Real evaluate(std::span<Vec<D, Real>> x, std::span<Vec<D, Real>> gradient) {
        return Kind::evaluate(std::span<const Vec<D, Real>>(x), gradient);
    }
};

/// Sizes the scratch of stencils for the widest constraint.
template <int D, class Real>
void make_room_for_widest(const World<D, Real>& world, std::vector<Vec<D, Real>>& scratch) {
    std::size_t widest = 0;
    for_each_table(world, [&]<class Table>(const Table& table) {
        if constexpr (Table::Kind::arity == any_arity)
            for (Row row = 0; row < table.size(); ++row) widest = std::max(widest, table.members[row].size());
    });
    if (scratch.size() < 3 * widest) scratch.resize(3 * widest);
}

/// Measure of an angle modulo a whole turn: the value nearest to the middle of the limits. Other measures are
/// unchanged.
template <class Kind, class Real> Real unwrap(Real measure, Real low, Real high) {
    if constexpr (Kind::period > 0) {
        constexpr Real turn = Real(Kind::period);
        const Real middle = clamp(Real(0.5) * (low + high), -Real(100) * turn, Real(100) * turn);
        return measure - turn * std::floor((measure - middle) / turn + Real(0.5));
    } else {
        return measure;
    }
}

/// Violation of the limits as a fraction of the violated limit; in radians for an angle. A limit of zero is never
/// strained.
template <class Kind, class Real> Real strain(Real measure, Real low, Real high) {
    const Real unwrapped = unwrap<Kind>(measure, low, high);
    const Real nearest = clamp(unwrapped, low, high);
    return (unwrapped - nearest) * inverse_or_zero(Kind::length_power > 0 ? absolute(nearest) : Real(1));
}

/// Multiplier of a constraint with two limits: positive below the low one, negative above the high one, zero in
/// between. The same text serves equalities, maximum and minimum lengths, and ranges.
template <class Real> Real limited_multiplier(Real lambda, Real below, Real above, Real alpha, Real per_resistance) {
    const Real pushing = lambda - (below + alpha * lambda) * per_resistance;
    const Real pulling = lambda - (above + alpha * lambda) * per_resistance;
    return maximum(pushing, Real(0)) + minimum(pulling, Real(0));
}

/// A unit vector that belongs to one member of one constraint.
template <int D, class Real> Vec<D, Real> own_direction(std::uint64_t constraint, std::uint64_t member) {
    const auto v =
        Vec<D, Real>::map([&](int i) { return random::symmetric<Real>(member, constraint, std::uint64_t(i)); });
    const auto n = direction(v);
    return n == Vec<D, Real>{} ? Vec<D, Real>::axis(0) : n;
}

/// Separates particles in a heap (coincident, collinear), where no direction of correction exists, by a small
/// displacement: each constraint in directions of its own, the same on every machine. Displacements are weighted by
/// inverse mass, so that momentum is conserved.
template <class Mover, class Real>
[[gnu::noinline]] void part(Mover& mover, std::span<const Row> members, Row constraint, Real rest) {
    constexpr auto share = Real(1e-3);
    Real extent = 0, lightest = 0;
    Vec<Mover::dimension, Real> mean{};
    for (std::size_t i = 0; i < members.size(); ++i) {
        extent = maximum(extent, distance(mover.point(members[i]), mover.point(members[0])));
        lightest = maximum(lightest, mover.weight(members[i]));
        mean += own_direction<Mover::dimension, Real>(constraint, i) * (Real(1) / Real(members.size()));
    }
    const Real size = share * (extent > Real(0) ? extent : minimum(absolute(rest), limit::coordinate<Real>));
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Real agility = mover.weight(members[i]) * inverse_or_zero(lightest);
        mover.push(members[i], (own_direction<Mover::dimension, Real>(constraint, i) - mean) * (size * agility));
    }
}

/// Twice the share of a correction that member i takes: 1 where the split is fair.
template <class Real> Real handicap(Real split, std::size_t member) {
    return Real(2) * (member == 0 ? split : Real(1) - split);
}

/// Mover of particles that move each other, such as the ports of a block (ports/port_mover.h).
template <class Mover>
concept CouplesParticles = Mover::couples;

/// Response of a measure to the multiplier: the sum of w g . d.
template <class Mover, class Stencil, class Real>
Real resistance_of(const Mover& mover, const Stencil& stencil, std::span<const Row> members, Real split) {
    if constexpr (CouplesParticles<Mover>) {
        return mover.resistance(stencil, members, split);
    } else {
        Real sum = 0;
        stencil.each([&](std::size_t i) {
            const Real w = mover.weight(members[i]) * handicap(split, i);
            sum += w * dot(stencil.gradient[i], stencil.direction[i]);
        });
        return sum;
    }
}

/// Change of a multiplier, limited to the trust region of a linear model.
template <class Mover, class Stencil, class Real>
Real trusted(const Mover& mover, const Stencil& stencil, std::span<const Row> members, Real split, Real change) {
    if constexpr (CouplesParticles<Mover>) return change * mover.trusted_share(stencil, members, split, change);
    return change;
}

template <class Mover, class Stencil, class Real>
void push_all(Mover& mover, const Stencil& stencil, std::span<const Row> members, Real split, Real change) {
    stencil.each([&](std::size_t i) {
        if constexpr (CouplesParticles<Mover>)
            mover.impart(members[i], stencil.direction[i] * (handicap(split, i) * change));
        else
            mover.push(members[i], stencil.direction[i] * (mover.weight(members[i]) * handicap(split, i) * change));
    });
}

template <class Stencil> auto squared(const Stencil& stencil) {
    decltype(dot(stencil.gradient[0], stencil.gradient[0])) sum = 0;
    stencil.each([&](std::size_t i) { sum += dot(stencil.gradient[i], stencil.gradient[i]); });
    return sum;
}

/// Corrects one constraint. False, and nothing corrected, if the gradient vanishes while a limit is violated.
template <class Mover, class Table, int D, class Real>
bool correct_row(std::span<Vec<D, Real>> scratch, Table& table, Row row, Mover& mover) {
    using Kind = typename Table::Kind;
    const auto members = std::as_const(table.members)[row];
    Stencil<Kind, D, Real> stencil(scratch, members.size());

    stencil.each([&](std::size_t i) { stencil.points[i] = mover.point(members[i]); });
    const Real low = table.low(row), high = table.high(row), split = table.split[row];
    const Real measure = unwrap<Kind>(stencil.evaluate(stencil.points, stencil.gradient), low, high);
    mover.choose_direction(stencil, members);

    const Real steepness = squared(stencil);
    Real resistance = resistance_of(mover, stencil, members, split);
    const Real error = measure - clamp(measure, low, high);
    if (steepness == Real(0) && error != Real(0)) return false;

    const Real alpha = mover.alpha(table.compliance[row]);
    const Real lambda = mover.first_iteration ? Real(0) : table.multiplier[row];
    const Real most = mover.most(table.max_force[row]);
    Real ahead = 0; // predicted change of a damped measure
    if (table.damping_time[row] > Real(0) && alpha > Real(0)) {
        ahead = mover.ahead(stencil, members, table.damping_time[row], table.motor_speed[row]);
        resistance *= Real(1) + mover.share(table.damping_time[row]);
    }
    const Real solved = clamp(limited_multiplier(lambda, measure - low + ahead, measure - high + ahead, alpha,
                                                 inverse_or_zero(resistance + alpha)),
                              -most, most);
    const Real change = table.relaxation[row] * (solved - lambda);
    const Real next = lambda + trusted(mover, stencil, members, split, change);
    table.multiplier[row] = next;
    push_all(mover, stencil, members, split, next - lambda);
    return true;
}

template <class Mover, class Table, int D, class Real>
void project_row(std::span<Vec<D, Real>> scratch, Table& table, Row row, Mover& mover) {
    if (correct_row(scratch, table, row, mover)) [[likely]]
        return;
    const auto members = std::as_const(table.members)[row];
    part(mover, members, row, clamp(Real(0), table.low(row), table.high(row)));
    correct_row(scratch, table, row, mover);
}

/// Consecutive constraints of one kind.
template <class Mover, int D, class Real>
void project_run(World<D, Real>& world, std::span<Vec<D, Real>> scratch, const SweepRun& run, Mover& mover) {
    visit_table(world, run.kind, [&](auto& table) {
        for (Row row = run.rows.first; row < run.rows.last; ++row) project_row(scratch, table, row, mover);
    });
}

/// Every constraint once, in the order of the world's sweep.
template <class Mover, int D, class Real>
void project_all(World<D, Real>& world, std::span<Vec<D, Real>> scratch, Mover& mover) {
    std::array<Row, std::size_t(Kinds<D>::size)> next{};
    for (const auto& run : world.sweep) {
        auto& row = next[std::size_t(run.kind)];
        project_run(world, scratch, {run.kind, {row, row + run.count}}, mover);
        row += run.count;
    }
}

} // namespace sinew::detail
