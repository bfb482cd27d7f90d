#pragma once

#include "sinew/solver/plan_pieces.h"
#include "sinew/solver/plan_runs.h"

/// Incremental planning: keeps the components without changes (changes.h), and updates their rows after removals.
/// Particles outside blocks without a slot must be laid out.
namespace sinew::detail {

template <int D, class Real> class PlanKeeper {
  public:
    static constexpr Row none = ~Row(0);

    explicit PlanKeeper(World<D, Real>& world)
        : world_(world), swept_(world.swept), plan_(world.swept.plan),
          kept_(world.swept.room.kept), pieces_{world.swept.plan, world.swept.row_of}, runs_(world) {}

    /// Drops every component.
    void drop_all() {
        plan_.clear();
        swept_.row_of.clear();
        swept_.slot_of.assign(world_.particles.size(), none);
        kept_.clear();
        dropped_ = true;
    }

    /// Decides which components to keep. Call after the blocks have been found.
    void look() {
        plan_.open();
        kept_.assign(plan_.sheets.size(), 1);
        follow_rows();
        for (const auto& touched : world_.blocks.touched) {
            if (!slots().in_use(touched.particle)) continue;
            const Row row = slots().row_at(touched.particle);
            const auto slot = swept_.slot_of[row];
            if (slot == none) continue;
            const auto sheet = sheet_at(slot);
            if (touched.what == Touch::joined)
                drop(sheet);
            else if (drop_if_left(row))
                continue;
            else
                kept_[sheet] = heavier;
        }
        for (const Row row : world_.blocks.room.members) drop_if_left(row);
        for (const Row row : world_.blocks.room.hung)
            if (swept_.slot_of[row] != none) drop(sheet_at(swept_.slot_of[row]));
        for (std::size_t i = 0; i < kept_.size(); ++i)
            if (kept_[i] == heavier) weigh(i);
    }

    bool is_kept(std::size_t sheet) const { return kept_[sheet] != 0; }
    std::size_t count() const { return kept_.size(); }
    bool rows_moved() const { return rows_moved_; }
    bool any_dropped() const { return dropped_; }

    std::size_t sheet_at(Row slot) const {
        const auto& sheets = plan_.sheets;
        const auto after = std::upper_bound(sheets.begin(), sheets.end(), slot,
                                            [](Row s, const Sheet& sheet) { return s < sheet.begin.slot; });
        return std::size_t(after - sheets.begin()) - 1;
    }

    void drop(std::size_t sheet) {
        if (!kept_[sheet]) return;
        kept_[sheet] = 0;
        dropped_ = true;
        for (auto slot = plan_.sheets[sheet].begin.slot; slot < plan_.end_of(sheet).slot; ++slot)
            swept_.slot_of[swept_.row_of[slot]] = none;
    }

  private:
    World<D, Real>& world_;
    Swept<D, Real>& swept_;
    Plan<Real>& plan_;
    std::vector<char>& kept_; ///< flag by component
    PlanPieces<Real> pieces_;
    RunWriter<D, Real> runs_;
    bool dropped_ = false, rows_moved_ = false;

    static constexpr char heavier = 2; ///< kept, with changed mobilities

    const Slots<ParticleTag>& slots() const { return world_.particles.slots; }

    void follow_rows() {
        rows_moved_ = plan_.row_moves != world_.blocks.row_moves;
        if (!rows_moved_) return swept_.slot_of.resize(world_.particles.size(), none);
        swept_.slot_of.assign(world_.particles.size(), none);
        const auto& links = std::get<kind_number<Distance, D>>(world_.constraints).slots;
        for (std::size_t i = 0; i < plan_.sheets.size(); ++i) {
            auto& sheet = plan_.sheets[i];
            const bool stays =
                moved_as_one(sheet.particles, slots()) && (!sheet.has_links() || moved_as_one(sheet.links, links));
            kept_[i] = stays;
            dropped_ = dropped_ || !stays;
            if (!stays) continue;
            pieces_.shift(sheet, slots().row_at(sheet.particles.first_id) - sheet.particles.first,
                          sheet.has_links() ? links.row_at(sheet.links.first_id) - sheet.links.first : 0);
            for (auto slot = sheet.begin.slot; slot < plan_.end_of(i).slot; ++slot)
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
        const auto sheet = sheet_at(slot);
        const bool left = world_.particles.in_block[row] || !plan_.sheets[sheet].has_links();
        if (left) drop(sheet);
        return left;
    }

    void weigh(std::size_t sheet) {
        const auto last = plan_.end_of(sheet).run;
        for (auto run = plan_.sheets[sheet].begin.run; run < last; ++run) runs_.weigh(plan_.runs[run]);
    }
};

} // namespace sinew::detail
