#include "canvas/image_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sinew::canvas {
namespace {

using Point = Vec2<float>;

/// Coordinate limit, user units: cairo counts in fixed point, and grids beyond the limit are skipped.
constexpr float drawn_within = 1e6F;

/// A grid of points with an image mapped onto the cells.
struct Grid {
    std::span<const Point> points;
    std::size_t across = 0, down = 0; ///< points
    cairo_surface_t* image = nullptr;
    double width = 0, height = 0; ///< size of the image, pixels
    /// Cairo's better filters are several times slower. Bilinear is as good while the image is at most twice the size
    /// on screen.
    cairo_filter_t filter = CAIRO_FILTER_BILINEAR;

    const Point& at(std::size_t row, std::size_t column) const { return points[row * across + column]; }
};

/// A part of a grid onto which the image is mapped affinely.
struct Facet {
    std::span<const Point> corners;
    Point right{}, below{}; ///< images of a step by one pixel to the right and by one pixel down, in user space
    Point position{};       ///< image of the pixel (u, v), in user space
    double u = 0, v = 0;

    /// Matrix from user space to image pixels; false if the facet has no area.
    bool way_back(cairo_matrix_t& matrix) const {
        cairo_matrix_init(&matrix, double(right[0]), double(right[1]), double(below[0]), double(below[1]),
                          double(position[0]), double(position[1]));
        cairo_matrix_translate(&matrix, -u, -v);
        return cairo_matrix_invert(&matrix) == CAIRO_STATUS_SUCCESS;
    }
};

void trace(cairo_t* context, std::span<const Point> corners) {
    cairo_new_path(context);
    for (const auto& p : corners) cairo_line_to(context, double(p[0]), double(p[1]));
    cairo_close_path(context);
}

/// Sets the image as the source of the context under the given matrix. The returned pattern lives as long as the
/// source.
cairo_pattern_t* take(cairo_t* context, const Grid& grid, const cairo_matrix_t& matrix) {
    cairo_set_source_surface(context, grid.image, 0, 0);
    cairo_pattern_t* const pattern = cairo_get_source(context);
    cairo_pattern_set_matrix(pattern, &matrix);
    cairo_pattern_set_extend(pattern, CAIRO_EXTEND_PAD);
    cairo_pattern_set_filter(pattern, grid.filter);
    return pattern;
}

/// Paints the grid's image on a facet and blends a colour over the image, weighted by the image's alpha.
void paint_facet(cairo_t* context, const Facet& facet, const Grid& grid, const Color& over) {
    cairo_matrix_t matrix;
    if (!facet.way_back(matrix)) return;
    cairo_save(context);
    trace(context, facet.corners);
    if (over.alpha < 1) {
        take(context, grid, matrix);
        cairo_fill_preserve(context);
    }
    if (over.alpha > 0) {
        cairo_clip_preserve(context);
        cairo_pattern_t* const mask = cairo_pattern_reference(take(context, grid, matrix));
        cairo_pattern_set_extend(mask, CAIRO_EXTEND_NONE); // a padded mask masks nothing in a PDF
        cairo_set_source_rgba(context, double(over.red), double(over.green), double(over.blue), double(over.alpha));
        cairo_mask(context, mask);
        cairo_pattern_destroy(mask);
    }
    cairo_restore(context);
    cairo_new_path(context); // the path outlives cairo_restore
}

/// True if the grid is a single facet: four corners of a parallelogram.
bool is_flat(const Grid& grid) {
    if (grid.across != 2 || grid.down != 2) return false;
    constexpr float min = 0.05F; // pixels
    return norm(grid.at(1, 1) - grid.at(1, 0) - grid.at(0, 1) + grid.at(0, 0)) < min;
}

void paint_flat(cairo_t* context, const Grid& grid, const Color& over) {
    const auto &origin = grid.at(0, 0), &right = grid.at(0, 1), &below = grid.at(1, 0);
    const std::array corners = {origin, right, right + below - origin, below};
    paint_facet(context,
                {corners, (right - origin) * float(1 / grid.width), (below - origin) * float(1 / grid.height), origin},
                grid, over);
}

/// Affine texture mapping of two triangles per cell: continuous across the grid. Each triangle extends by `seam` under
/// later ones, which hides the antialiased edges.
void paint_cells(cairo_t* context, const Grid& grid, float seam, const Color& over) {
    const double du = grid.width / double(grid.across - 1), dv = grid.height / double(grid.down - 1);
    for (std::size_t row = 0; row + 1 < grid.down; ++row)
        for (std::size_t column = 0; column + 1 < grid.across; ++column) {
            const auto &a = grid.at(row, column), &b = grid.at(row, column + 1);
            const auto &c = grid.at(row + 1, column), &d = grid.at(row + 1, column + 1);
            const auto on = column + 2 < grid.across ? direction(b - a + d - c) * seam : Point{};
            const auto down = row + 2 < grid.down ? direction(c - a + d - b) * seam : Point{};
            const auto over_there = direction(perpendicular(b - c)) * seam;
            const double u = du * double(column), v = dv * double(row);
            const std::array first = {a, b + on, b + on + over_there, c + down + over_there, c + down};
            const std::array second = {d + on + down, c + down, b + on};
            paint_facet(context, {first, (b - a) * float(1 / du), (c - a) * float(1 / dv), a, u, v}, grid, over);
            paint_facet(context, {second, (d - c) * float(1 / du), (d - b) * float(1 / dv), d, u + du, v + dv}, grid,
                        over);
        }
}

/// Part of the grid's bounding box inside the clip, in user units; false if empty.
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

/// Maps the image into a raster finer than the device, without antialiasing: every fine pixel belongs to one triangle,
/// so that there are no seams. The raster is then painted like a flat image, which smooths all edges.
void paint_bent(cairo_t* context, const Grid& grid, const Color& over) {
    cairo_rectangle_t part;
    if (!seen_part(context, grid.points, part)) return;
    double scale = 1, unused = 0;
    cairo_user_to_device_distance(context, &scale, &unused);
    constexpr double finest = 3, max_pixels = 1 << 24;
    const double fine = scale * std::fmin(finest, std::sqrt(max_pixels / (part.width * part.height * scale * scale)));
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
    paint_flat(context, {corners, 2, 2, bent.get(), double(width), double(height), CAIRO_FILTER_GOOD}, over);
}

bool has_pixels(cairo_t* context) {
    return cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE;
}

/// Level of the image's pyramid: the smallest with at least the pixels on screen. `pixel`: user units per device pixel.
const Image& fitting(const Image& whole, const Grid& grid, double pixel) {
    float across = 0, down = 0;
    for (std::size_t i = 0; i + 1 < grid.across; ++i) across += distance(grid.at(0, i), grid.at(0, i + 1));
    for (std::size_t i = 0; i + 1 < grid.down; ++i) down += distance(grid.at(i, 0), grid.at(i + 1, 0));
    const Image* image = &whole;
    while (image->half && image->width * pixel >= 2 * double(across) && image->height * pixel >= 2 * double(down))
        image = image->half.get();
    return *image;
}

} // namespace

