#include "bindings/c/player.h"

#include "sinew/prefab/prefabs.h"
#include "sinew/scene/text.h"
#include "sinew/session/pick.h"

#include "bindings/c/native/sized.h"
#include "canvas/beside.h"
#include "player/joints.h"
#include "player/scene_edit.h"
#include "player/tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::c {
namespace {

constexpr std::size_t max_events = 1000;
constexpr std::array of_host = {
    std::string_view("new"),          std::string_view("open"),           std::string_view("save"),
    std::string_view("save_as"),      std::string_view("copy"),           std::string_view("paste"),
    std::string_view("screenshot"),   std::string_view("film"),           std::string_view("panel"),
    std::string_view("settings"),     std::string_view("help"),           std::string_view("close"),
    std::string_view("free_running"), std::string_view("previous_scene"), std::string_view("next_scene")};

/// A library with one scene. A split view and a change of mode open it again in the other mode.
play::SceneLibrary shelf_of(const std::shared_ptr<const SceneFile>& file) {
    const auto fetched = [](const SceneFile& from, std::span<const Override> overrides, const std::string& path) {
        auto opened = from.open(overrides);
        return play::Fetched{std::move(opened), sinew_message(), path};
    };
    play::SceneLibrary library;
    library.fetch = [=](const std::string&, std::span<const Override> overrides) {
        return fetched(*file, overrides, file->name);
    };
    library.read = [=](const std::string& text, const std::string& name, const std::filesystem::path&) {
        auto other = *file;
        other.text = text, other.name = name;
        return fetched(other, {}, "");
    };
    return library;
}

std::unique_ptr<play::Play> play_of(const std::shared_ptr<const SceneFile>& file) {
    return std::make_unique<play::Play>(shelf_of(file), file->name, file->overrides);
}

/// Settings of the user, which another scene does not change.
void keep_settings(const play::Play& from, play::Play& to) {
    to.overlay = from.overlay;
    to.tool = from.tool;
    to.prefab = from.prefab;
    to.prefab_parameters = from.prefab_parameters;
    to.joint = from.joint;
    to.theme = from.theme;
}

} // namespace

bool is_of_scene(std::string_view action) {
    return std::find(of_host.begin(), of_host.end(), action) == of_host.end();
}

Handles<Player>& players() {
    static Handles<Player> open;
    return open;
}

Player::Player(SceneFile first) {
    open(std::move(first));
}

Player::~Player() {
    for (const auto simulation : simulations) c::simulations().remove(simulation);
}

bool Player::open(SceneFile next) {
    auto shared = std::make_shared<const SceneFile>(std::move(next));
    auto fresh = play_of(shared);
    if (!fresh->ready()) return false;
    if (play) keep_settings(*play, *fresh);
    file = std::move(shared);
    touch = std::make_unique<play::Touch>(*fresh);
    std::swap(play, fresh);
    play->listener = [this](const play::Told& told) {
        json::Object object{{"what", told.what}};
        object.insert(object.end(), told.more.begin(), told.more.end());
        events.push_back(json::to_text(object));
        if (events.size() > max_events) events.pop_front();
    };
    for (const auto simulation : simulations)
        if (auto* known = c::simulations().find(simulation)) known->player = play.get();
    const auto& size = play->session().scene().view.size;
    play->resize(size[0], size[1]);
    return true;
}

std::uint32_t Player::simulation_of(std::size_t pane) {
    while (simulations.size() <= pane) {
        auto simulation = std::make_unique<Simulation>();
        simulation->player = play.get();
        simulation->pane = simulations.size();
        const auto handle = c::simulations().add(std::move(simulation));
        if (handle == 0) return 0;
        simulations.push_back(handle);
    }
    return simulations[pane];
}

