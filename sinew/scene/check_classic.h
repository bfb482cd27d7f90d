#pragma once

#include "sinew/math/format.h"
#include "sinew/scene/check.h"

#include <array>
#include <string>
#include <string_view>

/// Warnings of values unknown to classic mode.
namespace sinew {

/// Properties of figures and constraints without effect in classic mode, where the file itself chooses this mode:
/// a scene of physical mode may be looked at in the other.
class ClassicCheck {
  public:
    ClassicCheck(const Scene& scene, Document& document) : scene_(scene), document_(document) {}

    void run() {
        const auto* mode = json::find(document_.root, "/solver/mode");
        if (scene_.solver.mode != "classic" || !mode || mode->span.source != 0) return;
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) {
            look(under("figures", i));
            if (const auto* by_hand = std::get_if<ByHand>(&scene_.figures[i].made))
                for (std::size_t k = 0; k < by_hand->constraints.size(); ++k)
                    look(under("figures", i) + under("constraints", k));
        }
        for (std::size_t i = 0; i < scene_.constraints.size(); ++i) look(under("constraints", i));
        for (std::size_t i = 0; i < scene_.events.size(); ++i)
            if (std::holds_alternative<JoinEvent>(scene_.events[i].event) ||
                std::holds_alternative<AdjustEvent>(scene_.events[i].event))
                look(under("events", i));
        for (std::size_t k = 0; k < physical.size(); ++k)
            if (found_[k].count > 0) warn(physical[k], found_[k]);
    }

  private:
    struct Ignored {
        std::string_view key, why, help;
    };
    static constexpr std::string_view by_corrections = "constraints are corrected in passes, not by forces";
    static constexpr std::string_view relaxes = "a \"relaxation\" below 1 makes a constraint softer";
    static constexpr std::array<Ignored, 7> physical = {
        {{"break_force", by_corrections, "a \"breaking_strain\" tears in both modes"},
         {"compliance", by_corrections, relaxes},
         {"max_force", by_corrections, relaxes},
         {"damping_time", by_corrections, "\"world.damping\" slows all motion"},
         {"bend_limit", "chains bend freely", "angles between the particles limit the bends"},
         {"bend_stiffness", "every bend that is held is held alike", relaxes},
         {"internal_damping", "motion inside of a figure has no damping of its own",
          "\"world.damping\" slows all motion"}}};
    struct Found {
        std::string first;
        std::size_t count = 0;
    };
    const Scene& scene_;
    Document& document_;
    std::array<Found, physical.size()> found_;

    /// Counts the ignored values of an object.
    void look(const std::string& place) {
        const auto* value = json::find(document_.root, place);
        const auto* members = value ? value->as<json::Object>() : nullptr;
        for (std::size_t k = 0; members && k < physical.size(); ++k) {
            const auto* member = json::find(*members, physical[k].key);
            const auto* number = member ? member->value.as<json::Number>() : nullptr;
            if (number && number->value != 0 && found_[k].count++ == 0)
                found_[k].first = concat(place, "/", physical[k].key);
        }
    }
    /// Warns at the first place, with the number of others.
    void warn(const Ignored& ignored, const Found& found) {
        const auto more = found.count - 1;
        document_.warn(found.first,
                       format_text("classic mode has no {}: {}{}", ignored.key, ignored.why,
                                   more == 0 ? "" : format_text(" (and {} more)", more)),
                       std::string(ignored.help));
    }
};

} // namespace sinew
