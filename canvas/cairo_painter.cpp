#include "canvas/cairo_painter.h"

#include "canvas/image_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::canvas {
namespace {

using Outline = std::span<const Vec2<float>>;

/// Coordinate limit, device pixels. Cairo's 24.8 fixed point wraps beyond 8e6; no surface reaches further than 16384.
constexpr double farthest = 1e6;

/// User units per device pixel.
double pixel_of(cairo_t* context) {
    double dx = 1, dy = 0;
    cairo_device_to_user_distance(context, &dx, &dy);
    return std::hypot(dx, dy);
}

bool is_paintable(Outline outline) {
    return !outline.empty() && std::ranges::all_of(outline, [](const auto& p) { return is_finite(p); });
}

void set_color(cairo_t* context, const Color& color) {
    cairo_set_source_rgba(context, double(color.red), double(color.green), double(color.blue), double(color.alpha));
}

/// Appends the outline to the path. A first line_to begins the path.
void trace(cairo_t* context, Outline outline, double pixel) {
    const double far = farthest * pixel;
    for (const auto& p : outline)
        cairo_line_to(context, clamp(double(p[0]), -far, far), clamp(double(p[1]), -far, far));
}

void fill_disc(cairo_t* context, Vec2<float> center, double diameter, double pixel) {
    const double far = farthest * pixel;
    cairo_arc(context, clamp(double(center[0]), -far, far), clamp(double(center[1]), -far, far), diameter / 2, 0,
              2 * std::numbers::pi);
    cairo_fill(context);
}

void stroke(cairo_t* context, double width) {
    cairo_set_line_width(context, width);
    cairo_stroke(context);
}

void paint_item(cairo_t* context, Shape shape, Outline outline, double width, double pixel) {
    switch (shape) {
    case Shape::polyline:
        if (outline.size() == 1) return fill_disc(context, outline[0], width, pixel);
        trace(context, outline, pixel);
        return stroke(context, width);
    case Shape::loop:
        if (outline.size() == 1) return fill_disc(context, outline[0], width, pixel);
        trace(context, outline, pixel);
        cairo_close_path(context);
        return stroke(context, width);
    case Shape::disc:
        return fill_disc(context, outline[0], width, pixel);
    case Shape::polygon:
        trace(context, outline, pixel);
        cairo_close_path(context);
        return cairo_fill(context);
    case Shape::image:
    case Shape::text:
    case Shape::pane:
        return; // not drawn as a path alone
    }
}

/// Fills the rectangle between two corners with the paper colour and clips all further painting to the rectangle.
void begin_pane(cairo_t* context, Outline corners, const Color& paper) {
    const auto low = [&](int i) { return double(min(corners[0][i], corners[1][i])); };
    const auto side = [&](int i) { return double(absolute(corners[1][i] - corners[0][i])); };
    cairo_restore(context); // ends the previous pane
    cairo_save(context);
    cairo_rectangle(context, low(0), low(1), side(0), side(1));
    cairo_clip(context);
    cover(context, paper);
}

/// Width of the rim around letters, both sides together, as a fraction of the letters' height.
constexpr double text_rim = 0.25;

void set_font(cairo_t* context, double height) {
    cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, height);
}

} // namespace

void cover(cairo_t* context, const Color& color) {
    set_color(context, color);
    cairo_paint(context);
}

void write(cairo_t* context, const std::string& text, Vec2<float> middle, double height, const Color& color,
           const Color& paper) {
    cairo_text_extents_t extents;
    set_font(context, height);
    cairo_text_extents(context, text.c_str(), &extents);
    const double x = double(middle[0]) - extents.x_bearing - extents.width / 2;
    const double y = double(middle[1]) - extents.y_bearing - extents.height / 2;
    cairo_save(context);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    set_color(context, paper);
    cairo_move_to(context, x, y);
    cairo_text_path(context, text.c_str());
    stroke(context, height * text_rim);
    cairo_restore(context);
    set_color(context, color);
    cairo_move_to(context, x, y);
    cairo_show_text(context, text.c_str());
    cairo_new_path(context); // show_text leaves a current point, where the next path would begin
}

Vec2<double> size_of_text(const std::string& text, double height) {
    const CairoSurface nowhere(cairo_recording_surface_create(CAIRO_CONTENT_ALPHA, nullptr));
    const CairoContext context(cairo_create(nowhere.get()));
    set_font(context.get(), height);
    cairo_text_extents_t extents;
    cairo_text_extents(context.get(), text.c_str(), &extents);
    const double rim = height * text_rim + 2;
    return {{extents.width + rim, extents.height + rim}};
}

void paint(cairo_t* context, const Picture& picture) {
    cairo_save(context);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
    const double pixel = pixel_of(context);
    cover(context, picture.background);
    ImagePainter images(context, picture);
    Color paper = picture.background;
    cairo_save(context);
    for (const Picture::Item& item : picture.items) {
        const Outline outline = picture.points_of(item);
        if (!is_paintable(outline)) continue;
        if (item.shape == Shape::pane && outline.size() == 2) begin_pane(context, outline, paper = item.color);
        if (item.shape == Shape::image) images.paint(item);
        if (item.shape == Shape::image || item.color.alpha <= 0) continue;
        // A width that is not a number also becomes one pixel.
        const double width = item.width >= pixel ? min(double(item.width), farthest * pixel) : pixel;
        set_color(context, item.color);
        if (item.shape == Shape::text && item.number < picture.texts.size())
            write(context, picture.texts[item.number], outline[0], width, item.color, paper);
        paint_item(context, item.shape, outline, width, pixel);
    }
    cairo_restore(context);
    cairo_restore(context);
}

void paint_fitted(cairo_t* context, const Picture& picture, const Region& region) {
    cairo_save(context);
    cairo_rectangle(context, region.x, region.y, region.width, region.height);
    cairo_clip(context);
    const double width = picture.width > 0 ? picture.width : region.width;
    const double height = picture.height > 0 ? picture.height : region.height;
    const double scale = min(region.width / width, region.height / height);
    cairo_translate(context, region.x + (region.width - scale * width) / 2,
                    region.y + (region.height - scale * height) / 2);
    cairo_scale(context, scale, scale);
    paint(context, picture);
    cairo_restore(context);
}

} // namespace sinew::canvas
