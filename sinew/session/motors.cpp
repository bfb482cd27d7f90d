#include "sinew/session/motors.h"

#include "sinew/assert/assert.h"
#include "sinew/constraint/kind_table.h"
#include "sinew/scene/check.h"
#include "sinew/scene/types.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sinew {
namespace {

constexpr auto no_figure_of_scene = ~std::size_t(0);

/// Last key at or before `time` with tells(key), and the first such key after `time`; null if missing.
template <class Tells>
std::array<const DriveKey*, 2> around(const std::vector<DriveKey>& keys, double time, Tells&& tells) {
    std::array<const DriveKey*, 2> found{};
    for (const auto& key : keys) {
        if (!tells(key)) continue;
        found[key.at <= time ? 0 : 1] = &key;
        if (key.at > time) break;
    }
    return found;
}

bool has_target(const DriveKey& key) {
    return key.to.has_value();
}

/// Value of the limit at a time, on straight lines through the keys from `rest` at time 0 on.
double target_at(const DriveSection& drive, double time, double rest) {
    const auto [last, next] = around(drive.keys, time, has_target);
    const double from = last ? *last->to : rest, since = last ? last->at : 0;
    if (!next) return from;
    return from + (*next->to - from) * (time - since) / (next->at - since);
}

/// Speed of the steepest piece between keys.
double steepest(const DriveSection& drive, double rest) {
    double fastest = 0, at = 0, value = rest;
    for (const auto& key : drive.keys) {
        if (!key.to) continue;
        if (key.at > at) fastest = max(fastest, absolute(*key.to - value) / (key.at - at));
        at = key.at, value = *key.to;
    }
    return fastest;
}

/// Speed of the limit over the next `dt`, from the value `now`, in the scene's units. A motor that lags behind its
/// keys, because its force was too small, makes up for it at the drive's speed.
double speed_at(const DriveSection& drive, double time, double dt, double now, double rest) {
    if (!drive.has_targets()) return drive.speed.value_or(0);
    const double fastest = drive.speed ? absolute(*drive.speed) : steepest(drive, rest);
    return clamp((target_at(drive, time + dt, rest) - now) / dt, -fastest, fastest);
}

/// Takes whole turns off the limits of an angle that turns for ever: rounding would grow with the angle.
template <class WorldT> void forget_turns(WorldT& world, const ConstraintId& id) {
    visit_table(world, id.kind, [&](auto& table) {
        using Kind = typename std::decay_t<decltype(table)>::Kind;
        if constexpr (Kind::period > 0) {
            using Real = typename WorldT::Real;
            const auto row = table.handles.find(id.id);
            constexpr auto turn = Real(Kind::period);
            if (!row) return;
            const Real low = absolute(table.low(*row)), high = absolute(table.high(*row));
            constexpr Real many = Real(64) * turn, far = Real(1e5) * turn;
            if (min(low, high) < many || max(low, high) > far) return;
            const Real whole = turn * std::floor(table.high(*row) / turn);
            table.limits.change(*row, [&](Real end) { return end - whole; });
        }
    });
}

std::optional<double> strength_at(const DriveSection& drive, double time) {
    const auto [last, next] = around(drive.keys, time, [](const DriveKey& k) { return k.strength.has_value(); });
    if (!last) return std::nullopt;
    if (!next) return *last->strength;
    return *last->strength + (*next->strength - *last->strength) * (time - last->at) / (next->at - last->at);
}

} // namespace

const ConstraintSection& Motors::section_of(const Scene& scene, const Driven& driven) {
    if (driven.figure == no_figure_of_scene) return scene.constraints[driven.section];
    return std::get<ByHand>(scene.figures[driven.figure].made).constraints[driven.section];
}

/// Number of constraints made from a section: 1, or one per particle matched by a star, less the particles named
/// singly.
template <class WorldT>
std::size_t made_by(const WorldT& world, const ConstraintSection& section, const std::string& prefix) {
    std::vector<ParticleId> single, each;
    bool many = false;
    for (const auto& name : section.between) {
        auto found = find_particles(world, full_name(name, prefix));
        if (found.empty()) return 0;
        if (name.ends_with('*'))
            many = true, each = std::move(found);
        else
            single.push_back(found.front());
    }
    if (!many) return 1;
    return std::size_t(std::count_if(each.begin(), each.end(),
                                     [&](ParticleId id) { return std::ranges::find(single, id) == single.end(); }));
}

