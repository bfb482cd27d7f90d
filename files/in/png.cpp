#include "files/in/contours.h"
#include "files/in/drawing.h"
#include "files/in/formats.h"
#include "files/in/png_file.h"
#include "files/in/png_pieces.h"
#include "files/out/png_writer.h"

#include <algorithm>

namespace sinew::files {
namespace {

/// Largest side of a picture in a scene, pixels: 3 m.
constexpr double usual_side = 300;
constexpr std::string_view png_signature("\x89PNG\r\n\x1a\n", 8);

class PngReader {
  public:
    PngReader(const ImportFile& file, const ImportOptions& options) : file_(file), options_(options) {
        image_ = read_png_file(file.bytes, notes_);
        const double side = std::max(image_.width, image_.height);
        scale_ = options.scale.value_or(std::min(1.0, usual_side / side));
        role_ = role_called(options.role).value_or(Role::jelly);
    }

    Imported read() {
        const Vec2<double> size{{double(image_.width), double(image_.height)}};
        constexpr double usual_error = 1; // pixels of the scene
        Drawing drawing(size * scale_, options_.error.value_or(usual_error));
        for (auto& note : notes_.taken()) drawing.notes().add(std::move(note.place), std::move(note.message));
        if (std::ranges::all_of(image_.pixels, [](auto pixel) { return pixel >> 24U == 255; }))
            drawing.notes().add("", "the picture has no transparency: its outline is its border");
        constexpr double least_share = 1e-3; // of the largest part
        std::size_t largest = 0, small = 0;
        each_part(image_, [&](const ImagePart& part) {
            largest = std::max(largest, part.pixels);
            if (double(part.pixels) >= least_share * double(largest) && part.pixels > 8)
                add(drawing, part);
            else
                ++small;
        });
        if (small > 0)
            drawing.notes().add("",
                                concat(small, " specks of less than a thousandth of the largest part are left out"));
        auto imported = drawing.finish(concat("Imported from ", file_.name));
        imported.beside = std::move(beside_);
        return imported;
    }

  private:
    const ImportFile& file_;
    const ImportOptions& options_;
    Notes notes_; ///< of the file
    Image image_;
    double scale_ = 1;
    Role role_ = Role::jelly;
    std::vector<SideFile> beside_;
    std::size_t written_ = 0; ///< pixels

    static PixelField alpha_field(const Image& image) {
        return {image.width, image.height, [&image](int x, int y) {
                    return double(image.pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] >> 24U);
                }};
    }

    std::string write(const Image& image) {
        auto name = format_text("{}_images/{}.png", file_.title, beside_.size());
        written_ += image.pixels.size();
        if (written_ > std::size_t(Limits{}.pixels))
            throw ImportError{"", concat("its pieces have more than ", Limits{}.pixels, " pixels"),
                              "--scale F makes it smaller"};
        beside_.push_back({name, png_of(image)});
        return name;
    }

    void add(Drawing& drawing, const ImagePart& part) {
        const Vec2<double> corner{{double(part.left), double(part.top)}};
        DrawnShape shape;
        shape.place = format_text("the part at {},{}", part.left, part.top);
        shape.name = file_.title;
        shape.role = role_;
        constexpr double level = 127.5; // half opaque
        for (auto& outline : contours(alpha_field(part.image), level)) {
            for (auto& p : outline) p = (p + corner) * scale_;
            shape.lines.push_back({std::move(outline), true});
        }
        if (role_ == Role::collider) return drawing.add(shape);
        shape.fill = role_ == Role::solid ? "none" : mean_color(part.image);
        Worn worn;
        worn.at = corner * scale_;
        const auto size = Vec2<double>{{double(part.image.width), double(part.image.height)}};
        worn.size = size * scale_;
        // Two pixels for each of the scene: screens have as many.
        const double density = std::min(1.0, 2 * scale_);
        if (role_ == Role::solid)
            worn.file = write(cut_out(part.image, {{{}, {{size[0], 0}}, size, {{0, size[1]}}}}, density));
        worn.tile = [&](std::array<Vec2<double>, 4> corners) {
            for (auto& p : corners) p = p * (1 / scale_) - corner;
            return write(cut_out(part.image, corners, density));
        };
        drawing.add(shape, &worn);
    }
};

} // namespace

const ImportFormat reader::png{
    "PNG", "png", "a picture with transparency: its outline as jelly, crate or collider",
    [](std::string_view bytes) { return bytes.starts_with(png_signature); },
    [](const ImportFile& file, const ImportOptions& options) { return PngReader(file, options).read(); }};

} // namespace sinew::files
