#pragma once

#include "sinew/collide/filter.h"
#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/layer_correction.h"
#include "sinew/world/world.h"

#include <algorithm>

/// Contact of cloth with itself and with other cloth: spheres at the particles keep layers apart. No side is
/// remembered: where layers are pressed through each other for a moment, the spheres part them again.
namespace sinew::detail {

template <int D, class Real> class ClothContact {
  public:
    using Vector = Vec<D, Real>;

    /// `number`: substep, counted from 1.
    ClothContact(const World<D, Real>& world, Solver<D, Real>& solver, Real h, int number, int substeps)
        : world_(world), state_(solver.sweep_state), room_(contact_room(solver).cloth),
          filter_(solver.options.contact_filter), h_(h), number_(number), substeps_(substeps) {}

    /// After an iteration over the links.
    void solve() {
        read();
        if (!is_list_valid()) list();
        find_touching();
        for (const auto& pair : room_.touching) part(pair);
        if (!room_.touching.empty()) write();
    }

  private:
    const World<D, Real>& world_;
    SweepState<D, Real>& state_;
    ClothRoom<D, Real>& room_;
    const ContactFilter& filter_;
    Real h_;
    int number_, substeps_;

    void read() {
        room_.particles.resize(room_.size());
        room_.spheres.resize(room_.size());
        for (std::size_t i = 0; i < room_.size(); ++i) {
            const Row slot = room_.slots[i];
            const auto position = state_.position_at(slot), displacement = state_.displacement_at(slot);
            room_.particles[i] = {position, displacement, state_.mobility[slot], room_.friction[i]};
            room_.spheres[i] = {position + displacement, room_.radius[i]};
        }
    }
    void write() {
        const Real furthest = max_displacement(h_);
        for (std::size_t i = 0; i < room_.size(); ++i)
            state_.set_displacement(room_.slots[i], clamp_components(room_.particles[i].displacement, furthest));
    }

    // --- candidates --------------------------------------------------------------------------------------------------

    Real largest_radius() const { return *std::max_element(room_.radius.begin(), room_.radius.end()); }
    /// Distance beyond contact up to which pairs are listed.
    Real margin() const { return Real(0.8) * largest_radius(); }

    /// In a calm step the list of an earlier step is used until it might miss a pair. Otherwise each step makes a list
    /// of its own, and another one whenever the cloth has changed its shape by half the margin, at most twice a step.
    /// All follows from the state of the world at the beginning of the step.
    bool is_list_valid() {
        const Real half = Real(0.5) * margin();
        if (number_ == 1) {
            begin_step(half);
            return room_.is_calm && room_.listed.size() == room_.size() && deviation(room_.listed) <= Real(0.5) * half;
        }
        if (room_.is_calm) return room_.is_calm = deviation(room_.step_at) <= Real(0.5) * half;
        const int min = std::max(1, substeps_ / 2);
        return number_ - room_.listed_in < min || deviation(room_.listed) <= half;
    }
    void begin_step(Real half) {
        Real fastest = 0;
        for (const auto& particle : room_.particles)
            fastest = max(fastest, dot(particle.displacement, particle.displacement));
        room_.is_calm = square_root(fastest) * Real(substeps_) <= Real(0.25) * half;
        note(room_.step_at);
    }
    void note(std::vector<Vector>& positions) const {
        positions.clear();
        for (const auto& sphere : room_.spheres) positions.push_back(sphere.center);
    }
    /// Largest distance from the places, apart from a common translation.
    Real deviation(const std::vector<Vector>& positions) const {
        Vector mean{};
        for (std::size_t i = 0; i < positions.size(); ++i) mean += room_.spheres[i].center - positions[i];
        mean *= Real(1) / Real(positions.size());
        Real furthest = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const auto off = room_.spheres[i].center - positions[i] - mean;
            furthest = max(furthest, dot(off, off));
        }
        return square_root(furthest);
    }