namespace {

/// Calls work(player) and returns its status, or SINEW_OK if it returns nothing; fails for an unknown handle.
template <class Work> sinew_status with(sinew_player handle, const Work& work) {
    auto* player = players().find(handle.id);
    if (!player) return bad_handle();
    if (player->is_busy) return callback_is_running();
    if constexpr (std::is_void_v<decltype(work(*player))>) {
        work(*player);
        return SINEW_OK;
    } else {
        return work(*player);
    }
}

/// The same for input and time. No dialog of the host tells of a problem, behind which a player stands still: the
/// message does.
template <class Work> sinew_status go_on_with(sinew_player handle, const Work& work) {
    return with(handle, [&](Player& known) {
        known.is_busy = true;
        work(known);
        known.is_busy = false;
        if (known.play->problem().empty()) return;
        known.play->message = known.play->problem();
        known.play->dismiss_problem();
    });
}

sinew_status reported(play::Play& play) {
    auto problem = play.problem();
    play.dismiss_problem();
    return problem.empty() ? SINEW_OK : fail(SINEW_BAD_SCENE, std::move(problem));
}

bool is_tool(std::string_view name) {
    const auto all = play::all_tools();
    return std::any_of(all.begin(), all.end(), [&](const auto& tool) { return tool->name() == name; });
}

std::string name_of_picked(const play::Play& play, const std::optional<Picked>& picked) {
    return picked ? sinew::name_of(play.session().world(), picked->members.front()) : std::string();
}

void fill(Player& player, sinew_player_state& state) {
    auto& play = *player.play;
    const auto& timeline = play.timeline();
    player.texts = {play.tool,
                    play.shown_theme(),
                    name_of_picked(play, play.hovered),
                    name_of_picked(play, play.selected),
                    play.message,
                    timeline.undo_name(),
                    timeline.redo_name()};
    const auto text = [&](std::size_t i) { return player.texts[i].c_str(); };
    const sinew_player_state now{0,
                                 double(timeline.now()),
                                 double(timeline.first()),
                                 double(timeline.end()),
                                 play.clock().scale(),
                                 play.clock().paused() ? 1 : play.clock().share(),
                                 play.clock().paused(),
                                 std::uint32_t(play.pane_count()),
                                 play.is_edited(),
                                 play.session().holds(),
                                 std::uint32_t(play.overlay.to_ulong()),
                                 text(0),
                                 text(1),
                                 text(2),
                                 text(3),
                                 text(4),
                                 text(5),
                                 text(6)};
    fill_sized(now, &state);
}

} // namespace
} // namespace sinew::c

using namespace sinew;
using namespace sinew::c;

