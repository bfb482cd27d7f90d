#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <optional>
#include <utility>

/// Constraints of kinds other than simple distances, and the components that they join.
namespace sinew::detail {

/// Decides which constraints of other kinds are projected there and back: those joined, through each other and through
/// components, to anything compliant or to a component that is swept there and back. Their components go back with
/// them.
template <int D, class Real> class TieFinder {
  public:
    TieFinder(const World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), swept_(solver.sweep_state), plan_(solver.sweep_state.plan), room_(solver.sweep_state.room) {}

    void run() {
        for (auto& component : plan_.components) component.is_tied = false;
        if (plan_.others.empty()) return;
        join();
        mark();
        tie();
    }

  private:
    const World<D, Real>& world_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;

    /// Component of a constraint's first swept member.
    template <class Table> std::optional<Row> component_of(const Table& table, Row row) const {
        for (const Row member : table.members[row])
            if (const auto component = component_of(member)) return component;
        return std::nullopt;
    }
    std::optional<Row> component_of(Row particle) const {
        const Row slot = swept_.slot_of[particle];
        if (slot >= swept_.row_of.size()) return std::nullopt;
        const auto after = std::upper_bound(plan_.components.begin(), plan_.components.end(), slot,
                                            [](Row s, const Component& c) { return s < c.begin.slot; });
        return Row(after - plan_.components.begin()) - 1;
    }

    template <class Visit> void each_row(Visit&& visit) const {
        for (const auto& run : plan_.others)
            visit_table(world_, run.kind, [&](const auto& table) {
                for (Row row = run.rows.first; row < run.rows.last; ++row) visit(run.kind, table, row);
            });
    }

    void join() {
        const auto count = Row(plan_.components.size());
        room_.sets.make_room(count);
        for (Row i = 0; i < count; ++i) room_.sets.separate(i);
        each_row([&](int, const auto& table, Row row) {
            const auto first = component_of(table, row);
            for (const Row member : table.members[row])
                if (const auto component = component_of(member)) room_.sets.join(*first, *component);
        });
    }

    void mark() {
        auto& goes_back = room_.chained;
        goes_back.assign(plan_.components.size(), 0);
        for (Row i = 0; i < plan_.components.size(); ++i)
            if (plan_.components[i].both_ways || plan_.components[i].is_elastic) goes_back[room_.sets.first_of(i)] = 1;
        each_row([&](int, const auto& table, Row row) {
            const auto component = component_of(table, row);
            if (component && !table.is_rigid(row)) goes_back[room_.sets.first_of(*component)] = 1;
        });
    }

    /// Divides the runs where the direction changes.
    void tie() {
        auto& divided = room_.others;
        divided.clear();
        each_row([&](int kind, const auto& table, Row row) {
            const auto component = component_of(table, row);
            const bool both_ways = component && room_.chained[room_.sets.first_of(*component)];
            if (divided.empty() || divided.back().kind != kind || divided.back().rows.last != row ||
                divided.back().both_ways != both_ways)
                divided.push_back({kind, {row, row}, both_ways});
            divided.back().rows.last = row + 1;
            if (!both_ways) return;
            for (const Row member : table.members[row])
                if (const auto tied = component_of(member); tied && plan_.components[*tied].has_links())
                    plan_.components[*tied].is_tied = true;
        });
        std::swap(divided, plan_.others);
    }
};

} // namespace sinew::detail
