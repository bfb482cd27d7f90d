#include "apps/cli/stage.h"

#include "sinew/picture/draw.h"
#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"
#include "sinew/session/view.h"

#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "canvas/beside.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace sinew::cli {
namespace {

constexpr std::size_t max_variants = 4;

/// Splits at commas outside brackets, braces and quotes: "world.gravity=[0,1]" stays whole.
std::vector<std::string> split_at_commas(const std::string& list) {
    std::vector<std::string> parts(1);
    int depth = 0;
    bool quoted = false;
    for (const char c : list) {
        if (c == '"') quoted = !quoted;
        if (!quoted) depth += (c == '[' || c == '{') - (c == ']' || c == '}');
        if (c == ',' && depth == 0 && !quoted)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

bool is_mode(std::string_view word) {
    return std::ranges::find(SolverSection::modes, word) != SolverSection::modes.end();
}

/// True if two variants can share a view; a mode may replace the scene together with the view section.
bool has_same_view(const Scene& a, const Scene& b) {
    const auto key = [](const Scene& scene) {
        const auto& [eye, target, field_of_view, projection] = scene.view.camera;
        return std::tuple(scene.dimension, scene.units.length, scene.units.up, scene.view.center, scene.view.height,
                          eye, target, field_of_view, projection);
    };
    return key(a) == key(b);
}

std::vector<Override> overrides_of(const SceneWords& words, const std::string& variant) {
    auto all = words.overrides;
    all.push_back({is_mode(variant) ? concat("mode=", variant) : variant, "--beside"});
    return all;
}

} // namespace

std::vector<std::string> variants_in(const std::string& list) {
    auto variants = split_at_commas(list);
    for (const auto& variant : variants) {
        if (is_mode(variant)) continue;
        const auto modes = std::vector<std::string_view>(SolverSection::modes.begin(), SolverSection::modes.end());
        if (variant.find('=') == std::string::npos || variant.starts_with('='))
            usage_error(fmt::format("--beside: {} is neither a mode nor key=value", in_quotes(variant)),
                        suggest(variant, modes));
    }
    if (variants.size() < 2 || variants.size() > max_variants)
        usage_error(fmt::format("--beside takes 2 to {} variants, found {}", max_variants, variants.size()),
                    "such as --beside classic,physical");
    return variants;
}

Stage::Stage(const SceneWords& words, std::span<const std::string> variants, WatchedFiles* read) {
    if (variants.empty()) runs_.emplace_back(open_file(words.scene, words.overrides, read));
    for (const auto& variant : variants) {
        runs_.emplace_back(open_file(words.scene, overrides_of(words, variant), read));
        labels_.push_back(variant);
    }
    pictures_.resize(labels_.size());
}

std::array<int, 2> Stage::size(std::array<int, 2> one) const {
    if (pictures_.empty()) return one;
    const auto whole = canvas::size_beside(pictures_.size(), one[0], one[1]);
    return {whole.width, whole.height};
}

std::uint64_t Stage::steps(double seconds) const {
    std::uint64_t sum = 0;
    for (const auto& run : runs_) sum += steps_before(run.session.scene(), seconds);
    return sum;
}

void Stage::advance(double seconds, canvas::Progress& progress) {
    std::uint64_t others = 0;
    for (const auto& run : runs_) others += run.steps();
    for (auto& run : runs_) {
        others -= run.steps();
        run.advance(steps_before(run.session.scene(), seconds), progress, others);
        others += run.steps();
    }
}

void Stage::draw(Picture& picture, std::array<int, 2> one, OverlaySet overlay) {
    const auto& first = runs_.front().session;
    const View shared(first.scene(), first.focus(), one[0], one[1]);
    std::vector<canvas::Labelled> parts;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        auto& part = pictures_.empty() ? picture : pictures_[i];
        part.width = one[0], part.height = one[1];
        const auto& session = runs_[i].session;
        const bool shares = has_same_view(first.scene(), session.scene());
        sinew::draw(session, shares ? shared : session.view(one[0], one[1]), part, overlay);
        if (!pictures_.empty()) parts.push_back({&part, labels_[i]});
    }
    if (!parts.empty()) canvas::put_beside(parts, picture);
}

} // namespace sinew::cli
