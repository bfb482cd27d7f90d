#pragma once

#include "sinew/collide/extreme_points.h"
#include "sinew/solver/contact/polyhedra.h"
#include "sinew/solver/contact/wall_rows.h"

namespace sinew::detail {

/// Rows of contact of the faces of solids in space with colliders which end below a face, as a post does. Edges and
/// corners of the solid have rows of their own.
template <class Real> class SolidWallRows : WallRows<3, Real> {
    using Base = WallRows<3, Real>;
    using Base::add, Base::take, Base::rub, Base::id, Base::from_, Base::to_, Base::h_, Base::touches_;
    using Base::world_, Base::state_, Base::room_, Base::part_;
    using typename Base::ContactRowT;
    using typename Base::Origin;
    using Vector = Vec3<Real>;

  public:
    using Base::Base;

    void add_all() {
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i)
            for (const auto number : part_.solids) add(room_.polyhedra.solids[number], number, i);
    }

  private:
    using Face = PolyhedronRoom::Face;
    Polyhedra<Real> polyhedra_{state_, room_};

    void add(const SolidParts& solid, std::uint32_t number, std::uint32_t index) {
        const auto& collider = world_.colliders[index];
        const Row lead = room_.particles[room_.polyhedra.lead(number)].row;
        if (collider.is_sensor || collider.one_way != Vector{} || !touch(collider.filter, filter_of(world_, lead)))
            return;
        collide::BoundingBox<3, Real> box;
        Real radius = std::numeric_limits<Real>::max(), widest = 0;
        for (const auto corner : polyhedra_.corners_of(solid)) {
            const auto& p = room_.particles[corner];
            box.include(polyhedra_.place(corner)),
                box.include(polyhedra_.place(corner) + state_.displacement_at(p.slot));
            radius = min(radius, p.radius), widest = max(widest, p.radius);
        }
        if (!touches_.boxes[index].overlaps(box.grown(widest + Base::margin(lead)))) return;
        const auto before = collider.pose_at(from_);
        for (const auto& face : polyhedra_.faces_of(solid)) {
            const auto along = before.turn_back(-polyhedra_.normal(face));
            std::visit(
                [&](const auto& shape) {
                    collide::each_extreme(shape, along, [&](const Vector& point, Real size, std::uint32_t corner) {
                        add(solid, face, index,
                            {point, size + radius, corner, Real(room_.polyhedra.half_width[number])});
                    });
                },
                collider.shape);
        }
    }

    struct Point {
        Vector place{}; ///< in the frame of the collider
        Real radius = 0;
        std::uint32_t number = 0;
        Real half_width = 0; ///< of the solid
    };
    void add(const SolidParts& solid, const Face& face, std::uint32_t index, const Point& point) {
        const auto& collider = world_.colliders[index];
        const auto before = collider.pose_at(from_), after = collider.pose_at(to_);
        const auto x = before.to_world(point.place);
        const Real distance = polyhedra_.beyond(face, x);
        if (distance < -point.half_width || !is_below(solid, face, x, point.half_width)) return;
        const auto shares = polyhedra_.shares(face, x);
        if (min(min(shares[0], shares[1]), shares[2]) < Real(-1e-5)) return;
        ContactRowT row;
        Origin origin;
        ContactKey key{.collider = world_.collider_handles.index_of(index), .feature = point.number};
        origin.collider = index;
        row.normal = -polyhedra_.normal(face);
        origin.surface_displacement = after.to_world(point.place) - x + collider.belt_velocity(after, row.normal) * h_;
        row.gap = distance - point.radius;
        origin.deep = Real(0.05) * point.half_width;
        rub(row, origin, room_.particles[face[0]].row, collider);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const auto& corner = room_.particles[face[i]];
            key.particle[i] = id(corner.row);
            take(row, corner.slot, shares[int(i)]);
        }
        add(row, origin, key);
    }
    /// True for a point well within the bounds of a face: along the bounds edges meet the collider.
    bool is_below(const SolidParts& solid, const Face& face, const Vector& x, Real half_width) const {
        constexpr Real level = Real(0.999), border = Real(0.02);
        const auto normal = polyhedra_.normal(face);
        return std::ranges::all_of(polyhedra_.faces_of(solid), [&](const Face& other) {
            return dot(polyhedra_.normal(other), normal) > level || polyhedra_.beyond(other, x) < -border * half_width;
        });
    }
};

} // namespace sinew::detail
