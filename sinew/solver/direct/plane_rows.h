#pragma once

#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/direct/state.h"

#include <algorithm>

/// Planes that hold the nodes of a block: those of the world, and one at each contact with a collider.
namespace sinew::detail {

template <int D> struct BlockPlane : HalfSpace<D, double> {
    Vec<D, double> surface_displacement{}; ///< displacement of the surface in the substep
    std::uint32_t collider = ~std::uint32_t(0);
};

template <int D, class Real> class BlockPlanes {
  public:
    using Vector = Vec<D, double>;
    using Plane = BlockPlane<D>;
    static constexpr auto none = ~std::uint32_t(0);

    explicit BlockPlanes(BlockState<D, Real>& state) : state_(state), world_(state.world) {}

    bool any() const { return has_walls(world_); }

    double depth(const BlockNode<D>& node, const HalfSpace<D, double>& plane) const {
        return plane.depth_of(node.position, double(world_.particles.radius[node.row]));
    }

    /// Calls visit(plane) for the planes of the world, and the contacts of a node with colliders at its present place.
    template <class Visit> void each(const BlockNode<D>& node, Visit&& visit) const {
        const bool lists = lists_planes(world_);
        for (std::size_t i = 0; i < world_.bounds.size(); ++i) {
            auto wall = world_.bounds[i].template as<double>();
            rub(wall, node.row, world_.bounds[i]);
            const double begun = wall.depth_of(node.start, double(world_.particles.radius[node.row]));
            const auto number = std::uint32_t(world_.colliders.size() + i);
            auto plane = eased(node, {wall, {}, lists ? number : none}, begun);
            if (is_admitted(node, plane, number, begun)) visit(plane);
        }
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            if (!is_near(i, node, 0)) continue;
            const auto& collider = world_.colliders[i];
            const collide::Cover<D, Real, double> cover(world_.colliders, state_.touches.boxes, state_.to(),
                                                        filter_of(world_, node.row));
            const collide::MovingCollider<D, Real, double> moving(collider, state_.from(), state_.to(),
                                                                  state_.substep(), cover);
            moving.contacts(node.start, node.position, double(world_.particles.radius[node.row]), 0.0,
                            [&](const auto& contact) {
                                if (!contact.begins_in_front && !has_touched(i, node.row)) return;
                                auto plane = eased(node, plane_of(collider, contact, i, node.row), contact.begun_depth);
                                if (!is_admitted(node, plane, i, contact.begun_depth)) return;
                                note(i, node.row, 0);
                                if (!collider.is_sensor) visit(plane);
                            });
        }
    }

    /// True if a node may touch a collider within a distance of its position; moving colliders then drive the block.
    bool is_any_collider_near(const BlockNode<D>& node, double margin) const {
        bool found = false;
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            if (!is_near(i, node, margin)) continue;
            const auto& collider = world_.colliders[i];
            const Real within = world_.particles.radius[node.row] + Real(margin);
            if (collider.is_at_rest() &&
                !collide::nearest(collider.shape, collider.target, cast<Real>(node.position), within))
                continue;
            if (collider.is_driven()) state_.be_motorized();
            found = true;
        }
        return found;
    }

    /// Reports the impulse of a collider on a particle, newton seconds.
    void note(std::uint32_t collider, Row row, double impulse) const {
        state_.touches.add(row, collider, Real(impulse));
    }
    void note(const BlockNode<D>& node, const Plane& plane, double impulse) const {
        const auto normal = cast<Real>(plane.normal);
        const auto point = node.position - plane.normal * (dot(plane.normal, node.position) - plane.offset);
        const auto surface = cast<Real>(plane.surface_displacement * (1 / state_.substep()));
        state_.touches.add(node.row, plane.collider, Real(impulse),
                           {cast<Real>(point), normal, dot(normal, surface - world_.particles.velocity[node.row])});
    }

  private:
    BlockState<D, Real>& state_;
    World<D, Real>& world_;

    bool is_near(std::uint32_t collider, const BlockNode<D>& node, double margin) const {
        collide::BoundingBox<D, Real> box;
        box.include(cast<Real>(node.start));
        box.include(cast<Real>(node.position));
        return touch(world_.colliders[collider].filter, filter_of(world_, node.row)) &&
               state_.touches.boxes[collider].overlaps(box.grown(world_.particles.radius[node.row] + Real(margin)));
    }

    /// The program's answer about a node that is beyond a plane, asked once a step, which may change how both rub and
    /// bounce.
    bool is_admitted(const BlockNode<D>& node, Plane& plane, std::uint32_t wall, double begun) const {
        if (!state_.filter || !(depth(node, plane) > 0)) return true;
        auto& answers = state_.blocks.answers;
        auto known = std::ranges::find_if(
            answers, [&](const WallAnswer& one) { return one.particle == node.row && one.wall == wall; });
        if (known == answers.end()) known = answers.insert(answers.end(), ask(node, plane, wall, begun));
        plane.friction = known->friction, plane.restitution = known->restitution;
        return known->is_admitted;
    }
    WallAnswer ask(const BlockNode<D>& node, const Plane& plane, std::uint32_t wall, double begun) const {
        const auto moved = node.position - node.start - plane.surface_displacement;
        PendingContact contact{.particle = node.row,
                               .gap = -begun,
                               .speed = -dot(plane.normal, moved) / state_.substep(),
                               .friction = plane.friction,
                               .restitution = plane.restitution};
        if (wall < world_.colliders.size()) contact.collider = wall;
        contact.set_normal(plane.normal);
        const bool is_admitted = state_.filter.ask(contact);
        return {node.row, wall, is_admitted, contact.friction, contact.restitution};
    }

    /// The plane behind which a node is held that begins the substep `begun` deep behind a surface.
    Plane eased(const BlockNode<D>& node, Plane plane, double begun) const {
        if (begun > 0) plane.offset -= depth_left(begun, norm(node.acceleration), state_.substep());
        return plane;
    }

    /// True for a particle in touch in this step or the one before: a spring gives a little, so a one-way collider
    /// cannot tell by the place.
    bool has_touched(std::uint32_t collider, Row row) const {
        if (state_.touches.has(row, collider)) return true;
        const auto& touching = world_.contacts.touching;
        return std::binary_search(
            touching.begin(), touching.end(),
            ColliderTouch{world_.particles.handles.index_of(row), world_.collider_handles.index_of(collider)});
    }

    Plane plane_of(const collide::Collider<D, Real>& collider, const collide::ColliderContact<D, double>& contact,
                   std::uint32_t index, Row row) const {
        const auto& [point, normal, distance, feature] = contact.surface;
        Plane plane{{normal, dot(normal, point), 0, 0}, contact.surface_displacement, index};
        rub(plane, row, collider);
        return plane;
    }
    template <class Wall> void rub(HalfSpace<D, double>& plane, Row row, const Wall& wall) const {
        const auto surface = surface_between(world_, row, wall);
        plane.restitution = double(surface.restitution), plane.friction = double(surface.friction);
    }
};

} // namespace sinew::detail
