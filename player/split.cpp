#include "canvas/beside.h"
#include "player/pin_marks.h"
#include "player/play.h"
#include "player/tool.h"

#include <array>
#include <utility>

/// Split view: classic and physical mode of one scene side by side, in lockstep.
namespace sinew::play {
namespace {

constexpr std::array<const char*, 2> sides = {"classic", "physical"};

} // namespace

int Play::pane_left(std::size_t number) const {
    return width_ * int(number) / int(panes_.size());
}

void Play::each_pane(const std::function<void()>& act) {
    const auto under_pointer = active_;
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        active_ = i;
        muted_ = i != under_pointer;
        act();
    }
    active_ = under_pointer;
    muted_ = false;
}

/// The selection carries over to the particles of the same names.
void Play::switch_pane(std::size_t number) {
    if (number == active_) return;
    const auto& from = session().world();
    const auto one = selected;
    active_ = number;
    hovered.reset();
    select(one ? counterpart(from, *one, session().world(), view()) : std::nullopt);
}

void Play::resize_eyes() {
    for (std::size_t i = 0; i < panes_.size(); ++i) panes_[i].camera.resize(pane_width(i), height_);
}

/// An unedited file is opened once per mode, because the file may contain settings for each; an edited scene is used
/// for both modes.
void Play::toggle_split() {
    let_go_of_everything();
    if (is_split()) {
        if (active_ != 0) std::swap(panes_[0], panes_[active_]);
        panes_.erase(panes_.begin() + 1, panes_.end());
        active_ = own_pane_ = 0;
        resize_eyes();
        return tell("split", {{"on", false}});
    }
    std::vector<Pane> panes;
    for (const char* mode : sides) {
        Fetched fetched;
        if (would_lose() || path_.empty()) {
            fetched = library_.read(saved_text(), name_, beside_);
            if (fetched.opened) fetched.opened->scene.solver.mode = mode;
            if (fetched.opened) fetched.opened->world = instantiate(fetched.opened->scene);
            fetched.level = session().level();
        } else {
            auto overrides = overrides_;
            std::erase_if(overrides, [](const Override& one) { return one.pair.starts_with("mode="); });
            overrides.push_back({std::string("mode=") + mode, "the split view"});
            fetched = library_.fetch(name_, overrides);
        }
        if (!fetched.opened) return report_problem(std::move(fetched.problem));
        panes.push_back({Timeline(session_from(std::move(fetched))), {}});
    }
    if (panes[0].timeline.session().scene().solver.rate != panes[1].timeline.session().scene().solver.rate)
        return report_problem("classic and physical mode of this scene take steps of other lengths");
    const bool is_lost = would_lose();
    const bool was_classic = session().scene().solver.mode == sides[0];
    auto saved = std::move(saved_as_);
    begin(std::move(panes));
    own_pane_ = was_classic ? 0 : 1;
    saved_as_ = is_lost ? std::move(saved) : saved_text();
    if (is_lost) saved_edits_ = draft_.edits = never_saved;
    tell("split", {{"on", true}});
}

void Play::paint_scene(std::size_t number, Picture& picture) {
    const auto under_pointer = std::exchange(active_, number);
    picture.width = pane_width(number), picture.height = height_;
    timeline().draw(picture, overlay, view(), clock_->paused() ? 1 : clock_->share(), theme);
    active_ = under_pointer;
}

void Play::paint_pointer(std::size_t number, Picture& picture) {
    const auto under_pointer = std::exchange(active_, number);
    if (is_split()) label_pane(number, picture);
    constexpr std::size_t pins = 2; // of `overlays`
    if (!overlay.test(pins)) draw_pin_marks(session().world(), view(), theme_called(shown_theme()), picture);
    if (number == under_pointer) highlight(picture);
    current_tool().draw_idle(*this, picture);
    if (busy_) busy_->draw(*this, picture);
    active_ = under_pointer;
}

/// Draws the name of the mode, and a line between neighbouring panes.
void Play::label_pane(std::size_t number, Picture& picture) const {
    const auto& colors = theme_called(shown_theme());
    const auto unit = float(density_);
    picture.add_text(session().scene().solver.mode, {{float(picture.width) / 2, 18 * unit}}, 15 * unit, colors.pen);
    const std::array<Vec2<float>, 2> edge = {{{{0, 0}}, {{0, float(picture.height)}}}};
    if (number > 0) picture.add(Shape::polyline, edge, 2 * unit, colors.wall);
}

void Play::lay_side_by_side(Picture& picture) {
    std::vector<Picture> parts(panes_.size());
    std::vector<canvas::Labelled> labelled;
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        paint_scene(i, parts[i]);
        labelled.push_back({&parts[i], panes_[i].timeline.session().scene().solver.mode});
    }
    canvas::put_beside(labelled, picture);
}

void Play::draw(Picture& picture) {
    if (is_split())
        lay_side_by_side(picture);
    else
        paint_scene(0, picture);
    take_pictures(picture);
    if (!is_split()) paint_pointer(0, picture);
}

void Play::draw_panes(std::vector<Picture>& pictures) {
    pictures.resize(panes_.size());
    if (!is_split()) return draw(pictures[0]);
    if (Picture whole; wants_pictures()) draw(whole);
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        paint_scene(i, pictures[i]);
        paint_pointer(i, pictures[i]);
    }
}

} // namespace sinew::play
