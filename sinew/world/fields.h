#pragma once

#include "sinew/world/world.h"

#include <string_view>
#include <utility>

/// THE list of a world's fields: a snapshot holds them, the hash covers them, a comparison names them. Each struct is
/// taken apart by structured bindings: a new field does not compile until listed here.
///
/// A visitor has four functions, each called with the name and the field:
///
///     fixed      decided when the world is built or edited: saved once
///     moving     changed by steps
///     noted      read by no step, but by the owner of the world: in a snapshot, not in the hash
///     derived    follows from the rest, or belongs to one process
///
/// and `enter(name)`, called before the fields of a struct.
namespace sinew {

template <class ParticlesT, class Visit> void visit_particles(ParticlesT& particles, Visit&& visit) {
    auto& [position, previous, velocity, at_end, residual, force, any_force, inverse_mass, mobility, radius, figure,
           quarantined, rest_time, asleep, energy_debt, rolls, inertia, spin, turn, near, handles] = particles;
    visit.enter("particles");
    visit.fixed("handles", handles);
    visit.fixed("inverse_mass", inverse_mass);
    visit.fixed("radius", radius);
    visit.fixed("figure", figure);
    visit.fixed("rolls", rolls);
    visit.fixed("inertia", inertia);
    visit.moving("spin", spin);
    visit.moving("turn", turn);
    visit.moving("position", position);
    visit.moving("previous", previous);
    visit.moving("velocity", velocity);
    visit.moving("residual", residual);
    visit.moving("any_force", any_force);
    visit.moving("force", force);
    visit.moving("mobility", mobility);
    visit.moving("quarantined", quarantined);
    visit.moving("rest_time", rest_time);
    visit.moving("asleep", asleep);
    visit.moving("energy_debt", energy_debt);
    visit.moving("near", near);
    visit.noted("at_end", at_end); // the step after rests on it only where the next is no longer prepared
}

template <class Table, class Visit> void visit_constraints(Table& table, Visit&& visit) {
    auto& [members, limits, multiplier, compliance, relaxation, split, max_force, damping_time, motor_speed, motorized,
           breaking_strain, break_force, damage_limit, damage, figure, handles] = table;
    visit.enter(std::remove_const_t<Table>::Kind::name);
    visit.fixed("handles", handles);
    visit.fixed("members", members);
    visit.fixed("compliance", compliance);
    visit.fixed("relaxation", relaxation);
    visit.fixed("split", split);
    visit.fixed("damping_time", damping_time);
    visit.fixed("breaking_strain", breaking_strain);
    visit.fixed("break_force", break_force);
    visit.fixed("damage_limit", damage_limit);
    visit.fixed("figure", figure);
    visit.moving("motorized", motorized);
    if (motorized.any_of([](char flag) { return flag != 0; }))
        visit.moving("limits", limits); // of a winch
    else
        visit.fixed("limits", limits);
    visit.moving("multiplier", multiplier);
    visit.moving("max_force", max_force); // of a motor that tires
    visit.moving("motor_speed", motor_speed);
    visit.moving("damage", damage);
}

template <class ContactsT, class Visit> void visit_contacts(ContactsT& contacts, Visit&& visit) {
    auto& [kept, kept_substep, passing, touching, lists_planes, lists_figures, figures, hit_impulse] = contacts;
    visit.enter("contacts");
    visit.moving("kept", kept);
    visit.moving("kept_substep", kept_substep);
    visit.moving("touching", touching);
    visit.noted("passing", passing);
    visit.noted("lists_planes", lists_planes);
    visit.noted("lists_figures", lists_figures);
    visit.noted("figures", figures);
    visit.noted("hit_impulse", hit_impulse);
}

template <class WorldT, class Visit> void visit_fields(WorldT& world, Visit&& visit) {
    auto& [settings, particles, constraints, sweep, pins, pin_handles, forces, bounds, colliders, collider_handles,
           contacts, figures, figure_names, figure_stamp, unused_figures, time, steps, energy_lost, last_step,
           last_substep, repair_window, sleep_parameters, events, journal] = world;
    visit.enter("world");
    visit.fixed("figures", figures);
    visit.fixed("figure_names", figure_names);
    visit.fixed("unused_figures", unused_figures);
    visit.fixed("sweep", sweep);
    visit.fixed("pin_handles", pin_handles);
    visit.fixed("collider_handles", collider_handles);
    visit.fixed("colliders", colliders); // their poses: see collider_poses
    visit.moving("settings", settings);
    visit.moving("time", time);
    visit.moving("steps", steps);
    visit.moving("last_step", last_step);
    visit.moving("last_substep", last_substep);
    visit.moving("repair_window", repair_window);
    visit.moving("sleep_parameters", sleep_parameters);
    visit.moving("pins", pins);
    visit.moving("forces", forces);
    visit.moving("bounds", bounds);
    visit.noted("energy_lost", energy_lost);
    visit.noted("events", events);
    visit.derived("figure_stamp", figure_stamp);
    visit.derived("journal", journal);
    visit_particles(particles, visit);
    std::apply([&](auto&... table) { (visit_constraints(table, visit), ...); }, constraints);
    visit_contacts(contacts, visit);
}

} // namespace sinew
