#include "canvas/sheet.h"

#include "canvas/cairo_painter.h"
#include "canvas/drawing.h"
#include "canvas/formats.h"

#include <fmt/format.h>
#include <numbers>

namespace sinew::canvas {
namespace {

// Pixels.
constexpr int gap = 14;
constexpr int caption_height = 22;
constexpr double caption_size = 13;
constexpr double corner_radius = 5;

/// A stroke font that cairo carries in itself: the same letters on every machine, those without fonts included.
constexpr const char* caption_font = "@cairo:";

long sheet_width(const SheetFormat& sheet) {
    return gap + long(sheet.columns) * (sheet.frame_width + gap);
}

/// The last row's captions make the lower margin.
long sheet_height(const SheetFormat& sheet) {
    return gap + long(sheet.rows) * (sheet.frame_height + caption_height) + gap / 2;
}

Color mixed(const Color& a, const Color& b, float part_of_b) {
    const auto mix = [&](float from, float to) { return from + (to - from) * part_of_b; };
    return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue), 1};
}

/// The mount and the lettering go with the pictures: a shade darker than light ones, a shade lighter than dark ones.
struct Mount {
    Color paper, ink;

    explicit Mount(const Color& background) {
        const bool light = 0.30f * background.red + 0.59f * background.green + 0.11f * background.blue > 0.5f;
        const Color contrast = light ? Color{0, 0, 0, 1} : Color{1, 1, 1, 1};
        paper = mixed(background, contrast, 0.08f);
        ink = mixed(background, contrast, 0.72f);
    }
};

void trace_rounded(cairo_t* context, const Region& r, double radius) {
    constexpr double quarter = std::numbers::pi / 2;
    cairo_new_sub_path(context);
    cairo_arc(context, r.x + r.width - radius, r.y + radius, radius, -quarter, 0);
    cairo_arc(context, r.x + r.width - radius, r.y + r.height - radius, radius, 0, quarter);
    cairo_arc(context, r.x + radius, r.y + r.height - radius, radius, quarter, 2 * quarter);
    cairo_arc(context, r.x + radius, r.y + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(context);
}

class SheetWriter final : public Writer {
  public:
    SheetWriter(const std::filesystem::path& path, const SheetFormat& sheet_format)
        : Writer(path,
                 {int(sheet_width(sheet_format)), int(sheet_height(sheet_format)), 0, false, sheet_format.called}),
          sheet(sheet_format) {}

  private:
    Failure start() override { return drawing.create(partial.path(), format.width, format.height); }

    Failure add(const Picture& picture) override {
        if (frames == std::size_t(sheet.columns) * std::size_t(sheet.rows))
            return fmt::format("it has room for {} pictures", frames);
        if (frames == 0) cover(drawing.context(), Mount(picture.background).paper);
        paint_frame(picture);
        write_caption(picture);
        return {};
    }

    Failure complete() override { return drawing.finish(); }
    void abandon() override { drawing.abandon(); }

    Region cell() const {
        const auto columns = std::size_t(sheet.columns);
        const auto column = int(frames % columns), row = int(frames / columns);
        return {double(gap + column * (sheet.frame_width + gap)),
                double(gap + row * (sheet.frame_height + caption_height)), double(sheet.frame_width),
                double(sheet.frame_height)};
    }

    void paint_frame(const Picture& picture) {
        cairo_t* const context = drawing.context();
        cairo_save(context);
        trace_rounded(context, cell(), corner_radius);
        cairo_clip(context);
        paint_fitted(context, picture, cell());
        cairo_restore(context);
    }

    void write_caption(const Picture& picture) {
        cairo_t* const context = drawing.context();
        const std::string text = fmt::format("{:.2f} s", sheet.first_second + double(frames) * sheet.seconds_between);
        cairo_select_font_face(context, caption_font, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(context, caption_size);
        cairo_text_extents_t extents;
        cairo_text_extents(context, text.c_str(), &extents);
        const Region below = cell();
        const Color ink = Mount(picture.background).ink;
        cairo_set_source_rgb(context, double(ink.red), double(ink.green), double(ink.blue));
        cairo_move_to(context, below.x + (below.width - extents.x_advance) / 2, below.y + below.height + 15);
        cairo_show_text(context, text.c_str());
    }

    const SheetFormat sheet;
    Drawing drawing;
};

} // namespace

Failure check_sheet(const std::filesystem::path& path, const SheetFormat& sheet) {
    const std::string grid = fmt::format("{}x{}", sheet.columns, sheet.rows);
    if (sheet.columns < 1 || sheet.rows < 1) return "a sheet of " + grid + " frames has no frames";
    // Checks the extension too, at a size that always passes.
    if (auto failure = check(path, {1, 1, 1})) return failure;
    const Format& kind = *format_of(path);
    if (kind.moves) return path.string() + ": a contact sheet is a still image; use .png, .svg or .pdf";
    const std::string frame = "a frame of a sheet";
    if (auto failure = size_problem(frame, sheet.frame_width, sheet.frame_height, kind.longest_side)) return failure;
    const std::string whole = "a sheet of " + grid + " such frames";
    return size_problem(whole, sheet_width(sheet), sheet_height(sheet), kind.longest_side);
}

Opened open_sheet(const std::filesystem::path& path, const SheetFormat& sheet) {
    if (auto failure = check_sheet(path, sheet)) return {nullptr, failure};
    return begun(std::make_unique<SheetWriter>(path, sheet));
}

} // namespace sinew::canvas