/// High limit of a constraint of a freshly built world.
template <class WorldT> double high_of(const WorldT& world, const ConstraintId& id) {
    double high = 0;
    visit_table(world, id.kind, [&](const auto& table) {
        if (const auto row = table.handles.find(id.id)) high = double(table.high(*row));
    });
    return high;
}

void Motors::find(const Scene& scene, const AnyWorld& any) {
    driven_.clear();
    std::visit(
        [&]<class WorldT>(const WorldT& world) {
            for (std::size_t f = 0; f < scene.figures.size(); ++f) {
                const auto* by_hand = std::get_if<ByHand>(&scene.figures[f].made);
                const auto prefix = std::string(name_of(scene.figures[f])) + "/";
                std::size_t next = 0;
                for (std::size_t i = 0; by_hand && i < by_hand->constraints.size(); ++i)
                    for (auto left = made_by(world, by_hand->constraints[i], prefix); left-- > 0; ++next)
                        if (by_hand->constraints[i].drive) {
                            SINEW_ASSERT(next < world.figures[f].constraints.size(),
                                         "sections make constraints in order");
                            driven_.push_back({world.figures[f].constraints[next], f, i,
                                               high_of(world, world.figures[f].constraints[next])});
                        }
            }
            // The scene's own constraints are the last of each kind, in the scene's order.
            std::array<Row, std::size_t(Kinds<WorldT::dimension>::size)> after{};
            for (std::size_t i = scene.constraints.size(); i-- > 0;) {
                int kind = 0;
                for_each_table(world, [&](const auto& table) {
                    using Kind = typename std::decay_t<decltype(table)>::Kind;
                    if (scene.constraints[i].kind == Kind::name)
                        for (auto left = made_by(world, scene.constraints[i], ""); left-- > 0;) {
                            const Row row = Row(table.size()) - ++after[std::size_t(kind)];
                            SINEW_ASSERT(row < table.size(), "the scene's constraints are the last of their kind");
                            if (scene.constraints[i].drive)
                                driven_.push_back(
                                    {{kind, table.handles.id_of(row)}, no_figure_of_scene, i, double(table.high(row))});
                        }
                    ++kind;
                });
            }
        },
        any);
}

bool Motors::is_of(const Scene& scene) const {
    return std::ranges::all_of(driven_, [&](const Driven& driven) {
        const bool is_own = driven.figure == no_figure_of_scene;
        if (!is_own && driven.figure >= scene.figures.size()) return false;
        const auto* by_hand = is_own ? nullptr : std::get_if<ByHand>(&scene.figures[driven.figure].made);
        if (!is_own && !by_hand) return false;
        const auto& sections = is_own ? scene.constraints : by_hand->constraints;
        return driven.section < sections.size() && sections[driven.section].drive.has_value();
    });
}

void Motors::run(const Scene& scene, AnyWorld& any) const {
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            using Real = typename WorldT::Real;
            const double dt = step_length(scene);
            for (const auto& driven : driven_) {
                const auto& section = section_of(scene, driven);
                SINEW_ASSERT(section.drive.has_value(), "constraints with a drive are driven");
                const double in_program = kind_called(section.kind)->angle ? pi<double> / 180 : 1;
                visit_table(world, driven.constraint.kind, [&](const auto& table) {
                    const auto row = table.handles.find(driven.constraint.id);
                    if (!row) return;
                    const double speed = speed_at(*section.drive, world.time, dt, double(table.high(*row)) / in_program,
                                                  driven.rest / in_program);
                    drive(world, driven.constraint, Real(speed * in_program));
                });
                if (!section.drive->has_targets()) forget_turns(world, driven.constraint);
                if (const auto strength = strength_at(*section.drive, world.time); strength && section.max_force > 0)
                    set_max_force(world, driven.constraint, Real(section.max_force * *strength));
            }
        },
        any);
}

} // namespace sinew