void ImagePainter::paint(const Picture::Item& item) {
    if (item.number >= picture_.images.size() || !picture_.images[item.number]) return;
    Grid grid{.points = picture_.points_of(item),
              .across = item.across,
              .down = item.across > 0 ? item.count / item.across : 0};
    const auto is_near = [](const Point& p) { return absolute(p[0]) < drawn_within && absolute(p[1]) < drawn_within; };
    if (grid.across < 2 || grid.down < 2 || !std::ranges::all_of(grid.points, is_near)) return;

    double pixel = 1, unused = 0;
    cairo_device_to_user_distance(context_, &pixel, &unused);
    const bool raster = has_pixels(context_); // vectors are viewed at any size
    const Image& whole = *picture_.images[item.number];
    const Image& image = raster ? fitting(whole, grid, pixel) : whole;
    grid.image = surface_of(image);
    grid.width = image.width;
    grid.height = image.height;
    constexpr float overlap = 0.4F; // pixels
    if (is_flat(grid))
        paint_flat(context_, grid, item.color);
    else if (raster)
        paint_bent(context_, grid, item.color);
    else
        paint_cells(context_, grid, overlap, item.color);
}

cairo_surface_t* ImagePainter::surface_of(const Image& image) {
    auto& surface = surfaces_[&image];
    if (!surface) {
        // Cairo only reads the pixels but takes a mutable pointer.
        auto* const pixels = const_cast<std::uint32_t*>(image.pixels.data());
        surface.reset(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels), CAIRO_FORMAT_ARGB32,
                                                          image.width, image.height,
                                                          image.width * int(sizeof *pixels)));
    }
    return surface.get();
}

} // namespace sinew::canvas