extern "C" {

// --- opening ---------------------------------------------------------------------------------------------------------

sinew_status sinew_player_create(const char* scene, const sinew_open_options* options, sinew_player* player) {
    if (!player) return null_argument();
    SceneFile file;
    if (const auto status = SceneFile::read(scene, options, file)) return status;
    auto fresh = std::make_unique<Player>(std::move(file));
    if (!fresh->play) return SINEW_BAD_SCENE;
    const auto id = players().add(std::move(fresh));
    if (id == 0) return fail(SINEW_FULL, "too many open players");
    player->id = id;
    return SINEW_OK;
}

sinew_status sinew_player_open(sinew_player player, const char* scene, const sinew_open_options* options) {
    SceneFile file;
    if (const auto status = SceneFile::read(scene, options, file)) return status;
    return with(player, [&](Player& known) { return known.open(std::move(file)) ? SINEW_OK : SINEW_BAD_SCENE; });
}

/// In a split view each pane keeps its mode.
sinew_status sinew_player_become(sinew_player player, const char* scene, const sinew_open_options* options) {
    SceneFile file;
    if (const auto status = SceneFile::read(scene, options, file)) return status;
    return with(player, [&](Player& known) {
        auto opened = file.open();
        if (!opened) return SINEW_BAD_SCENE;
        const bool split = known.play->is_split();
        known.play->change(
            [&](Scene& running) {
                const auto mode = running.solver.mode;
                running = opened->scene;
                if (split) running.solver.mode = mode;
            },
            "edit");
        return SINEW_OK;
    });
}

sinew_status sinew_player_close(sinew_player player) {
    return with(player, [&](const Player&) { players().remove(player.id); });
}

sinew_status sinew_player_world(sinew_player player, uint32_t pane, sinew_world* simulation) {
    if (!simulation) return null_argument();
    return with(player, [&](Player& known) {
        if (pane >= known.play->pane_count()) return fail(SINEW_NOT_FOUND, "there are fewer panes");
        const auto id = known.simulation_of(pane);
        if (id == 0) return fail(SINEW_FULL, "too many open simulations");
        simulation->id = id;
        return SINEW_OK;
    });
}

// --- time and picture
// --------------------------------------------------------------------------------------------------

sinew_status sinew_player_resize(sinew_player player, uint32_t width, uint32_t height, double density) {
    constexpr std::uint32_t longest = 16384; // pixels
    if (width == 0 || height == 0 || width > longest || height > longest)
        return fail(SINEW_BAD_ARGUMENT, "the sides of a picture are 1 to 16384 pixels");
    return with(player, [&](Player& known) { known.play->resize(int(width), int(height), density); });
}

sinew_status sinew_player_advance(sinew_player player, double seconds) {
    if (!(seconds >= 0) || !std::isfinite(seconds)) return fail(SINEW_BAD_ARGUMENT, "time goes on");
    return go_on_with(player, [&](Player& known) { known.play->advance(seconds); });
}

sinew_status sinew_player_draw(sinew_player player, sinew_picture* picture) {
    if (const auto status = can_fill(picture)) return status;
    return with(player, [&](Player& known) {
        known.play->draw_panes(known.panes);
        if (known.panes.size() == 1)
            std::swap(known.panes[0], known.drawn.picture);
        else
            canvas::join(known.panes, known.drawn.picture);
        known.drawn.hand_out(*picture);
    });
}

sinew_status sinew_player_picture_text(sinew_player player, uint32_t index, const char** text) {
    if (!text) return null_argument();
    return with(player, [&](const Player& known) {
        if (index >= known.drawn.picture.texts.size()) return fail(SINEW_NOT_FOUND, "there are fewer texts");
        *text = known.drawn.picture.texts[index].c_str();
        return SINEW_OK;
    });
}

/// A split view shows the images of its first pane, then those of the next: a mode may have others.
sinew_status sinew_player_picture_image(sinew_player player, uint32_t index, const char** name) {
    if (!name) return null_argument();
    return with(player, [&](Player& known) {
        std::size_t left = index;
        const char* found = nullptr;
        known.play->each_pane([&] {
            const auto& images = known.play->session().images();
            if (!found && left < images.size()) found = images[left].first.c_str();
            left -= std::min(left, images.size());
        });
        if (!found) return fail(SINEW_NOT_FOUND, "there are fewer images");
        *name = found;
        return SINEW_OK;
    });
}

// --- input
// -------------------------------------------------------------------------------------------------------------

sinew_status sinew_player_pointer(sinew_player player, double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return fail(SINEW_BAD_ARGUMENT, "a position is not finite");
    return go_on_with(player, [&](Player& known) { known.play->handle(play::Moved{{{x, y}}}); });
}

sinew_status sinew_player_leave(sinew_player player) {
    return go_on_with(player, [](Player& known) { known.play->handle(play::Left{}); });
}

sinew_status sinew_player_press(sinew_player player, sinew_button button) {
    if (int(button) < 0 || int(button) > 2) return fail(SINEW_BAD_ARGUMENT, "no such button");
    return go_on_with(player, [&](Player& known) { known.play->handle(play::Pressed{play::Button(button)}); });
}

sinew_status sinew_player_release(sinew_player player, sinew_button button) {
    if (int(button) < 0 || int(button) > 2) return fail(SINEW_BAD_ARGUMENT, "no such button");
    return go_on_with(player, [&](Player& known) { known.play->handle(play::Released{play::Button(button)}); });
}

sinew_status sinew_player_scroll(sinew_player player, double notches) {
    if (!std::isfinite(notches)) return fail(SINEW_BAD_ARGUMENT, "a number is not finite");
    return go_on_with(player, [&](Player& known) { known.play->handle(play::Scrolled{notches}); });
}

sinew_status sinew_player_pinch(sinew_player player, double dx, double dy, double factor) {
    if (!std::isfinite(dx) || !std::isfinite(dy) || !(factor > 0))
        return fail(SINEW_BAD_ARGUMENT, "a gesture has finite numbers and a factor above 0");
    return go_on_with(player, [&](Player& known) { known.play->handle(play::Pinched{{{dx, dy}}, factor}); });
}

sinew_status sinew_player_pan(sinew_player player, double dx, double dy) {
    return sinew_player_pinch(player, dx, dy, 1);
}

sinew_status sinew_player_orbit(sinew_player player, double dx, double dy) {
    if (!std::isfinite(dx) || !std::isfinite(dy)) return fail(SINEW_BAD_ARGUMENT, "a number is not finite");
    return with(player, [&](Player& known) {
        auto& play = *known.play;
        play.each_pane([&] { play.camera().orbit(play.session(), play::within_reach({{dx, dy}})); });
    });
}

sinew_status sinew_player_zoom(sinew_player player, double factor) {
    if (!(factor > 0) || !std::isfinite(factor)) return fail(SINEW_BAD_ARGUMENT, "a factor is above 0");
    return with(player, [&](Player& known) { known.play->zoom(factor); });
}

sinew_status sinew_player_touch(sinew_player player, int64_t finger, uint32_t phase, double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y) || phase > 2)
        return fail(SINEW_BAD_ARGUMENT, "a finger comes down (0), moves (1) or is lifted (2) at a position");
    return go_on_with(player, [&](Player& known) {
        const Vec2<double> at{{x, y}};
        if (phase == 0) known.touch->down(finger, at);
        if (phase == 1) known.touch->move(finger, at);
        if (phase == 2) known.touch->up(finger);
    });
}

