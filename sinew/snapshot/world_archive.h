#pragma once

#include "sinew/snapshot/archive.h"
#include "sinew/world/world.h"

/// Fields of a world's parts, by structured bindings: a new field does not compile until listed.
namespace sinew::snapshot {

template <> struct Enumerators<Mode> { static constexpr int count = 2; };
template <> struct Enumerators<PassOrder> { static constexpr int count = 3; };
template <> struct Enumerators<Hold> { static constexpr int count = 5; };
template <> struct Enumerators<Integrator> { static constexpr int count = int(integrator_names.size()); };
template <> struct Enumerators<Direct> { static constexpr int count = int(direct_names.size()); };
template <> struct Enumerators<ClothContactKind> { static constexpr int count = int(cloth_contact_names.size()); };
template <> struct Enumerators<Mark> { static constexpr int count = int(Mark::fragment) + 1; };
template <> struct Enumerators<EventType> { static constexpr int count = int(EventType::hit) + 1; };

// --- settings and surroundings ---------------------------------------------------------------------------------------

template <class Archive, class Real> void archive(Archive& at, SleepRules<Real>& rules) {
    auto& [speed, delay] = rules;
    archive_all(at, speed, delay);
}
template <class Archive, class Real> void archive(Archive& at, ClassicRules<Real>& rules) {
    auto& [passes, order, moves_each_pass, integrator, keep, damp_after_force, root_free, bounce, floor_keep,
           time_scale, longest_step, outward_bounce, points_only_passes, unscaled_inertia, halved_acceleration,
           dropped_leftover] = rules;
    archive_all(at, passes, order, moves_each_pass, integrator, keep, damp_after_force, root_free, bounce, floor_keep,
                time_scale, longest_step, outward_bounce, points_only_passes, unscaled_inertia, halved_acceleration,
                dropped_leftover);
}
template <class Archive, class Real> void archive(Archive& at, Settings<Real>& settings) {
    auto& [mode, substeps, iterations, damping, frame, classic, sleep] = settings;
    archive_all(at, mode, substeps, iterations, damping, frame, classic, sleep);
}

template <class Archive, int D, class Real> void archive(Archive& at, Gravity<D, Real>& gravity) {
    auto& [acceleration] = gravity;
    archive(at, acceleration);
}
template <class Archive, int D, class Real> void archive(Archive& at, Drag<D, Real>& drag) {
    auto& [strength] = drag;
    archive(at, strength);
}
template <class Archive, int D, class Real> void archive(Archive& at, Wind<D, Real>& wind) {
    auto& [velocity, strength, gust, gust_period, gust_size, seed, density, coefficient, metre] = wind;
    archive_all(at, velocity, strength, gust, gust_period, gust_size, seed, density, coefficient, metre);
}
template <class Archive, int D, class Real> void archive(Archive& at, Attractor<D, Real>& attractor) {
    auto& [center, strength, softness, figure] = attractor;
    archive_all(at, center, strength, softness, figure);
}
template <class Archive, int D, class Real> void archive(Archive& at, RandomPush<D, Real>& push) {
    auto& [low, high, seed] = push;
    archive_all(at, low, high, seed);
}
/// Ids and tags are there from a version of the format on; fields of an earlier one get new ids.
template <class Archive, int D, class Real> void archive(Archive& at, ForceTable<D, Real>& forces) {
    if constexpr (Archive::is_reading)
        if (at.version() < version_with_force_ids) {
            std::vector<Force<D, Real>> laws;
            archive(at, laws);
            for (const auto& law : laws) forces.push_back(law, std::uint32_t(forces.size()));
            return;
        }
    ForceTable<D, Real>::fields(forces, [&](auto&... fields) { archive_all(at, fields...); });
}
template <class Archive, int D, class Real> void archive(Archive& at, HalfSpace<D, Real>& plane) {
    auto& [normal, offset, restitution, friction] = plane;
    archive_all(at, normal, offset, restitution, friction);
}

// --- colliders -------------------------------------------------------------------------------------------------------

template <class Archive> void archive(Archive& at, collide::Filter& filter) {
    auto& [layers, mask] = filter;
    archive_all(at, layers, mask);
}
template <class Archive, int D, class Real> void archive(Archive& at, collide::Pose<D, Real>& pose) {
    auto& [position, rotation] = pose;
    archive_all(at, position, rotation.number);
}
template <class Archive, int D, class Real> void archive(Archive& at, collide::HalfSpace<D, Real>& plane) {
    auto& [normal, offset] = plane;
    archive_all(at, normal, offset);
}
template <class Archive, int D, class Real> void archive(Archive& at, collide::Sphere<D, Real>& sphere) {
    auto& [radius] = sphere;
    archive(at, radius);
}
template <class Archive, int D, class Real> void archive(Archive& at, collide::Capsule<D, Real>& capsule) {
    auto& [a, b, radius] = capsule;
    archive_all(at, a, b, radius);
}
template <class Archive, int D, class Real> void archive(Archive& at, collide::Box<D, Real>& box) {
    auto& [size] = box;
    archive(at, size);
}
template <class Archive, class Real> void archive(Archive& at, collide::Polygon<2, Real>& polygon) {
    auto& [corners] = polygon;
    archive(at, corners);
}
template <class Archive, class Real> void archive(Archive& at, collide::Chain<2, Real>& chain) {
    auto& [points, is_closed] = chain;
    archive_all(at, points, is_closed);
}
template <class Archive, class Real> void archive(Archive& at, collide::HeightField<3, Real>& field) {
    auto& [columns, spacing, height] = field;
    archive_all(at, columns, spacing, height);
}
/// The tree of boxes is built again.
template <class Archive, class Real> void archive(Archive& at, collide::Mesh<3, Real>& mesh) {
    auto corners = mesh.corners();
    auto triangles = mesh.triangles();
    archive_all(at, corners, triangles);
    if constexpr (Archive::is_reading) {
        for (const auto& triangle : triangles)
            for (const auto corner : triangle)
                if (corner >= corners.size()) return at.fail("a triangle has a corner that the mesh has not");
        mesh = collide::Mesh<3, Real>(std::move(corners), std::move(triangles));
    }
}
/// A collider without its poses.
template <class Archive, int D, class Real> void archive_but_poses(Archive& at, collide::Collider<D, Real>& collider) {
    auto& [shape, from, target, restitution, friction, filter, one_way, is_sensor, surface_velocity, name, tag] =
        collider;
    archive_all(at, shape, restitution, friction, filter, one_way, is_sensor, surface_velocity, name, tag);
}

// --- rows ------------------------------------------------------------------------------------------------------------

template <class Archive, int Arity> void archive(Archive& at, Members<Arity>& members) {
    if constexpr (Arity == any_arity) {
        archive_all(at, members.pool, members.first);
        if constexpr (Archive::is_reading) {
            auto& first = members.first;
            const bool is_sound = !first.empty() && first.front() == 0 && first.back() == members.pool.size() &&
                                  std::is_sorted(first.begin(), first.end());
            if (!is_sound) at.fail("members and constraints do not belong together");
            if (!is_sound) members = {};
        }
    } else {
        archive(at, members.rows);
    }
}
template <class Archive> void archive(Archive& at, Run& run) {
    auto& [kind, count] = run;
    archive_all(at, kind, count);
}
template <class Archive, int D, class Real> void archive(Archive& at, Pin<D, Real>& pin) {
    auto& [particle, from, target, compliance, damping, max_force, multiplier, hold, steer, steer_damping] = pin;
    archive_all(at, particle, from, target, compliance, damping, max_force, multiplier, hold, steer, steer_damping);
}

// --- contacts and events ---------------------------------------------------------------------------------------------

template <class Archive> void archive(Archive& at, ContactKey& key) {
    auto& [particle, collider, feature] = key;
    archive_all(at, particle, collider, feature);
}
template <class Archive, int D, class Real> void archive(Archive& at, KeptContact<D, Real>& contact) {
    auto& [key, multiplier, friction] = contact;
    archive_all(at, key, multiplier, friction);
}
template <class Archive> void archive(Archive& at, TouchStrength& strength) {
    auto& [impulse, blow, blow_before, is_new] = strength;
    archive_all(at, impulse, blow, blow_before, is_new);
}
template <class Archive> void archive(Archive& at, TouchPlace& place) {
    auto& [point, normal, speed] = place;
    archive_all(at, point, normal, speed);
}
template <class Archive> void archive(Archive& at, ColliderTouch& touch) {
    auto& [particle, collider, strength, place] = touch;
    archive_all(at, particle, collider, strength, place);
}
template <class Archive> void archive(Archive& at, FigureTouch& touch) {
    auto& [first, second, particle, hardest, strength, place] = touch;
    archive_all(at, first, second, particle, hardest, strength, place);
}
template <class Archive> void archive(Archive& at, Event& event) {
    auto& [type, figure, constraint, ends, particle, collider, other, other_particle, impulse] = event;
    archive_all(at, type, figure, constraint, ends[0], ends[1], particle, collider, other, other_particle, impulse);
}

// --- figures ---------------------------------------------------------------------------------------------------------

template <class Archive> void archive(Archive& at, Numbered& numbered) {
    auto& [stem, first, count, columns] = numbered;
    archive_all(at, stem, first, count, columns);
}
template <class Archive> void archive(Archive& at, VirtualNode& node) {
    auto& [of, count, position] = node;
    archive_all(at, of, count, position);
}
template <class Archive> void archive(Archive& at, Fragment& fragment) {
    auto& [corners, points, ends] = fragment;
    for (auto& corner : corners) archive(at, corner);
    archive_all(at, points, ends);
}
template <class Archive> void archive(Archive& at, Piece& piece) {
    auto& [mark, part, particles, width, end_width, hidden, fragment] = piece;
    archive_all(at, mark, part, particles, width, end_width, hidden, fragment);
}
template <class Archive> void archive(Archive& at, Figure& figure) {
    auto& [name, prefab, particles, constraints, particle_names, constraint_names, particle_numbers, constraint_numbers,
           pieces, fragments, direct, integrator, tethers, quarantined, faces_wind, filter, collides, touches_itself,
           cloth, friction, bounce, wall_friction, internal_damping, generation] = figure;
    archive_all(at, name, prefab, particles, constraints, particle_names, constraint_names, particle_numbers,
                constraint_numbers, pieces, fragments, direct, integrator, tethers, filter, collides, touches_itself,
                cloth, friction, bounce, wall_friction, internal_damping, generation);
}

} // namespace sinew::snapshot
