#include "canvas/image_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sinew::canvas {
namespace {

using Point = Vec2<float>;

/// Cairo counts in fixed point: what reaches further than this is left out.
constexpr float farthest = 1e6F;

/// A grid of points with an image over it.
struct Grid {
    std::span<const Point> points;
    std::size_t across = 0, down = 0; ///< points
    cairo_surface_t* image = nullptr;
    double width = 0, height = 0; ///< of the image, pixels

    const Point& at(std::size_t row, std::size_t column) const { return points[row * across + column]; }
};

/// A part of a grid that an image is only moved, turned, scaled and sheared onto.
struct Facet {
    std::span<const Point> corners;
    Point right{}, below{}; ///< what a pixel of the image to the right and one below are in the user's space
    Point place{};          ///< where this pixel is:
    double u = 0, v = 0;

    /// From the user's space to the image; false where the facet has no area.
    bool way_back(cairo_matrix_t& matrix) const {
        cairo_matrix_init(&matrix, double(right[0]), double(right[1]), double(below[0]), double(below[1]),
                          double(place[0]), double(place[1]));
        cairo_matrix_translate(&matrix, -u, -v);
        return cairo_matrix_invert(&matrix) == CAIRO_STATUS_SUCCESS;
    }
};

void trace(cairo_t* context, std::span<const Point> corners) {
    cairo_new_path(context);
    for (const auto& p : corners) cairo_line_to(context, double(p[0]), double(p[1]));
    cairo_close_path(context);
}

/// The image on a facet, and a colour laid over it, which is as strong as the image is there.
void paint_facet(cairo_t* context, const Facet& facet, cairo_surface_t* image, const Color& over) {
    cairo_matrix_t matrix;
    if (!facet.way_back(matrix)) return;
    cairo_save(context);
    trace(context, facet.corners);
    cairo_set_source_surface(context, image, 0, 0);
    cairo_pattern_t* const pattern = cairo_pattern_reference(cairo_get_source(context));
    cairo_pattern_set_matrix(pattern, &matrix);
    cairo_pattern_set_extend(pattern, CAIRO_EXTEND_PAD);
    if (over.alpha < 1) cairo_fill_preserve(context);
    if (over.alpha > 0) {
        cairo_clip(context);
        cairo_set_source_rgba(context, double(over.red), double(over.green), double(over.blue), double(over.alpha));
        cairo_mask(context, pattern);
    }
    cairo_pattern_destroy(pattern);
    cairo_restore(context);
}

/// Whether the whole grid is one facet: four corners of a parallelogram.
bool is_flat(const Grid& grid) {
    if (grid.across != 2 || grid.down != 2) return false;
    constexpr float least = 0.05F; // pixels
    return norm(grid.at(1, 1) - grid.at(1, 0) - grid.at(0, 1) + grid.at(0, 0)) < least;
}

void paint_flat(cairo_t* context, const Grid& grid, const Color& over) {
    const auto &origin = grid.at(0, 0), &right = grid.at(0, 1), &below = grid.at(1, 0);
    const std::array corners = {origin, right, right + below - origin, below};
    paint_facet(context,
                {corners, (right - origin) * float(1 / grid.width), (below - origin) * float(1 / grid.height), origin},
                grid.image, over);
}

/// Two triangles a cell, in each of which the image is sheared evenly; together it bends without a gap. Neighbours
/// overlap by `seam`, which hides where cairo smooths their edges.
void paint_cells(cairo_t* context, const Grid& grid, float seam, const Color& over) {
    const double du = grid.width / double(grid.across - 1), dv = grid.height / double(grid.down - 1);
    const auto triangle = [&](const Point& place, const Point& beside, const Point& other, double u, double v,
                              float way) {
        std::array corners = {place, beside, other};
        const Point middle = (place + beside + other) * (1.0F / 3);
        for (auto& corner : corners) corner += direction(corner - middle) * seam;
        paint_facet(context,
                    {corners, (beside - place) * (way / float(du)), (other - place) * (way / float(dv)), place, u, v},
                    grid.image, over);
    };
    for (std::size_t row = 0; row + 1 < grid.down; ++row)
        for (std::size_t column = 0; column + 1 < grid.across; ++column) {
            const double u = du * double(column), v = dv * double(row);
            triangle(grid.at(row, column), grid.at(row, column + 1), grid.at(row + 1, column), u, v, 1);
            triangle(grid.at(row + 1, column + 1), grid.at(row + 1, column), grid.at(row, column + 1), u + du, v + dv,
                     -1);
        }
}

/// What a grid covers of what the context shows, in its user units; false if nothing.
bool seen_part(cairo_t* context, std::span<const Point> points, cairo_rectangle_t& part) {
    double left = 0, top = 0, right = 0, bottom = 0;
    cairo_clip_extents(context, &left, &top, &right, &bottom);
    const auto [low_x, high_x] = std::ranges::minmax(points, {}, [](const Point& p) { return p[0]; });
    const auto [low_y, high_y] = std::ranges::minmax(points, {}, [](const Point& p) { return p[1]; });
    left = std::fmax(left, std::floor(double(low_x[0])) - 1),
    right = std::fmin(right, std::ceil(double(high_x[0])) + 1);
    top = std::fmax(top, std::floor(double(low_y[1])) - 1),
    bottom = std::fmin(bottom, std::ceil(double(high_y[1])) + 1);
    part = {left, top, right - left, bottom - top};
    return left < right && top < bottom;
}

/// Bends the image into a raster several times as fine as the device, without smoothing: every little pixel belongs to
/// one triangle, so that there are no seams. Then that raster is painted like a flat image, which smooths all edges.
void paint_bent(cairo_t* context, const Grid& grid, const Color& over) {
    cairo_rectangle_t part;
    if (!seen_part(context, grid.points, part)) return;
    double scale = 1, unused = 0;
    cairo_user_to_device_distance(context, &scale, &unused);
    constexpr double finest = 3, most_pixels = 1 << 24;
    const double fine = scale * std::fmin(finest, std::sqrt(most_pixels / (part.width * part.height * scale * scale)));
    const int width = std::max(int(std::ceil(part.width * fine)), 1),
              height = std::max(int(std::ceil(part.height * fine)), 1);
    const CairoSurface bent(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
    const CairoContext pen(cairo_create(bent.get()));
    cairo_set_antialias(pen.get(), CAIRO_ANTIALIAS_NONE);
    cairo_scale(pen.get(), fine, fine);
    cairo_translate(pen.get(), -part.x, -part.y);
    paint_cells(pen.get(), grid, 0, {0, 0, 0, 0});
    const auto x = float(part.x), y = float(part.y), right = x + float(width / fine), below = y + float(height / fine);
    const std::array<Point, 4> corners = {{{{x, y}}, {{right, y}}, {{x, below}}, {{right, below}}}};
    paint_flat(context, {corners, 2, 2, bent.get(), double(width), double(height)}, over);
}

bool has_pixels(cairo_t* context) {
    return cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE;
}

} // namespace

void ImagePainter::paint(const Picture::Item& item) {
    if (item.number >= picture_.images.size() || !picture_.images[item.number]) return;
    const Image& image = *picture_.images[item.number];
    const Grid grid{.points = picture_.points_of(item),
                    .across = item.across,
                    .down = item.across > 0 ? item.count / item.across : 0,
                    .image = surface_of(item.number),
                    .width = double(image.width),
                    .height = double(image.height)};
    const auto is_near = [](const Point& p) { return absolute(p[0]) < farthest && absolute(p[1]) < farthest; };
    if (grid.across < 2 || grid.down < 2 || !std::ranges::all_of(grid.points, is_near)) return;
    constexpr float overlap = 0.4F; // pixels
    if (is_flat(grid))
        paint_flat(context_, grid, item.color);
    else if (has_pixels(context_))
        paint_bent(context_, grid, item.color);
    else
        paint_cells(context_, grid, overlap, item.color);
}

cairo_surface_t* ImagePainter::surface_of(std::uint32_t number) {
    surfaces_.resize(std::max(surfaces_.size(), std::size_t(number) + 1));
    auto& surface = surfaces_[number];
    if (!surface) {
        // Cairo only reads it, and wants to be able to write.
        auto* pixels = const_cast<std::uint32_t*>(picture_.images[number]->pixels.data());
        const Image& image = *picture_.images[number];
        surface.reset(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels), CAIRO_FORMAT_ARGB32,
                                                          image.width, image.height,
                                                          image.width * int(sizeof *pixels)));
    }
    return surface.get();
}

} // namespace sinew::canvas