sinew_status sinew_player_key(sinew_player player, const char* name, uint32_t is_down) {
    if (!name) return null_argument();
    return go_on_with(player, [&](Player& known) {
        auto& play = *known.play;
        if (!is_down) return play.handle(play::KeyUp{name});
        if (play.steer(name, true)) return;
        const auto action = play.keys.action_of(name);
        if (is_of_scene(action)) return play.handle(play::Key{name});
        if (action == "close") play.choose({}, false); // dialogs and the way out are the host's
    });
}

// --- actions
// -----------------------------------------------------------------------------------------------------------

sinew_status sinew_player_do(sinew_player player, const char* action) {
    if (!action) return null_argument();
    return with(player, [&](Player& known) {
        for (const auto& one : play::key_actions())
            if (one.name == action && is_of_scene(action)) {
                one.act(*known.play);
                return reported(*known.play);
            }
        return fail(SINEW_BAD_ARGUMENT, concat("no action is called ", in_quotes(action)));
    });
}

sinew_status sinew_player_pause(sinew_player player, uint32_t on) {
    return with(player, [&](Player& known) { known.play->pause(on != 0); });
}

sinew_status sinew_player_time_scale(sinew_player player, double scale) {
    if (!(scale > 0)) return fail(SINEW_BAD_ARGUMENT, "a time scale is above 0");
    return with(player, [&](Player& known) { known.play->clock().set_scale(scale); });
}

sinew_status sinew_player_go_to(sinew_player player, double step) {
    if (!(step >= 0 && step < 1e15)) return fail(SINEW_BAD_ARGUMENT, "steps are counted from 0");
    return with(player, [&](Player& known) { known.play->go_to(std::uint64_t(step)); });
}

sinew_status sinew_player_set(sinew_player player, const char* path, const char* value, uint32_t goes_on) {
    if (!path || !value) return null_argument();
    return with(player, [&](Player& known) {
        known.play->set(path, value, goes_on != 0);
        return reported(*known.play);
    });
}

sinew_status sinew_player_tool(sinew_player player, const char* name) {
    if (!name) return null_argument();
    return with(player, [&](Player& known) {
        if (!is_tool(name)) return fail(SINEW_BAD_ARGUMENT, concat("no tool is called ", in_quotes(name)));
        known.play->tool = name;
        return SINEW_OK;
    });
}

sinew_status sinew_player_prefab(sinew_player player, const char* prefab, const char* parameters) {
    if (!prefab) return null_argument();
    return with(player, [&](Player& known) {
        auto document = load(parameters ? parameters : "{}", "parameters");
        auto* given = document.root.as<json::Object>();
        if (const auto status = keep_diagnostics(document.diagnostics)) return status;
        if (!make_prefab(prefab)) return fail(SINEW_BAD_ARGUMENT, concat("no prefab is called ", in_quotes(prefab)));
        known.play->prefab = prefab;
        known.play->prefab_parameters = given ? std::move(*given) : json::Object{};
        return SINEW_OK;
    });
}

sinew_status sinew_player_joint(sinew_player player, const char* joint) {
    if (!joint) return null_argument();
    return with(player, [&](Player& known) {
        if (std::ranges::find(play::joints, joint, &play::Joint::name) == play::joints.end())
            return fail(SINEW_BAD_ARGUMENT, concat("no joint is called ", in_quotes(joint)));
        known.play->joint = joint;
        return SINEW_OK;
    });
}

sinew_status sinew_player_overlays(sinew_player player, uint32_t overlay_bits) {
    return with(player, [&](Player& known) { known.play->overlay = OverlaySet(overlay_bits); });
}

sinew_status sinew_player_theme(sinew_player player, const char* theme) {
    if (!theme) return null_argument();
    const auto& known_themes = ViewSection::themes;
    if (*theme && std::find(known_themes.begin(), known_themes.end(), theme) == known_themes.end())
        return fail(SINEW_BAD_ARGUMENT, concat("no theme is called ", in_quotes(theme)));
    return with(player, [&](Player& known) { known.play->theme = theme; });
}

sinew_status sinew_player_get_state(sinew_player player, sinew_player_state* state) {
    if (const auto status = can_fill(state)) return status;
    return with(player, [&](Player& known) { fill(known, *state); });
}

sinew_status sinew_player_next_event(sinew_player player, const char** json) {
    if (!json) return null_argument();
    return with(player, [&](Player& known) {
        if (known.events.empty()) return SINEW_NOT_FOUND;
        known.event = std::move(known.events.front());
        known.events.pop_front();
        *json = known.event.c_str();
        return SINEW_OK;
    });
}

} // extern "C"
