#pragma once

#include "sinew/solver/cloth/thin_room.h"

namespace sinew::detail {

/// Gap of a pair along a direction: now, after this substep, and at the end of the list by the forecasts. In between it
/// is at least what straight lines through them say: the gap of linear motions is concave.
template <class Real> struct GapForecast {
    Real now = 0, next = 0, last = 0;

    Real least() const { return min(now, min(next, last)); }
};

/// Forecasts of the vertices of thin cloth: a list of pairs holds while every vertex keeps to its own.
template <class Real> class ClothForecasts {
  public:
    using Vector = Vec3<Real>;

    /// `substep`: the one being solved, counted from 1.
    ClothForecasts(ThinRoom<3, Real>& room, int substep) : room_(room), mesh_(room.mesh), substep_(substep) {}

    /// Begins a list, good until substep `last`; a static one holds as long as nothing has travelled.
    void begin_list(bool is_static, int last) {
        room_.is_static = is_static;
        room_.is_listed = true;
        room_.last_substep = last;
        room_.drift = {};
        room_.mean_displacement = is_static ? Vector{} : mean_displacement();
        room_.forecast.resize(mesh_.size());
        room_.is_dirty.assign(mesh_.size(), 1);
        room_.dirty.resize(mesh_.size());
        for (std::uint32_t i = 0; i < mesh_.size(); ++i) room_.dirty[i] = i;
        forecast_dirty();
    }
    /// Finds the vertices whose predicted places are off the forecast; false if there are none.
    bool find_dirty() {
        for (const auto i : room_.dirty) room_.is_dirty[i] = 0;
        room_.dirty.clear();
        for (std::uint32_t i = 0; i < mesh_.size(); ++i)
            if (!(off(i) <= 0.99 * double(room_.forecast[i].tolerance))) room_.dirty.push_back(i);
        for (const auto i : room_.dirty) room_.is_dirty[i] = 1;
        return !room_.dirty.empty();
    }
    /// Makes forecasts of the dirty, from their predicted places on; vertices that have left their neighbours may do so
    /// again.
    void forecast_dirty() {
        for (const auto i : room_.dirty) {
            auto& vertex = room_.vertices[i];
            vertex.listed_at = vertex.travel;
            auto& forecast = room_.forecast[i];
            forecast = {vertex.position, {}, room_.skin, substep_ - 1};
            if (room_.is_static) {
                forecast.tolerance += Real(2) * Real(off(i));
                continue;
            }
            forecast.per_substep = expected_move(i);
            const auto own = vertex.displacement - forecast.per_substep;
            forecast.position += own;
            forecast.tolerance += own_share * norm(own);
        }
    }
    bool is_any_dirty(const PairVertices& v) const {
        return room_.is_dirty[v[0]] || room_.is_dirty[v[1]] || room_.is_dirty[v[2]] || room_.is_dirty[v[3]];
    }

    /// How far a pair may be off its forecast. Both sides may leave it; a vertex listed before is off already.
    Real tolerance(const PairVertices& v, std::size_t first_side) const {
        std::array<Real, 2> largest{};
        for (std::size_t i = 0; i < 4; ++i) {
            auto& side = largest[i < first_side ? 0 : 1];
            side = max(side, room_.forecast[v[i]].tolerance * Real(room_.is_dirty[v[i]] ? 1 : 2));
        }
        return largest[0] + largest[1];
    }
    /// Gap along the direction of the nearest points.
    GapForecast<Real> gap(const PairVertices& v, std::size_t first_side, const NearestPoints<Real>& near) const {
        if (room_.is_static) return {near.distance, near.distance, near.distance};
        const auto& origin = room_.vertices[v[0]].position;
        std::array<Real, 4> now, next, last;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto& vertex = room_.vertices[v[i]];
            now[i] = dot(near.normal, vertex.position - origin);
            next[i] = now[i] + dot(near.normal, vertex.displacement);
            last[i] = next[i] + dot(near.normal, room_.forecast[v[i]].per_substep) * Real(left());
        }
        return {gap_of(now, first_side), gap_of(next, first_side), gap_of(last, first_side)};
    }
    /// Substep before which the gap is larger than `needed`.
    std::uint16_t wake(const GapForecast<Real>& gap, Real needed) const {
        const Real spare = gap.next - needed, closed = gap.next - gap.last;
        if (room_.is_static || !(min(gap.now - needed, spare) > Real(0))) return 0;
        const Real share = spare < closed ? spare / closed : Real(1);
        return std::uint16_t(substep_ + 1 + int(Real(0.999) * share * Real(left())));
    }

    /// Box around the motion from now until the end of the list, relative to the mean.
    collide::BoundingBox<3, Real> box_of(std::uint32_t i) const {
        const auto& forecast = room_.forecast[i];
        collide::BoundingBox<3, Real> box;
        const auto include = [&](int substep) {
            const auto position = forecast.position + forecast.per_substep * Real(substep - forecast.since);
            box.include(position - room_.mean_displacement * Real(substep));
        };
        if (room_.is_static) {
            box.include(forecast.position - room_.drift);
        } else {
            box.include(room_.vertices[i].position - room_.mean_displacement * Real(forecast.since));
            include(forecast.since + 1);
            include(room_.last_substep);
        }
        return box.grown(forecast.tolerance);
    }

  private:
    ThinRoom<3, Real>& room_;
    const ClothMesh<3, Real>& mesh_;
    int substep_;

    /// Share of the motion against the neighbours that may come again.
    static constexpr Real own_share = Real(0.3);

    /// Substeps after this one until the end of the list.
    int left() const { return room_.last_substep - substep_; }
    Vector mean_displacement() const {
        Vector sum{};
        for (const auto& vertex : room_.vertices) sum += vertex.last_displacement;
        return sum * (Real(1) / Real(room_.vertices.size()));
    }
    /// Mean of the displacements of a vertex and its neighbours: motion shared with them lasts, its own is gone
    /// within a substep.
    Vector expected_move(std::uint32_t vertex) const {
        Vector sum{};
        if (room_.is_static) return sum;
        Real count = 0;
        for (auto i = mesh_.first_cell_at[vertex]; i < mesh_.first_cell_at[vertex + 1]; ++i) {
            const auto corners = mesh_.corner_range[mesh_.cells_at[i]];
            for (auto k = corners.first; k < corners.last; ++k)
                sum += room_.vertices[mesh_.corners[k]].displacement, count += 1;
        }
        return sum * inverse_or_zero(count);
    }
    /// Distance from the forecast at the end of the substep; of a static list, the travel since the listing.
    double off(std::uint32_t i) const {
        const auto& vertex = room_.vertices[i];
        if (room_.is_static) return room_.ahead[i] - vertex.listed_at;
        const auto& forecast = room_.forecast[i];
        return double(norm((vertex.position - forecast.position) + vertex.displacement -
                           forecast.per_substep * Real(substep_ - forecast.since)));
    }
};

} // namespace sinew::detail
