#pragma once

#include "sinew/picture/piece_renderer.h"
#include "sinew/picture/style_resolver.h"
#include "sinew/scene/scene.h"
#include "sinew/session/view.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <optional>

namespace sinew {

inline bool is_area(const Piece& piece) {
    return piece.mark == Mark::fill || is_cloth(piece.mark);
}

inline bool is_round(const Piece& piece) {
    return piece.mark == Mark::dot || piece.mark == Mark::tip || piece.mark == Mark::face;
}

/// Projects the pieces of a world's figures to pixels.
template <class WorldT> class PieceProjector {
  public:
    /// Keeps references to all arguments.
    PieceProjector(const Scene& scene, const WorldT& world, const View& view)
        : scene_(scene), world_(world), view_(view) {}

    /// Position of a particle; empty if removed.
    std::optional<Vec3<double>> position_of(ParticleId id) const {
        const auto row = row_of(world_, id);
        if (!row) return std::nullopt;
        Vec3<double> wide{};
        for (int i = 0; i < WorldT::dimension; ++i) wide[i] = double(world_.particles.position[*row][i]);
        return wide;
    }

    /// Projects a piece. False if a particle has been removed or lies behind the eye.
    bool project(const Piece& piece, const Style& style, ProjectedPiece& projected) const {
        return project(piece, style, projected, [this](const Vec3<double>& position) { return view_.see(position); });
    }
    /// Projects a piece by see(place), in place of the view.
    template <class See>
    bool project(const Piece& piece, const Style& style, ProjectedPiece& projected, See&& see) const {
        projected.mark = piece.mark;
        projected.points.clear();
        float sum = 0;
        for (const auto id : piece.particles) {
            const auto position = position_of(id);
            const auto seen = position ? see(*position) : std::nullopt;
            if (!seen) return false;
            projected.points.push_back(seen->pixel);
            sum += seen->scale;
        }
        projected.scale = sum / float(std::max<std::size_t>(piece.particles.size(), 1));
        projected.width = width_of(piece, style) * projected.scale;
        projected.end_width =
            piece.end_width > 0 ? float(piece.end_width / piece.width) * projected.width : projected.width;
        return !projected.points.empty();
    }

    /// Mean depth of the particles; a face has the depth of the head.
    float depth_of(const Piece& piece) const {
        float sum = 0;
        if (piece.mark == Mark::face && !piece.particles.empty())
            return depth_of({.mark = Mark::dot, .particles = {piece.particles[piece.particles.size() - 1]}});
        for (const auto id : piece.particles)
            if (const auto position = position_of(id))
                if (const auto seen = view_.see(*position)) sum += seen->depth;
        return sum / float(std::max<std::size_t>(piece.particles.size(), 1));
    }

  private:
    /// Line width or diameter, in the scene's units of length.
    float width_of(const Piece& piece, const Style& style) const {
        constexpr double usual_line = 0.04, usual_dot = 0.07; // metres
        const double usual = (is_round(piece) ? usual_dot : usual_line) * scene_.measures().per_metre;
        return float(style.width.value_or(piece.width > 0 ? piece.width : usual));
    }

    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
};

} // namespace sinew
