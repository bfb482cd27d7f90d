#include "player/play.h"

#include "sinew/math/trig.h"
#include "sinew/session/event_json.h"
#include "sinew/world/measure.h"

#include "player/files.h"
#include "player/tool.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace sinew::play {
namespace {

constexpr double log_of_a_notch = 0.13976194237515863; // a notch of the wheel magnifies 1.15 times
constexpr double max_notches = 20;                     // per event
constexpr double look_every = 0.25;                    // seconds between checks of the scene's file

bool follows_pointer(const PinSection& pin) {
    return pin.driver && std::holds_alternative<PointerDriver>(*pin.driver);
}

bool has_hover(const std::vector<std::pair<std::string, sinew::Look>>& looks) {
    return std::any_of(looks.begin(), looks.end(), [](const auto& look) { return !look.second.hover.empty(); });
}

/// True if moving the pointer without a button affects the scene.
bool feels_pointer(const Scene& scene) {
    return scene.solver.rules.hover_freezes || has_hover(scene.looks) ||
           std::any_of(scene.pins.begin(), scene.pins.end(), follows_pointer) ||
           std::any_of(scene.figures.begin(), scene.figures.end(),
                       [](const FigureSection& figure) { return has_hover(figure.looks); });
}

} // namespace

std::vector<std::unique_ptr<Tool>> all_tools() {
    std::vector<std::unique_ptr<Tool>> all;
#define SINEW_MAKE(name) all.push_back(tool::name());
    SINEW_TOOLS(SINEW_MAKE)
#undef SINEW_MAKE
    return all;
}

Play::Play(SceneLibrary library, std::string scene, std::vector<Override> overrides)
    : library_(std::move(library)), tools_(all_tools()) {
    open_now(scene, std::move(overrides));
}

Play::~Play() = default;

// --- scenes ----------------------------------------------------------------------------------------------------------

void Play::begin(Fetched fetched) {
    path_ = beside_ = std::move(fetched.path);
    written_ = time_written(path_);
    std::vector<Pane> panes;
    panes.push_back({Timeline(session_from(std::move(fetched))), {}});
    begin(std::move(panes));
    look_at_level();
}

/// Goes on with the code and the scene of a level that was compiled again.
void Play::go_on_with(Fetched fetched) {
    each_pane([&] {
        timeline().change_level(fetched.level, fetched.opened->scene);
        saved_edits_ = timeline().edits();
    });
    clock_->set_rate(session().scene().solver.rate);
    problem_.clear();
    saved_as_ = saved_text();
    look_at_level();
}

/// Reports a failure of the level's code.
void Play::look_at_level() {
    if (!ready() || !session().level() || session().level()->problem.empty()) return;
    report_problem(std::exchange(session().level()->problem, {}));
}

void Play::begin(std::vector<Pane> panes) {
    problem_.clear();
    message.clear();
    hovered.reset(), selected.reset();
    chosen.clear(), followed.reset();
    saved_edits_ = draft_.edits = 0;
    const double scale = clock_ ? clock_->scale() : 1;
    const bool paused = clock_ && clock_->paused();
    panes_ = std::move(panes);
    active_ = own_pane_ = 0;
    saved_as_ = saved_text();
    clock_.emplace(session().scene().solver.rate);
    clock_->set_scale(scale);
    clock_->pause(paused);
    resize_eyes();
    begin_recording();
}

void Play::report_problem(std::string text) {
    problem_ = std::move(text);
    tell("problem", {{"text", problem_}});
}

/// Reads the scene's file again once another program has written it: when two looks find the same time.
void Play::look_at_file(double seconds) {
    since_look_ += seconds;
    if (path_.empty() || since_look_ < look_every) return;
    since_look_ = 0;
    const auto written = time_written(path_);
    const bool is_settled = std::exchange(seen_, written) == written;
    if (!is_settled || written == written_ || written == std::filesystem::file_time_type{}) return;
    written_ = written;
    if (!would_lose()) return read_again();
    if (question) return;
    let_go_of_everything();
    question = Question{"Read " + std::filesystem::path(name_).filename().string() + " again?",
                        "The file was changed by another program. What you changed here is lost if it is read again.",
                        {{"read", "Read it again", [this] { read_again(); }}, {"keep", "Keep what runs", {}}}};
    tell("asks", {{"question", question->title}});
}

