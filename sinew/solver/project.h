#pragma once

#include "sinew/math/random.h"
#include "sinew/solver/bend_legs.h"
#include "sinew/solver/sweep_run.h"
#include "sinew/world/stencil.h"

/// Solution of one constraint: the same text for every kind, dimension, precision and mode.
///
///     error    the measure's distance from its limits
///     dlambda = -(error + alpha lambda) / (sum w g . d + alpha),   alpha = compliance / h^2
///     x_i    += w_i d_i dlambda
///
/// (XPBD: Macklin, Mueller and Chentanez 2016; alpha = 0 is PBD: Mueller et al. 2007). g is the gradient at the present
/// positions, d the direction of the correction. A Mover gives access to the particles: see step.cpp and classic.cpp.
namespace sinew::detail {

/// Multiplier of a constraint with two limits: positive below the low one, negative above the high one, zero in
/// between. The same text serves equalities, maximum and minimum lengths, and ranges.
template <class Real> Real limited_multiplier(Real lambda, Real below, Real above, Real alpha, Real per_resistance) {
    const Real pushing = lambda - (below + alpha * lambda) * per_resistance;
    const Real pulling = lambda - (above + alpha * lambda) * per_resistance;
    return max(pushing, Real(0)) + min(pulling, Real(0));
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
        extent = max(extent, distance(mover.point(members[i]), mover.point(members[0])));
        lightest = max(lightest, mover.weight(members[i]));
        mean += own_direction<Mover::dimension, Real>(constraint, i) * (Real(1) / Real(members.size()));
    }
    const Real size = share * (extent > Real(0) ? extent : min(absolute(rest), limit::coordinate<Real>));
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Real agility = mover.weight(members[i]) * inverse_or_zero(lightest);
        mover.displace(members[i], (own_direction<Mover::dimension, Real>(constraint, i) - mean) * (size * agility));
    }
}

/// Twice the share of a correction that member i takes: 1 where the split is fair.
template <class Real> Real handicap(Real split, std::size_t member) {
    return Real(2) * (member == 0 ? split : Real(1) - split);
}

/// Mover of particles that move each other, such as the ports of a block (ports/port_mover.h).
template <class Mover>
concept CouplesParticles = Mover::couples;

/// A bend in physical mode, whose legs turn.
template <class Kind, class Mover>
concept BendsLegs = std::is_same_v<Kind, Angle<Mover::dimension>> && requires(const Mover& mover) {
    mover.bend_legs(Row());
};

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
template <class Kind, class Mover, class Stencil, class Real>
Real trusted(const Mover& mover, const Stencil& stencil, std::span<const Row> members, Real split, Real change) {
    if constexpr (CouplesParticles<Mover>)
        return change * mover.trusted_share(stencil, members, split, change);
    else if constexpr (BendsLegs<Kind, Mover>)
        return change * share_of_turn(stencil, mover, members, change);
    else
        return change;
}

template <class Mover, class Stencil, class Real>
void displace_all(Mover& mover, const Stencil& stencil, std::span<const Row> members, Real split, Real change) {
    stencil.each([&](std::size_t i) {
        if constexpr (CouplesParticles<Mover>)
            mover.impart(members[i], stencil.direction[i] * (handicap(split, i) * change));
        else
            mover.displace(members[i], stencil.direction[i] * (mover.weight(members[i]) * handicap(split, i) * change));
    });
}

template <class Stencil> auto squared(const Stencil& stencil) {
    decltype(dot(stencil.gradient[0], stencil.gradient[0])) sum = 0;
    stencil.each([&](std::size_t i) { sum += dot(stencil.gradient[i], stencil.gradient[i]); });
    return sum;
}

/// True if a bend fades with its legs: its measure and gradient are then those of the faded one.
template <class Kind, class Mover, class Stencil, class Real>
bool fades(const Mover& mover, Stencil& stencil, Row row, Real low, Real high, Real& measure) {
    if constexpr (BendsLegs<Kind, Mover>)
        return fade_bend(stencil, mover.bend_legs(row), low, high, measure);
    else
        return false;
}

/// Corrects one constraint. False, and nothing corrected, if the gradient vanishes while a limit is violated.
template <class Mover, class Table, int D, class Real>
bool correct_row(std::span<Vec<D, Real>> scratch, Table& table, Row row, Mover& mover) {
    using Kind = typename Table::Kind;
    const auto members = std::as_const(table.members)[row];
    Stencil<Kind, D, Real> stencil(scratch, members.size());

    stencil.each([&](std::size_t i) { stencil.points[i] = mover.point(members[i]); });
    const Real low = table.low(row), high = table.high(row), split = table.split[row];
    Real measure = unwrap<Kind>(stencil.evaluate(stencil.points, stencil.gradient), low, high);
    if (fades<Kind>(mover, stencil, row, low, high, measure))
        stencil.direction = stencil.gradient;
    else
        mover.choose_direction(stencil, members);

    const Real steepness = squared(stencil);
    Real resistance = resistance_of(mover, stencil, members, split);
    const Real error = measure - clamp(measure, low, high);
    if (steepness == Real(0) && error != Real(0)) return false;

    const Real alpha = mover.alpha(table.compliance[row]);
    const Real lambda = mover.first_iteration ? Real(0) : table.multiplier[row];
    const Real max = mover.max_multiplier(table.max_force[row]);
    Real ahead = 0; // predicted change of a damped measure
    if (table.damping_time[row] > Real(0) && alpha > Real(0)) {
        ahead = mover.ahead(stencil, members, table.damping_time[row], table.motor_speed[row]);
        resistance *= Real(1) + mover.share(table.damping_time[row]);
    }
    const Real solved = clamp(limited_multiplier(lambda, measure - low + ahead, measure - high + ahead, alpha,
                                                 inverse_or_zero(resistance + alpha)),
                              -max, max);
    const Real change = table.relaxation[row] * (solved - lambda);
    const Real next = lambda + trusted<Kind>(mover, stencil, members, split, change);
    table.multiplier[row] = next;
    displace_all(mover, stencil, members, split, next - lambda);
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
