#include "sinew/world/edit.h"

#include "sinew/constraint/kind_table.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>
#include <limits>

/// Edits of a simulation between steps.
using namespace sinew;
using namespace sinew::c;

namespace {

/// Calls work(world) of a simulation that may be changed.
template <class Work> sinew_status in_world(sinew_world simulation, const Work& work) {
    return change(simulation, [&](Session& session) { return std::visit(work, session.world()); });
}

sinew_status found(bool was, const char* of) {
    return was ? SINEW_OK : bad_id(of);
}

/// Calls work(world, id) for a constraint that exists.
template <class Work>
sinew_status in_constraint(sinew_world simulation, sinew_constraint constraint, const Work& work) {
    return in_world(simulation, [&](auto& world) {
        const auto id = constraint_of(constraint);
        return constraint_state(world, id) ? work(world, id) : bad_id("constraint");
    });
}

/// Calls set(world, id, value) for a number of a constraint that is not negative.
template <class Set>
sinew_status set_number(sinew_world simulation, sinew_constraint constraint, double value, const Set& set) {
    if (!(value >= 0)) return fail(SINEW_BAD_ARGUMENT, "the number is negative, or no number");
    return in_constraint(simulation, constraint, [&]<int D, class Real>(World<D, Real>& world, const ConstraintId& id) {
        return found(set(world, id, Real(value)), "constraint");
    });
}

/// Bound of a strength in a world; 0 stands for none.
template <class Real> Real or_never(Real bound) {
    return bound > Real(0) ? bound : std::numeric_limits<Real>::infinity();
}

template <class Real> ConstraintSpec<Real> spec_of(const sinew_constraint_spec* given) {
    ConstraintSpec<Real> spec;
    if (!given) return spec;
    if (given->low <= given->high) spec.limits = between(Real(given->low), Real(given->high));
    spec.compliance = Real(given->compliance);
    if (given->max_force > 0) spec.max_force = Real(given->max_force);
    if (given->breaking_strain > 0) spec.breaking_strain = Real(given->breaking_strain);
    return spec;
}

bool is_possible(const sinew_constraint_spec& spec) {
    return !std::isnan(spec.low) && !std::isnan(spec.high) && spec.compliance >= 0 && spec.max_force >= 0 &&
           spec.breaking_strain >= 0;
}

/// Worlds of float hold the inverse of every mass from here on; infinity is immovable.
constexpr double min_mass = 1e-30;

bool is_radius(double radius) {
    return radius >= 0 && std::isfinite(radius);
}

template <int D> bool takes(std::uint32_t kind, std::size_t count) {
    if (kind >= kinds_in<D>.size()) return false;
    const auto& info = kinds_in<D>[kind];
    return info.any_arity ? count >= std::size_t(info.min_arity) : count == std::size_t(info.min_arity);
}

} // namespace

extern "C" {

// --- particles and constraints
// -----------------------------------------------------------------------------------------

sinew_status sinew_world_add_particle(sinew_world simulation, const sinew_particle_spec* given,
                                      sinew_particle* particle) {
    sinew_particle_spec spec;
    if (const auto status = take(given, spec)) return status;
    if (!particle) return null_argument();
    if (!is_finite(spec.position) || !is_finite(spec.velocity)) return not_finite();
    if (!(spec.mass >= min_mass) || !is_radius(spec.radius))
        return fail(SINEW_BAD_ARGUMENT, "a mass is at least 1e-30, and a radius at least 0 and finite");
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        *particle = number_of(add_particle(world, ParticleSpec<D, Real>{.position = vector_of<D, Real>(spec.position),
                                                                        .velocity = vector_of<D, Real>(spec.velocity),
                                                                        .mass = Real(spec.mass),
                                                                        .radius = Real(spec.radius)}));
        return SINEW_OK;
    });
}

sinew_status sinew_world_remove_particle(sinew_world simulation, sinew_particle particle) {
    return in_world(simulation, [&](auto& world) {
        const auto id = id_of<ParticleTag>(particle);
        return found(remove_particles(world, std::span(&id, 1)) > 0, "particle");
    });
}

sinew_status sinew_world_add_constraint(sinew_world simulation, uint32_t kind, const sinew_particle* particles,
                                        size_t count, const sinew_constraint_spec* given,
                                        sinew_constraint* constraint) {
    if (!particles || !constraint) return null_argument();
    sinew_constraint_spec taken;
    if (given)
        if (const auto status = take(given, taken)) return status;
    const auto* spec = given ? &taken : nullptr;
    if (spec && !is_possible(*spec)) return fail(SINEW_BAD_ARGUMENT, "a number of the constraint is not possible");
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        if (!takes<D>(kind, count))
            return fail(SINEW_BAD_ARGUMENT, "no kind of this dimension has this number and so many particles");
        std::vector<ParticleId> members;
        for (std::size_t i = 0; i < count; ++i) members.push_back(id_of<ParticleTag>(particles[i]));
        const auto added = add_constraint(world, int(kind), members, spec_of<Real>(spec));
        if (!added)
            return fail(SINEW_BAD_ID,
                        "a particle is gone or named twice, or limits are negative of a measure that never is");
        *constraint = number_of(*added);
        return SINEW_OK;
    });
}

sinew_status sinew_world_remove_constraint(sinew_world simulation, sinew_constraint constraint) {
    return in_world(simulation, [&](auto& world) {
        const auto id = constraint_of(constraint);
        return found(remove_constraints(world, std::span(&id, 1)) > 0, "constraint");
    });
}

