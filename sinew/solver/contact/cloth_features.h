#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/cloth_room.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <optional>

/// Particles of cloth that collide, the distance that layers keep, and the neighbours that do not. Found once per
/// topology.
///
/// In an unstretched square mesh an edge can pierce a face only where one of its ends is within one cell of a corner
/// (half a diagonal and a circumradius): spheres 1.5 cells apart leave half a cell for stretch (cf. Wu et al., A safe
/// and fast repulsion method for GPU-based cloth self collisions, 2020).
namespace sinew::detail {

template <int D, class Real> class ClothFeatures {
  public:
    ClothFeatures(const World<D, Real>& world, const SweepState<D, Real>& state, ClothRoom<D, Real>& room)
        : world_(world), p_(world.particles), state_(state), room_(room) {}

    void find() {
        room_.clear();
        if (D != 3) return;
        list_particles();
        if (room_.empty()) return;
        list_links();
        set_radii();
        list_near();
        room_.reserve();
    }

  private:
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    static constexpr double cells_apart = 1.5;   ///< distance of layers, in cells
    static constexpr double min_near_way = 1.25; ///< shortest way through the sheet to a layer, in distances of layers

    struct Link {
        std::uint32_t to = 0;
        double length = 0;
    };

    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    const SweepState<D, Real>& state_;
    ClothRoom<D, Real>& room_;
    std::vector<std::uint32_t> number_; ///< by slot
    std::vector<std::uint32_t> first_link_;
    std::vector<Link> links_;
    struct Reached {
        std::uint32_t particle = 0;
        double way = 0;
    };
    std::vector<Reached> reached_;

    static bool is_of_cloth(const Piece& piece) { return is_cloth(piece.mark) && !piece.hidden; }
    std::uint32_t slot_of(ParticleId id) const {
        const auto row = p_.handles.find(id);
        return row ? state_.slot_of[*row] : none;
    }
    std::uint32_t number_of(std::uint32_t slot) const { return slot < number_.size() ? number_[slot] : none; }

    template <class Visit> void each_piece(Visit&& visit) const {
        for (FigureIndex i = 0; i < world_.figures.size(); ++i) {
            const auto& figure = world_.figures[i];
            if (!figure.in_use() || !figure.collides) continue;
            for (const auto& piece : figure.pieces)
                if (is_of_cloth(piece)) visit(i, piece);
        }
    }

    void list_particles() {
        number_.assign(state_.size(), none);
        each_piece([&](FigureIndex, const Piece& piece) {
            for (const auto id : piece.particles)
                if (const auto slot = slot_of(id); slot < state_.size()) number_[slot] = 0;
        });
        room_.figure.clear();
        room_.any_spheres = false;
        for (std::uint32_t slot = 0; slot < number_.size(); ++slot) {
            if (number_[slot] == none) continue;
            number_[slot] = std::uint32_t(room_.size());
            room_.slots.push_back(slot);
            room_.figure.push_back(p_.figure[state_.row_of[slot]]);
            const bool is_thin = world_.figures[room_.figure.back()].cloth == ClothContactKind::thin;
            room_.any_spheres = room_.any_spheres || !is_thin;
        }
    }

    /// True for a link with a rest length. That of a driven one changes from step to step.
    static bool is_edge(const Constraints<Distance<D>, Real>& table, Row row) {
        return table.high(row) < limit::measure<Real> && !table.motorized[row];
    }
    /// Links between particles of cloth, at both ends.
    void list_links() {
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        first_link_.assign(room_.size() + 1, 0);
        const auto each = [&](auto&& visit) {
            for (Row row = 0; row < table.size(); ++row) {
                const auto ends = table.members[row];
                const auto a = number_of(state_.slot_of[ends[0]]), b = number_of(state_.slot_of[ends[1]]);
                if (a == none || b == none || !is_edge(table, row)) continue;
                visit(a, b, double(table.high(row)));
                visit(b, a, double(table.high(row)));
            }
        };
        each([&](auto a, auto, double) { ++first_link_[a + 1]; });
        for (std::size_t i = 1; i < first_link_.size(); ++i) first_link_[i] += first_link_[i - 1];
        links_.resize(first_link_.back());
        auto next = first_link_;
        each([&](auto a, auto b, double length) { links_[next[a]++] = {b, length}; });
    }
    std::span<const Link> links_of(std::uint32_t i) const {
        return std::span(links_).subspan(first_link_[i], first_link_[i + 1] - first_link_[i]);
    }
    /// Rest length of an edge; nothing where no link is left. Places are no measure: a copy of the world made later
    /// would find others.
    std::optional<double> length_between(std::uint32_t a, std::uint32_t b) const {
        for (const auto& link : links_of(a))
            if (link.to == b) return link.length;
        return std::nullopt;
    }
    Row row_of(std::uint32_t i) const { return state_.row_of[room_.slots[i]]; }

    /// The distance of layers is 1.5 mean linked edges of the figure's faces, or twice the radius of its particles.
    void set_radii() {
        struct Edges {
            double sum = 0, count = 0;
        };
        std::vector<Edges> edges(world_.figures.size());
        each_piece([&](FigureIndex figure, const Piece& piece) {
            for (std::size_t i = 0; i < piece.particles.size(); ++i) {
                const auto a = number_of(slot_of(piece.particles[i]));
                const auto b = number_of(slot_of(piece.particles[(i + 1) % piece.particles.size()]));
                if (a == none || b == none || a == b) continue;
                if (const auto length = length_between(a, b)) edges[figure].sum += *length, edges[figure].count += 1;
            }
        });
        room_.radius.clear();
        room_.friction.clear();
        room_.is_cloth.assign(p_.size(), 0);
        for (std::uint32_t i = 0; i < room_.size(); ++i) {
            const auto& all = edges[room_.figure[i]];
            const Real half = Real(cells_apart / 2 * all.sum * inverse_or_zero(all.count));
            room_.radius.push_back(max(half, p_.radius[row_of(i)]));
            room_.friction.push_back(Real(world_.figures[room_.figure[i]].friction));
            room_.is_cloth[row_of(i)] = 1;
        }
    }

    void list_near() {
        std::vector<std::vector<std::uint32_t>> of_face(room_.size());
        each_piece([&](FigureIndex, const Piece& piece) {
            for (const auto one : piece.particles)
                for (const auto other : piece.particles) {
                    const auto a = number_of(slot_of(one)), b = number_of(slot_of(other));
                    if (a != none && b != none && a < b) of_face[a].push_back(b);
                }
        });
        room_.first_near.assign(1, 0);
        room_.near.clear();
        for (std::uint32_t i = 0; i < room_.size(); ++i) {
            walk_from(i, min_near_way * 2 * double(room_.radius[i]));
            auto& all = of_face[i];
            for (const auto& [particle, way] : reached_)
                if (particle > i) all.push_back(particle);
            sinew::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
            room_.near.insert(room_.near.end(), all.begin(), all.end());
            room_.first_near.push_back(std::uint32_t(room_.near.size()));
        }
    }
    /// Lists particles within a way along links, improved until nothing changes (Bellman 1958).
    void walk_from(std::uint32_t start, double max) {
        reached_.assign(1, {start, 0});
        for (std::size_t i = 0; i < reached_.size(); ++i) {
            const auto from = reached_[i];
            for (const auto& link : links_of(from.particle)) {
                const double way = from.way + link.length;
                if (way < max && !is_known(link.to, way)) reached_.push_back({link.to, way});
            }
        }
    }
    bool is_known(std::uint32_t particle, double way) const {
        return std::any_of(reached_.begin(), reached_.end(),
                           [&](const auto& r) { return r.particle == particle && r.way <= way; });
    }
};

} // namespace sinew::detail
