#pragma once

#include "sinew/solver/batch/bucket_queue.h"
#include "sinew/solver/batch/unfolded_triangles.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <cmath>
#include <optional>

/// Long-range attachments of components: the largest distance of each particle from some pins. Components with the same
/// layout and anchors as before keep theirs.
namespace sinew::detail {

template <int D, class Real> class TetherBuilder {
  public:
    TetherBuilder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), swept_(solver.sweep_state), plan_(solver.sweep_state.plan),
          room_(solver.sweep_state.room), spokes_(world, solver.sweep_state.plan), corners_(spokes_) {}

    /// Progress of preparation when this share of the components has tethers.
    static double tethered(double share) { return 0.45 + 0.55 * share; }

    /// Makes the tethers; none in a world with constraints that can tear.
    void run() {
        solver_.report(tethered(0));
        if (plan_.may_tear) return forget();
        std::size_t kept = 0;
        bool all = true;
        for (auto& component : plan_.components) {
            all = all && are_kept(component);
            kept += component.tethers;
        }
        if (!all || kept != plan_.tethers.size()) make_again();
    }

  private:
    World<D, Real>& world_;
    const Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    Adjacency<D, Real> spokes_;
    UnfoldedTriangles<D, Real> corners_;

    void forget() {
        plan_.tethers.clear();
        plan_.half_per_max_length_square.clear();
        for (auto& component : plan_.components) component.first_tether = component.tethers = 0;
        for (auto& tile : plan_.tiles) tile.span_repairs = 0;
    }

    bool is_anchor(const Pin<D, Real>& pin, Row particle) const {
        if (!pin.hard()) return false;
        const auto figure = world_.particles.figure[particle];
        return figure < world_.figures.size() && world_.figures[figure].tethers;
    }

    /// Anchors of a component: the component's hard pins, at most `max_tethers`, evenly spaced in slot order.
    std::span<const PinnedSlot> anchors(const Component& component) const {
        auto& all = room_.anchors;
        all.clear();
        if (!component.has_links() || component.copies > 0) return {};
        const auto first = plan_.tiles[component.first_tile].first_pin;
        const auto last = plan_.tiles[component.first_tile + component.tiles - 1].last_pin;
        for (auto i = first; i < last; ++i) { // the last of several pins holds the particle
            const auto& pinned = plan_.pins[i];
            if (!is_anchor(world_.pins[pinned.pin], swept_.row_of[pinned.slot])) continue;
            if (!all.empty() && all.back().slot == pinned.slot) all.pop_back();
            all.push_back(pinned);
        }
        if (all.size() > max_tethers) {
            for (std::size_t i = 0; i < max_tethers; ++i) all[i] = all[i * (all.size() - 1) / (max_tethers - 1)];
            all.resize(max_tethers);
        }
        return all;
    }

    /// True if the component has the same anchors as before; updates their pin indices.
    bool are_kept(const Component& component) {
        const auto pins = anchors(component);
        bool same = pins.size() == component.tethers;
        for (std::size_t i = 0; same && i < pins.size(); ++i) {
            auto& tether = plan_.tethers[component.first_tether + i];
            same = tether.at == pins[i].slot - component.begin.slot;
            tether.pin = pins[i].pin;
        }
        return same;
    }

    void make_again() {
        const auto old = std::move(plan_.tethers);
        const auto old_lengths = std::move(plan_.half_per_max_length_square);
        plan_.tethers.clear();
        plan_.half_per_max_length_square.clear();
        make_room();
        std::size_t number = 0;
        for (auto& component : plan_.components) {
            const auto before = std::span(old).subspan(component.first_tether, component.tethers);
            set_anchors(component, before, old_lengths, double(number++) / double(plan_.components.size()));
            find_spans(component);
        }
        if (!plan_.tethers.empty())
            plan_.half_per_max_length_square.resize(plan_.half_per_max_length_square.size() + plan_.lanes);
        spokes_.forget();
    }

    /// Reserves all memory at once: growing would double the peak.
    void make_room() {
        std::size_t lengths = 0;
        for (const auto& component : plan_.components) lengths += anchors(component).size() * size_of(component);
        if (lengths > 0) plan_.half_per_max_length_square.reserve(lengths + plan_.lanes);
    }
    std::uint32_t size_of(const Component& component) const {
        return plan_.end_of(component).slot - component.begin.slot;
    }

