#pragma once

#include "sinew/math/format.h"
#include "sinew/math/union_find.h"
#include "sinew/scene/check.h"
#include "sinew/world/body_shape.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <vector>

/// Warnings of figures that begin in each other.
namespace sinew {

/// Figures with an inside, filled outlines and single spheres, that begin in each other and cannot touch. Silent are
/// figures joined by a constraint, figures kept apart by layers, and scenery, of which nothing moves: meant so.
template <int D, class Real> class OverlapCheck {
  public:
    using Vector = Vec<D, Real>;

    OverlapCheck(const Scene& scene, const World<D, Real>& world, Document& document)
        : scene_(scene), world_(world), document_(document), joined_(world.figures.size()) {}

    /// Warns of the first pair in the order of the figures, with the number of figures that others overlap.
    void run() {
        join_figures();
        for (FigureIndex i = 0; i < std::min(world_.figures.size(), scene_.figures.size()); ++i)
            if (world_.figures[i].in_use()) add(i);
        std::ranges::sort(bodies_, {}, [](const Body& body) { return std::pair(body.box.low[0], body.figure); });
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            for (auto k = i + 1; k < bodies_.size() && bodies_[k].box.low[0] < bodies_[i].box.high[0]; ++k)
                if (pass_through(bodies_[i], bodies_[k]) && overlap(bodies_[i], bodies_[k]))
                    pairs.push_back(std::minmax({bodies_[i].figure, bodies_[k].figure}));
        if (!pairs.empty()) warn(pairs);
    }

  private:
    struct Body {
        FigureIndex figure = 0;
        collide::BoundingBox<D, Real> box{};
        std::vector<Row> rows{};
        bool is_solid = false, moves = false;
        bool is_sphere() const { return rows.size() == 1; }
    };
    using Pair = std::pair<FigureIndex, FigureIndex>;
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;
    UnionFind joined_;
    std::vector<Body> bodies_;
    /// Share by which points are drawn to the middle of their figure, and spheres shrink: flush figures are apart.
    static constexpr Real share = Real(0.01);

    const Figure& figure(const Body& body) const { return world_.figures[body.figure]; }
    const Vector& place(Row row) const { return world_.particles.position[row]; }
    Real radius(Row row) const { return world_.particles.radius[row] * (Real(1) - share); }

    void join_figures() {
        for_each_table(world_, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row)
                for (const Row member : table.members[row]) {
                    const auto a = world_.particles.figure[table.members[row][0]], b = world_.particles.figure[member];
                    if (a != b && has_figure(world_, a) && has_figure(world_, b)) joined_.join(a, b);
                }
        });
    }
    void add(FigureIndex i) {
        const auto& figure = world_.figures[i];
        Body body{.figure = i};
        for (const auto& id : figure.particles)
            if (const auto row = row_of(world_, id)) {
                body.rows.push_back(*row);
                const auto grown = Vector::map([&](int) { return radius(*row); });
                body.box.include(place(*row) - grown), body.box.include(place(*row) + grown);
                body.moves = body.moves || world_.particles.mobility[*row] > Real(0);
            }
        body.is_solid = std::ranges::any_of(
            figure.pieces, [](const Piece& piece) { return piece.mark == Mark::fill && !piece.hidden; });
        if (!body.rows.empty()) bodies_.push_back(std::move(body));
    }
    /// True for figures which move, without contact to keep them apart and without a joint.
    bool pass_through(const Body& a, const Body& b) {
        const bool has_inside = a.is_solid || b.is_solid || (a.is_sphere() && b.is_sphere());
        return has_inside && a.moves && b.moves && !(figure(a).collides && figure(b).collides) &&
               a.box.overlaps(b.box) && joined_.first_of(a.figure) != joined_.first_of(b.figure);
    }
    bool overlap(const Body& a, const Body& b) const {
        if (a.is_sphere() && b.is_sphere())
            return distance(place(a.rows[0]), place(b.rows[0])) < radius(a.rows[0]) + radius(b.rows[0]);
        return reaches_into(a, b) || reaches_into(b, a);
    }
    /// True if a point of a figure, or a sphere, is in the filled outlines of another.
    bool reaches_into(const Body& a, const Body& solid) const {
        if (!solid.is_solid) return false;
        const BodyShape<D, Real> shape(world_, figure(solid));
        Vector middle{};
        for (const Row row : a.rows) middle += place(row) * (Real(1) / Real(a.rows.size()));
        const auto is_inside = [&](const Vector& point) {
            return solid.box.contains(point) && shape.solid_around(point) != shape.none;
        };
        bool found = is_inside(middle);
        for (const Row row : a.rows) found = found || is_inside(place(row) + (middle - place(row)) * share);
        if (a.is_sphere())
            shape.each_segment([&](Row p, Row q, Real) {
                const auto t = collide::nearest_parameter(place(p), place(q), middle);
                found = found || distance(place(p) + (place(q) - place(p)) * t, middle) < radius(a.rows[0]);
            });
        return found;
    }

    void warn(const std::vector<Pair>& pairs) const {
        const auto [one, other] =
            *std::ranges::min_element(pairs, {}, [](const Pair& pair) { return std::pair(pair.second, pair.first); });
        const auto name = [&](FigureIndex i) { return in_quotes(world_.figures[i].name); };
        const auto more = pairs.size() - 1;
        std::string lacking;
        for (const auto i : {one, other})
            if (!world_.figures[i].collides) lacking += (lacking.empty() ? "" : " and ") + name(i);
        document_.warn(under("figures", other),
                       format_text("{} begins in {}, and they cannot touch: nothing keeps them apart{}", name(other),
                                   name(one),
                                   more == 0 ? "" : format_text(", nor {} other pair{}", more, more == 1 ? "" : "s")),
                       concat("give ", lacking,
                              " \"contact\": {\"figures\": true}, or begin apart; with contact, and "
                              "\"layers\" that do not touch, the overlap is meant"));
    }
};

} // namespace sinew