    void list() {
        note(room_.listed);
        room_.listed_in = number_;
        room_.found.clear();
        const Real extra = margin();
        room_.grid.each_pair(room_.listed, Real(2) * largest_radius() + extra, [&](auto i, auto k) {
            if (i == k) return;
            const ClothPair pair{std::min(i, k), std::max(i, k)};
            if (may_touch(pair)) room_.found.push_back(pair);
        });
        sort_found();
    }
    bool may_touch(const ClothPair& pair) const {
        const auto a = room_.figure[pair.first], b = room_.figure[pair.second];
        if (is_thin(a) || is_thin(b)) return false; // cloth/thin_contact.h
        if (a != b) return touch(world_.figures[a].filter, world_.figures[b].filter);
        const auto near = room_.near_of(pair.first);
        return world_.figures[a].touches_itself && std::find(near.begin(), near.end(), pair.second) == near.end();
    }
    bool is_thin(FigureIndex figure) const { return world_.figures[figure].cloth == ClothContactKind::thin; }
    /// Sorts by both numbers, and leaves each pair once.
    void sort_found() {
        auto& first = room_.first;
        first.assign(room_.size() + 1, 0);
        for (const auto& pair : room_.found) ++first[pair.first + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        room_.second.resize(room_.found.size());
        for (const auto& pair : room_.found) room_.second[first[pair.first]++] = pair.second;
        std::uint32_t kept = 0, begin = 0; // first[i] is the end of i now
        for (std::size_t i = 0; i < room_.size(); ++i) {
            const auto from = room_.second.begin() + begin, to = room_.second.begin() + first[i];
            begin = first[i];
            sinew::sort(from, to);
            const auto last = std::unique(from, to);
            first[i] = kept;
            kept = std::uint32_t(std::move(from, last, room_.second.begin() + kept) - room_.second.begin());
        }
        first.back() = kept;
        room_.second.resize(kept);
    }

    // --- solution ----------------------------------------------------------------------------------------------------

    void find_touching() {
        auto& touching = room_.touching;
        touching.resize(room_.second.size());
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < room_.size(); ++i) {
            const auto own = room_.spheres[i];
            for (const auto k : room_.candidates_of(i)) {
                const auto& other = room_.spheres[k];
                const auto away = own.center - other.center;
                touching[count] = {i, k}; // overwritten unless it counts
                count += dot(away, away) < square(own.radius + other.radius);
            }
        }
        touching.resize(count);
        if (filter_) std::erase_if(touching, [&](const ClothPair& pair) { return !is_admitted(pair); });
    }
    bool is_admitted(const ClothPair& pair) const {
        const auto &a = room_.particles[pair.first], &b = room_.particles[pair.second];
        const auto away = a.position - b.position;
        PendingContact contact{.particle = state_.row_of[room_.slots[pair.first]],
                               .other = state_.row_of[room_.slots[pair.second]],
                               .gap = double(norm(away) - room_.radius[pair.first] - room_.radius[pair.second]),
                               .friction = double(min(a.friction, b.friction))};
        const auto normal = direction(away);
        contact.speed = -double(dot(normal, a.displacement - b.displacement) / h_);
        contact.set_normal(normal);
        return filter_.ask(contact);
    }

    /// Corrects two particles nearer than layers, each by its share of mobility.
    void part(const ClothPair& pair) {
        auto &a = room_.particles[pair.first], &b = room_.particles[pair.second];
        const auto away = (a.position - b.position) + (a.displacement - b.displacement);
        const Real apart = room_.radius[pair.first] + room_.radius[pair.second], length = norm(away);
        const Real mobility = a.mobility + b.mobility;
        if (!(length < apart) || mobility == Real(0)) return;
        const auto normal = length > Real(0) ? away * inverse_or_zero(length) : Vector::axis(D - 1);
        const auto change =
            layer_correction(normal, a.displacement - b.displacement, apart - length, min(a.friction, b.friction)) *
            inverse_or_zero(mobility);
        a.displacement += change * a.mobility;
        b.displacement -= change * b.mobility;
    }
};

} // namespace sinew::detail
