#pragma once

#include "sinew/session/keep_changes.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Rows of three worlds that are compared: that of the scene as it began (`base`), the old one and the new one. A
/// number that the edit leaves as it was at the beginning is taken from the old world, as in a merge of three texts.
namespace sinew::detail {

inline constexpr Row no_row = ~Row(0);

/// Takes a number over, unless the edit has changed it.
template <class T> void merge(const T& base, const T& old, T& fresh) {
    if (fresh == base) fresh = old;
}

template <class T>
void merge_row(const std::vector<T>& base, Row b, const std::vector<T>& old, Row o, std::vector<T>& fresh, Row f) {
    merge(base[b], old[o], fresh[f]);
}
template <class T> void merge_row(const Column<T>& base, Row b, const Column<T>& old, Row o, Column<T>& fresh, Row f) {
    if (fresh[f] == base[b]) fresh.set(f, old[o]);
}
template <class Real>
void merge_row(const LimitColumns<Real>& base, Row b, const LimitColumns<Real>& old, Row o, LimitColumns<Real>& fresh,
               Row f) {
    if (fresh.low(f) == base.low(b) && fresh.high(f) == base.high(b)) fresh.set(f, old.low(o), old.high(o));
}

template <class T> void copy_row(const std::vector<T>& from, Row row, std::vector<T>& to, Row into) {
    to[into] = from[row];
}
template <class T> void copy_row(const Column<T>& from, Row row, Column<T>& to, Row into) {
    to.set(into, from[row]);
}
template <class Real> void copy_row(const LimitColumns<Real>& from, Row row, LimitColumns<Real>& to, Row into) {
    to.set(into, from.low(row), from.high(row));
}

/// Copies a row of a table into a row of another table.
template <class Table> void copy_columns(const Table& from, Row row, Table& to, Row into) {
    std::vector<const void*> columns;
    Table::columns(from, [&](const auto& column) { columns.push_back(&column); });
    std::size_t number = 0;
    Table::columns(to, [&]<class Column>(Column& column) { // of the same types, in the same order
        copy_row(*static_cast<const Column*>(columns[number++]), row, column, into);
    });
}

/// Rows of the particles of one world in another one: figure by figure, in the order of construction.
template <class WorldT> class Counterparts {
  public:
    Counterparts(const WorldT& base, const WorldT& old, const WorldT& fresh, std::span<const FigureIndex> going_on)
        : old_of_base(base.particles.size(), no_row), fresh_of_base(base.particles.size(), no_row),
          fresh_of_old(old.particles.size(), no_row), is_described(old.figures.size(), 0) {
        for (const auto& figure : base.figures) {
            const auto was = find_figure(old, figure.name);
            if (!was) continue;
            is_described[*was] = 1;
            map(base, figure, old, old.figures[*was], old_of_base);
            const auto is = find_figure(fresh, figure.name);
            if (!is || std::ranges::find(going_on, *is) == going_on.end()) continue;
            map(base, figure, fresh, fresh.figures[*is], fresh_of_base);
            map(old, old.figures[*was], fresh, fresh.figures[*is], fresh_of_old);
        }
    }

    std::vector<Row> old_of_base, fresh_of_base, fresh_of_old;
    std::vector<char> is_described; ///< by figure of the old world: the scene has built it

  private:
    static void map(const WorldT& from, const Figure& first, const WorldT& to, const Figure& second,
                    std::vector<Row>& rows) {
        if (first.particles.size() != second.particles.size()) return;
        for (std::size_t i = 0; i < first.particles.size(); ++i) {
            const auto a = row_of(from, first.particles[i]), b = row_of(to, second.particles[i]);
            if (a && b) rows[*a] = *b;
        }
    }
};

/// One row of each of the three worlds; no_row where it is missing.
struct Match {
    Row base = no_row, old = no_row, fresh = no_row;
};

/// The worlds, and their rows.
template <class WorldT> struct Merge {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;

    Merge(const WorldT& began, const Replacement& all, const WorldT& before, WorldT& now)
        : base(began), worlds(all), old(before), fresh(now), rows(began, before, now, all.going_on) {
        for_each_table(old, [&](const auto& table) { known_constraints.emplace_back(table.size(), char(0)); });
        known_pins.assign(old.pins.size(), 0);
        for (const auto id : worlds.not_kept)
            if (const auto row = old.pin_handles.find(id)) known_pins[*row] = 1;
    }

    const WorldT& base;
    const Replacement& worlds;
    const WorldT& old;
    WorldT& fresh;
    Counterparts<WorldT> rows;
    std::vector<std::vector<char>> known_constraints{}; ///< by kind and row of the old world: not to be added
    std::vector<char> known_pins{};                     ///< by row of the old world
    std::vector<std::array<ParticleId, 2>> particles{}; ///< ids in the new world and in the old one
    std::vector<std::array<ConstraintId, 2>> constraints{};
    std::vector<std::array<PinId, 2>> pins{};
    std::vector<std::array<ColliderId, 2>> colliders{};
    std::string lost{}; ///< why something cannot go on

    void lose(std::string reason) {
        if (lost.empty()) lost = std::move(reason);
    }
};

} // namespace sinew::detail
