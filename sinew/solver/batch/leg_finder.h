#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/slack_links.h"
#include "sinew/world/world.h"

#include <algorithm>

namespace sinew::detail {

/// Lists the links that are legs of bends of the sweep and can shrink (solver/bend_legs.h).
template <int D, class Real> void find_bend_links(const World<D, Real>& world, Plan<Real>& plan, PlanRoom& room) {
    constexpr auto kind = kind_number<Angle, D>;
    plan.bend_links.clear();
    if (std::none_of(plan.others.begin(), plan.others.end(), [](const SweepRun& run) { return run.kind == kind; }))
        return;
    const SlackLinks slack(std::get<kind_number<Distance, D>>(world.constraints), room.slack_links);
    if (room.slack_links.empty()) return;
    const auto& bends = std::get<kind>(world.constraints);
    plan.bend_links.resize(bends.size());
    for (Row row = 0; row < bends.size(); ++row)
        for (std::size_t i = 0; i < 2; ++i) {
            const auto* link = slack.between(bends.members[row][i], bends.members[row][i + 1]);
            plan.bend_links[row][i] = link ? link->row : Plan<Real>::no_link;
        }
}

} // namespace sinew::detail
