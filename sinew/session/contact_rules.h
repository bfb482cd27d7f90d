#pragma once

#include "sinew/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Occurrence of a scene's event that waits for a contact.
struct RuleMet {
    std::size_t event = 0;    ///< index of the scene's event
    std::uint64_t before = 0; ///< number of earlier occurrences
    std::string with;         ///< name of the collider or figure touched; may be empty
    double impulse = 0;       ///< in the step, or of a hit, in the scene's units; the largest if several contacts count
};

/// Events of a scene that happen on contact.
class ContactRules {
  public:
    /// Begins anew; lists the touches of figures and of the bounds in the world if any rule asks for contacts.
    void restart(const Scene& scene, AnyWorld& world);
    /// Rules that the contacts of the last step fulfil, in the order of the events.
    std::vector<RuleMet> met(const Scene& scene, const AnyWorld& world);

    /// State of a snapshot; is_of() says whether it belongs to a scene.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [waiting] = self;
        visit(waiting);
    }
    bool is_of(const Scene& scene) const;

  private:
    struct Waiting {
        std::size_t event = 0;
        std::uint64_t count = 0; ///< occurrences so far
        double next = 0;         ///< time before which the event does not happen

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [event, count, next] = self;
            visit(event, count, next);
        }
    };
    std::vector<Waiting> waiting_;
};

} // namespace sinew
