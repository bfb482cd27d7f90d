#include "player/pick.h"

namespace sinew::play {

std::optional<std::vector<ParticleId>> namesakes(const AnyWorld& from, std::span<const ParticleId> members,
                                                 const AnyWorld& to) {
    std::vector<ParticleId> found;
    for (const auto id : members) {
        const auto name = name_of(from, id);
        const auto same = std::visit([&](const auto& any) { return find_particle(any, name); }, to);
        if (!same) return std::nullopt;
        found.push_back(*same);
    }
    return found;
}

std::optional<Picked> counterpart(const AnyWorld& from, const Picked& picked, const AnyWorld& to, const View& view) {
    auto members = namesakes(from, picked.members, to);
    const auto there = position_of(from, picked.members);
    if (!members || !there) return std::nullopt;
    Picked same{.members = *members, .position = *position_of(to, *members), .figure = picked.figure};
    for (int i = 0; i < 3; ++i) same.position[i] += picked.position[i] - (*there)[i];
    if (const auto seen = view.see(same.position.as<3, double>()))
        same.depth = double(seen->depth), same.pixel = seen->pixel;
    return same;
}

} // namespace sinew::play
