#include "sinew/math/sort.h"
#include "sinew/solver/batch/components.h"
#include "sinew/solver/batch/leg_finder.h"
#include "sinew/solver/batch/reuse.h"
#include "sinew/solver/batch/tethers.h"
#include "sinew/solver/batch/ties.h"
#include "sinew/solver/phases.h"

#include <algorithm>

/// PlanBuilder of the sweep: lays out the connected components of simple distances one by one, then adds tethers.
namespace sinew {
namespace {

template <int D, class Real> class PlanBuilder {
  public:
    PlanBuilder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), swept_(solver.sweep_state), plan_(solver.sweep_state.plan),
          room_(solver.sweep_state.room), parts_(world, solver), sheets_(world, solver, parts_),
          tethers_(world, solver), keeper_(world, solver) {}

    void run(bool anew) {
        const bool tore = std::exchange(plan_.may_tear, false);
        inspect_world();
        if (anew || tore != plan_.may_tear)
            keeper_.drop_all();
        else
            keeper_.inspect();
        if (keeper_.rows_moved() || keeper_.any_dropped() || parts_.any()) {
            find_parts();
            solver_.report(0.3);
            lay_out();
            parts_.forget();
        }
        plan_.close();
        for (auto& run : plan_.runs) run.kind = kind_of(run);
        detail::TieFinder<D, Real>(world_, solver_).run();
        detail::find_bend_links(world_, plan_, room_);
        swept_.bend_legs.reserve(plan_.bend_links.capacity());
        plan_.row_moves = world_.journal.row_moves;
        list_pins();
        tethers_.run();
        plan_.parameters.prepare();
        swept_.make_room();
    }

  private:
    static constexpr Row none = ~Row(0);

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    detail::ComponentFinder<D, Real> parts_;
    detail::ComponentBuilder<D, Real> sheets_;
    detail::TetherBuilder<D, Real> tethers_;
    detail::PlanReuse<D, Real> keeper_;

    /// Finds the connected components of all particles without a kept one, until no kept one is affected.
    void find_parts() {
        for (bool found = false; !found;) {
            found = parts_.find([&](Row slot) { keeper_.drop(keeper_.sheet_at(slot)); });
            if (!found) continue;
            put_in_order();
            found = !joins_those_without_links() && !regroups();
        }
    }

    /// Orders by first particle; components without links come last.
    void put_in_order() {
        auto& order = room_.order;
        order.clear();
        for (std::uint32_t part = 0; part < parts_.size(); ++part)
            order.push_back({parts_.links(part).empty() ? none : parts_.members(part).front(), part, false});
        for (std::uint32_t i = 0; i < keeper_.count(); ++i)
            if (keeper_.is_kept(i))
                order.push_back(
                    {plan_.components[i].has_links() ? plan_.components[i].particles.first : none, i, true});
        sinew::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    }

    /// Drops the kept component without links if another one has none: both are laid out as one. True if dropped.
    bool joins_those_without_links() {
        const auto& order = room_.order;
        if (order.size() < 2 || order[order.size() - 2].first != none) return false;
        keeper_.drop(order[order.size() - (order.back().stays ? 1 : 2)].number);
        return true;
    }

    /// Small components of equal shape are laid out together when adjacent. If a small one was added, removed or
    /// changed, or others came between, drops all small components for a new grouping. True if dropped.
    bool regroups() {
        const auto is_small = [&](const PlanRoom::Piece& piece) {
            if (piece.stays) return plan_.components[piece.number].small && plan_.components[piece.number].has_links();
            return !parts_.links(piece.number).empty() && parts_.members(piece.number).size() <= sheets_.max_in_copies;
        };
        bool any_stays = false, changed = false;
        for (std::size_t i = 0; i < keeper_.count(); ++i)
            changed = changed || (!keeper_.is_kept(i) && plan_.components[i].small && plan_.components[i].has_links());
        Row last = 0; // last particle of the small components before
        for (std::size_t i = 0; i < room_.order.size(); ++i) {
            const auto& piece = room_.order[i];
            if (piece.stays && is_small(piece)) {
                any_stays = true;
                changed = changed || piece.number != i;
                last = std::max(last, plan_.components[piece.number].particles.last);
            } else if (!piece.stays) {
                changed = changed || is_small(piece) || (piece.first != none && piece.first < last);
            }
        }
        if (!any_stays || !changed) return false;
        for (std::size_t i = 0; i < keeper_.count(); ++i)
            if (plan_.components[i].small && plan_.components[i].has_links()) keeper_.drop(i);
        return true;
    }

