#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/world/asleep.h"

/// Multipliers of contacts between steps, in the world, and between substeps, beside the list of candidates.
namespace sinew {

/// Forgets all contacts but those of sleeping bodies.
template <int D, class Real> void forget_contacts(World<D, Real>& world) {
    for (auto* contacts : {&world.contacts.kept, &world.contacts.passing})
        std::erase_if(*contacts,
                      [&](const auto& contact) { return !is_asleep(world.particles, contact.key.particle[0]); });
}

namespace detail {

template <int D, class Real> class KeptContacts {
  public:
    KeptContacts(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), state_(solver.sweep_state), room_(contact_room(solver)) {}

    /// At the start of a step.
    void take_from_world(bool list_is_new) {
        const auto& kept = world_.contacts.kept;
        const auto is_same = [](const auto& a, const auto& b) {
            return a.key == b.key && a.multiplier == b.multiplier && a.friction == b.friction;
        };
        if ((!list_is_new || room_.list.follows_last) && std::ranges::equal(kept, room_.written, is_same))
            return list_is_new ? take_from_last_list() : void();
        room_.multipliers.assign(room_.list.candidates.size(), {});
        room_.kept_at_walls.clear();
        for (const auto& contact : kept)
            if (contact.key.collider != ContactKey::none)
                room_.kept_at_walls.push_back(contact);
            else if (auto* multiplier = find(contact.key))
                *multiplier = {contact.multiplier, contact.friction,
                               contact.key.feature == ContactKey::face ? 0 : side_of(contact.key.feature)};
    }
    /// After a new list in a later substep: pairs of the last list are in the same parts.
    void take_from_last_list() {
        room_.multipliers.assign(room_.list.candidates.size(), {});
        std::size_t old = 0;
        for (std::size_t i = 0; i < room_.parts.list.size(); ++i) {
            const auto& part = room_.parts.list[i];
            for (auto k = part.first; k < part.last; ++k) {
                const auto& pair = room_.list.candidates[k];
                while (old < room_.list.end_before[i] && room_.list.before[old] < pair) ++old;
                if (old < room_.list.end_before[i] && room_.list.before[old] == pair)
                    room_.multipliers[k] = room_.list.multipliers_before[old];
            }
            old = room_.list.end_before[i];
        }
    }

    /// Multipliers of the rows of a substep.
    void keep() {
        if constexpr (D == 3)
            for (auto& kept : room_.multipliers) kept.side = 0;
        for (auto& part : room_.parts.list)
            for (std::size_t i = 0; i < part.first_wall; ++i) {
                const auto& row = part.rows[i];
                room_.multipliers[part.origins[i].source] =
                    lasts(row) ? Multiplier{row.multiplier, row.tangent, row.side} : Multiplier{};
            }
        room_.kept_at_walls.clear();
        for (const auto& part : room_.parts.list)
            for (auto i = part.first_wall; i < part.rows.size(); ++i) {
                const auto& row = part.rows[i];
                const bool acts = row.keeps && row.multiplier > Real(0);
                if (!acts && !(part.origins[i].is_one_way && row.gap < Real(0))) continue;
                room_.kept_at_walls.push_back({part.wall_keys[part.origins[i].source], acts ? row.multiplier : Real(0),
                                               acts ? row.tangent : Vec<D, Real>{}});
            }
        sort(room_.kept_at_walls);
    }
    /// After the last substep.
    void give_to_world() {
        auto& kept = world_.contacts.kept;
        forget_contacts(world_);
        kept.insert(kept.end(), room_.kept_at_walls.begin(), room_.kept_at_walls.end());
        for (const auto& part : room_.parts.list)
            for (std::size_t i = 0; i < part.first_wall; ++i) {
                const auto& row = part.rows[i];
                const bool passes = !row.keeps && row.multiplier > Real(0);
                if (!passes && !lasts(row)) continue;
                auto& contacts = passes ? world_.contacts.passing : kept;
                const auto key =
                    row.is_on_face ? key_of_face(row) : key_of(room_.list.candidates[part.origins[i].source], row);
                contacts.push_back({key, row.multiplier, row.tangent});
            }
        give_faces();
        sort(kept);
        room_.written = kept;
    }

  private:
    using Multiplier = ContactMultiplier<D, Real>;
    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;

    static void sort(std::vector<KeptContact<D, Real>>& contacts) {
        const auto by_key = [](const auto& a, const auto& b) { return a.key < b.key; };
        if (!std::is_sorted(contacts.begin(), contacts.end(), by_key))
            sinew::sort(contacts.begin(), contacts.end(), by_key);
    }

    /// Rows of faces of cloth, each told by a corner.
    void give_faces() {
        const auto& faces = room_.faces;
        for (std::size_t i = 0; i < faces.rows.size(); ++i) {
            const auto& row = faces.rows[i];
            if (!(row.max > Real(0))) continue;
            const auto& striker = faces.strikers[faces.touches[i].striker];
            const Row corner = state_.row_of[faces.mesh.slots[faces.touches[i].vertex]];
            const auto end = striker.is_link ? id(striker.row[1]) : none;
            world_.contacts.passing.push_back(
                {{.particle = {id(striker.row[0]), end, id(corner), none}}, row.multiplier, row.tangent});
        }
    }

    std::uint32_t id(Row row) const { return world_.particles.handles.index_of(row); }
    ContactKey key_of(const ContactCandidate& pair, const ContactRow<D, Real>& row) const {
        ContactKey key{.feature = feature_of_side(row.side)};
        const auto count = room_.particles.size();
        std::size_t i = 0;
        for (const auto feature : {pair.first, pair.second}) {
            if (feature < count) {
                key.particle[i] = id(room_.particles[feature].row);
            } else {
                key.particle[i] = id(room_.segments[feature - count].a);
                key.particle[i + 1] = id(room_.segments[feature - count].b);
            }
            i = 2;
        }
        return key;
    }

    /// Corners of the face, and the particle.
    ContactKey key_of_face(const ContactRow<D, Real>& row) const {
        const auto slot = [&](std::size_t i) { return id(state_.row_of[row.slot[i]]); };
        return {.particle = {slot(1), slot(2), slot(3), slot(0)}, .feature = ContactKey::face};
    }
    /// A row that acts, and one that remembers on which side of a segment a particle is.
    static bool lasts(const ContactRow<D, Real>& row) {
        return row.keeps && (row.multiplier > Real(0) || (row.side != 0 && row.gap < Real(0)));
    }
    static constexpr int side_of(std::uint32_t feature) { return feature == 2 ? -1 : int(feature); }
    static constexpr std::uint32_t feature_of_side(int side) { return side < 0 ? 2 : std::uint32_t(side); }

    // --- look-up -----------------------------------------------------------------------------------------------------

    static constexpr auto none = ContactKey::none;

    std::uint32_t number_of(std::uint32_t slot) const {
        if (!world_.particles.handles.in_use(slot)) return none;
        return room_.number_of[world_.particles.handles.row_at(slot)];
    }
    /// Number of a feature of one or two particles.
    std::uint32_t feature_of(std::uint32_t slot_a, std::uint32_t slot_b) const {
        const auto a = number_of(slot_a);
        if (slot_b == none || a == none) return a;
        const auto b = number_of(slot_b);
        for (auto i = room_.first_segment_at[a]; i < room_.first_segment_at[a + 1]; ++i)
            if (room_.segments[room_.segments_at[i]].number_b == b)
                return std::uint32_t(room_.particles.size()) + room_.segments_at[i];
        return none;
    }
    std::uint32_t solid_with(std::uint32_t corner) const {
        const auto& polyhedra = room_.polyhedra;
        if (corner == none || polyhedra.solids.empty() || polyhedra.solid_of[corner] == none) return none;
        return std::uint32_t(room_.particles.size() + room_.segments.size()) + polyhedra.solid_of[corner];
    }
    Multiplier* find(const ContactKey& key) {
        const auto& at = key.particle;
        const bool is_face = key.feature == ContactKey::face;
        const ContactCandidate pair = is_face ? ContactCandidate{solid_with(number_of(at[0])), number_of(at[3])}
                                              : ContactCandidate{feature_of(at[0], at[1]), feature_of(at[2], at[3])};
        if (pair.first == none || pair.second == none) return nullptr;
        const auto& part = room_.parts.list[part_of(room_, pair)];
        const auto begin = room_.list.candidates.begin() + part.first, end = room_.list.candidates.begin() + part.last;
        const auto found = std::lower_bound(begin, end, pair);
        return found != end && *found == pair ? &room_.multipliers[std::size_t(found - room_.list.candidates.begin())]
                                              : nullptr;
    }
};

} // namespace detail
} // namespace sinew
