#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/row_solver.h"

/// The Delassus operator of the rows of contact of a group of bodies (nonsmooth dynamics: Moreau 1988): how far each
/// contact moves for an impulse at each other, as whole figures answer with their links held,
///
///     W = H M^-1 H^T,    H  from displacements of particles to those of the contacts
///
/// Impulses on figures with links act on the contacts alone, a few numbers each, until `finish` gives their sums to the
/// particles. A particle without links is moved at once.
namespace sinew::detail {

template <int D, class Real> class Delassus {
  public:
    using Vector = Vec<D, Real>;
    using Matrix = sinew::Matrix<D, Real>;
    using RowT = ContactRow<D, Real>;

    Delassus(ContactRoom<D, Real>& room, SweepState<D, Real>& state, const RowSolver<D, Real>& rows)
        : room_(room), state_(state), rows_(rows), all_(room.delassus) {}

    /// Calls list(add), which calls add(row) for each row of the group.
    template <class List> void begin(const List& list) {
        all_.contacts.clear(), all_.touching.clear(), all_.entries.clear();
        list([&](RowT& row) {
            const auto number = std::uint32_t(all_.contacts.size());
            all_.contacts.push_back({.row = &row, .moved = moved_linked(row)});
            each_lone(row, [&](std::size_t) { all_.contacts.back().has_lone = true; });
            each_component(row, [&](std::uint32_t component) { all_.touching.push_back({component, number}); });
        });
        sinew::sort(all_.touching.begin(), all_.touching.end());
    }
    const RowT& row(std::size_t contact) const { return *all_.contacts[contact].row; }
    /// Displacement of a contact.
    Vector moved(std::size_t contact) const {
        const auto& one = all_.contacts[contact];
        auto sum = one.moved;
        if (one.has_lone) each_lone(*one.row, [&](std::size_t i) { sum += moved_by(*one.row, i); });
        return sum;
    }
    Real mass_along(std::size_t contact, const Vector& direction) {
        learn(contact);
        return inverse_or_zero(dot(direction, all_.contacts[contact].own * direction));
    }
    /// Mass that an impulse along the normal of its row feels.
    Real mass(std::size_t contact) {
        learn(contact);
        return all_.contacts[contact].mass;
    }
    void push(std::size_t contact, const Vector& impulse) {
        if (impulse == Vector{}) return;
        learn(contact);
        auto& one = all_.contacts[contact];
        one.impulse += impulse;
        if (one.has_lone) push_lone(*one.row, impulse);
        if (one.is_kept)
            for (auto i = one.first; i < one.last; ++i) {
                const auto& entry = all_.entries[i];
                all_.contacts[entry.contact].moved += entry.response * impulse;
            }
        else
            answer(contact, [&](std::uint32_t other, const Matrix& response) {
                all_.contacts[other].moved += response * impulse;
            });
    }
    /// Gives the impulses to the particles, and holds the links of each figure. Where a rope lets go or takes hold, the
    /// figure answers otherwise from then on.
    void finish() {
        for (std::size_t i = 0, next = 0; i < all_.touching.size(); i = next) {
            const auto component = all_.touching[i].component;
            Row member = 0;
            bool is_pushed = false;
            for (next = i; next < all_.touching.size() && all_.touching[next].component == component; ++next) {
                const auto& contact = all_.contacts[all_.touching[next].contact];
                if (contact.impulse == Vector{}) continue;
                is_pushed = true;
                for (std::size_t k = 0; k < contact.row->members; ++k)
                    if (component_of(contact.row->slot[k]) == component)
                        give(member = contact.row->slot[k], contact.row->on_member(k, contact.impulse));
            }
            if (!is_pushed || !projector().project_velocities(state_, member)) continue;
            for (const auto& touching : contacts_of(component)) all_.contacts[touching.contact].is_known = false;
        }
        for (auto& one : all_.contacts) one.impulse = {}, one.moved = moved_linked(*one.row);
    }

  private:
    using Touching = typename DelassusRoom<D, Real>::Touching;
    static constexpr auto none = RigidLinks<D, Real>::none;
    static constexpr std::size_t most_entries = 1 << 18; ///< kept; a push at other contacts asks the figures again
    ContactRoom<D, Real>& room_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
    DelassusRoom<D, Real>& all_;

    LinkProjector<D, Real>& projector() const { return room_.projector; }
    std::uint32_t component_of(Row slot) const { return projector().links().component_of[slot]; }

    /// Calls visit(i) for the members that can move and have no links.
    template <class Visit> void each_lone(const RowT& row, const Visit& visit) const {
        for (std::size_t i = 0; i < row.members; ++i)
            if (is_lone(row.slot[i])) visit(i);
    }
    bool is_lone(Row slot) const { return component_of(slot) == none && state_.mobility[slot] > Real(0); }
    Vector moved_by(const RowT& row, std::size_t i) const {
        return row.by_member(i, state_.displacement_at(row.slot[i]));
    }
    /// Displacement by the members that have links, or cannot move.
    Vector moved_linked(const RowT& row) const {
        Vector sum{};
        for (std::size_t i = 0; i < row.members; ++i)
            if (!is_lone(row.slot[i])) sum += moved_by(row, i);
        return sum;
    }
    void give(Row slot, const Vector& impulse) const {
        const auto moved = state_.displacement_at(slot) + impulse * state_.mobility[slot];
        state_.set_displacement(slot, clamp_components(moved, rows_.furthest()));
    }
    void push_lone(const RowT& row, const Vector& impulse) const {
        each_lone(row, [&](std::size_t i) { give(row.slot[i], row.on_member(i, impulse)); });
    }
    /// Calls visit(component) for each component of rigid links that a row meets.
    template <class Visit> void each_component(const RowT& row, const Visit& visit) const {
        for (std::size_t i = 0; i < row.members; ++i) {
            const auto component = component_of(row.slot[i]);
            const auto is_same = [&](Row slot) { return component_of(slot) == component; };
            if (component != none && std::ranges::none_of(row.slots().first(i), is_same)) visit(component);
        }
    }
    std::span<const Touching> contacts_of(std::uint32_t component) const {
        const auto [first, last] = std::ranges::equal_range(all_.touching, component, {}, &Touching::component);
        return {first, last};
    }

    void learn(std::size_t contact) {
        auto& one = all_.contacts[contact];
        if (one.is_known) return;
        one.is_known = true;
        one.first = all_.entries.size();
        one.own = {};
        each_lone(*one.row, [&](std::size_t i) {
            for (std::size_t axis = 0; axis < D; ++axis) {
                const auto push = one.row->on_member(i, Vector::axis(int(axis))) * state_.mobility[one.row->slot[i]];
                one.own.column[axis] += one.row->by_member(i, push);
            }
        });
        std::size_t count = 0;
        each_component(*one.row, [&](std::uint32_t component) { count += contacts_of(component).size(); });
        one.is_kept = one.first + count <= most_entries;
        answer(contact, [&](std::uint32_t other, const Matrix& response) {
            if (other == contact) one.own += response;
            if (one.is_kept) all_.entries.push_back({other, response});
        });
        one.last = all_.entries.size();
        one.mass = inverse_or_zero(dot(one.row->normal, one.own * one.row->normal));
    }
    /// Calls visit(other, response) for the contacts of each component that a contact meets: displacement there for an
    /// impulse here.
    template <class Visit> void answer(std::size_t contact, const Visit& visit) const {
        const auto& row = *all_.contacts[contact].row;
        const auto response = projector().response(state_);
        each_component(row, [&](std::uint32_t component) {
            const auto others = contacts_of(component);
            all_.responses.assign(others.size(), Matrix{});
            for (std::size_t axis = 0; axis < D; ++axis) {
                std::array<Vec<D, double>, RowT::most> pushes{};
                for (std::size_t i = 0; i < row.members; ++i)
                    pushes[i] = cast<double>(row.on_member(i, Vector::axis(int(axis))));
                const auto displacement_at =
                    response.respond(component, row.slots(), std::span(pushes).first(row.members));
                for (std::size_t k = 0; k < others.size(); ++k) {
                    const auto& other = *all_.contacts[others[k].contact].row;
                    for (std::size_t i = 0; i < other.members; ++i)
                        if (component_of(other.slot[i]) == component)
                            all_.responses[k].column[axis] +=
                                other.by_member(i, cast<Real>(displacement_at(other.slot[i])));
                }
            }
            for (std::size_t k = 0; k < others.size(); ++k) visit(others[k].contact, all_.responses[k]);
        });
    }
};

/// Whole figures as the nodes of a row (row_nodes.h).
template <int D, class Real> struct DelassusNodes {
    using Vector = Vec<D, Real>;
    Delassus<D, Real>& figures;
    std::size_t contact = 0;

    Vector displacement() const { return figures.moved(contact); }
    Real mass_along(const Vector& direction) const { return figures.mass_along(contact, direction); }
    void push(const Vector& impulse) const { figures.push(contact, impulse); }
};

} // namespace sinew::detail
