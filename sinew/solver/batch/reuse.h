#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/batch/batches.h"
#include "sinew/solver/batch/incremental.h"

/// Incremental planning: keeps the components without changes (changes.h), and updates their rows after removals.
/// Particles outside blocks without a slot must be laid out.
namespace sinew::detail {

template <int D, class Real> class PlanReuse {
  public:
    static constexpr Row none = ~Row(0);

    PlanReuse(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), swept_(solver.sweep_state), plan_(solver.sweep_state.plan),
          kept_(solver.sweep_state.room.kept), pieces_{solver.sweep_state.plan, solver.sweep_state.row_of},
          runs_(world, solver) {}

    /// Drops every component.
    void drop_all() {
        plan_.clear();
        swept_.row_of.clear();
        swept_.slot_of.assign(world_.particles.size(), none);
        kept_.clear();
        dropped_ = true;
    }

    /// Decides which components to keep. Call after the blocks have been found.
    void inspect() {
        plan_.open();
        kept_.assign(plan_.components.size(), 1);
        follow_rows();
        for (const auto& touched : world_.journal.touched) {
            if (!handles().in_use(touched.particle)) continue;
            const Row row = handles().row_at(touched.particle);
            const auto slot = swept_.slot_of[row];
            if (slot == none) continue;
            const auto component = sheet_at(slot);
            if (touched.what == Touch::joined)
                drop(component);
            else if (drop_if_left(row))
                continue;
            else
                kept_[component] = heavier;
        }
        for (const Row row : solver_.blocks.room.members) drop_if_left(row);
        for (const Row row : solver_.blocks.room.attached)
            if (swept_.slot_of[row] != none) drop(sheet_at(swept_.slot_of[row]));
        for (std::size_t i = 0; i < kept_.size(); ++i)
            if (kept_[i] == heavier) weigh(i);
    }

    bool is_kept(std::size_t component) const { return kept_[component] != 0; }
    std::size_t count() const { return kept_.size(); }
    bool rows_moved() const { return rows_moved_; }
    bool any_dropped() const { return dropped_; }

    std::size_t sheet_at(Row slot) const {
        SINEW_ASSERT(!plan_.components.empty() && slot < swept_.row_of.size(), "the slot belongs to a component");
        const auto& components = plan_.components;
        const auto after = std::upper_bound(components.begin(), components.end(), slot,
                                            [](Row s, const Component& component) { return s < component.begin.slot; });
        return std::size_t(after - components.begin()) - 1;
    }

    void drop(std::size_t component) {
        if (!kept_[component]) return;
        kept_[component] = 0;
        dropped_ = true;
        for (auto slot = plan_.components[component].begin.slot; slot < plan_.end_of(component).slot; ++slot)
            swept_.slot_of[swept_.row_of[slot]] = none;
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    std::vector<char>& kept_; ///< flag by component
    IncrementalPlan<Real> pieces_;
    RunWriter<D, Real> runs_;
    bool dropped_ = false, rows_moved_ = false;

    static constexpr char heavier = 2; ///< kept, with changed mobilities

    const HandleMap<ParticleTag>& handles() const { return world_.particles.handles; }

    void follow_rows() {
        rows_moved_ = plan_.row_moves != world_.journal.row_moves;
        if (!rows_moved_) return swept_.slot_of.resize(world_.particles.size(), none);
        swept_.slot_of.assign(world_.particles.size(), none);
        const auto& links = std::get<kind_number<Distance, D>>(world_.constraints).handles;
        for (std::size_t i = 0; i < plan_.components.size(); ++i) {
            auto& component = plan_.components[i];
            const bool stays = moved_as_one(component.particles, handles()) &&
                               (!component.has_links() || moved_as_one(component.links, links));
            kept_[i] = stays;
            dropped_ = dropped_ || !stays;
            if (!stays) continue;
            pieces_.shift(component, handles().row_at(component.particles.first_id) - component.particles.first,
                          component.has_links() ? links.row_at(component.links.first_id) - component.links.first : 0);
            for (auto slot = component.begin.slot; slot < plan_.end_of(i).slot; ++slot)
                swept_.slot_of[swept_.row_of[slot]] = slot;
        }
    }
    template <class Ids> static bool moved_as_one(const Extent& extent, const Ids& ids) {
        return ids.in_use(extent.first_id) && ids.in_use(extent.last_id) &&
               ids.row_at(extent.last_id) - ids.row_at(extent.first_id) == extent.last - extent.first;
    }

    /// Drops the component of a particle now moved by a block, or of a particle without links, which may have got some.
    bool drop_if_left(Row row) {
        const auto slot = swept_.slot_of[row];
        if (slot == none) return true;
        const auto component = sheet_at(slot);
        const bool left = world_.particles.at_end[row] || !plan_.components[component].has_links();
        if (left) drop(component);
        return left;
    }

    void weigh(std::size_t component) {
        const auto last = plan_.end_of(component).run;
        for (auto run = plan_.components[component].begin.run; run < last; ++run) runs_.weigh(plan_.runs[run]);
    }
};

} // namespace sinew::detail
