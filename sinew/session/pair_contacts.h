#pragma once

#include "sinew/scene/scene.h"
#include "sinew/solver/contact_filter.h"
#include "sinew/world/colliders.h"
#include "sinew/world/edit.h"

#include <array>
#include <optional>
#include <string_view>
#include <tuple>

namespace sinew {

/// Filter of contacts for one step that gives the pairs of a scene their bounce and friction, before a program's own
/// filter is asked. Pairs of figures and colliders that are gone do not count.
template <class WorldT> class PairContacts {
  public:
    /// Stands in the filter's place until its own end.
    PairContacts(const Scene& scene, const WorldT& world, ContactFilter& place)
        : world_(world), place_(place), program_(place) {
        for (const auto& pair : scene.pairs) {
            const auto first = side_called(pair.between[0]), second = side_called(pair.between[1]);
            if (first && second && count_ < pairs_.size()) pairs_[count_++] = {ordered(*first, *second), &pair};
        }
        if (count_ > 0) place_ = ContactFilter::of(*this);
    }
    ~PairContacts() { place_ = program_; }
    PairContacts(const PairContacts&) = delete;
    PairContacts& operator=(const PairContacts&) = delete;

    bool operator()(PendingContact& contact) const {
        const auto sides = ordered(figure_of(contact.particle), other_side_of(contact));
        for (std::size_t i = 0; i < count_; ++i)
            if (pairs_[i].sides == sides) {
                contact.restitution = pairs_[i].section->bounce.value_or(contact.restitution);
                contact.friction = pairs_[i].section->friction.value_or(contact.friction);
                break;
            }
        return program_.ask(contact);
    }

  private:
    enum class Kind { figure, collider, bounds };
    struct Side {
        Kind kind = Kind::figure;
        std::uint32_t index = 0; ///< of the figure, or row of the collider

        bool operator==(const Side&) const = default;
        bool operator<(const Side& other) const { return std::tie(kind, index) < std::tie(other.kind, other.index); }
    };
    using Sides = std::array<Side, 2>;
    struct Pair {
        Sides sides;
        const PairSection* section = nullptr;
    };

    const WorldT& world_;
    ContactFilter& place_;
    ContactFilter program_;
    std::array<Pair, max_pairs> pairs_;
    std::size_t count_ = 0;

    static Sides ordered(const Side& a, const Side& b) { return b < a ? Sides{b, a} : Sides{a, b}; }

    std::optional<Side> side_called(std::string_view name) const {
        if (const auto figure = find_figure(world_, name)) return Side{Kind::figure, *figure};
        if (const auto collider = collider_called(world_, name)) {
            const auto row = world_.collider_handles.find(*collider);
            return row ? std::optional(Side{Kind::collider, *row}) : std::nullopt;
        }
        return name == bounds_name ? std::optional(Side{Kind::bounds}) : std::nullopt;
    }
    Side figure_of(Row particle) const { return {Kind::figure, world_.particles.figure[particle]}; }
    Side other_side_of(const PendingContact& contact) const {
        if (contact.other != PendingContact::none) return figure_of(contact.other);
        return contact.collider != PendingContact::none ? Side{Kind::collider, contact.collider} : Side{Kind::bounds};
    }
};

} // namespace sinew