// --- values of a constraint
// --------------------------------------------------------------------------------------------

sinew_status sinew_world_set_limits(sinew_world simulation, sinew_constraint constraint, double low, double high) {
    if (!(low <= high)) return fail(SINEW_BAD_ARGUMENT, "low is above high, or not a number");
    return in_constraint(simulation, constraint, [&]<int D, class Real>(World<D, Real>& world, const ConstraintId& id) {
        if (set_limits(world, id, between(Real(low), Real(high)))) return SINEW_OK;
        const bool is_angle = D == 3 && id.kind == kind_number<Angle, D>;
        return fail(SINEW_BAD_ARGUMENT, is_angle ? "an angle in 3 dimensions has no sign: limits from 0 to pi"
                                                 : "a measure of this kind is never negative, and `high` is");
    });
}

sinew_status sinew_world_set_compliance(sinew_world simulation, sinew_constraint constraint, double compliance) {
    return set_number(simulation, constraint, compliance,
                      [](auto& world, const ConstraintId& id, auto value) { return set_compliance(world, id, value); });
}

sinew_status sinew_world_set_max_force(sinew_world simulation, sinew_constraint constraint, double max_force) {
    return set_number(simulation, constraint, max_force, [](auto& world, const ConstraintId& id, auto value) {
        return set_max_force(world, id, or_never(value));
    });
}

sinew_status sinew_world_set_breaking_strain(sinew_world simulation, sinew_constraint constraint, double strain) {
    return set_number(simulation, constraint, strain, [](auto& world, const ConstraintId& id, auto value) {
        return set_breaking_strain(world, id, or_never(value));
    });
}

sinew_status sinew_world_set_break_force(sinew_world simulation, sinew_constraint constraint, double force) {
    return set_number(simulation, constraint, force, [](auto& world, const ConstraintId& id, auto value) {
        return set_break_force(world, id, or_never(value));
    });
}

sinew_status sinew_world_drive(sinew_world simulation, sinew_constraint constraint, double rate) {
    if (!std::isfinite(rate)) return not_finite();
    return in_constraint(simulation, constraint, [&]<int D, class Real>(World<D, Real>& world, const ConstraintId& id) {
        if (drive(world, id, Real(rate))) return SINEW_OK;
        return fail(SINEW_BAD_ARGUMENT,
                    "a motor of unlimited force beside a rigid constraint of the same particles: set its max_force");
    });
}

// --- state of a particle
// -----------------------------------------------------------------------------------------------

sinew_status sinew_world_set_position(sinew_world simulation, sinew_particle particle, sinew_point position) {
    if (!is_finite(position)) return not_finite();
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(set_position(world, id_of<ParticleTag>(particle), vector_of<D, Real>(position)), "particle");
    });
}

sinew_status sinew_world_set_velocity(sinew_world simulation, sinew_particle particle, sinew_point velocity) {
    if (!is_finite(velocity)) return not_finite();
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(set_velocity(world, id_of<ParticleTag>(particle), vector_of<D, Real>(velocity)), "particle");
    });
}

sinew_status sinew_world_set_mass(sinew_world simulation, sinew_particle particle, double mass) {
    if (!(mass >= min_mass)) return fail(SINEW_BAD_ARGUMENT, "a mass is at least 1e-30");
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(set_mass(world, id_of<ParticleTag>(particle), Real(mass)), "particle");
    });
}

sinew_status sinew_world_set_radius(sinew_world simulation, sinew_particle particle, double radius) {
    if (!is_radius(radius)) return fail(SINEW_BAD_ARGUMENT, "a radius is at least 0 and finite");
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(set_radius(world, id_of<ParticleTag>(particle), Real(radius)), "particle");
    });
}

sinew_status sinew_world_apply_force(sinew_world simulation, sinew_particle particle, sinew_point force) {
    if (!is_finite(force)) return not_finite();
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(apply_force(world, id_of<ParticleTag>(particle), vector_of<D, Real>(force)), "particle");
    });
}

sinew_status sinew_world_apply_impulse(sinew_world simulation, sinew_particle particle, sinew_point impulse) {
    if (!is_finite(impulse)) return not_finite();
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(apply_impulse(world, id_of<ParticleTag>(particle), vector_of<D, Real>(impulse)), "particle");
    });
}

// --- pins
// --------------------------------------------------------------------------------------------------------------

sinew_status sinew_world_pin_particle(sinew_world simulation, sinew_particle particle, sinew_pin* pin) {
    if (!pin) return null_argument();
    return in_world(simulation, [&](auto& world) {
        const auto added = sinew::pin(world, id_of<ParticleTag>(particle));
        if (added) *pin = number_of(*added);
        return found(added.has_value(), "particle");
    });
}

sinew_status sinew_world_move_pin(sinew_world simulation, sinew_pin pin, sinew_point target) {
    if (!is_finite(target)) return not_finite();
    return in_world(simulation, [&]<int D, class Real>(World<D, Real>& world) {
        return found(move_pin(world, id_of<PinTag>(pin), vector_of<D, Real>(target)), "pin");
    });
}

sinew_status sinew_world_unpin(sinew_world simulation, sinew_pin pin) {
    return in_world(simulation, [&](auto& world) { return found(unpin(world, id_of<PinTag>(pin)), "pin"); });
}

} // extern "C"
