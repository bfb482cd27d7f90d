#pragma once

#include "sinew/constraint/kind_table.h"
#include "sinew/math/format.h"
#include "sinew/scene/check.h"
#include "sinew/scene/types.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

/// Warnings of strengths beyond reach.
namespace sinew {

/// Constraints too strong for the largest force or strain they reach, and damage without a strain to begin at.
template <int D, class Real> class BreakingCheck {
  public:
    BreakingCheck(const Scene& scene, const World<D, Real>& world, Document& document)
        : scene_(scene), world_(world), document_(document) {}

    void run() {
        for (const auto& event : scene_.events)
            if (const auto* to = std::get_if<AdjustEvent>(&event.event))
                if (to->max_force || to->break_force || to->breaking_strain || to->compliance)
                    adjusted_.insert(adjusted_.end(), to->constraints.begin(), to->constraints.end());
        for (std::size_t i = 0; i < scene_.figures.size(); ++i)
            detail::visit_held(scene_.figures[i].made, [&](const auto& made) {
                const auto place = under("figures", i);
                if constexpr (requires { made.strength; }) damage(made.strength, place);
                if constexpr (requires { made.constraints[0].between; })
                    each(made.constraints, std::string(name_of(scene_.figures[i])) + "/", place);
            });
        each(scene_.constraints, "", "");
        for (std::size_t i = 0; i < scene_.events.size(); ++i)
            if (const auto* join = std::get_if<JoinEvent>(&scene_.events[i].event)) {
                const auto& first = join->constraint.between.front();
                constraint(join->constraint, first.substr(0, first.find('/') + 1), under("events", i));
            }
    }

  private:
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;
    std::vector<std::string_view> adjusted_; ///< names of constraints with another strength by an event

    void each(const std::vector<ConstraintSection>& list, const std::string& prefix, const std::string& place) {
        for (std::size_t i = 0; i < list.size(); ++i) constraint(list[i], prefix, place + under("constraints", i));
    }
    void constraint(const ConstraintSection& section, const std::string& prefix, const std::string& place) {
        if (is_adjusted(section, prefix)) return;
        damage(section.strength, place);
        if (section.max_force > 0 && scene_.solver.mode != "classic") yields(section, prefix, place);
    }

    void damage(const Strength& strength, const std::string& place) {
        if (strength.damage_limit > 0 && strength.breaking_strain == 0)
            document_.warn(place + "/damage_limit",
                           "a damage_limit does nothing without a breaking_strain, beyond which damage adds up",
                           strength.break_force > 0 ? "beyond a break_force a constraint tears at once"
                                                    : "give it a breaking_strain, too");
    }

    /// Constraints with a largest force never reach a larger one, and a length slips there, strained no further.
    void yields(const ConstraintSection& section, const std::string& prefix, const std::string& place) {
        const double most = section.max_force * largest_share(section);
        if (section.strength.break_force >= most)
            document_.warn(place + "/break_force",
                           format_text("a break_force of {:6} is never reached: the force is {:6} at most, the "
                                       "max_force",
                                       section.strength.break_force, most),
                           "give it a break_force below max_force, or no max_force");
        const bool slips = kind_called(section.kind)->length_power == 1 && !section.is_rigid() && !section.drive;
        const auto rest = slips ? rest_of(section, prefix) : 0;
        if (!(rest > 0)) return;
        const double strain = most * section.compliance / rest;
        if (section.strength.breaking_strain > strain)
            document_.warn(place + "/breaking_strain",
                           format_text("a breaking_strain of {:6} is never reached: beyond a strain of {:3} the "
                                       "force is max_force, and the length slips",
                                       section.strength.breaking_strain, strain),
                           "give it a larger max_force or none, or a smaller breaking_strain");
    }
    /// Length beyond which a constraint pulls; 0 where only the world's own steps find out.
    double rest_of(const ConstraintSection& section, const std::string& prefix) const {
        if (section.rest || section.low || section.high) return section.rest.value_or(section.high.value_or(0));
        const auto a = find_particle(world_, full_name(section.between.front(), prefix));
        const auto b = find_particle(world_, full_name(section.between.back(), prefix));
        const bool is_link = section.kind == Distance<D>::name && a && b;
        return is_link ? double(distance(*position_of(world_, *a), *position_of(world_, *b))) : 0;
    }
    /// Largest share of max_force by the keys of a drive.
    static double largest_share(const ConstraintSection& section) {
        double share = 1;
        if (section.drive)
            for (const auto& key : section.drive->keys) share = std::max(share, key.strength.value_or(1));
        return share;
    }

    /// True if an event gives the constraint another strength. Of very many events, any may.
    bool is_adjusted(const ConstraintSection& section, const std::string& prefix) const {
        constexpr std::size_t many = 100;
        if (section.name.empty() || adjusted_.empty()) return false;
        const auto full = prefix + section.name;
        return adjusted_.size() > many || std::ranges::any_of(adjusted_, [&](std::string_view name) {
                   return name == full || (name.ends_with('*') && full.starts_with(name.substr(0, name.size() - 1)));
               });
    }
};

} // namespace sinew
