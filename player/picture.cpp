#include "sinew/math/trig.h"
#include "sinew/picture/theme.h"

#include "canvas/beside.h"
#include "canvas/formats.h"
#include "player/files.h"
#include "player/play.h"
#include "player/tool.h"

#include <algorithm>
#include <utility>

/// Pictures of a game on the screen, as screenshots and as films.
namespace sinew::play {
namespace {

/// Scene files are named by their paths, scenes of the catalogue by a word.
std::string stem_of(const std::string& name) {
    return std::filesystem::path(name).stem().string();
}

} // namespace

/// Draws a ring around the particles to be grabbed by a press.
void Play::highlight(Picture& picture) const {
    if (!hovered || busy_ || !over_ || question || path_request) return;
    const auto position = hovered->members.size() == 1 ? position_of(session().world(), hovered->members)
                                                       : std::optional(hovered->position);
    const auto seen = position ? view().see(position->as<3, double>()) : std::nullopt;
    if (!seen) return;
    const auto& colors = theme_called(shown_theme());
    constexpr int corners = 24;
    const auto unit = float(density_);
    std::array<Vec2<float>, corners> ring;
    for (int i = 0; i < corners; ++i) {
        const double turn = 2 * pi<double> * i / corners;
        ring[std::size_t(i)] = seen->pixel + Vec2<float>{{float(cosine(turn)), float(sine(turn))}} * (9 * unit);
    }
    picture.add(Shape::loop, ring, 4.5F * unit, colors.background);
    picture.add(Shape::loop, ring, 2 * unit, colors.palette[0]);
    picture.add(Shape::disc, std::span(&seen->pixel, 1), 5 * unit, colors.palette[0]);
}

void Play::switch_theme() {
    theme = shown_theme() == "dark" ? "light" : "dark";
}

void Play::screenshot(std::filesystem::path path) {
    screenshots_.push_back(path.empty() ? free_path("out/" + stem_of(name_) + ".png") : std::move(path));
}

void Play::toggle_recording(std::filesystem::path path) {
    if (film_.recording()) {
        if (const auto failure = film_.finish()) return report_problem(*failure);
        message = "recorded " + full_path(film_.path());
        return tell("recorded", {{"path", film_.path().string()}});
    }
    if (path.empty()) path = free_path("out/" + stem_of(name_) + ".mp4");
    const auto size =
        is_split() ? canvas::size_beside(panes_.size(), pane_width(0), height_) : canvas::BesideSize{width_, height_};
    if (auto exporter = open_export(path, {size.width, size.height}, Film::rate)) {
        film_.begin(std::move(path), std::move(exporter));
    } else if (const auto failure = film_.begin(std::move(path), size.width, size.height)) {
        return report_problem(*failure);
    }
    message = "recording; V ends it";
    tell("recording", {{"path", film_.path().string()}});
}

/// An export of frames, or of a moment (0); null for a file of pictures.
std::unique_ptr<files::Exporter> Play::open_export(const std::filesystem::path& path, std::array<int, 2> size,
                                                   double fps) const {
    return library_.open_export ? library_.open_export(path, size, fps) : nullptr;
}

canvas::Failure Play::take_picture(const std::filesystem::path& path, const Picture& picture) const {
    if (const auto exporter = open_export(path, {picture.width, picture.height}, 0)) {
        if (auto failure = exporter->frame(session())) return failure;
        return exporter->finish();
    }
    auto opened = canvas::open(path, {.width = picture.width, .height = picture.height});
    if (opened.failure) return opened.failure;
    if (auto failure = opened.writer->frame(picture)) return failure;
    return opened.writer->finish();
}

/// A recording ends when the size of the picture changes.
void Play::take_pictures(const Picture& picture) {
    for (const auto& path : std::exchange(screenshots_, {})) {
        if (const auto failure = take_picture(path, picture)) {
            report_problem(*failure);
            continue;
        }
        message = "screenshot " + full_path(path);
        tell("screenshot", {{"path", path.string()}});
    }
    if (film_.recording() && !film_.fits(picture)) toggle_recording();
    if (const auto failure = film_.add(session(), picture)) report_problem(*failure);
}

} // namespace sinew::play