    /// Lays out new components. Kept components with nothing new before stay in place.
    void lay_out() {
        const auto& order = room_.order;
        std::size_t in_place = 0;
        while (in_place < order.size() && order[in_place].stays && order[in_place].number == in_place) ++in_place;
        detail::IncrementalPlan<Real> plan{plan_, swept_.row_of}, spare{swept_.spare, swept_.spare_rows};
        spare.cut_off(0);
        for (std::size_t i = in_place; i < order.size(); ++i)
            if (order[i].stays) spare.append(plan, order[i].number);
        plan.cut_off(in_place);
        std::size_t taken = 0;
        for (std::size_t i = in_place; i < order.size();) {
            if (order[i].stays) {
                plan.append(spare, taken++);
                for (Row slot = plan_.components.back().begin.slot; slot < swept_.row_of.size(); ++slot)
                    swept_.slot_of[swept_.row_of[slot]] = slot;
                ++i;
                continue;
            }
            auto parts = i;
            while (parts < order.size() && !order[parts].stays) ++parts;
            sheets_.lay_out(order[i].number, parts - i);
            i = parts;
        }
    }

    /// Determines may_tear, and reserves memory for the largest plan of a world that can tear: tearing must not
    /// allocate within a step. Large worlds are excepted, to save memory.
    void inspect_world() {
        std::size_t constraints = 0;
        for_each_table(world_, [&](const auto& table) {
            constraints += table.size();
            plan_.may_tear = plan_.may_tear || table.may_tear();
        });
        constexpr std::size_t small = 100'000;
        if (!plan_.may_tear || constraints > small) return;
        plan_.reserve(world_.particles.size(), std::get<kind_number<Distance, D>>(world_.constraints).size(),
                      constraints);
        room_.reserve(world_.particles.size(), std::get<kind_number<Distance, D>>(world_.constraints).size(),
                      constraints);
        swept_.spare.reserve(world_.particles.size(), std::get<kind_number<Distance, D>>(world_.constraints).size(), 0);
        swept_.reserve(world_.particles.size());
    }

    static LinkKind kind_of(const LinkBatch& run) {
        using enum LinkKind;
        if (run.compliant || run.scattered || (run.old_gradient && !run.equality)) return other;
        if (run.old_gradient)
            return !run.equal_mass ? old_gradient_uneven : run.uniform ? old_gradient : old_gradient_each;
        if (run.equality) return !run.equal_mass ? equality_uneven : run.uniform ? equality : equality_each;
        return !run.equal_mass ? inequality_uneven : run.uniform ? inequality : inequality_each;
    }

    void list_pins() {
        plan_.pins.clear();
        for (std::uint32_t i = 0; i < world_.pins.size(); ++i)
            if (const auto row = world_.particles.handles.find(world_.pins[i].particle);
                row && swept_.slot_of[*row] != none)
                plan_.pins.push_back({swept_.slot_of[*row], i});
        sinew::sort(plan_.pins.begin(), plan_.pins.end(),
                    [](const auto& a, const auto& b) { return std::pair(a.slot, a.pin) < std::pair(b.slot, b.pin); });
        std::size_t pin = 0;
        for (auto& tile : plan_.tiles) {
            tile.first_pin = std::uint32_t(pin);
            while (pin < plan_.pins.size() && plan_.pins[pin].slot < tile.last) ++pin;
            tile.last_pin = std::uint32_t(pin);
        }
    }
};

} // namespace

template <int D, class Real> void make_plan(World<D, Real>& world, Solver<D, Real>& solver, bool anew) {
    PlanBuilder<D, Real>(world, solver).run(anew);
}

#define SINEW_PLAN(D, Real) template void make_plan(World<D, Real>&, Solver<D, Real>&, bool);
SINEW_INSTANTIATE(SINEW_PLAN)

} // namespace sinew
