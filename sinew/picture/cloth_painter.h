#pragma once

#include "sinew/picture/order.h"
#include "sinew/picture/outline.h"
#include "sinew/picture/picture.h"
#include "sinew/picture/style_resolver.h"
#include "sinew/picture/surface.h"
#include "sinew/session/view.h"

#include <algorithm>

namespace sinew {

/// Paints the cells of cloth: whole cells, and the fragments a cut leaves.
template <class WorldT> class ClothPainter {
  public:
    /// Keeps references to all arguments but `unit`, the pixels per nominal pixel.
    ClothPainter(const WorldT& world, const View& view, const Light& light, float unit, Picture& picture)
        : world_(world), view_(view), light_(light), unit_(unit), picture_(picture) {}

    /// Vertex normals of a figure's cloth: area-weighted means over the adjacent cells.
    void find_normals(const Figure& figure, const std::vector<DrawItem>& order) {
        normals_.clear();
        for (const auto& [piece, depth, group] : order) {
            if (!is_cloth(piece->mark)) continue;
            if (normals_.empty()) normals_.resize(world_.particles.size());
            const auto patch = patch_of(figure, *piece);
            if (!patch) continue;
            const auto normal = own_normal<D>(*patch);
            each_corner(figure, *piece, [&](Row row, bool is_particle) {
                if (is_particle) normals_[row] += normal;
            });
        }
    }

    void paint(const Figure& figure, const Piece& piece, const Style& style) {
        const auto patch = patch_of(figure, piece);
        if (!patch) return;
        if (piece.mark == Mark::fragment)
            return figure.fragments[piece.fragment].each_tile(
                [&](std::span<const Vec2<float>> tile) { paint_tile(*patch, tile, style); });
        const int parts = parts_of(*patch);
        see_corners(*patch, parts);
        const auto at = [&](int i, int k) { return std::size_t(i * (parts + 1) + k); };
        const double step = 1.0 / parts;
        for (int i = 0; i < parts; ++i)
            for (int k = 0; k < parts; ++k) {
                shape_.clear();
                for (const auto corner : {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)})
                    if (corners_[corner]) shape_.push_back(corners_[corner]->pixel);
                if (shape_.size() == 4) paint_shape(*patch, (i + 0.5) * step, (k + 0.5) * step, style);
            }
    }

    /// Calls visit(places) for each tile of a fragment, with the tile's corners in space.
    template <class Visit> void each_tile(const Figure& figure, const Piece& piece, Visit&& visit) const {
        const auto patch = patch_of(figure, piece);
        if (!patch) return;
        std::vector<Vec3<double>> positions;
        figure.fragments[piece.fragment].each_tile([&](std::span<const Vec2<float>> tile) {
            positions.clear();
            for (const auto& uv : tile) positions.push_back(place_at(*patch, double(uv[0]), double(uv[1])));
            visit(std::span<const Vec3<double>>(positions));
        });
    }

  private:
    static constexpr int D = WorldT::dimension;
    const WorldT& world_;
    const View& view_;
    const Light& light_;
    const float unit_;
    Picture& picture_;
    std::vector<Vec3<double>> normals_;              // by row of the particles
    std::vector<std::optional<View::Seen>> corners_; // of the tiles of a cell
    Pixels shape_;

    Vec3<double> position_in_space(Row row) const {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(world_.particles.position[row][i]);
        return wide;
    }

    /// Calls visit(row, is_particle) for each corner: the particle there, or the base particle of a virtual node.
    template <class Visit> void each_corner(const Figure& figure, const Piece& piece, Visit&& visit) const {
        for (std::size_t i = 0; i < 4; ++i) {
            const auto* node = piece.mark == Mark::fragment ? &figure.fragments[piece.fragment].corners[i] : nullptr;
            visit(*row_of(world_, piece.particles[node ? node->of[0] : i]), !node || node->is_particle());
        }
    }

    /// Empty if one of the piece's particles has been removed.
    std::optional<Patch> patch_of(const Figure& figure, const Piece& piece) const {
        Patch patch;
        const bool whole = piece.mark == Mark::surface;
        if (whole && piece.particles.size() != patch.corner.size()) return std::nullopt;
        for (const auto id : piece.particles)
            if (!row_of(world_, id)) return std::nullopt;
        std::size_t i = 0;
        each_corner(figure, piece, [&](Row row, bool is_particle) {
            const auto position = [&](std::size_t k) { return position_in_space(*row_of(world_, piece.particles[k])); };
            patch.corner[i] = is_particle ? position_in_space(row)
                                          : position_of(figure.fragments[piece.fragment].corners[i], position, D == 2);
            if (row < normals_.size()) patch.normal[i] = direction(normals_[row]);
            ++i;
        });
        return patch;
    }

    static Vec3<double> place_at(const Patch& patch, double u, double v) {
        return D == 3 ? bulge(patch, u, v) : flat(patch, u, v);
    }

    /// Number of tiles along a side of a cell, 1 to 8: fine enough for smooth shading.
    int parts_of(const Patch& patch) const {
        constexpr float finest = 4.5F; // pixels, longest side of a tile
        constexpr int max_tiles = 8;
        float side = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto a = view_.see(patch.corner[i]), b = view_.see(patch.corner[(i + 1) % 4]);
            if (a && b) side = max(side, distance(a->pixel, b->pixel));
        }
        return 1 + int(clamp(side / (finest * max(unit_, 1.0F)), 0.0F, float(max_tiles - 1)));
    }

    /// Projects the corners of all tiles of a cell into corners_, row by row.
    void see_corners(const Patch& patch, int parts) {
        const double step = 1.0 / parts;
        corners_.clear();
        for (int i = 0; i <= parts; ++i)
            for (int k = 0; k <= parts; ++k) corners_.push_back(view_.see(place_at(patch, i * step, k * step)));
    }

    void paint_tile(const Patch& patch, std::span<const Vec2<float>> tile, const Style& style) {
        shape_.clear();
        Vec2<float> middle{};
        for (const auto& uv : tile) {
            const auto seen = view_.see(place_at(patch, double(uv[0]), double(uv[1])));
            if (!seen) return;
            shape_.push_back(seen->pixel);
            middle += uv * (1 / float(tile.size()));
        }
        paint_shape(patch, double(middle[0]), double(middle[1]), style);
    }

    /// Paints the tile in shape_ in the colour of its middle.
    void paint_shape(const Patch& patch, double u, double v, const Style& style) {
        constexpr float seam = 0.5F; // pixels
        widen(shape_, seam);
        picture_.add(Shape::polygon, shape_, 0, light_.shade(style.color, style.fill, normal_at(patch, u, v)));
    }
};

} // namespace sinew
