#include "apps/cli/prefab_names.h"

#include "apps/cli/console.h"
#include "apps/cli/prefab_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

struct Varied {
    Variation variation;
    Survey survey;
};

std::vector<Varied> surveys_of(const AnyPrefab& prefab) {
    std::vector<Varied> all;
    for (auto& variation : variations_of(prefab))
        if (auto found = survey(variation.prefab)) all.push_back({std::move(variation), std::move(*found)});
    return all;
}

// --- names ------------------------------------------------------------------------------------------------------

const NameRun* same_run(const std::vector<NameRun>& runs, const NameRun& run) {
    const auto found = std::ranges::find_if(runs, [&](const NameRun& other) {
        return other.stem == run.stem && other.indices.size() == run.indices.size();
    });
    return found == runs.end() ? nullptr : &*found;
}

/// slope * parameter + offset, in the syntax of a scene file.
std::string linear(long slope, std::string_view parameter, long offset) {
    const auto product = slope == 1 ? std::string(parameter) : fmt::format("{} {}", slope, parameter);
    return offset == 0 ? fmt::format("{{{}}}", product) : fmt::format("{{{}{:+}}}", product, offset);
}

/// Last number at one position of a run: an expression of the integer parameter the number grows with, or the plain
/// number if several parameters change the number.
template <class RunsOf>
std::string last_number(const NameRun& run, std::size_t position, const std::vector<Varied>& varied, RunsOf&& runs_of) {
    const long last = run.indices[position].last;
    std::string text = std::to_string(last);
    int parameters = 0;
    for (const auto& [variation, survey] : varied) {
        const auto* raised = variation.counts ? same_run(runs_of(survey), run) : nullptr;
        const long slope = raised ? raised->indices[position].last - last : 0;
        if (slope == 0) continue;
        ++parameters;
        text = linear(slope, variation.parameter, last - slope * variation.before);
    }
    return parameters > 1 ? std::to_string(last) : text;
}

template <class RunsOf> std::string run_text(const NameRun& run, const std::vector<Varied>& varied, RunsOf&& runs_of) {
    std::string first = run.stem, last = run.stem;
    bool single = true;
    for (std::size_t i = 0; i < run.indices.size(); ++i) {
        first += fmt::format("_{}", run.indices[i].first);
        last += "_" + last_number(run, i, varied, runs_of);
        single = single && run.indices[i].first == run.indices[i].last;
    }
    return single && first.ends_with(last) ? first : first + " .. " + last;
}

/// Names with the default parameters, then names added by another value of one parameter.
template <class RunsOf>
std::string names_text(const Survey& usual, const std::vector<Varied>& varied, RunsOf&& runs_of) {
    std::string text;
    for (const auto& run : runs_of(usual)) text += (text.empty() ? "" : ", ") + run_text(run, varied, runs_of);
    std::vector<NameRun> told = runs_of(usual);
    for (const auto& [variation, survey] : varied)
        for (const auto& run : runs_of(survey)) {
            if (same_run(told, run)) continue;
            told.push_back(run);
            text += fmt::format("{}{} ({}={})", text.empty() ? "" : ", ", run_text(run, {}, runs_of),
                                variation.parameter, variation.value);
        }
    return text.empty() ? "none" : text;
}

// --- parts ------------------------------------------------------------------------------------------------------

/// Description of a mark, and the look properties the mark accepts.
struct MarkText {
    std::string_view name, looks;
};

MarkText mark_text(const Piece& piece) {
    switch (piece.mark) {
    case Mark::stroke:
        return {"a line", "color, width"};
    case Mark::curve:
        return {"a smooth line", "color, width"};
    case Mark::limb:
        return {"a limb", "color, width, profile"};
    case Mark::tip:
        return {"a disc at the end of a limb", "color, width"};
    case Mark::loop:
        return {"a closed line", "color, width"};
    case Mark::ring:
        return {"a ring", "color, width"};
    case Mark::dot:
        return {"a disc", "color, width"};
    case Mark::fill:
        return {"an area", "fill"};
    case Mark::surface:
        return {"a shaded surface", "fill"};
    case Mark::face:
        return {"eyes and a mouth", "color"};
    case Mark::fragment:
        return {"a part of a surface", "fill"};
    }
    return {};
}

std::vector<std::string> part_row(const std::string& part, const Piece& piece, const std::string& condition) {
    const auto [name, looks] = mark_text(piece);
    return {part, fmt::format("{}{}{}: {}{}{}", name, piece.hidden ? ", hidden" : "", condition, looks,
                              takes_image(piece) ? ", image" : "", piece.hidden ? ", hidden" : "")};
}

Rows parts_of(const Survey& usual, const std::vector<Varied>& varied) {
    Rows rows;
    std::vector<std::string> told = usual.parts;
    for (const auto& part : usual.parts) rows.push_back(part_row(part, usual.drawn.at(part), ""));
    for (const auto& [variation, survey] : varied)
        for (const auto& part : survey.parts) {
            if (std::ranges::find(told, part) != told.end()) continue;
            told.push_back(part);
            rows.push_back(
                part_row(part, survey.drawn.at(part), fmt::format(" ({}={})", variation.parameter, variation.value)));
        }
    return rows;
}

// --- place ------------------------------------------------------------------------------------------------------

std::string point_text(const std::vector<double>& point) {
    std::string text;
    for (const double x : point) text += fmt::format("{}{:.3g}", text.empty() ? "" : ", ", std::abs(x) < 1e-9 ? 0 : x);
    return "[" + text + "]";
}

/// Position of the origin relative to the figure's bounding box, in words.
std::string place_in_box(const Survey& survey) {
    const auto side = [&](std::size_t axis, std::array<std::string_view, 3> words) -> std::string_view {
        const double low = survey.low[axis], high = survey.high[axis], close = 1e-3 * (high - low);
        if (std::abs(low) <= close) return words[0];
        if (std::abs(high) <= close) return words[2];
        return std::abs(low + high) <= 2 * close ? words[1] : "";
    };
    const auto across = side(0, {"left", "middle", "right"}), up = side(1, {"bottom", "middle", "top"});
    if (across.empty() || up.empty()) return "a point inside";
    if (across == "middle" && up == "middle") return "its middle";
    if (up == "middle") return fmt::format("the middle of its {} side", across);
    if (across == "middle") return fmt::format("the middle of its {}", up);
    return fmt::format("its {} {} corner", up, across);
}

std::string at_text(const Survey& survey) {
    const auto position = survey.at.empty() ? place_in_box(survey) : fmt::format("the particle {}", survey.at);
    return fmt::format("{}; with the defaults {} from {} to {} m about it", position,
                       survey.has_radii ? "the centres of its particles reach" : "it reaches", point_text(survey.low),
                       point_text(survey.high));
}

} // namespace

std::string prefab_names(std::string_view name) {
    const auto prefab = make_prefab(name);
    const auto usual = prefab ? survey(*prefab) : std::nullopt;
    if (!usual) return {};
    const auto varied = surveys_of(*prefab);
    const auto particles = [](const Survey& survey) -> const std::vector<NameRun>& { return survey.particles; };
    const auto constraints = [](const Survey& survey) -> const std::vector<NameRun>& { return survey.constraints; };
    const Rows names{{"at", at_text(*usual)},
                     {"particles", names_text(*usual, varied, particles)},
                     {"constraints", names_text(*usual, varied, constraints)}};
    return fmt::format("\n{}\n{}\n{}\n{}", bold("names in scene files"), table(names),
                       bold("parts for \"looks\" (or \"all\")"), table(parts_of(*usual, varied)));
}

} // namespace sinew::cli
