#pragma once

#include "sinew/table/id.h"

#include <array>

/// Contacts filtered and changed by the program.
namespace sinew {

/// A contact that is about to act in a substep: of a particle, or of a link or face by its first corner.
struct PendingContact {
    static constexpr Row none = ~Row(0);
    Row particle = none;
    Row other = none;               ///< the same of the other figure; none: a collider or a plane is touched
    Row collider = none;            ///< index in World::colliders; none: a figure or a plane is touched
    std::array<double, 3> normal{}; ///< unit length, towards `particle`; in 2D the third number is 0
    double gap = 0;                 ///< at the start of the substep, length; negative for an overlap
    double speed = 0;               ///< of approach along the normal, before the contact acts
    double friction = 0;            ///< may be changed: Coulomb's coefficient, >= 0
    double restitution = 0;         ///< may be changed: 0 to 1

    /// Keeps the numbers within their ranges; a NaN counts as 0.
    void clamp() {
        if (!(friction > 0)) friction = 0;
        if (!(restitution > 0)) restitution = 0;
        if (restitution > 1) restitution = 1;
    }
    template <class Vector> void set_normal(const Vector& along) {
        for (std::size_t k = 0; k < along.component.size(); ++k) normal[k] = double(along.component[k]);
    }
};

/// Function of the program that is asked about every contact before it acts, an option of the solver
/// (SolverOptions::contact_filter): of particles, links and faces with planes, colliders and sensors, and of figures
/// with each other, in every substep. A contact that is refused does not act in this substep, and is no touch.
///
/// Asked in the order of the solver, in the thread that takes the steps, which then takes them alone: the same answers
/// give the same bits, and a filter that admits all changes nothing. A particle of a block, which is solved at once
/// over a whole step, is asked about once a step and wall. Friction and bounce count for rows, blocks and swept
/// particles; layers of cloth only part or not; layers of `thin` cloth, which never cross, are not asked about, nor
/// what sleeps. The function may read the world but not change it.
/// An exception of the function ends the program (std::terminate): a step has no state halfway.
///
///     auto admits = [&](PendingContact& contact) { return contact.collider != platform; };
///     simulation.solver.options.contact_filter = ContactFilter::of(admits); // which outlives it
struct ContactFilter {
    bool (*admits)(void* context, PendingContact& contact) noexcept = nullptr; ///< null: all contacts act
    void* context = nullptr;

    explicit operator bool() const { return admits != nullptr; }

    /// A filter that asks a callable object, which must outlive it.
    template <class Admits> static ContactFilter of(Admits& admits) {
        return {[](void* object, PendingContact& contact) noexcept {
                    return bool((*static_cast<Admits*>(object))(contact));
                },
                &admits};
    }

    /// The answer; friction and restitution are within their ranges afterwards.
    bool ask(PendingContact& contact) const {
        if (!admits) return true;
        const bool answer = admits(context, contact);
        contact.clamp();
        return answer;
    }
};

} // namespace sinew
