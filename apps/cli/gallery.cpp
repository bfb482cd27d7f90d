#include "sinew/picture/draw.h"
#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/catalogue.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/gallery_page.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scrap.h"
#include "apps/cli/side_by_side.h"
#include "apps/cli/stepping.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "canvas/partial_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

constexpr double max_width = 320, max_height = 240; // pixels
constexpr double film_fps = 10, film_seconds = 5;

std::unique_ptr<canvas::Writer> open(const Scrap& scrap, const Picture& picture) {
    auto [writer, failure] =
        canvas::open(scrap.path(), {picture.width, picture.height, film_fps, true, scrap.called()});
    settle(failure);
    return std::move(writer);
}

/// A scene in one mode: a film of the beginning, and a still after a fifth of the scene's time.
struct Reel {
    std::string film, still;
};

/// Picture with the scene's aspect ratio.
Picture paper_of(const Scene& scene) {
    const double width = scene.view.size[0], height = scene.view.size[1];
    const double scale = min(max_width / width, max_height / height);
    Picture picture;
    picture.width = std::max(int(width * scale + 0.5), 1);
    picture.height = std::max(int(height * scale + 0.5), 1);
    return picture;
}

/// Renders film and still of a scene. `number` distinguishes the files of concurrent calls.
Reel shoot(const std::string& name, std::string_view mode, const fs::path& page, std::size_t number) {
    const std::vector<Override> overrides = {{concat("mode=", mode)}};
    Run run(open_file(name, overrides));
    const double seconds = run.session.scene().seconds;
    const auto frames = std::max<std::size_t>(std::size_t(std::min(seconds, film_seconds) * film_fps), 1);
    const auto still_frame = std::min(frames - 1, std::size_t(seconds / 5 * film_fps));
    Scrap film(page, fmt::format(".{}.webp", number), page.string());
    Scrap still(page, fmt::format(".{}.png", number), page.string());
    Picture picture = paper_of(run.session.scene());
    const auto film_writer = open(film, picture), still_writer = open(still, picture);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        run.advance(steps_before(run.session.scene(), double(frame) / film_fps));
        draw(run.session, picture);
        settle(film_writer->frame(picture));
        if (frame == still_frame) settle(still_writer->frame(picture));
    }
    settle(film_writer->finish());
    settle(still_writer->finish());
    return {film.bytes(), still.bytes()};
}

class GalleryCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "gallery",
            .usage = "[SCENE...] [-o FILE]",
            .about = "makes one page with every scene: film, description, parameters, source",
            .details =
                "The page is one HTML file that needs no network. Each scene moves for up to five seconds, in both\n"
                "modes. Films need ffmpeg.\n",
            .examples = "sinew gallery -o out/gallery.html\n"
                        "sinew gallery ragdoll rope -o two.html\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words_);
        declare_text(parser, "-o,--output", path_, "FILE",
                     "file to write, replaced where it exists; else out/gallery.html");
    }

    int run() override {
        if (!words_.overrides.empty()) usage_error("gallery changes no values");
        auto names = words_.plain.empty() ? catalogue_names() : words_.plain;
        if (names.empty()) refuse("sinew", "the catalogue is empty");
        canvas::catch_interrupts();
        canvas::PartialFile file;
        if (const auto failure = file.create(path_)) refuse(path_, *failure);

        std::vector<Exhibit> exhibits;
        for (const auto& name : names) exhibits.push_back({page_of(name), {}, {}});
        const auto reels = shoot_all(names);
        for (std::size_t i = 0; i < reels.size(); ++i) {
            auto& exhibit = exhibits[i / modes.size()];
            exhibit.films.push_back(reels[i].film);
            exhibit.stills.push_back(reels[i].still);
        }
        const auto html = gallery_html(exhibits);
        errno = 0;
        std::ofstream out(file.path(), std::ios::binary);
        out << html << std::flush;
        if (!out) refuse(path_, std::strerror(errno != 0 ? errno : EIO));
        if (const auto failure = file.commit()) refuse(path_, *failure);
        print(fmt::format("{}: {}, {:.1f} MB\n", path_, count_of(exhibits.size(), "scene"), double(html.size()) / 1e6));
        return done;
    }

    /// Renders every mode of every scene, several concurrently.
    std::vector<Reel> shoot_all(const std::vector<std::string>& names) const {
        std::vector<Reel> reels(names.size() * modes.size());
        canvas::Progress progress(path_, reels.size());
        side_by_side(
            reels.size(),
            [&](std::size_t i) { reels[i] = shoot(names[i / modes.size()], modes[i % modes.size()], path_, i); },
            [&](std::size_t done) { progress.update(done); });
        return reels;
    }

    Words words_;
    std::string path_ = "out/gallery.html";
};

} // namespace

std::unique_ptr<Command> command::gallery() {
    return std::make_unique<GalleryCommand>();
}

} // namespace sinew::cli
