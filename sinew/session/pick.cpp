#include "sinew/session/pick.h"

#include "sinew/math/sort.h"

#include <algorithm>
#include <limits>

namespace sinew {
namespace {

template <class WorldT> class Picker {
  public:
    Picker(const WorldT& world, const View& view, Vec2<double> pixel, double radius)
        : world_(world), view_(view), pixel_(cast<float>(pixel)), radius_(float(radius)) {
        for (const auto& position : world.particles.position) seen_.push_back(view.see(in_space(position)));
    }

    std::optional<Picked> pick() {
        particles();
        if (best_) return best_;
        for (FigureIndex i = 0; i < world_.figures.size(); ++i)
            for (const auto& piece : world_.figures[i].pieces)
                if (!piece.hidden) lines(piece, i);
        if (best_) return best_;
        for (FigureIndex i = Row(world_.figures.size()); i-- > 0;)
            for (const auto& piece : world_.figures[i].pieces)
                if (piece.mark == Mark::fill && !best_) inside(piece, i);
        return best_;
    }

  private:
    static constexpr int D = WorldT::dimension;
    const WorldT& world_;
    const View& view_;
    const Vec2<float> pixel_;
    const float radius_;
    std::vector<std::optional<View::Seen>> seen_;
    std::optional<Picked> best_;
    float best_score_ = std::numeric_limits<float>::infinity();

    static Vec3<double> in_space(const Vec<D, typename WorldT::Real>& position) {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(position[i]);
        return wide;
    }

    bool movable(Row row) const { return world_.particles.mobility[row] > 0; }

    /// Keeps the candidate with the lowest score, the distance to the pointer in pixels.
    void offer(float score, Picked picked) {
        if (score >= best_score_) return;
        best_score_ = score;
        best_ = std::move(picked);
    }

    Picked at(std::vector<ParticleId> members, const Vec3<double>& position, FigureIndex figure) const {
        Picked picked{.members = std::move(members), .position = {}, .figure = figure};
        for (int i = 0; i < D; ++i) picked.position[i] = position[i];
        if (const auto seen = view_.see(position)) picked.depth = double(seen->depth), picked.pixel = seen->pixel;
        return picked;
    }

    void particles() {
        for (Row row = 0; row < seen_.size(); ++row) {
            const auto& seen = seen_[row];
            if (!seen || !movable(row)) continue;
            const float away = distance(seen->pixel, pixel_);
            if (away <= radius_)
                offer(away, at({world_.particles.handles.id_of(row)}, in_space(world_.particles.position[row]),
                               world_.particles.figure[row]));
        }
    }

    /// Segments of a piece, with the width of the piece.
    void lines(const Piece& piece, FigureIndex figure) {
        if (piece.mark == Mark::dot || piece.mark == Mark::face || is_cloth(piece.mark)) return;
        const bool closed = piece.mark == Mark::loop || piece.mark == Mark::fill;
        const auto count = piece.particles.size();
        for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
            line(piece, piece.particles[i], piece.particles[(i + 1) % count], figure);
    }

    void line(const Piece& piece, ParticleId from, ParticleId to, FigureIndex figure) {
        const auto a = row_of(world_, from), b = row_of(world_, to);
        if (!a || !b || *a == *b || !seen_[*a] || !seen_[*b] || (!movable(*a) && !movable(*b))) return;
        const auto along = seen_[*b]->pixel - seen_[*a]->pixel;
        const float share =
            clamp(dot(pixel_ - seen_[*a]->pixel, along) * inverse_or_zero(dot(along, along)), 0.0F, 1.0F);
        const float away = distance(pixel_, seen_[*a]->pixel + along * share);
        const float half_width = float(piece.width) * 0.5F * seen_[*a]->scale;
        if (away > max(radius_ * 0.5F, half_width)) return;
        const auto start = in_space(world_.particles.position[*a]), end = in_space(world_.particles.position[*b]);
        offer(away, at({from, to}, start + (end - start) * double(share), figure));
    }

    /// 2D: a point within a filled polygon, held by the three nearest corners; a fourth would overdetermine the grab.
    void inside(const Piece& piece, FigureIndex figure) {
        if (D == 3) return;
        bool odd = false, moves = false;
        std::vector<std::pair<float, ParticleId>> corners;
        const auto count = piece.particles.size();
        for (std::size_t i = 0, before = count - 1; i < count; before = i++) {
            const auto row = row_of(world_, piece.particles[i]), last = row_of(world_, piece.particles[before]);
            if (!row || !last || !seen_[*row] || !seen_[*last]) return;
            const auto p = seen_[*row]->pixel, q = seen_[*last]->pixel;
            if ((p[1] > pixel_[1]) != (q[1] > pixel_[1]) &&
                pixel_[0] < (q[0] - p[0]) * (pixel_[1] - p[1]) / (q[1] - p[1]) + p[0])
                odd = !odd;
            moves = moves || movable(*row);
            corners.emplace_back(distance(p, pixel_), piece.particles[i]);
        }
        if (!odd || !moves || count < 3) return;
        sinew::stable_sort(corners.begin(), corners.end(), [](auto& a, auto& b) { return a.first < b.first; });
        const auto position = view_.position_of(cast<double>(pixel_));
        best_ = at({corners[0].second, corners[1].second, corners[2].second}, {{position[0], position[1], 0}}, figure);
    }
};

} // namespace

std::optional<Picked> pick(const AnyWorld& world, const View& view, Vec2<double> pixel, double radius) {
    return std::visit([&](const auto& any) { return Picker(any, view, pixel, radius).pick(); }, world);
}

std::string name_of(const AnyWorld& world, ParticleId id) {
    return std::visit(
        [&](const auto& any) -> std::string {
            const auto row = row_of(any, id);
            if (!row || any.particles.figure[*row] >= any.figures.size()) return "";
            const auto& figure = any.figures[any.particles.figure[*row]];
            for (const auto& [name, named] : figure.particle_names)
                if (named == id) return figure.name + "/" + std::string(name);
            const auto at = std::find(figure.particles.begin(), figure.particles.end(), id) - figure.particles.begin();
            const auto name = sinew::name_of(std::size_t(at), figure.particle_numbers);
            return name.empty() ? figure.name : figure.name + "/" + name;
        },
        world);
}

std::optional<Point> position_of(const AnyWorld& world, std::span<const ParticleId> members) {
    return std::visit(
        [&]<class WorldT>(const WorldT& any) -> std::optional<Point> {
            Point middle;
            for (const auto id : members) {
                const auto position = position_of(any, id);
                if (!position) return std::nullopt;
                for (int i = 0; i < WorldT::dimension; ++i)
                    middle[i] += double((*position)[i]) / double(members.size());
            }
            return middle;
        },
        world);
}

} // namespace sinew
