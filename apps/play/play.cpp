#include "apps/play/play.h"

#include "sinew/solver/measure.h"

#include "apps/play/files.h"
#include "apps/play/keys.h"
#include "apps/play/scene_edit.h"
#include "apps/play/tool.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sinew::play {
namespace {

constexpr double a_notch = 1.15;    // how much larger a notch of the wheel shows things
constexpr double most_notches = 20; // at once
constexpr double look_every = 0.5;  // seconds between looks at the scene's file

bool follows_pointer(const PinSection& pin) {
    return pin.driver && std::holds_alternative<PointerDriver>(*pin.driver);
}

bool has_hover(const std::vector<std::pair<std::string, Look>>& looks) {
    return std::any_of(looks.begin(), looks.end(), [](const auto& look) { return !look.second.hover.empty(); });
}

/// Whether a pointer that only moves does something to the scene.
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

Play::Play(Shelf shelf, std::string scene, std::vector<Override> overrides)
    : shelf_(std::move(shelf)), tools_(all_tools()) {
    open(scene, std::move(overrides));
}

Play::~Play() = default;

// --- scenes ----------------------------------------------------------------------------------------------------------

void Play::open(const std::string& scene, std::vector<Override> overrides) {
    auto fetched = shelf_.fetch(scene, overrides);
    if (!fetched.opened) return report_problem(std::move(fetched.problem));
    let_go_of_everything();
    name_ = scene;
    overrides_ = std::move(overrides);
    begin(std::move(fetched));
    tell("scene", {{"name", name_}});
}

void Play::begin(Fetched fetched) {
    problem_.clear();
    message.clear();
    hovered.reset(), selected.reset();
    saved_edits_ = 0;
    told_ = 0;
    path_ = std::move(fetched.path);
    written_ = time_written(path_);
    const double scale = clock_ ? clock_->scale() : 1;
    const bool paused = clock_ && clock_->paused();
    clock_.emplace(fetched.opened->scene.solver.rate);
    clock_->set_scale(scale);
    clock_->pause(paused);
    tape_.emplace(Session(std::move(*fetched.opened)));
    eye_ = {};
    eye_.resize(width_, height_);
}

void Play::open_neighbour(int by) {
    const auto& names = shelf_.names;
    if (names.empty()) return;
    const auto found = std::find(names.begin(), names.end(), name_);
    const auto count = std::ptrdiff_t(names.size());
    const auto here = found == names.end() ? (by > 0 ? -1 : 0) : found - names.begin();
    open(names[std::size_t((here + by + count) % count)]);
}

void Play::report_problem(std::string text) {
    problem_ = std::move(text);
    tell("problem", {{"text", problem_}});
}

/// A scene file that was written since is played as it is now; one that is wrong leaves the scene that runs.
void Play::look_at_file(double seconds) {
    since_look_ += seconds;
    if (path_.empty() || since_look_ < look_every) return;
    since_look_ = 0;
    const auto written = time_written(path_);
    if (written == written_) return;
    written_ = written;
    auto fetched = shelf_.fetch(name_, overrides_);
    if (!fetched.opened) return report_problem(std::move(fetched.problem));
    let_go_of_everything();
    begin(std::move(fetched));
    tell("reloaded", {{"name", name_}});
}

// --- time ------------------------------------------------------------------------------------------------------------

void Play::advance(double seconds, const std::function<bool()>& enough) {
    film_due_ -= seconds;
    look_at_file(seconds);
    for (int due = clock_->advance(seconds); due > 0; --due) {
        tape_->step();
        tell_happenings();
        if (enough && due > 1 && enough()) {
            clock_->forget();
            break;
        }
    }
    if (over_ && !held_) hovered = pick_here(); // things move under a pointer that rests
    find_selected_again();
}

void Play::pause(bool on) {
    if (clock_->paused() == on) return;
    clock_->pause(on);
    tell(on ? "pause" : "resume", {{"hash", hash()}});
}

void Play::step() {
    pause(true);
    tape_->step();
    tell_happenings();
    tell("step", {{"hash", hash()}});
}

void Play::step_back() {
    pause(true);
    if (tape_->now() > tape_->first()) tape_->go_to(tape_->now() - 1);
    tell("back", {{"hash", hash()}});
}

void Play::go_to(std::uint64_t step) {
    let_go_of_everything();
    pause(true);
    tape_->go_to(step);
    tell("scrub", {{"hash", hash()}});
}

void Play::close() {
    if (help)
        help = false;
    else if (!problem_.empty())
        problem_.clear();
    else
        quit = true;
}

void Play::restart() {
    let_go_of_everything();
    tape_->act(Restart{});
    tell("restart");
}

// --- edits -----------------------------------------------------------------------------------------------------------

void Play::undo() {
    let_go_of_everything();
    const auto what = tape_->undo_name();
    if (!tape_->undo()) return;
    message = "undone: " + what;
    tell("undo", {{"edit", what}, {"hash", hash()}});
}

void Play::redo() {
    let_go_of_everything();
    const auto what = tape_->redo_name();
    if (!tape_->redo()) return;
    message = "done again: " + what;
    tell("redo", {{"edit", what}, {"hash", hash()}});
}

void Play::become(Scene scene, std::string name, bool goes_on) {
    let_go_of_everything();
    tape_->edit(Become{std::make_shared<const Scene>(std::move(scene))}, name, goes_on);
    clock_->set_rate(session().scene().solver.rate);
    tell("edit", {{"edit", std::move(name)}});
}

void Play::edit(Deed deed, std::string name) {
    tape_->edit(std::move(deed), name, tape_->undo_name() == name);
    tell("edit", {{"edit", std::move(name)}});
}

bool Play::add_figure(json::Object figure, const std::string& name) {
    auto changed = edited(session().scene(), [&](json::Object& root) { append(root, "figures", std::move(figure)); });
    if (!changed.scene) return report_problem(std::move(changed.problem)), false;
    become(std::move(*changed.scene), "add " + name);
    tell("add", {{"figure", name}});
    return true;
}

bool Play::set(const std::string& path, const std::string& value, bool goes_on) {
    const std::array<Override, 1> overrides = {{{path + "=" + value, "the panel"}}};
    auto changed = edited(session().scene(), overrides);
    if (!changed.scene) return report_problem(std::move(changed.problem)), false;
    become(std::move(*changed.scene), path, goes_on);
    return true;
}

/// The file may say more about the other mode than which it is.
void Play::switch_mode() {
    const std::string other = session().scene().solver.mode == "classic" ? "physical" : "classic";
    if (is_edited()) {
        set("solver.mode", other);
        return;
    }
    auto overrides = overrides_;
    std::erase_if(overrides, [](const Override& one) { return one.pair.starts_with("mode="); });
    overrides.push_back({"mode=" + other, "the panel"});
    open(name_, std::move(overrides));
}

void Play::toggle_gravity() {
    auto scene = session().scene();
    const bool on = !(scene.world.gravity == Point{});
    if (on)
        gravity_ = scene.world.gravity;
    else if (gravity_ == Point{})
        gravity_[1] =
            (scene.units.up == "-y" ? 9.81 : -9.81) * scene.measures().per_metre / square(scene.measures().per_second);
    scene.world.gravity = on ? Point{} : gravity_;
    become(std::move(scene), on ? "no gravity" : "gravity");
    message = on ? "no gravity" : "gravity";
}

void Play::toggle_wind() {
    auto scene = session().scene();
    auto& forces = scene.world.forces;
    const auto is_wind = [](const ForceSection& section) { return std::holds_alternative<WindForce>(section.force); };
    const bool on = std::any_of(forces.begin(), forces.end(), is_wind);
    if (on) {
        std::erase_if(forces, is_wind);
    } else {
        const auto units = scene.measures();
        WindForce wind;
        wind.velocity[0] = 6 * units.per_metre / units.per_second;
        wind.gust[0] = 4 * units.per_metre / units.per_second;
        wind.gust_period = 1.5 * units.per_second;
        wind.strength = 0.15 / units.per_second;
        forces.push_back({wind});
    }
    become(std::move(scene), on ? "no wind" : "wind");
    message = on ? "no wind" : "wind";
}

bool Play::save(const std::filesystem::path& path) {
    if (auto failure = write_file(path, text_of(session()))) return report_problem(std::move(*failure)), false;
    if (path == path_) written_ = time_written(path_);
    saved_edits_ = tape_->edits();
    message = "saved " + path.string();
    tell("saved", {{"path", path.string()}});
    return true;
}

// --- input -----------------------------------------------------------------------------------------------------------

void Play::resize(int width, int height, double density) {
    width_ = std::max(width, 1), height_ = std::max(height, 1);
    density_ = density > 0 ? density : 1;
    eye_.resize(width_, height_);
}

void Play::handle(const Input& input) {
    struct Handler {
        Play& play;
        void operator()(const Moved& moved) const { play.moved(moved.to); }
        void operator()(const Pressed& pressed) const { play.pressed(pressed.button); }
        void operator()(const Released& released) const { play.released(released.button); }
        void operator()(const Scrolled& scrolled) const {
            const double notches = std::clamp(scrolled.notches, -most_notches, most_notches);
            const auto& scene = play.session().scene();
            if (scene.pointer.wheel_quickens > 0 && scene.solver.mode == "classic")
                return play.tape().act(Quicken{notches * scene.pointer.wheel_quickens});
            const double factor = std::pow(a_notch, notches);
            play.eye_.zoom(play.session(), play.pointer_, factor);
        }
        void operator()(const Pinched& pinched) const {
            play.eye_.pan(play.session(), pinched.by);
            play.eye_.zoom(play.session(), play.pointer_, pinched.factor);
        }
        void operator()(const Key& key) const { play.key(key.name); }
        void operator()(const KeyUp& key) const {
            if (key.name == "space") play.space_ = false;
        }
        void operator()(const Left&) const { play.over_ = false, play.hovered.reset(); }
    };
    std::visit(Handler{*this}, input);
}

void Play::select(std::optional<Picked> picked) {
    selected = std::move(picked);
    selected_names_.clear();
    if (!selected) return;
    for (const auto id : selected->members) selected_names_.push_back(name_of(session().world(), id));
}

/// An edit makes the scene's world anew: its particles have other ids then, but the same names.
void Play::find_selected_again() {
    if (!selected) return;
    const auto& world = session().world();
    for (std::size_t i = 0; i < selected_names_.size(); ++i) {
        auto& id = selected->members[i];
        if (place_of(world, {&id, 1})) continue;
        const auto named = std::visit([&](const auto& any) { return find_particle(any, selected_names_[i]); }, world);
        id = named.value_or(id);
    }
}

std::optional<Picked> Play::pick_here() const {
    return pick(session().world(), view(), pointer_, pick_radius * density_);
}

void Play::moved(Vec2<double> to) {
    const auto by = to - pointer_;
    pointer_ = to;
    over_ = true;
    if (busy_) return busy_->move(*this);
    const bool around = held_ == Button::left || held_ == Button::right;
    if (held_ && (held_ == Button::middle || space_)) return eye_.pan(session(), by);
    if (held_ && around) return eye_.orbit(session(), by);
    hovered = pick_here();
    if (feels_pointer(session().scene()) && !clock_->paused())
        tape_->act(PointAt{view().place_of(pointer_, hovered ? hovered->depth : 1)});
}

Tool& Play::current_tool() {
    for (auto& one : tools_)
        if (one->name() == tool) return *one;
    return *tools_.front();
}

/// With the grab tool, pressing where nothing is turns a 3D scene.
void Play::pressed(Button button) {
    if (held_) return;
    held_ = button;
    if (button == Button::middle || space_) return;
    auto& chosen = current_tool();
    if (button == Button::left && chosen.name() == "grab" && !pick_here()) {
        selected.reset();
        if (session().scene().dimension == 3) return;
    }
    busy_ = &chosen;
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
    if (name == "space") space_ = true;
    for (auto& one : tools_)
        if (one->key() == name) {
            let_go_of_everything();
            tool = one->name();
            message = std::string(one->name()) + ": " + std::string(one->about());
            return tell("tool", {{"name", one->name()}});
        }
    press_key(*this, name);
}

// --- what is told ----------------------------------------------------------------------------------------------------

void Play::tell(std::string what, json::Object more) {
    if (listener) listener({std::move(what), std::move(more)});
}

std::string Play::hash() const {
    const auto bits = std::visit([](const auto& world) { return state_hash(world); }, session().world());
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
    return text;
}

void Play::tell_happenings() {
    const auto& all = session().happenings();
    if (told_ > all.size()) told_ = all.size(); // it went back
    for (; told_ < all.size(); ++told_) tell(all[told_].what, {{"where", all[told_].where}});
}

} // namespace sinew::play
