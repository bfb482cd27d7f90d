#pragma once

#include "sinew/solver/plan_parts.h"
#include "sinew/solver/waiting.h"

/// The tethers of a sheet: how far from its pins each of its particles can get.
namespace sinew::detail {

template <int D, class Real> class TetherMaker {
  public:
    explicit TetherMaker(World<D, Real>& world, const PlanParts<D, Real>& parts)
        : world_(world), distances_(std::get<kind_number<Distance, D>>(world.constraints)), swept_(world.swept),
          plan_(world.swept.plan), room_(world.swept.room), parts_(parts) {}

    /// Of all there is to get ready, when such a share of the sheets has its tethers.
    static double tethered(double share) { return 0.45 + 0.55 * share; }

    /// To a few of its pins: of many those that lie furthest apart. What may tear has none, nor what gives.
    void add_tethers(Sheet& sheet) {
        const Row begin = plan_.bands[sheet.first_band].first;
        const auto part = room_.part_of[swept_.row_of[begin]];
        const auto slots = plan_.bands[sheet.first_band + sheet.bands - 1].last - begin;
        sheet.first_tether = std::uint32_t(plan_.tethers.size());
        if (plan_.pins.empty() || parts_.links(part).empty() || slots != parts_.members(part).size()) return;
        auto& pins = room_.anchors;
        pins.clear();
        for (const auto& pinned : plan_.pins) // where there are several, the last one holds it
            if (is_anchor(world_.pins[pinned.pin], part)) {
                if (!pins.empty() && world_.pins[pins.back()].particle == world_.pins[pinned.pin].particle)
                    pins.pop_back();
                pins.push_back(pinned.pin);
            }
        if (pins.empty()) return;
        list_rigid_links(part);
        constexpr std::size_t most = most_tethers;
        const auto size = parts_.members(part).size();
        for (std::size_t i = 0; i < std::min(most, pins.size()); ++i) {
            const auto pin = pins.size() <= most ? pins[i] : pins[i * (pins.size() - 1) / (most - 1)];
            const auto first = plan_.per_reach_square.size();
            plan_.tethers.push_back({.pin = pin, .first = std::uint32_t(first)});
            plan_.per_reach_square.resize(first + size);
            reach_from(part, *world_.particles.slots.find(world_.pins[pin].particle), begin, first);
            ++sheet.tethers;
            const auto share = double(i + 1) / double(std::min(most, pins.size()));
            Waiting::tell(tethered((double(&sheet - plan_.sheets.data()) + share) / double(plan_.sheets.size())));
        }
    }

  private:
    using RigidLink = PlanRoom::RigidLink;

    World<D, Real>& world_;
    const Constraints<Distance<D>, Real>& distances_;
    Swept<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    const PlanParts<D, Real>& parts_;

    Row slot(Row row) const { return swept_.slot_of[row]; }

    bool is_anchor(const Pin<D, Real>& pin, std::size_t part) const {
        const auto row = world_.particles.slots.find(pin.particle);
        if (!row || !pin.hard() || slot(*row) == Swept<D, Real>::none || room_.part_of[*row] != part) return false;
        const auto figure = world_.particles.figure[*row];
        return figure < world_.figures.size() && world_.figures[figure].tethers;
    }

    /// The shortest ways (Dijkstra 1959), along rigid links and across the triangles they span: as from one particle
    /// the others come in the order of their distance, a third corner is reached on the straight line from where the
    /// way to two of them would have begun if all lay flat (Mitchell, Mount and Papadimitriou 1987, of the edges the
    /// first step only). A trace longer, so that nothing that hangs straight is pulled.
    void reach_from(std::size_t part, Row anchor, Row begin, std::size_t first) {
        constexpr double far = double(limit::coordinate<Real>) * 100, slack = 1.0001;
        const auto all = parts_.members(part);
        auto& way = room_.way;
        way.assign(all.size(), Real(far));
        auto& done = room_.chained;
        done.assign(all.size(), 0);
        constexpr double apart = -1;
        auto& length_to = room_.length_to; // of the particle that is looked at
        length_to.assign(all.size(), apart);
        auto& heap = room_.heap;
        heap.assign(1, {0, room_.rank[anchor]});
        way[room_.rank[anchor]] = 0;
        const auto later = [](const auto& a, const auto& b) { return a > b; };
        const auto shorten = [&](Row r, double length) {
            if (!(Real(length) < way[r])) return;
            way[r] = Real(length);
            heap.push_back({length, r});
            std::push_heap(heap.begin(), heap.end(), later);
        };
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end(), later);
            const Row r = heap.back().second;
            heap.pop_back();
            if (done[r]) continue;
            done[r] = 1;
            for (const auto& [other, length] : rigid(r)) length_to[other] = length;
            for (const auto& [other, length] : rigid(r)) {
                if (done[other]) continue;
                shorten(other, double(way[r]) + length);
                for (const auto& [third, side] : rigid(other))
                    if (length_to[third] != apart && done[third])
                        shorten(other, across(double(way[r]), double(way[third]), length_to[third], length, side));
            }
            for (const auto& [other, length] : rigid(r)) length_to[other] = apart;
        }
        for (Row r = 0; r < all.size(); ++r) {
            const double reach = minimum(way[r] * slack, far);
            plan_.per_reach_square[first + (slot(all[r]) - begin)] = reach > 0 ? Real(1 / square(reach)) : Real(0);
        }
    }

    std::span<const RigidLink> rigid(Row r) const {
        return std::span(room_.rigid).subspan(room_.first_rigid[r], room_.first_rigid[r + 1] - room_.first_rigid[r]);
    }

    void list_rigid_links(std::size_t part) {
        parts_.list_neighbours(part);
        room_.rigid.clear();
        room_.first_rigid.assign(1, 0);
        for (Row r = 0; r < parts_.members(part).size(); ++r) {
            for (auto i = room_.first_near[r]; i < room_.first_near[r + 1]; ++i) {
                const Row link = room_.near_link[i];
                if (distances_.compliance[link] == Real(0) && distances_.high[link] < limit::coordinate<Real>)
                    room_.rigid.push_back({room_.near[i], double(distances_.high[link])});
            }
            room_.first_rigid.push_back(std::uint32_t(room_.rigid.size()));
        }
    }

    /// How far c is from where a is `to_a` and b `to_b` away, on the other side of ab and in the plane of abc.
    static double across(double to_a, double to_b, double ab, double ac, double bc) {
        constexpr double nowhere = 1e300;
        if (!(ab > 0)) return nowhere;
        const auto place = [&](double a, double b) { // along ab, and beside it
            const double along = (a * a - b * b + ab * ab) / (2 * ab);
            return std::pair(along, square_root(maximum(a * a - along * along, 0.0)));
        };
        const auto [from, below] = place(to_a, to_b);
        const auto [to, above] = place(ac, bc);
        if (!(below + above > 0)) return nowhere;
        const double crossing = from + (to - from) * below / (below + above);
        if (!(crossing >= 0 && crossing <= ab)) return nowhere;
        return square_root(square(to - from) + square(below + above));
    }
};

} // namespace sinew::detail
