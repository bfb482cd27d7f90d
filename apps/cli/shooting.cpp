#include "apps/cli/shooting.h"

#include "apps/cli/scrap.h"
#include "canvas/formats.h"
#include "canvas/sheet.h"

#include <cmath>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

/// A picture of a scene that says nothing else shows it at this part of its time: something has happened, and it is
/// not over.
constexpr double telling_moment = 0.2;

double duration(const Wishes& wishes, const Scene& scene) {
    return wishes.seconds.value_or(scene.seconds);
}

Frames still_frame(const Wishes& wishes, const Scene& scene) {
    return {.first = wishes.at.value_or(wishes.seconds.value_or(telling_moment * scene.seconds))};
}

Frames film_frames(const Wishes& wishes, const Scene& scene, double fps) {
    const auto count = std::fmax(std::round(duration(wishes, scene) * fps), 1);
    const auto first = wishes.at.value_or(0);
    return {first, 1 / fps, std::size_t(count), first + count / fps};
}

/// The last frame is the end.
Frames sheet_frames(const Wishes& wishes, const Scene& scene) {
    const auto count = std::size_t((*wishes.sheet)[0]) * std::size_t((*wishes.sheet)[1]);
    const auto first = wishes.at.value_or(0), length = duration(wishes, scene);
    return {first, count > 1 ? length / double(count - 1) : 0, count, first + length};
}

std::unique_ptr<canvas::Writer> checked(canvas::Opened opened) {
    settle(opened.failure);
    return std::move(opened.writer);
}

Shooting begin_sheet(const std::filesystem::path& path, const std::string& called, const Wishes& wishes,
                     const Stage& stage) {
    constexpr double usual_width = 320;
    const auto [width, height] = stage.scene().view.size;
    const auto usual_height = int(std::fmax(std::round(usual_width * height / width), 1));
    const auto one = wishes.size.value_or(std::array{int(usual_width), usual_height});
    const auto whole = stage.size(one);
    const auto [columns, rows] = *wishes.sheet;
    const auto frames = sheet_frames(wishes, stage.scene());
    const canvas::SheetFormat format{columns, rows, whole[0], whole[1], frames.first, frames.between, called};
    return {checked(canvas::open_sheet(path, format)), frames, one, whole, whole};
}

std::string bytes_text(std::uintmax_t bytes) {
    if (bytes < 1000) return fmt::format("{} bytes", bytes);
    if (bytes < 1000 * 1000) return fmt::format("{:.0f} kB", double(bytes) / 1e3);
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::string size_text(const std::array<int, 2>& size) {
    return fmt::format("{}x{}", size[0], size[1]);
}

} // namespace

Shooting begin_file(const std::filesystem::path& path, const std::string& called, const Wishes& wishes,
                    const Stage& stage) {
    if (wishes.sheet) return begin_sheet(path, called, wishes, stage);
    const auto one = wishes.size.value_or(stage.scene().view.size);
    const auto whole = stage.size(one);
    const auto* kind = canvas::format_of(path);
    const double fps = wishes.fps.value_or(kind ? kind->usual_fps : 60);
    auto writer = checked(canvas::open(path, {whole[0], whole[1], fps, false, called})); // refuses an unknown kind
    const auto frames = kind->moves ? film_frames(wishes, stage.scene(), fps) : still_frame(wishes, stage.scene());
    return {std::move(writer), frames, one, whole, {canvas::padded(whole[0], *kind), canvas::padded(whole[1], *kind)}};
}

void write_frames(Shooting& shooting, Stage& stage, OverlaySet overlay, const std::string& label) {
    Picture picture;
    const auto& frames = shooting.frames;
    canvas::Progress progress(label, std::size_t(stage.steps(frames.time(frames.count - 1))));
    for (std::size_t frame = 0; frame < frames.count; ++frame) {
        stage.advance(frames.time(frame), progress);
        stage.draw(picture, shooting.one, overlay);
        settle(shooting.writer->frame(picture));
    }
    settle(shooting.writer->finish());
}

std::string written_text(const std::string& called, const Shooting& shooting, std::uintmax_t bytes) {
    const auto& frames = shooting.frames;
    auto size = size_text(shooting.written);
    if (shooting.written != shooting.whole)
        size += fmt::format(" ({} padded, as its kind needs)", size_text(shooting.whole));
    if (frames.count == 1)
        return fmt::format("{}: {} at {:.4g} s, {}\n", called, size, frames.first, bytes_text(bytes));
    return fmt::format("{}: {} frames of {} from {:.4g} to {:.4g} s, {}\n", called, frames.count, size, frames.first,
                       frames.end, bytes_text(bytes));
}

} // namespace sinew::cli
