#pragma once

#include "sinew/collide/collider.h"
#include "sinew/collide/segment.h"
#include "sinew/math/sort.h"
#include "sinew/picture/forces.h"
#include "sinew/world/contacts.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace sinew {

/// Contact as it is drawn. The force is the normal one, on the side on which the fields of force press: upwards under
/// what lies. Unit: the world's own unit of force.
template <int D> struct ContactPoint { Vec<D, double> position{}, force{}; };

/// Contacts after a step: of particles with planes and colliders, and of figures. In classic mode forces are zero.
/// Contacts of cloth with cloth, which is kept apart by position, are not among them.
template <class WorldT> class ContactPoints {
  public:
    static constexpr int D = WorldT::dimension;
    using Point = ContactPoint<D>;
    using Plane = HalfSpace<D, typename WorldT::Real>;

    /// `step`: duration of a step; `near`: gap up to which a particle touches a plane. Keeps a reference to the world.
    ContactPoints(const WorldT& world, double step, double near)
        : world_(world), p_(world.particles), per_step_(inverse_or_zero(step)), near_(near),
          per_substep2_(inverse_or_zero(square(double(world.contacts.kept_substep)))),
          knows_forces_(world.settings.mode == Mode::physical) {}

    std::vector<Point> list() {
        add_planes();
        for (const auto& contact : world_.contacts.kept) add(contact);
        for (const auto& contact : world_.contacts.passing) add(contact);
        sort_unique(held_);
        for (const auto& touch : world_.contacts.touching) add(touch);
        return std::move(points_);
    }

  private:
    using Real = typename WorldT::Real;
    using Vector = Vec<D, double>;
    using Kept = KeptContact<D, Real>;
    using Surface = collide::SurfacePoint<D, Real>;
    static constexpr auto none = ContactKey::none;

    /// One side of a contact: a particle, or a link as a capsule.
    struct Side {
        Row row = 0;
        Vec<D, Real> a{}, b{};
        Real radius = 0;
        Vector at(double t) const { return cast<double>(a) * (1 - t) + cast<double>(b) * t; }
    };

    const WorldT& world_;
    const decltype(world_.particles)& p_;
    double per_step_, near_, per_substep2_;
    bool knows_forces_;
    std::vector<Point> points_;
    std::vector<std::array<std::uint32_t, 2>> held_; ///< particle and collider of rows, by slots

    static void sort_unique(std::vector<std::array<std::uint32_t, 2>>& pairs) {
        sinew::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    }

    // --- planes ------------------------------------------------------------------------------------------------------

    void add_planes() {
        const std::optional<Forces<WorldT>> forces =
            knows_forces_ && !world_.bounds.empty() ? std::optional<Forces<WorldT>>(world_) : std::nullopt;
        for (std::uint32_t i = 0; i < world_.bounds.size(); ++i)
            for (Row row = 0; row < p_.size(); ++row)
                if (const auto& plane = world_.bounds[i]; p_.mobility[row] > 0 && touches(row, plane)) {
                    const auto normal = cast<double>(plane.normal);
                    const auto kept = force_of_row(row, i);
                    const double push = kept ? *kept : forces ? forces->of_plane(row, plane) : 0;
                    points_.push_back(
                        {cast<double>(p_.position[row]) - normal * double(p_.radius[row]), normal * push});
                }
    }
    /// Tolerance of resting contact: rounding and the fall during a step leave a smaller gap.
    bool touches(Row row, const Plane& plane) const {
        return double(dot(plane.normal, p_.position[row]) - plane.offset - p_.radius[row]) <= near_;
    }
    /// Force of the row that holds a particle on a plane; nothing if no row does.
    std::optional<double> force_of_row(Row row, std::uint32_t plane) const {
        const auto& kept = world_.contacts.kept;
        const ContactKey key{.particle = {p_.handles.index_of(row), none, none, none}, .collider = plane_bit | plane};
        const auto found = std::lower_bound(kept.begin(), kept.end(), key,
                                            [](const Kept& contact, const ContactKey& k) { return contact.key < k; });
        if (found == kept.end() || found->key != key) return std::nullopt;
        return double(found->multiplier) * per_substep2_;
    }

    // --- rows --------------------------------------------------------------------------------------------------------

    void add(const Kept& contact) {
        const auto& key = contact.key;
        if (D == 3 && key.collider == none && key.feature == ContactKey::face) return add_on_face(contact);
        const auto side = side_of(key.particle[0], key.particle[1]);
        if (!side || !(contact.multiplier > 0)) return;
        const double force = double(contact.multiplier) * per_substep2_;
        if (key.collider == none) {
            if (const auto other = side_of(key.particle[2], key.particle[3])) add(*side, *other, force);
        } else if (key.collider < plane_bit) {
            if (add(*side, key.collider, force)) held_.push_back({key.particle[0], key.collider});
        }
    }
    void add_on_face(const Kept& contact) {
        std::array<Vec<D, double>, 4> at;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!p_.handles.in_use(contact.key.particle[i])) return;
            at[i] = cast<double>(p_.position[p_.handles.row_at(contact.key.particle[i])]);
        }
        if constexpr (D == 3) {
            const auto normal = direction(cross(at[1] - at[0], at[2] - at[0]));
            const double radius = double(p_.radius[p_.handles.row_at(contact.key.particle[3])]);
            const double force = double(contact.multiplier) * per_substep2_;
            if (force > 0) points_.push_back({at[3] - normal * radius, normal * force});
        }
    }
    std::optional<Side> side_of(std::uint32_t slot_a, std::uint32_t slot_b) const {
        const auto& handles = p_.handles;
        if (!handles.in_use(slot_a) || (slot_b != none && !handles.in_use(slot_b))) return std::nullopt;
        const Row a = handles.row_at(slot_a), b = slot_b == none ? a : handles.row_at(slot_b);
        return Side{a, p_.position[a], p_.position[b], min(p_.radius[a], p_.radius[b])};
    }

    void add(const Side& one, const Side& other, double force) {
        const auto at = collide::nearest_parameters(one.a, one.b, other.a, other.b);
        const auto near = one.at(double(at.s)), far = other.at(double(at.t));
        const double distance = norm(near - far);
        const auto normal = distance > 0 ? (near - far) * (1 / distance) : Vector::axis(1);
        const auto fields = cast<double>(forcing_on(world_, one.row).acceleration);
        const double half = (distance + double(other.radius) - double(one.radius)) / 2;
        points_.push_back({far + normal * half, normal * (dot(fields, normal) > 0 ? -force : force)});
    }
    /// False if no surface is near.
    bool add(const Side& side, std::uint32_t slot, double force) {
        const auto* collider = collider_at(slot);
        const auto surface = collider ? surface_at(*collider, side) : std::nullopt;
        if (surface) points_.push_back({cast<double>(surface->point), cast<double>(surface->normal) * force});
        return surface.has_value();
    }

    // --- touches of colliders that no row holds; planes are found by position ----------------------------------------

    void add(const ColliderTouch& touch) {
        if (is_plane(touch.collider)) return;
        const std::array pair = {touch.particle, touch.collider};
        const auto side = side_of(touch.particle, none);
        const auto* collider = collider_at(touch.collider);
        if (!side || !collider || collider->is_sensor || std::binary_search(held_.begin(), held_.end(), pair)) return;
        add(*side, touch.collider, knows_forces_ ? touch.strength.impulse * per_step_ : 0);
    }
    const collide::Collider<D, Real>* collider_at(std::uint32_t slot) const {
        const auto& handles = world_.collider_handles;
        return handles.in_use(slot) ? &world_.colliders[handles.row_at(slot)] : nullptr;
    }
    /// Point of a surface nearest to a side, not far beyond its radius: what touched during a step may since have left.
    static std::optional<Surface> surface_at(const collide::Collider<D, Real>& collider, const Side& side) {
        const Real within = Real(4) * side.radius;
        if (side.a == side.b) return collide::nearest(collider.shape, collider.target, side.a, within);
        const auto found = collide::nearest_to_segment(collider.shape, collider.target, side.a, side.b, within);
        return found ? std::optional(found->surface) : std::nullopt;
    }
};

} // namespace sinew
