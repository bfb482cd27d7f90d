#include "player/play.h"
#include "player/scene_edit.h"

#include <algorithm>
#include <utility>

/// Edits of the running session, applied to every pane.
namespace sinew::play {

void Play::undo() {
    let_go_of_everything();
    const auto what = timeline().undo_name();
    if (what.empty()) return;
    message = "undone: " + what;
    each_pane([&] {
        timeline().undo();
        tell_what_is_lost();
    });
    tell("undo", {{"edit", what}, {"hash", hash()}});
}

void Play::redo() {
    let_go_of_everything();
    const auto what = timeline().redo_name();
    if (what.empty()) return;
    message = "done again: " + what;
    each_pane([&] {
        timeline().redo();
        tell_what_is_lost();
    });
    tell("redo", {{"edit", what}, {"hash", hash()}});
}

/// `scenes`: one per pane.
void Play::become(const std::vector<Scene>& scenes, const std::string& name, bool goes_on) {
    let_go_of_everything();
    apply(scenes, name, goes_on);
}

/// The same while a tool is busy.
void Play::apply(const std::vector<Scene>& scenes, const std::string& name, bool goes_on) {
    each_pane([&] {
        timeline().edit(Become{std::make_shared<const Scene>(scenes[active_])}, name, goes_on);
        tell_what_is_lost();
    });
    clock_->set_rate(session().scene().solver.rate);
    tell("edit", {{"edit", name}});
}

/// Shows what an edit could not keep.
void Play::tell_what_is_lost() {
    if (!timeline().lost().empty()) message = "not kept: " + timeline().lost();
}

void Play::change(const std::function<void(Scene&)>& change, const std::string& name) {
    std::vector<Scene> scenes;
    each_pane([&] { change(scenes.emplace_back(session().scene())); });
    become(scenes, name, false);
}

/// In other panes the edit applies to the particle of the same name.
void Play::edit(Action action, std::string name) {
    const auto& world = session().world();
    const auto under_pointer = active_;
    each_pane([&] {
        auto own = action;
        if (auto* tweak = std::get_if<Tweak>(&own); tweak && active_ != under_pointer) {
            const auto id = id_at(world, tweak->particle);
            const auto same = namesakes(world, {&id, 1}, session().world());
            tweak->particle = same ? rows_of(session().world(), *same).front() : ~Row(0);
        }
        timeline().edit(std::move(own), name, timeline().undo_name() == name);
    });
    tell("edit", {{"edit", std::move(name)}});
}

bool Play::add_figure(json::Object figure, const std::string& name) {
    if (!add("figures", std::move(figure), name)) return false;
    tell("add", {{"figure", name}});
    return true;
}

bool Play::add(std::string_view list, json::Object element, const std::string& name) {
    auto changed = edited(session().scene(), [&](json::Object& root) { append(root, list, std::move(element)); });
    if (!changed.scene) return report_problem(std::move(changed.problem)), false;
    timeline().edit(Become{std::make_shared<const Scene>(std::move(*changed.scene))}, "add " + name);
    tell_what_is_lost();
    tell("edit", {{"edit", "add " + name}});
    return true;
}

bool Play::set(const std::string& path, const std::string& value, bool goes_on) {
    const std::array<Override, 1> overrides = {{{path + "=" + value, "the panel"}}};
    std::vector<Scene> scenes;
    std::string problem;
    each_pane([&] {
        auto changed = edited(session().scene(), overrides);
        if (changed.scene)
            scenes.push_back(std::move(*changed.scene));
        else
            problem = std::move(changed.problem);
    });
    if (!problem.empty()) return report_problem(std::move(problem)), false;
    become(scenes, path, goes_on);
    return true;
}

void Play::switch_mode() {
    show_mode(session().scene().solver.mode == "classic" ? "physical" : "classic");
}

/// In a split view, keeps the pane of the mode. An unedited file is opened again, because the file may contain
/// settings for each mode.
void Play::show_mode(const std::string& mode) {
    for (std::size_t i = 0; i < panes_.size() && is_split(); ++i)
        if (panes_[i].timeline.session().scene().solver.mode == mode) return switch_pane(i), toggle_split();
    if (session().scene().solver.mode == mode) return;
    if (would_lose() || path_.empty()) {
        set("solver.mode", mode);
        return;
    }
    auto overrides = overrides_;
    std::erase_if(overrides, [](const Override& one) { return one.pair.starts_with("mode="); });
    overrides.push_back({"mode=" + mode, "the panel"});
    open_now(name_, std::move(overrides));
}

void Play::toggle_gravity() {
    const bool on = !(session().scene().world.gravity == Point{});
    if (on) gravity_ = session().scene().world.gravity;
    const auto toggle = [&](Scene& scene) {
        if (!on && gravity_ == Point{})
            gravity_[1] = (scene.units.up == "-y" ? 9.81 : -9.81) * scene.measures().per_metre /
                          square(scene.measures().per_second);
        scene.world.gravity = on ? Point{} : gravity_;
    };
    const std::string name = on ? "no gravity" : "gravity";
    message = name;
    change(toggle, name);
}

void Play::toggle_wind() {
    const auto is_wind = [](const ForceSection& section) { return std::holds_alternative<WindForce>(section.force); };
    const auto& now = session().scene().world.forces;
    const bool on = std::any_of(now.begin(), now.end(), is_wind);
    const auto toggle = [&](Scene& scene) {
        std::erase_if(scene.world.forces, is_wind);
        if (on) return;
        const auto units = scene.measures();
        WindForce wind;
        wind.velocity[0] = 6 * units.per_metre / units.per_second;
        wind.gust[0] = 4 * units.per_metre / units.per_second;
        wind.gust_period = 1.5 * units.per_second;
        wind.strength = 0.15 / units.per_second;
        scene.world.forces.push_back({wind});
    };
    const std::string name = on ? "no wind" : "wind";
    message = name;
    change(toggle, name);
}

} // namespace sinew::play
