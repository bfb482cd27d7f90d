#include "sinew/solver/free_bodies.h"

#include "sinew/solver/phases.h"

#include <algorithm>
#include <span>
#include <utility>

namespace sinew {
namespace {

/// Connected components of the plan under all constraints. Simple distances have joined the particles of a component of
/// the plan.
template <int D, class Real> class FreeBodyFinder {
  public:
    FreeBodyFinder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), state_(solver.sweep_state), ports_(solver.blocks.ports), plan_(solver.sweep_state.plan),
          bodies_(solver.sweep_state.bodies), sets_(solver.sweep_state.room.sets),
          number_(solver.sweep_state.room.part_of) {}

    void run() {
        bodies_.clear();
        begin();
        each_other([&](const auto& table, Row row) { join(table.members[row]); });
        hold();
        for (Row slot = 0; slot < state_.size(); ++slot)
            if (auto& members = number_[sets_.first_of(slot)]; members != held) ++members;
        list_bodies();
        list_members();
        note_springs();
        if (!bodies_.list.empty()) bodies_.touched.reserve(state_.size());
    }

  private:
    static constexpr Row none = ~Row(0), held = none;

    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    const Ports<D>& ports_;
    Plan<Real>& plan_;
    FreeBodies<D>& bodies_;
    UnionFind& sets_;          ///< of slots
    std::vector<Row>& number_; ///< by first slot: number of members, later index in the list; or `held`

    void begin() {
        sets_.make_room(state_.size());
        number_.assign(state_.size(), 0);
        for (const auto& component : plan_.components) {
            const Row first = component.begin.slot, last = plan_.end_of(component).slot;
            const Row parts = !component.has_links() ? last - first : max(component.copies, 1U);
            for (Row slot = first; slot < last; ++slot) sets_.attach(slot, first + (slot - first) % parts);
        }
    }

    /// Calls visit(table, row) for each constraint that is no simple distance.
    template <class Visit> void each_other(Visit&& visit) {
        for (const auto& run : plan_.others)
            visit_table(world_, run.kind, [&](const auto& table) {
                for (Row row = run.rows.first; row < run.rows.last; ++row) visit(table, row);
            });
    }
    void join(std::span<const Row> members) {
        Row joined = none;
        for (const Row member : members) {
            if (state_.slot_of[member] == none) continue;
            const Row slot = state_.slot_of[member];
            if (joined != none) sets_.join(joined, slot);
            joined = slot;
        }
    }

    /// Marks components with pins or ports, and those with a constraint that acts otherwise than in pairs.
    void hold() {
        for (const auto& pinned : plan_.pins) number_[sets_.first_of(pinned.slot)] = held;
        for (const auto& group : ports_.groups)
            for (const auto slot : std::span(ports_.members).subspan(group.first, group.members))
                number_[sets_.first_of(slot)] = held;
        each_other([&](const auto& table, Row row) {
            const auto members = table.members[row];
            const auto is_outside = [&](Row member) { return state_.slot_of[member] == none; };
            if (table.split[row] == Real(0.5) && std::none_of(members.begin(), members.end(), is_outside)) return;
            for (const Row member : members)
                if (!is_outside(member)) number_[sets_.first_of(state_.slot_of[member])] = held;
        });
    }

    void list_bodies() {
        for (auto& component : plan_.components) {
            component.first_body = std::uint32_t(bodies_.list.size());
            for (Row slot = component.begin.slot; slot < plan_.end_of(component).slot; ++slot) {
                if (!sets_.is_first(slot)) continue;
                const auto members = number_[slot];
                const bool is_body = members != held && members > 1;
                number_[slot] = is_body ? Row(bodies_.list.size()) : held;
                if (is_body) bodies_.list.push_back({.first = slot, .members = members});
            }
            component.bodies = std::uint32_t(bodies_.list.size()) - component.first_body;
        }
    }

    /// Lists the members of bodies that do not lie side by side.
    void list_members() {
        for (Row slot = 0; slot < state_.size(); ++slot)
            if (auto* body = body_of(slot)) {
                body->scattered = body->scattered || slot >= body->first + body->members;
                body->near = body->near || world_.particles.near[state_.row_of[slot]] != 0;
            }
        std::uint32_t size = 0;
        for (auto& body : bodies_.list)
            if (body.scattered) body.first = std::exchange(size, size + std::exchange(body.members, 0));
        bodies_.slots.resize(size);
        for (Row slot = 0; slot < state_.size(); ++slot)
            if (auto* body = body_of(slot); body && body->scattered)
                bodies_.slots[body->first + body->members++] = slot;
    }
    FreeBody<D>* body_of(Row slot) {
        const Row number = number_[sets_.first_of(slot)];
        return number == held ? nullptr : &bodies_.list[number];
    }

    void note_springs() {
        for (const auto& component : plan_.components) {
            const auto runs = std::span(plan_.runs).first(plan_.end_of(component).run).subspan(component.begin.run);
            if (std::none_of(runs.begin(), runs.end(), [](const LinkBatch& run) { return run.compliant; })) continue;
            for (Row slot = component.begin.slot; slot < plan_.end_of(component).slot; ++slot)
                if (auto* body = body_of(slot)) body->lossless = false;
        }
        each_other([&](const auto& table, Row row) {
            if (table.is_rigid(row) && !table.motorized[row] && !table.gives(row)) return;
            for (const Row member : table.members[row])
                if (const Row slot = state_.slot_of[member]; slot != none)
                    if (auto* body = body_of(slot)) body->lossless = false;
        });
    }
};

} // namespace

template <int D, class Real> void find_free_bodies(World<D, Real>& world, Solver<D, Real>& solver) {
    FreeBodyFinder<D, Real>(world, solver).run();
}

#define SINEW_FREE_BODIES(D, Real) template void find_free_bodies(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_FREE_BODIES)

} // namespace sinew
