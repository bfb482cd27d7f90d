#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/catalogue.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/gallery_page.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/stepping.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "canvas/partial_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

constexpr int film_width = 320, film_height = 240;
constexpr double film_fps = 12, film_seconds = 6;

void settle(const canvas::Failure& failure) {
    give_up_if_interrupted();
    if (failure) refuse("sinew", *failure);
}

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes pictures of a session as WebP beside the gallery and takes the bytes.
class Camera {
  public:
    explicit Camera(fs::path target) : target_(std::move(target)) {
        picture_.width = film_width;
        picture_.height = film_height;
    }

    /// `count` frames from now on.
    std::string film(Run& run, std::size_t count) {
        canvas::PartialFile file;
        settle(file.create(target_, ".webp"));
        auto [writer, failure] = canvas::open(file.path(), {film_width, film_height, film_fps, true});
        settle(failure);
        const auto begin = run.steps();
        for (std::size_t frame = 0; frame < count; ++frame) {
            run.advance(begin + steps_before(run.session.scene(), double(frame) / film_fps));
            run.session.draw(picture_);
            settle(writer->frame(picture_));
        }
        settle(writer->finish());
        return bytes_of(file.path());
    }

  private:
    fs::path target_;
    Picture picture_;
};

class GalleryCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "gallery",
            .usage = "[SCENE...] [-o FILE]",
            .about = "makes one page with every scene: film, description, parameters, source",
            .details =
                "The page is one HTML file that needs no network. Each scene moves for up to six seconds, in both\n"
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
        if (!words_.overrides.empty()) misused("gallery changes no values");
        auto names = words_.plain.empty() ? catalogue_names() : words_.plain;
        if (names.empty()) refuse("sinew", "the catalogue is empty");
        canvas::catch_interrupts();
        canvas::PartialFile file;
        if (const auto failure = file.create(path_)) refuse(path_, *failure);

        std::vector<Exhibit> exhibits;
        canvas::Progress progress(path_, names.size() * modes.size());
        for (const auto& name : names) {
            exhibits.push_back({page_of(name), {}, {}});
            for (std::size_t mode = 0; mode < modes.size(); ++mode) {
                record(name, modes[mode], exhibits.back());
                progress.update((exhibits.size() - 1) * modes.size() + mode + 1);
            }
        }
        const auto html = gallery_html(exhibits);
        std::ofstream out(file.path(), std::ios::binary);
        out << html << std::flush;
        if (!out) refuse(path_, "it cannot be written");
        if (const auto failure = file.commit()) refuse(path_, *failure);
        print(fmt::format("{}: {}, {:.1f} MB\n", path_, count_of(exhibits.size(), "scene"), double(html.size()) / 1e6));
        return done;
    }

    void record(const std::string& name, std::string_view mode, Exhibit& exhibit) const {
        const std::vector<Override> overrides = {{concat("mode=", mode)}};
        Camera camera(path_);
        Run run(open_file(name, overrides));
        const double seconds = std::min(run.session.scene().seconds, film_seconds);
        exhibit.films.push_back(camera.film(run, std::max<std::size_t>(std::size_t(seconds * film_fps), 1)));
        Run again(open_file(name, overrides));
        again.advance(steps_before(again.session.scene(), again.session.scene().seconds / 5));
        exhibit.stills.push_back(camera.film(again, 1));
    }

    Words words_;
    std::string path_ = "out/gallery.html";
};

} // namespace

std::unique_ptr<Command> command::gallery() {
    return std::make_unique<GalleryCommand>();
}

} // namespace sinew::cli
