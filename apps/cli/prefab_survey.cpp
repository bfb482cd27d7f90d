#include "apps/cli/prefab_survey.h"

#include "sinew/scene/text.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace sinew::cli {
namespace {

/// Removes "_12" from the end of a name.
std::optional<long> take_number(std::string_view& name) {
    const auto bar = name.rfind('_');
    if (bar == std::string_view::npos || bar == 0) return std::nullopt;
    long number = 0;
    const char* const last = name.data() + name.size();
    const auto [end, error] = std::from_chars(name.data() + bar + 1, last, number);
    if (error != std::errc{} || end != last || bar + 1 == name.size()) return std::nullopt;
    name.remove_suffix(name.size() - bar);
    return number;
}

void add_name(std::vector<NameRun>& runs, std::string_view name) {
    std::vector<NameRun::Index> indices;
    while (const auto number = take_number(name)) indices.insert(indices.begin(), {*number, *number});
    const auto same = std::ranges::find_if(runs, [&](const NameRun& run) {
        return run.stem == name && run.indices.size() == indices.size() && !indices.empty();
    });
    if (same == runs.end()) {
        runs.push_back({std::string(name), std::move(indices)});
        return;
    }
    for (std::size_t i = 0; i < indices.size(); ++i) {
        same->indices[i].first = std::min(same->indices[i].first, indices[i].first);
        same->indices[i].last = std::max(same->indices[i].last, indices[i].last);
    }
}

template <class Id> std::vector<NameRun> runs_of(const NameTable<Id>& given, const std::vector<Numbered>& numbered) {
    std::vector<NameRun> runs;
    for (const auto& [name, id] : given) add_name(runs, name);
    for (const auto& [stem, first, count, columns] : numbered) {
        if (count == 0) continue;
        if (columns == 0)
            runs.push_back({stem, {{0, long(count) - 1}}});
        else
            runs.push_back({stem, {{0, long(columns) - 1}, {0, long(count / columns) - 1}}});
    }
    return runs;
}

template <int D> std::string name_at_origin(const World<D, double>& world, const Figure& figure) {
    for (std::size_t i = 0; i < figure.particles.size(); ++i) {
        const auto position = position_of(world, figure.particles[i]);
        if (!position || norm(*position) > 1e-9) continue;
        for (const auto& [name, id] : figure.particle_names)
            if (id == figure.particles[i]) return name;
        if (auto name = name_of(i, figure.particle_numbers); !name.empty()) return name;
    }
    return {};
}

template <int D> std::optional<Survey> survey_in(const AnyPrefab& prefab) {
    World<D, double> world;
    const auto index = build(world, prefab, "figure");
    if (!index) return std::nullopt;
    Survey survey;
    const auto& figure = world.figures[*index];
    survey.particles = runs_of(figure.particle_names, figure.particle_numbers);
    survey.constraints = runs_of(figure.constraint_names, figure.constraint_numbers);
    for (const auto& piece : figure.pieces) {
        const auto [known, first] = survey.drawn.emplace(piece.part, piece);
        if (first) survey.parts.push_back(piece.part);
        if (known->second.hidden && !piece.hidden) known->second = piece;
    }
    survey.at = name_at_origin(world, figure);
    for (int i = 0; i < D; ++i) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const auto& position : world.particles.position) {
            low = std::min(low, position[i]);
            high = std::max(high, position[i]);
        }
        survey.low.push_back(low);
        survey.high.push_back(high);
    }
    for (const auto radius : world.particles.radius) survey.has_radii = survey.has_radii || radius > 0;
    return survey;
}

bool in_range(const Field& field, double value) {
    return field.low <= value && value <= field.high;
}

template <class Prefab> std::vector<Variation> variations(const Prefab& prefab) {
    std::vector<Variation> all;
    Prefab changed = prefab;
    const auto add = [&](const Field& field, std::string value) -> Variation& {
        return all.emplace_back(Variation{std::string(field.name), std::move(value), false, 0, changed});
    };
    Prefab::fields(changed, [&](auto& member, const Field& field) {
        using T = std::remove_cvref_t<decltype(member)>;
        const T before = member;
        if constexpr (std::is_same_v<T, bool>) {
            member = !before;
            add(field, member ? "true" : "false");
        } else if constexpr (std::is_integral_v<T>) {
            member = before + 1;
            if (!in_range(field, double(member))) return void(member = before);
            auto& raised = add(field, std::to_string(member));
            raised.counts = true;
            raised.before = long(before);
        } else if constexpr (std::is_same_v<T, double>) {
            member = 1;
            if (before == 0 && in_range(field, 1)) add(field, "1");
        } else if constexpr (std::is_same_v<T, std::string>) {
            for (const auto choice : field.choices) {
                member = choice;
                if (member != before) add(field, member);
            }
        }
        member = before;
    });
    return all;
}

} // namespace

std::optional<Survey> survey(const AnyPrefab& prefab) {
    if (!problem_of(prefab, 2)) return survey_in<2>(prefab);
    if (!problem_of(prefab, 3)) return survey_in<3>(prefab);
    return std::nullopt;
}

std::vector<Variation> variations_of(const AnyPrefab& prefab) {
    return std::visit([](const auto& made) { return variations(made); }, prefab);
}

} // namespace sinew::cli
