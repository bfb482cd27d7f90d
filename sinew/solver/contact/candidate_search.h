#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_room.h"

namespace sinew::detail {

/// Features that may touch each other while a list of pairs is valid.
template <int D, class Real> class CandidateSearch {
  public:
    using Vector = Vec<D, Real>;

    CandidateSearch(World<D, Real>& world, ContactRoom<D, Real>& room)
        : world_(world), room_(room), list_(room.list), count_(std::uint32_t(room.particles.size())) {}

    // --- forecast ----------------------------------------------------------------------------------------------------

    /// Expected position of a particle at present.
    Vector position(std::uint32_t i) const {
        return list_.position[i] + list_.velocity[i] * (min(list_.age, list_.horizon) - list_.born[i]);
    }
    /// The same in the frame that moves with the mean velocity.
    Vector position_in_frame(std::uint32_t i) const { return position(i) - list_.mean * min(list_.age, list_.horizon); }
    /// Time for which a relative speed brings features nearer to each other: rows look two substeps ahead.
    Real time_ahead() const { return list_.horizon - min(list_.age, list_.horizon) + Real(2) * list_.h; }

    Real size_of(std::uint32_t particle) const { return room_.particles[particle].radius; }
    /// A filled area pushes out the points in its skin.
    Real size_of(const ContactSegment& s) const {
        const Real radius = min(room_.particles[s.number_a].radius, room_.particles[s.number_b].radius);
        return s.side != 0 ? radius + Real(2) * list_.widest : radius;
    }
    /// Reach of a feature from its place in the frame.
    Real radius_of(std::uint32_t i) const { return size_of(i) + skin() + way(i); }
    Real radius_of(const ContactSegment& s) const {
        return size_of(s) + skin() + max(way(s.number_a), way(s.number_b));
    }

    /// Solids in space: the box around the corners.
    Real size_of(const SolidParts& solid) const {
        Real size = std::numeric_limits<Real>::max();
        each_corner(solid, [&](std::uint32_t i) { size = min(size, size_of(i)); });
        return size;
    }
    Real radius_of(const SolidParts& solid) const {
        Real fastest = 0;
        each_corner(solid, [&](std::uint32_t i) { fastest = max(fastest, way(i)); });
        return size_of(solid) + skin() + fastest;
    }
    collide::BoundingBox<D, Real> box_in_frame(const SolidParts& solid) const {
        collide::BoundingBox<D, Real> box;
        each_corner(solid, [&](std::uint32_t i) { box.include(position_in_frame(i)); });
        return box;
    }

    // --- search ------------------------------------------------------------------------------------------------------

    /// Calls visit(other) for the features with lower numbers that may touch a feature. All forecasts are new.
    template <class Visit> void each_lower(std::uint32_t feature, Visit&& visit) const {
        if (feature < count_) {
            if (room_.particles[feature].is_covered) return;
            list_.particles.each_near(searched(feature, feature, feature, size_of(feature)), [&](auto other) {
                if (other < feature && are_near(feature, other) && may_touch(feature, other)) visit(other);
            });
            return;
        }
        if (D == 3 && room_.is_solid(feature)) {
            const auto& solid = room_.solid(feature);
            collide::BoundingBox<D, Real> box;
            each_corner(solid, [&](std::uint32_t i) { box.include(list_.position[i]); });
            list_.particles.each_near(box.grown(list_.search_radius[feature]), [&](auto other) {
                if (are_near(solid, other) && may_touch(other, solid)) visit(other);
            });
            return;
        }
        const auto& s = room_.segments[feature - count_];
        list_.particles.each_near(searched(feature, s.number_a, s.number_b, size_of(s)), [&](auto other) {
            if (are_near(s, other) && may_touch(other, s)) visit(other);
        });
        if constexpr (D == 3)
            list_.segments.each_near(box_around(s).grown(list_.search_radius[feature]), [&](std::uint32_t other) {
                const auto& t = room_.segments[other];
                if (other + count_ < feature && are_near(s, feature, t, other + count_) && may_touch(s, t))
                    visit(other + count_);
            });
    }

    /// Calls visit(first, second) for the pairs of a feature with others that may touch it, in a round of renewal. Two
    /// features renewed in the same round meet once.
    template <class Visit> void each_around_particle(std::uint32_t p, Visit&& visit) const {
        collide::BoundingBox<D, Real> box;
        box.include(position_in_frame(p));
        box = box.grown(radius_of(p));
        if (!room_.particles[p].is_covered)
            each_particle(box, [&](std::uint32_t other) {
                if (other != p && (!list_.is_new[other] || other < p) && are_near(p, other) && may_touch(p, other))
                    visit(std::max(p, other), std::min(p, other));
            });
        each_segment(box, [&](std::uint32_t other) {
            const auto& s = room_.segments[other];
            if (!is_new(s) && are_near(s, p) && may_touch(p, s)) visit(other + count_, p);
        });
        if constexpr (D == 3)
            each_solid(box, [&](std::uint32_t number) {
                const auto& solid = room_.polyhedra.solids[number];
                if (!is_new(solid) && are_near(solid, p) && may_touch(p, solid)) visit(number + first_solid(), p);
            });
    }
    template <class Visit> void each_around_solid(std::uint32_t number, Visit&& visit) const {
        const auto& solid = room_.polyhedra.solids[number];
        each_particle(box_in_frame(solid).grown(radius_of(solid)), [&](std::uint32_t other) {
            if (are_near(solid, other) && may_touch(other, solid)) visit(number + first_solid(), other);
        });
    }
    template <class Visit> void each_around_segment(std::uint32_t number, Visit&& visit) const {
        const auto& s = room_.segments[number];
        collide::BoundingBox<D, Real> box;
        box.include(position_in_frame(s.number_a));
        box.include(position_in_frame(s.number_b));
        box = box.grown(radius_of(s));
        each_particle(box, [&](std::uint32_t other) {
            if (are_near(s, other) && may_touch(other, s)) visit(number + count_, other);
        });
        if constexpr (D == 3)
            each_segment(box, [&](std::uint32_t other) {
                const auto& t = room_.segments[other];
                if (other == number || (is_new(t) && other > number)) return;
                if (are_near(s, number + count_, t, other + count_) && may_touch(s, t))
                    visit(std::max(number, other) + count_, std::min(number, other) + count_);
            });
    }

    bool may_touch(std::uint32_t particle, const ContactSegment& segment) const {
        return !segment.is_inner && may_meet(particle, segment);
    }
    /// True for a particle and a segment of figures that touch each other, unless they are neighbours.
    bool may_meet(std::uint32_t particle, const ContactSegment& segment) const {
        const Row row = room_.particles[particle].row;
        if (room_.is_of_cloth(row)) return false;
        return row != segment.a && row != segment.b && meets(row, segment.a) && !are_linked(row, segment.a) &&
               !are_linked(row, segment.b);
    }
    /// Calls visit(corner) for the corners of solids nested with that of a side.
    template <class Visit> void each_nested(const ContactSegment& s, Visit&& visit) const {
        if (s.side == 0) return;
        for (const auto& pair : list_.nested) {
            if (pair[0] != s.first && pair[1] != s.first) continue;
            const auto other = pair[pair[0] == s.first];
            for (auto i = other; i < other + room_.segments[other].count; ++i)
                if (may_touch(room_.segments[i].number_a, s)) visit(room_.segments[i].number_a);
        }
    }

    /// True for a particle and a solid of figures in contact, unless the particle is a corner or linked to one.
    bool may_touch(std::uint32_t particle, const SolidParts& solid) const {
        const Row row = room_.particles[particle].row;
        bool may = !room_.is_of_cloth(row);
        each_corner(solid, [&](std::uint32_t i) {
            const Row corner = room_.particles[i].row;
            may = may && row != corner && meets(row, corner) && !are_linked(row, corner);
        });
        return may;
    }
    bool is_new(const SolidParts& solid) const { return any_corner(solid, list_.is_new); }
    bool is_renewed(const SolidParts& solid) const { return any_corner(solid, list_.is_renewed); }
    bool is_new(const ContactSegment& s) const { return list_.is_new[s.number_a] || list_.is_new[s.number_b]; }
    bool is_renewed(const ContactSegment& s) const {
        return list_.is_renewed[s.number_a] || list_.is_renewed[s.number_b];
    }

  private:
    World<D, Real>& world_;
    ContactRoom<D, Real>& room_;
    ContactList<D, Real>& list_;
    std::uint32_t count_; ///< particles

    static Real squared(const Vector& v) { return dot(v, v); }
    std::uint32_t first_solid() const { return count_ + std::uint32_t(room_.segments.size()); }
    template <class Visit> void each_corner(const SolidParts& solid, const Visit& visit) const {
        for (auto i = solid.first_corner; i < solid.first_corner + solid.corners; ++i)
            visit(room_.polyhedra.corners[i]);
    }
    bool any_corner(const SolidParts& solid, const std::vector<char>& flags) const {
        bool any = false;
        each_corner(solid, [&](std::uint32_t i) { any = any || flags[i] != 0; });
        return any;
    }
    Real skin() const { return Real(2) * list_.margin + list_.near_by; }
    Real way(std::uint32_t i) const { return norm(list_.velocity[i] - list_.mean) * time_ahead(); }

    template <class Visit> void each_particle(const collide::BoundingBox<D, Real>& box, Visit&& visit) const {
        list_.particles.each_near(box, [&](std::uint32_t i) {
            if (!list_.is_renewed[i]) visit(i);
        });
        list_.renewed_particles.each_near(box, [&](std::uint32_t i) { visit(list_.renewed[i]); });
    }
    template <class Visit> void each_segment(const collide::BoundingBox<D, Real>& box, Visit&& visit) const {
        list_.segments.each_near(box, [&](std::uint32_t i) {
            if (!is_renewed(room_.segments[i])) visit(i);
        });
        list_.renewed_segment_grid.each_near(box, [&](std::uint32_t i) { visit(list_.renewed_segments[i]); });
    }
    template <class Visit> void each_solid(const collide::BoundingBox<D, Real>& box, Visit&& visit) const {
        list_.solids.each_near(box, [&](std::uint32_t i) {
            if (!is_renewed(room_.polyhedra.solids[i])) visit(i);
        });
        list_.renewed_solid_grid.each_near(box, [&](std::uint32_t i) { visit(list_.renewed_solids[i]); });
    }

    auto searched(std::uint32_t feature, std::uint32_t a, std::uint32_t b, Real size) const {
        return typename FeatureGrid<D, Real>::SearchedFeature{.a = list_.position[a],
                                                              .b = list_.position[b],
                                                              .velocity_a = list_.velocity[a],
                                                              .velocity_b = list_.velocity[b],
                                                              .radius = list_.search_radius[feature],
                                                              .near = size + slack(),
                                                              .ahead = time_ahead(),
                                                              .group = group_of(room_.particles[a].figure)};
    }
    collide::BoundingBox<D, Real> box_around(const ContactSegment& s) const {
        collide::BoundingBox<D, Real> box;
        box.include(list_.position[s.number_a]);
        box.include(list_.position[s.number_b]);
        return box;
    }
    /// Figure whose particles need not be looked at.
    std::uint32_t group_of(FigureIndex figure) const {
        return world_.figures[figure].touches_itself ? no_figure : figure;
    }

    // --- distances ---------------------------------------------------------------------------------------------------

    Real slack() const { return Real(4) * list_.margin + Real(2) * list_.near_by; }
    /// Largest distance at which features that close in at a relative speed may touch while the list holds.
    bool is_within(Real squared_distance, Real sizes, Real squared_speed) const {
        const Real max = sizes + slack() + square_root(squared_speed) * time_ahead();
        return squared_distance <= square(max);
    }
    bool are_near(std::uint32_t a, std::uint32_t b) const {
        return is_within(squared(position(a) - position(b)), size_of(a) + size_of(b),
                         squared(list_.velocity[a] - list_.velocity[b]));
    }
    bool are_near(const ContactSegment& s, std::uint32_t p) const {
        const auto a = position(s.number_a), b = position(s.number_b), x = position(p);
        const auto far = squared(x - (a + (b - a) * collide::nearest_parameter(a, b, x)));
        const auto& v = list_.velocity[p];
        const Real speed = max(squared(v - list_.velocity[s.number_a]), squared(v - list_.velocity[s.number_b]));
        return is_within(far, size_of(p) + size_of(s), speed);
    }
    bool are_near(const SolidParts& solid, std::uint32_t p) const {
        collide::BoundingBox<D, Real> box;
        Real speed = 0;
        each_corner(solid, [&](std::uint32_t i) {
            box.include(position(i));
            speed = max(speed, squared(list_.velocity[p] - list_.velocity[i]));
        });
        const auto x = position(p);
        const auto off = Vector::map([&](int k) { return max(max(box.low[k] - x[k], x[k] - box.high[k]), Real(0)); });
        return is_within(squared(off), size_of(p) + size_of(solid), speed);
    }
    bool are_near(const ContactSegment& s, std::uint32_t feature_s, const ContactSegment& t,
                  std::uint32_t feature_t) const {
        const auto a = position(s.number_a), b = position(s.number_b), c = position(t.number_a),
                   d = position(t.number_b);
        const auto at = collide::nearest_parameters(a, b, c, d);
        const auto far = squared(a + (b - a) * at.s - (c + (d - c) * at.t));
        return far <= square(list_.search_radius[feature_s] + list_.search_radius[feature_t]);
    }

    // --- kinds of pairs ----------------------------------------------------------------------------------------------

    bool may_touch(std::uint32_t i, std::uint32_t k) const {
        const auto &a = room_.particles[i], &b = room_.particles[k];
        if (room_.is_of_cloth(a.row) || room_.is_of_cloth(b.row)) return false; // face_contact.h, cloth_contact.h
        return !a.is_covered && !b.is_covered && meets(a.row, b.row) && !are_linked(a.row, b.row);
    }
    bool may_touch(const ContactSegment& s, const ContactSegment& t) const {
        return meets(s.a, t.a) && s.a != t.a && s.a != t.b && s.b != t.a && s.b != t.b && !are_linked(s.a, t.a) &&
               !are_linked(s.a, t.b) && !are_linked(s.b, t.a) && !are_linked(s.b, t.b);
    }
    bool meets(Row a, Row b) const {
        const auto figure_a = world_.particles.figure[a], figure_b = world_.particles.figure[b];
        if (figure_a == figure_b) return world_.figures[figure_a].touches_itself;
        return world_.figures[figure_a].collides && world_.figures[figure_b].collides &&
               touch(filter_of(world_, a), filter_of(world_, b));
    }
    bool are_linked(Row a, Row b) const {
        if (room_.links.empty()) return false;
        const std::array<Row, 2> pair = {std::min(a, b), std::max(a, b)};
        return std::binary_search(room_.links.begin(), room_.links.end(), pair);
    }
};

} // namespace sinew::detail
