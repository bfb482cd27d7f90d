#include "sinew/scene/read_images.h"

#include "sinew/scene/check.h"
#include "sinew/scene/file_name.h"
#include "sinew/scene/text.h"

#include <algorithm>
#include <map>

namespace sinew {
namespace {

class ReadingImages {
  public:
    ReadingImages(const Opened& opened, const ImageReader& reader, Document& document)
        : opened_(opened), reader_(reader), document_(document) {}

    Images read() {
        for (const auto& [key, seen] : opened_.scene.looks)
            if (seen.image) read(*seen.image, "/looks" + json::pointer_step(key), "", key);
        const auto& figures = opened_.scene.figures;
        for (std::size_t i = 0; i < figures.size(); ++i)
            for (const auto& [part, seen] : figures[i].looks)
                if (seen.image)
                    read(*seen.image, format_text("/figures/{}/looks{}", i, json::pointer_step(part)),
                         name_of(figures[i]), part);
        return std::move(images_);
    }

  private:
    const Opened& opened_;
    const ImageReader& reader_;
    Document& document_;
    Images images_;
    std::map<std::string, std::string> broken_; ///< error message of each unreadable file
    std::int64_t pixels_ = 0;

    void read(const ImageLook& image, const std::string& place, std::string_view figure, std::string_view key) {
        if (has_no_room(figure, key))
            document_.error(place + "/image", format_text("nothing of {} takes an image", in_quotes(key)),
                            "an image goes on dots, sticks, links, limbs, ropes and polygons of four corners");
        if (!in_its_folder(image.file, place + "/image/file", "sprites/link.png", document_)) return;
        if (const auto known = broken_.find(image.file); known != broken_.end())
            return document_.error(place + "/image/file", known->second);
        const auto same_name = [&](const auto& known) { return known.first == image.file; };
        if (std::none_of(images_.begin(), images_.end(), same_name)) read(image.file, place + "/image/file");
    }

    void read(const std::string& name, const std::string& place) {
        Limits limits = document_.limits;
        limits.pixels -= pixels_;
        auto [image, problem, help] = reader_(name, limits);
        if (!image) {
            document_.error(place, problem, help);
            broken_[name] = problem;
            return;
        }
        pixels_ += std::int64_t(image->width) * image->height;
        images_.emplace_back(name, std::move(image));
    }

    /// True if a look refers to pieces and none of them takes an image; a look of no piece at all is reported
    /// elsewhere. `figure` is empty for looks of the whole scene.
    bool has_no_room(std::string_view figure, std::string_view key) const {
        bool meant = false, taken = false;
        const auto weigh = [&](const Figure& built) {
            if (!figure.empty() && built.name != figure) return;
            const bool all = figure.empty() ? key == built.name : key == "all";
            for (const auto& piece : built.pieces) {
                if (!all && key != piece.part && key != built.name + "/" + piece.part) continue;
                meant = true;
                taken |= takes_image(piece);
            }
        };
        std::visit([&](const auto& world) { std::for_each(world.figures.begin(), world.figures.end(), weigh); },
                   opened_.world);
        return meant && !taken;
    }
};

} // namespace

Images read_images(const Opened& opened, const ImageReader& reader, Document& document) {
    return ReadingImages(opened, reader, document).read();
}

} // namespace sinew
