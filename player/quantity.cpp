#include "player/quantity.h"

#include "sinew/world/edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace sinew::play {
namespace {

constexpr Unit energy{.length = 2, .mass = 1, .time = -2};

struct OfWorld {
    std::string_view name, about;
    Unit unit;
    double (*value)(const Report&);
};

constexpr std::array of_world = {
    OfWorld{"kinetic energy", "of all particles", energy, [](const Report& report) { return report.kinetic; }},
    OfWorld{"potential energy", "in gravity", energy, [](const Report& report) { return report.potential; }},
    OfWorld{"stored energy", "in springs", energy, [](const Report& report) { return report.stored; }},
    OfWorld{"total energy", "kinetic, potential and stored", energy,
            [](const Report& report) { return report.kinetic + report.potential + report.stored; }},
    OfWorld{"energy lost", "in impacts since the start", energy,
            [](const Report& report) { return report.energy_lost; }},
    OfWorld{"largest speed", "of any particle", unit::speed, [](const Report& report) { return report.max_speed; }},
    OfWorld{"largest stretch",
            "of any distance, percent",
            {},
            [](const Report& report) { return report.stretch_max * 100; }},
    OfWorld{"mean stretch",
            "of all distances, percent",
            {},
            [](const Report& report) { return report.stretch_mean * 100; }},
    OfWorld{"constraints", "their number", {}, [](const Report& report) { return double(report.constraints); }},
};

constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};

/// A quantity of one particle: its name in the scene, a colon, a word.
std::string own_name(const std::string& particle, std::string_view word) {
    return particle + ": " + std::string(word);
}

std::string link_word(std::string_view kind, std::size_t number, std::string_view what) {
    return concat(what, " of ", kind, " ", number);
}

/// Constraints of a particle, at most `most`: calls visit(kind's name, number, state).
template <class Visit> void each_link(const AnyWorld& world, ParticleId id, Visit&& visit) {
    constexpr std::size_t most = 6;
    std::visit(
        [&](const auto& any) {
            const auto own = row_of(any, id);
            if (!own) return;
            int kind = 0;
            std::size_t count = 0;
            for_each_table(any, [&](const auto& table) {
                using Kind = typename std::decay_t<decltype(table)>::Kind;
                const int number = kind++;
                for (Row row = 0; row < table.size() && count < most; ++row) {
                    const auto members = table.members[row];
                    if (std::find(members.begin(), members.end(), *own) == members.end()) continue;
                    if (const auto state = constraint_state(any, {number, table.handles.id_of(row)}))
                        visit(std::string_view(Kind::name), ++count, *state);
                }
            });
        },
        world);
}

std::optional<double> of_particle(const Play& play, const std::string& particle, const std::string& word) {
    const auto& world = play.session().world();
    const auto id = std::visit([&](const auto& any) { return find_particle(any, particle); }, world);
    if (!id) return std::nullopt;
    const auto found = std::visit(
        [&]<class WorldT>(const WorldT& any) -> std::optional<double> {
            const auto row = row_of(any, *id);
            if (!row) return std::nullopt;
            const auto position = cast<double>(any.particles.position[*row]);
            const auto velocity = cast<double>(any.particles.velocity[*row]);
            for (int i = 0; i < WorldT::dimension; ++i) {
                if (word == axes[std::size_t(i)]) return position[i];
                if (word == "speed along " + std::string(axes[std::size_t(i)])) return velocity[i];
            }
            return word == "speed" ? std::optional(norm(velocity)) : std::nullopt;
        },
        world);
    if (found) return found;
    std::optional<double> of_link;
    each_link(world, *id, [&](std::string_view kind, std::size_t number, const auto& state) {
        if (word == link_word(kind, number, "measure")) of_link = state.measure;
        if (word == link_word(kind, number, "tension")) of_link = state.tension;
    });
    return of_link;
}

} // namespace

std::vector<Quantity> quantities_of(const Play& play) {
    std::vector<Quantity> all;
    for (const auto& one : of_world) all.push_back({std::string(one.name), std::string(one.about)});
    if (!play.selected) return all;
    const auto& world = play.session().world();
    const auto id = play.selected->members.front();
    const auto particle = name_of(world, id);
    if (particle.empty()) return all;
    for (int i = 0; i < play.session().scene().dimension; ++i) {
        const auto axis = axes[std::size_t(i)];
        all.push_back({own_name(particle, axis), "position along the axis"});
        all.push_back({own_name(particle, "speed along " + std::string(axis)), "velocity along the axis"});
    }
    all.push_back({own_name(particle, "speed"), "length of the velocity"});
    each_link(world, id, [&](std::string_view kind, std::size_t number, const auto&) {
        all.push_back({own_name(particle, link_word(kind, number, "measure")), "length, angle or area that is kept"});
        all.push_back({own_name(particle, link_word(kind, number, "tension")), "pull, or push where negative"});
    });
    return all;
}

std::optional<double> value_of(const std::string& quantity, const Play& play, const Report& report) {
    for (const auto& one : of_world)
        if (one.name == quantity) return one.value(report);
    const auto colon = quantity.find(": ");
    if (colon == std::string::npos) return std::nullopt;
    return of_particle(play, quantity.substr(0, colon), quantity.substr(colon + 2));
}

std::string unit_of(const std::string& quantity, const Play& play) {
    const auto units = play.session().scene().measures();
    for (const auto& one : of_world)
        if (one.name == quantity)
            return one.name.find("stretch") == std::string_view::npos ? units.text(one.unit) : "%";
    const auto word = quantity.substr(std::min(quantity.find(": ") + 2, quantity.size()));
    if (word.starts_with("speed")) return units.text(unit::speed);
    if (word.starts_with("tension")) return units.text(unit::force);
    return word.size() == 1 ? units.text(unit::length) : "";
}

} // namespace sinew::play
