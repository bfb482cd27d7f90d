#pragma once

#include "sinew/prefab/ground.h"

#include <array>
#include <optional>

namespace sinew::detail {

/// Handhold: a point of a link of another figure. A link that leads upwards, as of a rope, is held at its upper end; a
/// level one, a plank, at a point between both.
template <class Real> struct Handhold {
    std::array<ParticleId, 2> anchors{};
    int count = 0; ///< of anchors
    Vec<2, Real> point{};
    FigureIndex figure = no_figure;
};

inline constexpr std::string_view hold_name = "hold"; ///< of the distances from the head to a handhold

/// Row of the particle that a hold leads to; nothing for any other constraint.
template <class Real>
std::optional<Row> anchor_of(const World<2, Real>& world, std::string_view called, const ConstraintId& id) {
    if (called != hold_name || id.kind != kind_number<Distance, 2>) return std::nullopt;
    const auto& links = std::get<std::size_t(kind_number<Distance, 2>)>(world.constraints);
    const auto row = links.handles.find(id.id);
    return row ? std::optional(links.members[*row][1]) : std::nullopt;
}

/// Figure that a character holds; nothing if it holds none.
template <class Real> std::optional<FigureIndex> held_by(const World<2, Real>& world, FigureIndex figure) {
    for (const auto& [called, id] : world.figures[figure].constraint_names)
        if (const auto anchor = anchor_of(world, called, id)) return world.particles.figure[*anchor];
    return std::nullopt;
}

/// Hands of a character: the distances called "hold" from its head to a handhold.
template <class Real> class Hands {
  public:
    using Vector = Vec<2, Real>;

    Hands(World<2, Real>& world, FigureIndex figure, const Character& character, Row head)
        : world_(world), figure_(figure), character_(character), head_(world.particles.handles.id_of(head)),
          upright_(Upright<Real>::of(world)) {}

    void let_go() {
        std::array<ConstraintId, 2> holds{};
        const auto count = find(holds);
        if (count > 0) remove_constraints(world_, std::span<const ConstraintId>(holds.data(), count));
    }

    /// Takes the nearest handhold within reach; false if there is none.
    bool take() {
        const auto found = nearest(Real(character_.reach), no_figure, [](const Vector&) { return Real(0); });
        if (found) take(*found);
        return found.has_value();
    }

    /// Pulls towards the length of the arms, and climbs: `up` is the share of the speed.
    void climb(Real up) {
        const Real spare = (arms() - length()) * (up > Real(0) ? Real(1) : Real(-1));
        if (up != Real(0) && spare > Real(-0.02) * arms()) reach(up);
        pull(up == Real(0) ? Real(1) : min(absolute(up), Real(1)));
    }

  private:
    World<2, Real>& world_;
    FigureIndex figure_;
    const Character& character_;
    ParticleId head_;
    Upright<Real> upright_;

    Real arms() const { return Real(0.5 * character_.reach); }
    Vector head() const { return position_of(world_, head_).value_or(Vector{}); }
    const auto& links() const { return std::get<std::size_t(kind_number<Distance, 2>)>(world_.constraints); }

    std::size_t find(std::array<ConstraintId, 2>& holds) const {
        std::size_t count = 0;
        for (const auto& [called, id] : world_.figures[figure_].constraint_names)
            if (count < holds.size() && anchor_of(world_, called, id)) holds[count++] = id;
        return count;
    }

    /// Place of the handhold: between the anchors, above the head.
    std::optional<Vector> place() const {
        std::array<ConstraintId, 2> holds{};
        std::array<Vector, 2> at{};
        const auto count = find(holds);
        for (std::size_t i = 0; i < count; ++i)
            at[i] = world_.particles.position[*anchor_of(world_, hold_name, holds[i])];
        if (count == 0) return std::nullopt;
        if (count == 1) return at[0];
        const auto line = at[1] - at[0];
        const Real share = clamp(dot(head() - at[0], line) * inverse_or_zero(dot(line, line)), Real(0), Real(1));
        return at[0] + line * share;
    }
    Real length() const {
        const auto at = place();
        return at ? distance(*at, head()) : Real(0);
    }

    /// Handhold within a distance of the head with the smallest `worth`, and the nearest among equals. `of`: a figure,
    /// or no_figure for any other than the own one. A negative worth excludes.
    template <class Worth>
    std::optional<Handhold<Real>> nearest(Real within, FigureIndex of, const Worth& worth) const {
        std::optional<Handhold<Real>> best;
        Real best_worth = 0, best_distance = 0;
        const auto& p = world_.particles;
        const auto from = head();
        for (Row row = 0; row < links().size(); ++row) {
            const auto figure = p.figure[links().members[row][0]];
            if (!ties(links(), row) || figure == figure_ || (of != no_figure && figure != of)) continue;
            if (figure == no_figure || !touch(world_.figures[figure].filter, world_.figures[figure_].filter)) continue;
            const auto hold = handhold(row, figure);
            const Real away = distance(hold.point, from), worth_of = worth(hold.point);
            if (away > within || worth_of < Real(0)) continue;
            if (best && (worth_of > best_worth || (worth_of == best_worth && away >= best_distance))) continue;
            best = hold, best_worth = worth_of, best_distance = away;
        }
        return best;
    }
    Handhold<Real> handhold(Row row, FigureIndex figure) const {
        const auto& p = world_.particles;
        const auto ends = links().members[row];
        const auto a = p.position[ends[0]], b = p.position[ends[1]], line = b - a;
        const Real rise = dot(line, upright_.up);
        Handhold<Real> hold{.figure = figure};
        if (absolute(rise) > Real(0.5) * norm(line)) {
            const Row top = rise > Real(0) ? ends[1] : ends[0];
            hold.anchors[0] = p.handles.id_of(top), hold.count = 1, hold.point = p.position[top];
        } else {
            const Real share = clamp(dot(head() - a, line) * inverse_or_zero(dot(line, line)), Real(0), Real(1));
            hold.anchors = {p.handles.id_of(ends[0]), p.handles.id_of(ends[1])}, hold.count = 2;
            hold.point = a + line * share;
        }
        return hold;
    }

    void take(const Handhold<Real>& hold) {
        let_go();
        for (int i = 0; i < hold.count; ++i) {
            const auto anchor = hold.anchors[std::size_t(i)];
            const auto id =
                add<Distance>(world_, {head_, anchor},
                              {.limits = at_most(distance(head(), *position_of(world_, anchor))), .figure = figure_});
            if (id) world_.figures[figure_].constraint_names.emplace_back(hold_name, *id);
        }
    }

    /// Takes the next handhold of the same figure above or below.
    void reach(Real up) {
        const auto now = place();
        const auto figure = held_by(world_, figure_);
        if (!now || !figure) return;
        const Real least = Real(0.02) * arms(), sign = up > Real(0) ? Real(1) : Real(-1);
        const auto next = nearest(arms() + Real(character_.reach), *figure, [&](const Vector& point) {
            const Real further = sign * dot(point - *now, upright_.up);
            return further > least ? further : Real(-1);
        });
        if (next) take(*next);
    }

    /// Drives the holds so that the hands come to the length of the arms.
    void pull(Real share) {
        std::array<ConstraintId, 2> holds{};
        const auto count = find(holds);
        const auto at = place();
        if (!at) return;
        const Real speed = Real(character_.climb_speed) * share, tolerance = Real(0.01) * arms();
        for (std::size_t i = 0; i < count; ++i) {
            const auto row = *links().handles.find(holds[i].id);
            const auto anchor = world_.particles.position[links().members[row][1]];
            const auto below = *at - upright_.up * arms();
            const Real wanted = distance(below, anchor) - links().high(row);
            drive(world_, holds[i],
                  absolute(wanted) < tolerance ? Real(0)
                                               : clamp(wanted / tolerance * Real(0.2), Real(-1), Real(1)) * speed);
        }
    }
};

} // namespace sinew::detail
