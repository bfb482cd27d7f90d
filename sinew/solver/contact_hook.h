#pragma once

#include "sinew/world/world.h"

#include <array>
#include <utility>

/// Contacts filtered and changed by the program.
namespace sinew {

/// A contact that is about to act in a substep: of a particle, or of a link by its first end.
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
};

namespace detail {

struct ContactHook {
    bool (*admits)(void* context, PendingContact& contact) = nullptr;
    void* context = nullptr;
};

#if defined(__wasm__)
/// The module has no callbacks, and its workers no thread-local memory.
inline const ContactHook* contact_hook() {
    return nullptr;
}
inline const ContactHook* set_contact_hook(const ContactHook*) {
    return nullptr;
}
#else
inline thread_local constinit const ContactHook* contact_hook_of_thread = nullptr;
/// Hook of the steps that this thread takes; null: none.
inline const ContactHook* contact_hook() {
    return contact_hook_of_thread;
}
/// Returns the hook before.
inline const ContactHook* set_contact_hook(const ContactHook* hook) {
    return std::exchange(contact_hook_of_thread, hook);
}
#endif

} // namespace detail

/// While it lives, steps that this thread takes ask admits(contact) about every contact of rows (particles and links
/// of figures with each other, with colliders and with planes) and of swept particles with colliders and planes, in
/// every substep. A contact that is refused does not act in this substep, and is no touch. Asked in the order of rows,
/// in this thread, which then takes the steps alone: the same answers give the same bits. Not asked are faces of cloth,
/// sensors, and classic mode. `admits` may read the world but not change it; a body that sleeps is not asked about.
///
///     const ContactFilter filter([&](PendingContact& contact) { return contact.collider != platform; });
///     simulation.step(1.0 / 60);
template <class Admits> class ContactFilter {
  public:
    explicit ContactFilter(Admits admits)
        : admits_(std::move(admits)), hook_{&call, this}, before_(detail::set_contact_hook(&hook_)) {}
    ~ContactFilter() { detail::set_contact_hook(before_); }
    ContactFilter(const ContactFilter&) = delete;
    ContactFilter& operator=(const ContactFilter&) = delete;

  private:
    Admits admits_;
    detail::ContactHook hook_;
    const detail::ContactHook* before_;

    /// Worlds that `admits` itself steps are not asked about.
    static bool call(void* context, PendingContact& contact) {
        const auto* hook = detail::set_contact_hook(nullptr);
        const bool admits = static_cast<ContactFilter*>(context)->admits_(contact);
        detail::set_contact_hook(hook);
        return admits;
    }
};

} // namespace sinew
