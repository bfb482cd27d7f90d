#include "files/in/uncrossed.h"

#include "sinew/collide/decompose.h"
#include "sinew/scene/fill_rule.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sinew::files {
namespace {

constexpr double cells_a_pixel = 1024;
constexpr std::size_t max_pieces = 3000; // nine million pairs a round
constexpr int max_rounds = 12;

/// Place on the grid: whole numbers of cells.
using Spot = Vec2<double>;

Spot rounded(const Spot& p) {
    return {{std::floor(p[0] + 0.5), std::floor(p[1] + 0.5)}};
}

double turn_of(const Spot& a, const Spot& b, const Spot& c) {
    return cross(b - a, c - a);
}

/// A piece of an outline. Lists of pieces are lists of spots, two for each.
struct Piece {
    Spot from, to;
};

Piece piece_at(const Outline& pieces, std::size_t i) {
    return {pieces[2 * i], pieces[2 * i + 1]};
}

void append(Outline& pieces, const Spot& from, const Spot& to) {
    if (from == to) return;
    pieces.push_back(from);
    pieces.push_back(to);
}

/// True for a spot of the piece that is not one of its ends.
bool is_within(const Piece& p, const Spot& spot) {
    return turn_of(p.from, p.to, spot) == 0 && dot(spot - p.from, spot - p.to) < 0;
}

/// The crossing of two pieces, rounded, if it is inside both.
std::optional<Spot> crossing_of(const Piece& a, const Piece& b) {
    const double from = turn_of(a.from, a.to, b.from), to = turn_of(a.from, a.to, b.to);
    if (!(from * to < 0 && turn_of(b.from, b.to, a.from) * turn_of(b.from, b.to, a.to) < 0)) return std::nullopt;
    return rounded(b.from + (b.to - b.from) * (from / (from - to)));
}

/// Adds a stop of a piece, by its distance from the first one.
void add_stop(Outline& stops, const Spot& stop) {
    stops.push_back(stop);
    const auto away = [&](std::size_t i) { return distance(stops[0], stops[i]); };
    for (auto k = stops.size() - 1; away(k) < away(k - 1); --k) std::swap(stops[k], stops[k - 1]);
}

/// Pieces cut where others cross or touch them. Crossings are rounded, which bends pieces: they may cross again.
Outline cut_once(const Outline& pieces) {
    Outline result, stops;
    const auto count = pieces.size() / 2;
    for (std::size_t i = 0; i < count; ++i) {
        const auto piece = piece_at(pieces, i);
        stops.clear();
        stops.push_back(piece.from);
        for (std::size_t k = 0; k < count; ++k) {
            const auto other = piece_at(pieces, k);
            if (is_within(piece, other.from)) add_stop(stops, other.from);
            if (is_within(piece, other.to)) add_stop(stops, other.to);
            const auto crossing = i < k ? crossing_of(piece, other) : crossing_of(other, piece);
            if (crossing) add_stop(stops, *crossing);
        }
        stops.push_back(piece.to);
        for (std::size_t k = 1; k < stops.size(); ++k) append(result, stops[k - 1], stops[k]);
    }
    return result;
}

/// +1 for a piece with the same ends as another, -1 for one that runs back, else 0.
int passes(const Piece& along, const Piece& piece) {
    return piece.from == along.from && piece.to == along.to   ? 1
           : piece.from == along.to && piece.to == along.from ? -1
                                                              : 0;
}

/// Winding number just beside a piece, on the side of a ray from its middle: along x, or along y if that is more
/// across.
int winding_beside(const Outline& pieces, const Piece& at, int axis) {
    const auto middle = (at.from + at.to) * 0.5;
    const int up = 1 - axis;
    int winding = 0;
    for (std::size_t k = 0; 2 * k < pieces.size(); ++k) {
        const auto piece = piece_at(pieces, k);
        if ((piece.from[up] > middle[up]) == (piece.to[up] > middle[up]) || passes(at, piece) != 0) continue;
        const bool is_leftward = (piece.to[up] > piece.from[up]) == (axis == 0);
        // The ray crosses a piece that has the middle on its left if it crosses to the left of it.
        if ((turn_of(piece.from, piece.to, middle) > 0) == is_leftward) winding += is_leftward ? 1 : -1;
    }
    return winding;
}

/// Pieces, or their reverses, that are filled on their left alone.
Outline filled_borders(const Outline& pieces, bool is_even_odd) {
    const auto is_filled = [&](int winding) { return is_even_odd ? winding % 2 != 0 : winding != 0; };
    Outline borders;
    for (std::size_t i = 0; 2 * i < pieces.size(); ++i) {
        const auto piece = piece_at(pieces, i);
        int net = 0;
        bool is_first = true;
        for (std::size_t k = 0; 2 * k < pieces.size(); ++k) {
            const int pass = passes(piece, piece_at(pieces, k));
            net += pass;
            is_first = is_first && !(pass != 0 && k < i);
        }
        if (!is_first || net == 0) continue;
        const auto along = piece.to - piece.from;
        const int axis = absolute(along[1]) >= absolute(along[0]) ? 0 : 1;
        const int beside = winding_beside(pieces, piece, axis);
        const bool is_right = (along[1 - axis] > 0) == (axis == 0); // side of the ray
        const int left = is_right ? beside + net : beside;
        const bool is_left_filled = is_filled(left), is_right_filled = is_filled(left - net);
        if (is_left_filled && !is_right_filled) append(borders, piece.from, piece.to);
        if (is_right_filled && !is_left_filled) append(borders, piece.to, piece.from);
    }
    return borders;
}

/// True if the way from `at` to `a` comes before that to `b`, clockwise from the way back to `before`.
bool is_sooner(const Spot& before, const Spot& at, const Spot& a, const Spot& b) {
    const bool is_late = turn_of(at, before, a) > 0, is_other_late = turn_of(at, before, b) > 0;
    return is_late == is_other_late ? turn_of(at, a, b) < 0 : is_other_late;
}

/// Removes and returns the border that goes on where `border` ends. Where several do, that round the nearest filled
/// corner: areas that touch at a corner come apart, and a hole that touches its outline is a bay of it.
Piece take_next(Outline& borders, const Piece& border) {
    std::size_t next = borders.size();
    for (std::size_t i = 0; i < borders.size(); i += 2)
        if (borders[i] == border.to &&
            (next == borders.size() || is_sooner(border.from, border.to, borders[i + 1], borders[next + 1])))
            next = i;
    const Piece found{borders[next], borders[next + 1]}; // as many borders begin at a spot as end there
    const auto last = borders.size() - 2;
    borders[next] = borders[last], borders[next + 1] = borders[last + 1];
    borders.pop_back(), borders.pop_back();
    return found;
}

std::vector<Outline> loops_of(Outline borders) {
    std::vector<Outline> loops;
    while (!borders.empty()) {
        const auto first = piece_at(borders, 0);
        auto& loop = loops.emplace_back();
        loop.push_back((first.from + first.to) * (0.5 / cells_a_pixel));
        auto border = first;
        do {
            loop.push_back(border.to * (1 / cells_a_pixel));
            border = take_next(borders, border);
        } while (!(border.from == first.from && border.to == first.to));
    }
    return loops;
}

} // namespace

bool have_crossings(const std::vector<Outline>& outlines) {
    for (std::size_t i = 0; i < outlines.size(); ++i)
        for (std::size_t k = 0; k <= i; ++k)
            if (collide::cross_each_other(outlines[i], outlines[k])) return true;
    return false;
}

std::vector<Outline> uncrossed(const std::vector<Outline>& outlines, std::string_view fill_rule) {
    Outline pieces;
    for (const auto& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i)
            append(pieces, rounded(outline[i] * cells_a_pixel),
                   rounded(outline[(i + 1) % outline.size()] * cells_a_pixel));
    for (int round = 0; round < max_rounds && pieces.size() <= 2 * max_pieces; ++round) {
        auto cut = cut_once(pieces);
        if (cut.size() == pieces.size()) return loops_of(filled_borders(pieces, fill_rule == fill_rules[1]));
        pieces = std::move(cut);
    }
    return {};
}

} // namespace sinew::files
