#pragma once

#include "sinew/session/order.h"
#include "sinew/session/outline.h"
#include "sinew/session/picture.h"
#include "sinew/session/surface.h"
#include "sinew/session/view.h"
#include "sinew/session/wardrobe.h"

#include <algorithm>

namespace sinew {

/// Paints the cells of cloth, whole ones and what blades left of them.
template <class WorldT> class ClothPainter {
  public:
    /// All are kept by reference; `unit` is how many pixels a nominal pixel has.
    ClothPainter(const WorldT& world, const View& view, const Light& light, float unit, Picture& picture)
        : world_(world), view_(view), light_(light), unit_(unit), picture_(picture) {}

    /// The normals of a figure's cloth, smooth from cell to cell.
    void find_normals(const Figure& figure, const std::vector<Drawn>& order) {
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
        const float step = 1.0F / float(parts);
        for (int i = 0; i < parts; ++i)
            for (int k = 0; k < parts; ++k) {
                const float u = float(i) * step, v = float(k) * step;
                const std::array<Vec2<float>, 4> tile = {
                    {{{u, v}}, {{u + step, v}}, {{u + step, v + step}}, {{u, v + step}}}};
                paint_tile(*patch, tile, style);
            }
    }

    /// Calls visit(places) for each tile of a fragment, its corners in space.
    template <class Visit> void each_tile(const Figure& figure, const Piece& piece, Visit&& visit) const {
        const auto patch = patch_of(figure, piece);
        if (!patch) return;
        std::vector<Vec3<double>> places;
        figure.fragments[piece.fragment].each_tile([&](std::span<const Vec2<float>> tile) {
            places.clear();
            for (const auto& uv : tile) places.push_back(place_at(*patch, double(uv[0]), double(uv[1])));
            visit(std::span<const Vec3<double>>(places));
        });
    }

  private:
    static constexpr int D = WorldT::dimension;
    const WorldT& world_;
    const View& view_;
    const Light& light_;
    const float unit_;
    Picture& picture_;
    std::vector<Vec3<double>> normals_; // by row
    Pixels shape_;

    Vec3<double> place_in_space(Row row) const {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(world_.particles.position[row][i]);
        return wide;
    }

    /// Calls visit(row, is_particle) for the particle at each corner, or the base of a virtual node there.
    template <class Visit> void each_corner(const Figure& figure, const Piece& piece, Visit&& visit) const {
        for (std::size_t i = 0; i < 4; ++i) {
            const auto* node = piece.mark == Mark::fragment ? &figure.fragments[piece.fragment].corners[i] : nullptr;
            visit(*row_of(world_, piece.particles[node ? node->of[0] : i]), !node || node->is_particle());
        }
    }

    /// Nothing where one of its particles is gone.
    std::optional<Patch> patch_of(const Figure& figure, const Piece& piece) const {
        Patch patch;
        const bool whole = piece.mark == Mark::surface;
        if (whole && piece.particles.size() != patch.corner.size()) return std::nullopt;
        for (const auto id : piece.particles)
            if (!row_of(world_, id)) return std::nullopt;
        std::size_t i = 0;
        each_corner(figure, piece, [&](Row row, bool is_particle) {
            const auto place = [&](std::size_t k) { return place_in_space(*row_of(world_, piece.particles[k])); };
            patch.corner[i] = is_particle ? place_in_space(row)
                                          : place_of(figure.fragments[piece.fragment].corners[i], place, D == 2);
            if (row < normals_.size()) patch.normal[i] = direction(normals_[row]);
            ++i;
        });
        return patch;
    }

    static Vec3<double> place_at(const Patch& patch, double u, double v) {
        return D == 3 ? bulge(patch, u, v) : flat(patch, u, v);
    }

    /// Into how many tiles a side of a cell is divided, so that shades run smoothly.
    int parts_of(const Patch& patch) const {
        constexpr float finest = 4.5F; // pixels
        constexpr int most = 8;
        float side = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto a = view_.see(patch.corner[i]), b = view_.see(patch.corner[(i + 1) % 4]);
            if (a && b) side = maximum(side, distance(a->pixel, b->pixel));
        }
        return 1 + int(minimum(side / (finest * maximum(unit_, 1.0F)), float(most - 1)));
    }

    void paint_tile(const Patch& patch, std::span<const Vec2<float>> tile, const Style& style) {
        constexpr float seam = 0.5F; // pixels
        shape_.clear();
        Vec2<float> middle{};
        for (const auto& uv : tile) {
            const auto seen = view_.see(place_at(patch, double(uv[0]), double(uv[1])));
            if (!seen) return;
            shape_.push_back(seen->pixel);
            middle += uv * (1 / float(tile.size()));
        }
        widen(shape_, seam);
        const auto normal = normal_at(patch, double(middle[0]), double(middle[1]));
        picture_.add(Shape::polygon, shape_, 0, light_.shade(style.color, style.fill, normal));
    }
};

} // namespace sinew