    void set_anchors(Component& component, std::span<const Tether> before, const std::vector<Real>& lengths,
                     double share) {
        const auto pins = anchors(component);
        const auto size = size_of(component);
        component.first_tether = std::uint32_t(plan_.tethers.size());
        component.tethers = std::uint32_t(pins.size());
        bool any_new = false;
        for (std::size_t i = 0; i < pins.size(); ++i) {
            const auto first = plan_.half_per_max_length_square.size();
            const auto at = pins[i].slot - component.begin.slot;
            plan_.tethers.push_back({.pin = pins[i].pin, .at = at, .first = std::uint32_t(first)});
            const auto same = std::find_if(before.begin(), before.end(), [&](const auto& b) { return b.at == at; });
            if (same != before.end()) {
                const auto from = lengths.begin() + same->first;
                plan_.half_per_max_length_square.insert(plan_.half_per_max_length_square.end(), from, from + size);
                continue;
            }
            if (!any_new) spokes_.list(component, size), corners_.begin();
            any_new = true;
            plan_.half_per_max_length_square.resize(first + size);
            measure_from(at, std::span(plan_.half_per_max_length_square).subspan(first));
            solver_.report(tethered(share + double(i + 1) / double(pins.size() * plan_.components.size())));
        }
    }

    /// Finds tiles spanning from pin to pin: for at least half of the particles, the path between two pins by way of
    /// the particle is at most half a link longer than the direct one.
    void find_spans(const Component& component) {
        const auto tiles = std::span(plan_.tiles).subspan(component.first_tile, component.tiles);
        const auto tethers = std::span(plan_.tethers).subspan(component.first_tether, component.tethers);
        for (auto& tile : tiles) tile.span_repairs = 0;
        constexpr Real many = 128; // links from pin to pin: one sweep leaves much of the error of a longer row
        for (const auto& from : tethers) {
            const Real half_a_link = Real(0.5) * shortest_length(component, from);
            for (const auto& to : tethers.first(std::size_t(&from - tethers.data()))) {
                const Real between_pins = max_length(from, to.at), furthest = between_pins + half_a_link;
                const std::uint32_t times = between_pins > many * Real(2) * half_a_link ? 2 : 1;
                for (auto& tile : tiles) {
                    std::uint32_t between = 0;
                    for (auto s = tile.first - component.begin.slot; s < tile.last - component.begin.slot; ++s)
                        between += max_length(from, s) + max_length(to, s) <= furthest;
                    if (2 * between >= tile.last - tile.first) tile.span_repairs = std::max(tile.span_repairs, times);
                }
            }
        }
    }
    Real max_length(const Tether& tether, std::uint32_t s) const {
        return square_root(inverse_or_zero(2 * plan_.half_per_max_length_square[tether.first + s]));
    }
    /// Maximum distance of the particle nearest to the pin: one link.
    Real shortest_length(const Component& component, const Tether& tether) const {
        const auto lengths = std::span(plan_.half_per_max_length_square).subspan(tether.first, size_of(component));
        return square_root(inverse_or_zero(2 * *std::max_element(lengths.begin(), lengths.end())));
    }

    /// Geodesic distances from an anchor (Dijkstra 1959), along rigid links and across the triangles between them.
    /// Particles are finished in the order of distance; a third corner is reached on the straight line from the source,
    /// unfolded into the plane through two finished corners (Mitchell, Mount and Papadimitriou 1987, first step from
    /// each edge only). Lengthened by 1e-5, to leave straight hanging links alone. Particles are numbered in the
    /// component.
    void measure_from(std::uint32_t anchor, std::span<Real> half_per_square) {
        constexpr double far = double(limit::coordinate<Real>) * 100, slack = 1.00001;
        const auto way = half_per_square; // path lengths until all are final; negative when final
        std::fill(way.begin(), way.end(), Real(far));
        const auto done = [&](std::uint32_t s) { return std::signbit(way[s]); };
        const auto way_to = [&](std::uint32_t s) { return double(absolute(way[s])); };
        std::vector<double> lengths; // path lengths via the current particle
        BucketQueue next(spokes_.longest());
        const auto shorten = [&](std::uint32_t s, double length) {
            if (!(Real(length) < way[s])) return;
            way[s] = Real(length);
            next.put({length, s});
        };
        shorten(anchor, 0);
        while (!next.empty()) {
            const auto s = next.take().number;
            if (done(s)) continue;
            const double here = double(way[s]);
            way[s] = -way[s];
            const auto near = spokes_.of(s);
            lengths.resize(near.size());
            for (std::size_t i = 0; i < near.size(); ++i) lengths[i] = here + double(near[i].length);
            for (std::size_t i = 0; i < near.size(); ++i) {
                const auto edge = s + near[i].offset;
                const double between = double(near[i].length);
                if (!done(edge) || !(between > 0)) continue;
                std::optional<Beside> begun; // most edges have nothing left to reach
                for (const auto& [third, to] : corners_.beyond(s, i)) {
                    if (done(s + near[third].offset)) continue;
                    if (!begun) begun = Beside::of(here, way_to(edge), between);
                    const double across = begun->across(to, between);
                    if (Real(across) < Real(lengths[third])) lengths[third] = across;
                }
            }
            for (std::size_t i = 0; i < near.size(); ++i) shorten(s + near[i].offset, lengths[i]);
        }
        for (auto& length : way) length = half_per_square_of(min(double(absolute(length)) * slack, far));
    }
    static Real half_per_square_of(double length) { return length > 0 ? Real(0.5 / square(length)) : Real(0); }
};

} // namespace sinew::detail
