#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/segment_normals.h"
#include "sinew/world/world.h"

namespace sinew::detail {

/// Lists the solids in space: surfaces of filled outlines, each edge between two triangles, convex at present; a rigid
/// one, which a blow may bend for a moment, by its lengths.
template <class Real> class PolyhedronFeatures {
  public:
    using Vector = Vec3<Real>;

    PolyhedronFeatures(const World<3, Real>& world, ContactRoom<3, Real>& room)
        : world_(world), room_(room), solids_(room.polyhedra) {}

    /// After the particles and segments have numbers.
    void find() {
        solids_.clear();
        for (auto& segment : room_.segments) segment.edge = none;
        if (room_.particles.empty()) return;
        list_faces();
        if (solids_.listed.empty()) return;
        solids_.solid_of.assign(room_.particles.size(), none);
        solids_.place.resize(room_.particles.size());
        sinew::sort(solids_.listed.begin(), solids_.listed.end());
        for (std::size_t first = 0, last = 0; first < solids_.listed.size(); first = last) {
            while (last < solids_.listed.size() && solids_.listed[last].solid == solids_.listed[first].solid) ++last;
            place_corners(std::uint32_t(first), std::uint32_t(last));
            add(std::uint32_t(first), std::uint32_t(last));
        }
        for (auto& segment : room_.segments) segment.edge = edge_between(segment.number_a, segment.number_b);
    }

  private:
    static constexpr auto none = PolyhedronRoom::none;
    const World<3, Real>& world_;
    ContactRoom<3, Real>& room_;
    PolyhedronRoom& solids_;

    /// At the start of the step, or at rest.
    Vector place(std::uint32_t number) const { return cast<Real>(solids_.place[number]); }
    Real beyond(const PolyhedronRoom::Face& face, const Vector& x) const {
        const auto a = place(face[0]), b = place(face[1]), c = place(face[2]);
        return dot(normal_of(cross(b - a, c - a), Vector::axis(1)), x - a);
    }
    std::uint32_t number_of(ParticleId id) const {
        const auto row = world_.particles.handles.find(id);
        return row ? room_.number_of[*row] : none;
    }
    void list_faces() {
        for (const auto& figure : world_.figures)
            for (const auto& piece : figure.pieces) {
                if (piece.hidden || piece.mark != Mark::fill) continue;
                for (std::size_t i = 2; i < piece.particles.size(); ++i)
                    list({number_of(piece.particles[0]), number_of(piece.particles[i - 1]),
                          number_of(piece.particles[i])});
            }
        for (auto& one : solids_.listed) one.solid = solids_.joined.first_of(one.face[0]);
    }
    void list(const PolyhedronRoom::Face& face) {
        if (std::ranges::find(face, none) != face.end()) return;
        if (solids_.listed.empty()) solids_.joined.reset(room_.particles.size());
        solids_.joined.join(face[0], face[1]), solids_.joined.join(face[0], face[2]);
        solids_.listed.push_back({.face = face});
    }

    /// Places the corners of a range of the listed triangles.
    void place_corners(std::uint32_t first, std::uint32_t last) {
        const auto each_corner = [&](const auto& visit) {
            for (auto i = first; i < last; ++i)
                for (const auto corner : solids_.listed[i].face) visit(corner, room_.particles[corner]);
        };
        const auto cluster_of = room_.projector.cluster_of();
        const auto slot = room_.particles[solids_.listed[first].face[0]].slot;
        const auto cluster = slot < cluster_of.size() ? cluster_of[slot] : none;
        bool is_rigid = cluster != none;
        each_corner(
            [&](std::uint32_t, const auto& particle) { is_rigid = is_rigid && cluster_of[particle.slot] == cluster; });
        each_corner([&](std::uint32_t corner, const auto& particle) {
            solids_.place[corner] = is_rigid ? room_.projector.links().clusters.rest_of(particle.slot)
                                             : cast<double>(world_.particles.position[particle.row]);
        });
    }
    /// Adds the solid of a range of the listed triangles, if there is one.
    void add(std::uint32_t first, std::uint32_t last) {
        const SolidParts solid{.first_face = std::uint32_t(solids_.faces.size()),
                               .faces = last - first,
                               .first_corner = std::uint32_t(solids_.corners.size()),
                               .first_edge = std::uint32_t(solids_.edges.size())};
        for (auto i = first; i < last; ++i) solids_.faces.push_back(solids_.listed[i].face);
        auto whole = solid;
        if (add_edges(whole) && add_corners(whole) && turn_outwards(whole)) {
            for (auto i = whole.first_corner; i < solids_.corners.size(); ++i)
                solids_.solid_of[solids_.corners[i]] = std::uint32_t(solids_.solids.size());
            solids_.solids.push_back(whole);
            return;
        }
        solids_.faces.resize(solid.first_face);
        solids_.corners.resize(solid.first_corner);
        solids_.edges.resize(solid.first_edge);
    }
    /// False unless each edge has two sides.
    bool add_edges(SolidParts& solid) {
        auto& halves = solids_.halves;
        halves.clear();
        for (auto i = solid.first_face; i < solid.first_face + solid.faces; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& face = solids_.faces[i];
                const auto a = face[k], b = face[(k + 1) % 3];
                halves.push_back({{std::min(a, b), std::max(a, b)}, face[(k + 2) % 3]});
            }
        sinew::sort(halves.begin(), halves.end());
        for (std::size_t i = 0; i + 1 < halves.size(); i += 2) {
            const auto &one = halves[i], &other = halves[i + 1];
            const bool has_third = i + 2 < halves.size() && halves[i + 2].ends == one.ends;
            if (one.ends != other.ends || has_third) return false;
            solids_.edges.push_back(
                {one.ends[0], one.ends[1], {one.opposite, other.opposite}, std::uint32_t(solids_.solids.size())});
        }
        solid.edges = std::uint32_t(solids_.edges.size()) - solid.first_edge;
        return halves.size() % 2 == 0;
    }
    bool add_corners(SolidParts& solid) {
        auto& corners = solids_.corners;
        const auto begin = std::ptrdiff_t(solid.first_corner);
        for (auto i = solid.first_face; i < solid.first_face + solid.faces; ++i)
            corners.insert(corners.end(), solids_.faces[i].begin(), solids_.faces[i].end());
        sinew::sort(corners.begin() + begin, corners.end());
        corners.erase(std::unique(corners.begin() + begin, corners.end()), corners.end());
        solid.corners = std::uint32_t(corners.size()) - solid.first_corner;
        return solid.corners > 3;
    }
    /// Turns the faces of a convex surface; false for another one. A rigid crate under load is bent a little.
    bool turn_outwards(SolidParts& solid) {
        constexpr Real slight = Real(1e-3);
        Vector middle{};
        Real widest = 0, half_width = std::numeric_limits<Real>::max();
        const auto each_corner = [&](const auto& visit) {
            for (auto i = solid.first_corner; i < solid.first_corner + solid.corners; ++i)
                visit(place(solids_.corners[i]));
        };
        each_corner([&](const Vector& x) { middle += x * (Real(1) / Real(solid.corners)); });
        each_corner([&](const Vector& x) { widest = max(widest, distance(x, middle)); });
        for (auto i = solid.first_face; i < solid.first_face + solid.faces; ++i) {
            auto& face = solids_.faces[i];
            if (beyond(face, middle) > Real(0)) std::swap(face[1], face[2]);
            bool is_outside = true;
            each_corner([&](const Vector& x) { is_outside &= beyond(face, x) <= slight * widest; });
            half_width = min(half_width, -beyond(face, middle));
            if (!is_outside || !(half_width > slight * widest)) return false;
        }
        drop_flat_edges(solid, slight * widest);
        solids_.half_width.push_back(double(half_width));
        return true;
    }
    /// Lines across a flat side have no outside of their own.
    void drop_flat_edges(SolidParts& solid, Real flat) {
        const auto begin = solids_.edges.begin() + std::ptrdiff_t(solid.first_edge);
        const auto end = std::remove_if(begin, solids_.edges.end(), [&](const SolidEdge& edge) {
            const PolyhedronRoom::Face side{edge.a, edge.b, edge.opposite[0]};
            return absolute(beyond(side, place(edge.opposite[1]))) <= flat;
        });
        solids_.edges.erase(end, solids_.edges.end());
        solid.edges = std::uint32_t(end - begin);
    }
    std::uint32_t edge_between(std::uint32_t a, std::uint32_t b) const {
        const auto number = solids_.solid_of[a];
        if (number == none || solids_.solid_of[b] != number) return none;
        const auto& solid = solids_.solids[number];
        const auto begin = solids_.edges.begin() + std::ptrdiff_t(solid.first_edge),
                   end = begin + std::ptrdiff_t(solid.edges);
        const auto ends = std::pair{std::min(a, b), std::max(a, b)};
        const auto found = std::find_if(begin, end, [&](const auto& e) { return std::pair{e.a, e.b} == ends; });
        return found == end ? none : std::uint32_t(found - solids_.edges.begin());
    }
};

} // namespace sinew::detail