/// An invalid file leaves the running scene as it is.
void Play::read_again() {
    auto fetched = library_.fetch(name_, overrides_);
    if (!fetched.opened) return report_problem(std::move(fetched.problem));
    let_go_of_everything();
    const bool split = is_split();
    if (would_lose()) drop_draft();
    if (fetched.level && session().level())
        go_on_with(std::move(fetched));
    else
        begin(std::move(fetched));
    if (split && !is_split()) toggle_split();
    tell("reloaded", {{"name", name_}});
}

// --- time ------------------------------------------------------------------------------------------------------------

void Play::advance(double seconds, const std::function<bool()>& enough) {
    if (restoration_) {
        restoration_->advance(enough);
        if (restoration_->done()) end_restoration();
        return;
    }
    look_at_file(seconds);
    tend_draft(seconds);
    if (has_dialog()) return;
    film_.advance(seconds);
    tour.advance(seconds);
    for (int due = clock_->advance(seconds); due > 0; --due) {
        each_pane([&] { timeline().step(); });
        look_at_level();
        tell_happenings();
        if (enough && due > 1 && enough()) {
            clock_->forget();
            break;
        }
    }
    if (over_ && !held_) hovered = pick_here(); // particles move under a resting pointer
    find_selected_again();
    forget_missing_parts();
    follow(seconds);
}

void Play::pause(bool on) {
    if (clock_->paused() == on) return;
    clock_->pause(on);
    tell(on ? "pause" : "resume", {{"hash", hash()}});
}

void Play::step() {
    pause(true);
    each_pane([&] { timeline().step(); });
    tell_happenings();
    tell("step", {{"hash", hash()}});
}

void Play::step_back() {
    pause(true);
    each_pane([&] {
        if (timeline().now() > timeline().first()) timeline().go_to(timeline().now() - 1);
    });
    tell("back", {{"hash", hash()}});
}

void Play::go_to(std::uint64_t step) {
    let_go_of_everything();
    pause(true);
    each_pane([&] { timeline().go_to(step); });
    tell("scrub", {{"hash", hash()}});
}

void Play::restart() {
    let_go_of_everything();
    each_pane([&] { timeline().act(Restart{}); });
    tell("restart");
}

// --- input -----------------------------------------------------------------------------------------------------------

void Play::resize(int width, int height, double density) {
    width_ = std::max(width, 1), height_ = std::max(height, 1);
    density_ = density > 0 ? density : 1;
    resize_eyes();
}

void Play::zoom(double factor) {
    each_pane([&] { camera().zoom(session(), pointer_, factor); });
}

void Play::handle(const Input& input) {
    struct Handler {
        Play& play;
        void operator()(const Moved& moved) const { play.moved(within_reach(moved.to)); }
        void operator()(const Pressed& pressed) const { play.pressed(pressed.button); }
        void operator()(const Released& released) const { play.released(released.button); }
        void operator()(const Scrolled& scrolled) const {
            const double notches = std::clamp(scrolled.notches, -max_notches, max_notches);
            const auto& scene = play.session().scene();
            if (scene.pointer.wheel_time_scale > 0 && scene.solver.mode == "classic")
                return play.timeline().act(Quicken{notches * scene.pointer.wheel_time_scale});
            play.zoom(exponential(log_of_a_notch * notches));
        }
        void operator()(const Pinched& pinched) const {
            play.each_pane([&] { play.camera().pan(play.session(), within_reach(pinched.by)); });
            play.zoom(pinched.factor);
        }
        void operator()(const Key& key) const { play.key(key.name); }
        void operator()(const KeyUp& key) const {
            play.steer(key.name, false);
            if (key.name.ends_with("shift")) play.shift_held = false;
        }
        void operator()(const Left&) const { play.over_ = false, play.hovered.reset(); }
    };
    const bool acts = std::holds_alternative<Pressed>(input) || std::holds_alternative<Scrolled>(input) ||
                      std::holds_alternative<Pinched>(input);
    if (acts && has_dialog()) return;
    std::visit(Handler{*this}, input);
}

void Play::select(std::optional<Picked> picked) {
    selected = std::move(picked);
    selected_names_.clear();
    if (!selected) return;
    for (const auto id : selected->members) selected_names_.push_back(name_of(session().world(), id));
}

/// An edit rebuilds the world with new particle ids but the same names.
void Play::find_selected_again() {
    if (!selected) return;
    const auto& world = session().world();
    for (std::size_t i = 0; i < selected_names_.size(); ++i) {
        auto& id = selected->members[i];
        if (position_of(world, {&id, 1})) continue;
        const auto named = std::visit([&](const auto& any) { return find_particle(any, selected_names_[i]); }, world);
        id = named.value_or(id);
    }
}

