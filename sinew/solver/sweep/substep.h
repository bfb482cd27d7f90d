#pragma once

#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"
#include "sinew/solver/sweep/pin_projector.h"
#include "sinew/solver/sweep/predictor.h"

#include <algorithm>

/// Phases of a substep, each for the particles of a tile. The order is in step.cpp.
namespace sinew::detail {

template <int D, class Real> class Substep {
  public:
    Substep(World<D, Real>& world, Solver<D, Real>& solver, const Kernels<D, Real>& kernels,
            const DistanceColumns<D, Real>& links, int number, int substeps, Real h)
        : world_(world), solver_(solver), swept_(solver.sweep_state), kernels_(kernels),
          links_(links), mover_{solver.sweep_state, h}, predictor_(world, solver.sweep_state, mover_, number),
          share_(Real(number) / Real(substeps)), share_of_substep_(Real(1) / Real(substeps)), number_(number),
          last_(number == substeps), tethered_((substeps - number) % 2 == 0) {
        motion_.position = swept_.position[0];
        motion_.displacement = swept_.displacement[0];
        motion_.residual = swept_.residual[0];
        motion_.stride = swept_.stride();
        motion_.mobility = swept_.mobility;
        motion_.max = mover_.furthest;
        motion_.furthest = limit::coordinate<Real>;
        predictor_.fall(motion_);
    }

    /// The links of cloth are swept several times: the last substep corrects them by the tangent, as the others do.
    bool is_repeated = false;
    SubstepMover<D, Real>& mover() { return mover_; }
    PinProjector<D, Real> pins() { return {world_, solver_, mover_, share_ - share_of_substep_, share_, number_ > 1}; }
    /// Factor of velocities by the common damping.
    Real keep() const { return predictor_.keep(); }

    /// Free motion, and hard pins.
    void predict(const Tile& tile) {
        if (has_walls(world_))
            for (Row slot = tile.first; slot < tile.last; ++slot) swept_.blows[slot].count = 0;
        if (swept_.everyone_alike) {
            predictor_.weigh(tile);
            predictor_.slow_turns(tile);
            kernels_.drift(motion_, tile.first, tile.last);
        } else {
            for (Row slot = tile.first; slot < tile.last; ++slot) predictor_.predict(slot);
        }
        pins().move(tile);
    }

    /// Projects the simple distances of a colour that start in tile `tile`.
    void project(const Component& component, std::uint32_t number, std::uint32_t tile, bool again = false) {
        const auto [first, last] = batches_of(component, number, tile);
        if (first == last) return;
        const auto* batches = swept_.plan.runs.data();
        auto pass = pass_over(component);
        pass.first = mover_.first_iteration && !again;
        pass.adds = is_repeated && !again;
        pass.again = again;
        kernels_.project(links_, pass, batches + first, batches + last);
        note(pass, component, tile, first, last);
    }

    /// The same in reverse order. Multipliers go on: the way back belongs to the same iteration.
    void project_back(const Component& component, std::uint32_t number, std::uint32_t tile) {
        const auto [first, last] = batches_of(component, number, tile);
        auto pass = pass_over(component);
        pass.first = false;
        pass.adds = true;
        for (auto i = last; i-- > first;)
            each_disjoint_back(swept_.plan.runs[i],
                               [&](const LinkBatch& part) { kernels_.project(links_, pass, &part, &part + 1); });
        note(pass, component, tile, first, last);
    }

    /// Repair of overstretched links of a tethered component (snapping taut, a hem cracking like a whip): sweeps
    /// part of the `repair_window` tiles from this one on again. The window ends one tile after the last
    /// overstretched tile and begins four tiles before the first for each overstretched one. Every tile does so in
    /// turn, hence errors travel as far as necessary. The colours are swept in reverse: otherwise the first would
    /// always bear the errors of all others.
    void repair_overstretch(const Component& component, std::uint32_t tile) {
        const auto tiles = std::span(swept_.plan.tiles).subspan(component.first_tile, component.tiles);
        const auto end = std::min(tile + world_.repair_window, component.tiles);
        std::uint32_t first = end, last = tile, overstretched = 0;
        for (auto i = tile; i < end; ++i) {
            if (!tiles[i].overstretched) continue;
            first = std::min(first, i);
            last = std::min(i + 2, end);
            ++overstretched;
        }
        if (overstretched == 0) return;
        first -= std::min(first - tile, 4 * overstretched);
        tiles[tile].again = std::max(tiles[tile].again, last - first);
        for (auto i = first; i < last; ++i) {
            tether(tiles[i]);
            tiles[i].overstretched = false;
        }
        for (auto color = component.colors; color-- > 0;)
            for (auto i = first; i < last; ++i) project(component, color, i, true);
    }

    /// A row between two pins is supported by nearly horizontal tethers, which act only while the row is taut;
    /// without extra passes along the row it sags on the rows below, buckles and never comes to rest. Links within
    /// the row (colours of span 0) touch no other tile.
    void repair_spans(const Component& component, std::uint32_t number) {
        const auto& tile = swept_.plan.tiles[component.first_tile + number];
        if (tile.span_repairs == 0 || component.is_crushed) return;
        constexpr std::uint32_t times = 6; // each costs a hanging cloth of 64 x 64 about 2 %
        for (std::uint32_t i = 0; i < times * tile.span_repairs; ++i) {
            if (i % tile.span_repairs == 0) tether(tile);
            for (std::uint32_t color = 0; color < component.colors; ++color)
                if (swept_.plan.colors[component.first_color + color].tile_span == 0)
                    project(component, color, number, true);
        }
    }

    /// Sets the anchors of a component's tethers for this substep.
    void set_anchors(const Component& component) {
        const auto& plan = swept_.plan;
        const auto first = plan.tiles[component.first_tile].first;
        for (std::uint32_t i = 0; i < component.tethers; ++i) {
            const auto& tether = plan.tethers[component.first_tether + i];
            const auto& pin = world_.pins[tether.pin];
            const auto goal = pin.target_at(share_);
            for (int k = 0; k < D; ++k) anchors_[i].opposite[k] = -goal[k];
            anchors_[i].half_per_max_length_square = plan.half_per_max_length_square.data() + tether.first - first;
        }
        motion_.anchors = anchors_.data();
        motion_.anchor_count = component.is_crushed ? 0 : component.tethers;
        is_gathered_ = component.is_gathered;
    }

    /// Long-range attachments: no particle is further from a hard pin than the links reach.
    void tether(const Tile& tile) {
        if (motion_.anchor_count > 0) kernels_.tether(motion_, tile.first, tile.last);
    }
    /// Tethers in every second substep, including the last: particles fall little in between
    /// (docs/measured/sweep.md). Gathered cloth is tethered in each: what its links push out in one substep would
    /// swing back in the next for ever.
    void tether_in_turn(const Tile& tile) {
        if (tethered_ || is_gathered_) tether(tile);
    }

    /// Contact with planes, then with colliders.
    void keep_in_bounds(const Tile& tile) {
        const PlaneContact<D, Real> contact(world_, solver_, mover_);
        const bool lists = lists_planes(world_);
        for (std::size_t i = 0; i < world_.bounds.size(); ++i) {
            const auto& plane = world_.bounds[i];
            const Real lowest = kernels_.lowest(motion_, plane.normal.component.data(), tile.first, tile.last);
            if (lowest > plane.offset + swept_.largest_radius) continue;
            const auto number = std::uint32_t(world_.colliders.size() + i);
            for (Row slot = tile.first; slot < tile.last; ++slot) {
                const Real speed = -dot(plane.normal, swept_.displacement_at(slot)) * mover_.per_h;
                const Real stopped = contact.keep_in(plane, slot, lists ? number + 1 : 0);
                if (!lists || !(stopped > Real(0))) continue;
                const auto place = mover_.point_at(slot);
                solver_.touches.add(
                    swept_.row_of[slot], number, stopped * inverse_or_zero(swept_.mobility[slot]) * mover_.per_h,
                    {place - plane.normal * (dot(plane.normal, place) - plane.offset), plane.normal, speed});
            }
        }
        if (!world_.colliders.empty())
            ColliderSweep<D, Real>(world_, solver_, contact, mover_, share_ - share_of_substep_, share_)
                .keep_out(tile.first, tile.last);
    }

    /// x += h v. The rounding error is carried to the next substep: otherwise a float particle slower than half a
    /// unit in the last place per substep would not move.
    void advance(const Tile& tile) {
        roll(tile);
        kernels_.advance(motion_, tile.first, tile.last);
    }

    /// Velocities of particles that struck planes or colliders, by restitution and friction.
    void rebound(const Tile& tile) {
        if (!has_walls(world_)) return;
        for (Row slot = tile.first; slot < tile.last; ++slot)
            if (swept_.blows[slot].count > 0) rebound(slot);
    }

    void hold(const Tile& tile) {
        tether_in_turn(tile);
        pins().pull(tile);
        keep_in_bounds(tile);
    }

    /// Ends this substep and begins the next one, if any, in one pass where particles move independently (only
    /// gravity, no planes, no soft pins).
    void go_on(const Tile& tile, Substep* next) {
        if (!swept_.everyone_alike || has_walls(world_) || pins().any_soft(tile)) {
            hold(tile);
            advance(tile);
            rebound(tile);
            if (next) next->predict(tile);
            return;
        }
        tether_in_turn(tile);
        if (!next) return advance(tile);
        roll(tile);
        next->predictor_.slow_turns(tile);
        kernels_.go_on(next->motion_, tile.first, tile.last);
        next->predictor_.weigh(tile);
        next->pins().move(tile);
    }

  private:
    using Vector = Vec<D, Real>;

    /// All walls of a corner at once: v+ >= away, impulse >= 0, and one of both is sharp (contact/rebounds.h).
    void rebound(Row slot) {
        constexpr int enough = 32;         // between walls at 10 degrees
        constexpr Real exact = Real(1e-6); // of the speeds
        auto& blows = swept_.blows[slot];
        auto velocity = swept_.velocity_at(slot);
        std::array<Real, std::size_t(D)> given{};
        for (int i = 0; i < enough; ++i) {
            Real corrected = 0, fastest = 0;
            for (std::size_t k = 0; k < blows.count; ++k) {
                const auto& blow = blows.list[k];
                const Real least = blows.count > 1 ? -blow.stopped : Real(0);
                const Real next = max(least, given[k] + blow.away - dot(blow.normal, velocity));
                velocity += blow.normal * (next - given[k]);
                corrected = max(corrected, absolute(next - given[k])), fastest = max(fastest, blow.away);
                given[k] = next;
            }
            if (blows.count < 2 || corrected <= exact * fastest) break;
        }
        for (std::size_t k = 0; k < blows.count; ++k) {
            const auto& blow = blows.list[k];
            const Real added = max(Real(0), given[k]);
            const RelativeMotion<D, Real> motion(blow.normal, velocity - blow.surface);
            velocity -= rub(swept_, slot, blow.normal, motion.along, blow.friction * added, mover_.per_h);
            if (blow.collider > 0)
                solver_.touches.add(swept_.row_of[slot], blow.collider - 1,
                                    added * inverse_or_zero(swept_.mobility[slot]));
        }
        swept_.set_displacement(slot, velocity * mover_.h);
    }

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    const Kernels<D, Real>& kernels_;
    const DistanceColumns<D, Real>& links_;
    SubstepMover<D, Real> mover_;
    Predictor<D, Real> predictor_;
    Real share_, share_of_substep_; ///< fraction of the step elapsed at the end of the substep, and per substep
    int number_;                    ///< 1 to the number of substeps
    bool last_, tethered_;
    bool is_gathered_ = false; ///< the component whose anchors are set
    Motion<D, Real> motion_{};
    std::array<Anchor<D, Real>, max_tethers> anchors_;

    /// Batches of a colour that start in a tile.
    std::pair<std::uint32_t, std::uint32_t> batches_of(const Component& component, std::uint32_t number,
                                                       std::uint32_t tile) const {
        const auto& plan = swept_.plan;
        const auto at = plan.colors[component.first_color + number].first_batch + tile;
        return {plan.first_batch[at], plan.first_batch[at + 1]};
    }
    DistancePass<Real> pass_over(const Component& component) const {
        return {.per_h2 = mover_.per_h * mover_.per_h,
                .kept = last_ || component.goes_back() || (is_repeated && component.is_elastic) ||
                        world_.settings.iterations > 1 || !solver_.blocks.attached_trees.empty(),
                .last_substep = last_,
                .overstretched_from = Real(component.is_gathered ? 1.05 * 1.05 : 1.02 * 1.02)};
    }
    void note(const DistancePass<Real>& pass, const Component& component, std::uint32_t tile, std::uint32_t first,
              std::uint32_t last) {
        if (pass.overstretched && component.tethers > 0 && !component.is_crushed)
            swept_.plan.tiles[component.first_tile + tile].overstretched = true;
        if (pass.shortest < limit::shortest_link<Real>) part_heaps(first, last);
    }
    /// Visits a batch in parts without common particles, the last part first.
    template <class Visit> static void each_disjoint_back(const LinkBatch& batch, Visit&& visit) {
        const auto offset = batch.a < batch.b ? batch.b - batch.a : batch.a - batch.b;
        if (batch.scattered || batch.count <= offset) return visit(batch);
        for (auto end = batch.count; end > 0;) {
            const auto begin = (end - 1) / offset * offset;
            visit(part_of(batch, begin, end));
            end = begin;
        }
    }
    /// Links [first, last) of a batch that is not scattered.
    static LinkBatch part_of(LinkBatch batch, std::uint32_t first, std::uint32_t last) {
        batch.a += first, batch.b += first, batch.count = last - first;
        batch.row += first * (batch.row_step == 0 ? 1 : batch.row_step);
        batch.parameters += batch.uniform ? 0 : first;
        return batch;
    }
    void roll(const Tile& tile) {
        if (swept_.rollers.empty()) return;
        for (Row slot = tile.first; slot < tile.last; ++slot) swept_.rollers[slot].rolled += swept_.rollers[slot].rim;
    }
    void part_heaps(std::uint32_t first, std::uint32_t last) {
        auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (auto run = first; run < last; ++run)
            for (std::uint32_t i = 0; i < swept_.plan.runs[run].count; ++i) {
                const Row row = swept_.plan.row_of(swept_.plan.runs[run], i);
                const auto ends = std::as_const(table.members)[row];
                if (!(table.low(row) > Real(0)) ||
                    norm(mover_.point(ends[1]) - mover_.point(ends[0])) > limit::shortest_link<Real>)
                    continue;
                part(mover_, ends, row, clamp(Real(0), table.low(row), table.high(row)));
                correct_row(std::span(solver_.scratch), table, row, mover_);
            }
    }
};

} // namespace sinew::detail
