#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/world/world.h"

namespace sinew::detail {

/// Mesh of all cloth that collides, and the particles, links, and faces of solids of other figures that may strike it.
template <int D, class Real> class FaceFeatures {
  public:
    FaceFeatures(const World<D, Real>& world, const SweepState<D, Real>& state, ContactRoom<D, Real>& room)
        : world_(world), state_(state), room_(room), faces_(room.faces) {}

    void find(bool is_stale) {
        if (is_stale) ClothMeshBuilder<D, Real>(world_, state_, faces_.mesh).build(MeshOf::all);
        list_strikers();
        if (!is_stale) return;
        number_vertices();
        list_links();
        faces_.reserve(faces_.mesh.empty() ? 0 : state_.size());
    }

  private:
    const World<D, Real>& world_;
    const SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    FaceRoom<D, Real>& faces_;

    void list_strikers() {
        faces_.strikers.clear(), faces_.solids.clear(), faces_.solid_faces.clear();
        if (faces_.mesh.empty()) return;
        auto& number = faces_.striker_of;
        number.clear();
        for (const auto& particle : room_.particles) {
            number.push_back(std::uint32_t(faces_.strikers.size()));
            if (!room_.is_of_cloth(particle.row)) add(particle, particle, false);
        }
        for (const auto& solid : room_.polyhedra.solids) add(solid);
        for (const auto& s : room_.segments) add(room_.particles[s.number_a], room_.particles[s.number_b], true);
    }
    void add(const ContactParticle<Real>& a, const ContactParticle<Real>& b, bool is_link) {
        faces_.strikers.push_back({.slot = {a.slot, b.slot},
                                   .row = {a.row, b.row},
                                   .figure = a.figure,
                                   .radius = min(a.radius, b.radius),
                                   .friction = a.friction,
                                   .is_link = is_link});
    }
    /// A solid with corners of cloth is cloth.
    void add(const SolidParts& solid) {
        const auto& list = room_.polyhedra;
        const auto corners = std::span(list.corners).subspan(solid.first_corner, solid.corners);
        if (std::ranges::any_of(corners, [&](auto i) { return room_.is_of_cloth(room_.particles[i].row); })) return;
        const auto first = std::uint32_t(faces_.solid_faces.size());
        for (const auto& face : std::span(list.faces).subspan(solid.first_face, solid.faces))
            faces_.solid_faces.push_back(
                {faces_.striker_of[face[0]], faces_.striker_of[face[1]], faces_.striker_of[face[2]]});
        faces_.solids.push_back({first, first + solid.faces, faces_.striker_of[corners.front()]});
    }
    void number_vertices() {
        faces_.vertex_at.assign(faces_.mesh.empty() ? 0 : state_.size(), ~std::uint32_t(0));
        for (std::uint32_t i = 0; i < faces_.mesh.size(); ++i) faces_.vertex_at[faces_.mesh.slots[i]] = i;
    }
    void list_links() {
        faces_.links.clear();
        if (faces_.mesh.empty()) return;
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < table.size(); ++row) {
            const auto ends = table.members[row];
            if (room_.is_of_cloth(ends[0]) != room_.is_of_cloth(ends[1]))
                faces_.links.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
        }
        sinew::sort(faces_.links.begin(), faces_.links.end());
    }
};

} // namespace sinew::detail