std::optional<Picked> Play::pick_here() const {
    return pick(session().world(), view(), pointer_, pick_radius * density_);
}

/// A drag stays in the pane where it began.
void Play::moved(Vec2<double> to) {
    const auto last = active_;
    if (!held_)
        for (std::size_t i = 0; i < panes_.size(); ++i)
            if (to[0] >= pane_left(i)) switch_pane(i);
    to[0] -= pane_left(active_);
    const auto by = last == active_ ? to - pointer_ : Vec2<double>{};
    pointer_ = to;
    over_ = true;
    if (busy_) return busy_->move(*this);
    const bool around = held_ == Button::left || held_ == Button::right;
    if (held_ == Button::middle) return each_pane([&] { camera().pan(session(), by); });
    if (held_ && around) return each_pane([&] { camera().orbit(session(), by); });
    hovered = pick_here();
    if (clock_->paused()) return;
    each_pane([&] {
        if (session().level() || feels_pointer(session().scene()))
            timeline().act(PointAt{view().position_of(pointer_, hovered ? hovered->depth : 1)});
    });
}

Tool& Play::current_tool() {
    for (auto& one : tools_)
        if (one->name() == tool) return *one;
    return *tools_.front();
}

/// With the grab tool, a press on the background turns the camera of a 3D scene.
void Play::pressed(Button button) {
    if (held_ || restoration_) return;
    held_ = button;
    if (button == Button::middle) return;
    auto& using_tool = current_tool();
    if (button == Button::left && using_tool.name() == "grab" && !pick_here()) {
        selected.reset();
        if (session().scene().dimension == 3) return;
    }
    busy_ = &using_tool;
    if (button == Button::right)
        for (auto& one : tools_)
            if (one->name() == "cut") busy_ = one.get();
    busy_->press(*this);
}

void Play::released(Button button) {
    if (held_ != button) return;
    held_.reset();
    if (auto* done = std::exchange(busy_, nullptr)) done->release(*this);
    hovered = pick_here();
}

void Play::let_go_of_everything() {
    if (held_) released(*held_);
}

void Play::key(const std::string& name) {
    const auto action = keys.action_of(name);
    const bool is_page =
        !question && !path_request && problem_.empty() && (action == "settings" || (action == "help" && !settings));
    if (question && name == "return") return answer(0);
    if (name == "return" && !path_request && !problem_.empty()) return dismiss_problem();
    if (name.ends_with("shift")) return void(shift_held = true);
    if (has_dialog() && action != "close" && !is_page) return;
    if (steer(name, true)) return;
    if (action == "remove" && !chosen.empty()) return remove(std::vector(chosen));
    for (auto& one : tools_)
        if (one->name() == action) {
            let_go_of_everything();
            tool = one->name();
            message = std::string(one->name()) + ": " + std::string(one->about());
            return tell("tool", {{"name", one->name()}});
        }
    press_key(*this, name);
}

/// The arrows, space, and h.
bool Play::steer(const std::string& key, bool is_down) {
    constexpr std::array names = {"left", "right", "up", "down", "space", "h"};
    if (std::ranges::find(names, key) == names.end()) return false;
    if (!session().level() && !session().steering().has_any(session().scene())) return false;
    const auto before = steering_keys_;
    std::erase(steering_keys_, key);
    if (is_down) steering_keys_.push_back(key);
    if (before.size() == steering_keys_.size()) return true; // a key repeats while it is held
    const auto held = [&](const char* name) { return std::ranges::count(steering_keys_, name) > 0; };
    const Controls controls{.along = double(held("right")) - double(held("left")),
                            .up = double(held("up")) - double(held("down")),
                            .jump = held("space"),
                            .hold = held("h")};
    each_pane([&] { timeline().act(Steer{controls}); });
    return true;
}

// --- events ----------------------------------------------------------------------------------------------------------

void Play::tell(std::string what, json::Object more) {
    if (!muted_) tour.hear(what);
    if (listener && !muted_) listener({std::move(what), std::move(more)});
}

std::string Play::hash() const {
    const auto bits = std::visit([](const auto& world) { return state_hash(world); }, session().world());
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
    return text;
}

void Play::tell_happenings() {
    const auto& all = session().happenings();
    auto& told = pane().told;
    told = std::min(told, all.size()); // the session was restored to an earlier state
    for (; told < all.size(); ++told) tell(all[told].what, event_details(all[told]));
}

} // namespace sinew::play
