#include "sinew/math/trig.h"
#include "sinew/scene/check.h"

#include "player/names.h"
#include "player/obstacle_pick.h"
#include "player/play.h"

#include <algorithm>

/// Chosen figures and obstacles: moved, turned, made larger, copied and deleted together.
namespace sinew::play {

std::optional<Part> Play::part_here() const {
    const auto& scene = session().scene();
    if (const auto picked = pick_here())
        if (auto name = figure_name(*picked); !name.empty()) return Part{std::move(name), false};
    const auto number = obstacle_at(scene, view(), pointer_, pick_radius * density_ / 2);
    return number ? std::optional(Part{obstacle_name(scene, *number), true}) : std::nullopt;
}

std::string Play::figure_name(const Picked& picked) const {
    return std::visit(
        [&](const auto& world) {
            return picked.figure < world.figures.size() ? world.figures[picked.figure].name : std::string();
        },
        session().world());
}

bool Play::is_chosen(const Part& part) const {
    return std::ranges::find(chosen, part) != chosen.end();
}

/// `adds`: beside the parts chosen before; a part among them is left out.
void Play::choose(const std::optional<Part>& part, bool adds) {
    if (!adds) chosen.clear();
    if (!part) return;
    if (is_chosen(*part))
        std::erase(chosen, *part);
    else
        chosen.push_back(*part);
    tell("choose", {{"part", part->name}, {"chosen", chosen.size()}});
}

void Play::choose_all() {
    chosen.clear();
    const auto& scene = session().scene();
    for (const auto& figure : scene.figures) chosen.push_back({std::string(sinew::name_of(figure)), false});
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) chosen.push_back({obstacle_name(scene, i), true});
    tool = "select";
}

/// Parts that an undo or another scene has taken away are no longer chosen.
void Play::forget_missing_parts() {
    const auto& scene = session().scene();
    const auto is_gone = [&](const Part& part) {
        return part.is_obstacle ? !obstacle_called(scene, part.name)
                                : std::ranges::none_of(scene.figures, [&](const auto& figure) {
                                      return sinew::name_of(figure) == part.name;
                                  });
    };
    std::erase_if(chosen, is_gone);
    if (followed && is_gone(*followed)) followed.reset();
}

bool Play::reshape(const std::vector<Part>& parts, const Reshape& by, const std::string& name, bool goes_on) {
    std::vector<Scene> scenes;
    std::string problem;
    each_pane([&] {
        if (auto changed = reshaped(session().scene(), session().world(), parts, by, problem))
            scenes.push_back(std::move(*changed));
    });
    if (scenes.size() != panes_.size()) return report_problem(std::move(problem)), false;
    apply(scenes, name, goes_on);
    return true;
}

/// Copies lie beside their originals, and are chosen in their place.
void Play::duplicate_chosen() {
    if (chosen.empty()) return void(message = "choose what to copy first: " + keys.of("select") + ", then press it");
    constexpr double beside = 40; // nominal pixels
    std::vector<Scene> scenes;
    std::vector<Part> made;
    std::string problem;
    let_go_of_everything();
    each_pane([&] {
        made.clear();
        const auto& world = session().world();
        const auto middle = middle_of(session().scene(), world, chosen.front()).value_or(Point{});
        const auto shift = shift_of(middle, {{beside * density_, -beside * density_}});
        if (auto changed = duplicated(session().scene(), world, chosen, shift, made, problem))
            scenes.push_back(std::move(*changed));
    });
    if (scenes.size() != panes_.size()) return report_problem(std::move(problem));
    apply(scenes, "duplicate", false);
    chosen = made;
    tell("duplicate", {{"made", made.size()}});
}

void Play::remove(const std::vector<Part>& parts) {
    if (parts.empty()) return;
    std::vector<Scene> scenes;
    std::string problem;
    hovered.reset(), selected.reset();
    let_go_of_everything();
    each_pane([&] {
        if (auto changed = without(session().scene(), session().world(), parts, problem))
            scenes.push_back(std::move(*changed));
    });
    if (scenes.size() != panes_.size()) return report_problem(std::move(problem));
    const auto what = parts.size() == 1 ? parts.front().name : concat(parts.size(), " parts");
    apply(scenes, "delete " + what, false);
    for (const auto& part : parts) tell("remove", {{part.is_obstacle ? "obstacle" : "figure", part.name}});
    forget_missing_parts();
}

/// Displacement in the scene of something at `from` that moves by pixels.
Point Play::shift_of(const Point& from, Vec2<double> pixels) const {
    const auto now = view();
    const auto seen = now.see(from.as<3, double>());
    if (!seen) return {};
    const double depth = double(seen->depth);
    const auto a = now.position_of(cast<double>(seen->pixel), depth);
    const auto b = now.position_of(cast<double>(seen->pixel) + pixels, depth);
    Point shift;
    for (int i = 0; i < session().scene().dimension; ++i) shift[i] = b[i] - a[i];
    return shift;
}

void Play::toggle_follow() {
    if (followed) {
        followed.reset();
        message = "the camera stays";
    } else {
        followed = !chosen.empty() ? std::optional(chosen.front()) : part_here();
        message = followed ? "the camera follows " + followed->name
                           : "point at what the camera shall follow, or choose it first";
    }
    tell("follow", {{"part", followed ? followed->name : ""}});
}

/// Leads the middle of the followed part to the middle of the picture.
void Play::follow(double seconds) {
    if (!followed) return;
    constexpr double rate = 6; // per second
    const double share = 1 - exponential(-rate * seconds);
    each_pane([&] {
        const auto middle = middle_of(session().scene(), session().world(), *followed);
        const auto seen = middle ? view().see(middle->as<3, double>()) : std::nullopt;
        if (!seen) return;
        const Vec2<double> center{{pane_width(active_) * 0.5, height_ * 0.5}};
        camera().pan(session(), (center - cast<double>(seen->pixel)) * share);
    });
}

} // namespace sinew::play
