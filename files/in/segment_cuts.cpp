#include "files/in/segment_cuts.h"

#include <algorithm>
#include <cmath>

namespace sinew::files {
namespace {

constexpr double cells_a_pixel = 1024;
constexpr std::size_t max_pieces = 3000; // 4.5 million pairs a round
constexpr int max_rounds = 12;

std::int64_t rounded(double cells) {
    return std::int64_t(std::floor(cells + 0.5));
}

bool share_a_box(const Segment& a, const Segment& b) {
    const auto apart = [](std::int64_t a1, std::int64_t a2, std::int64_t b1, std::int64_t b2) {
        return std::max(a1, a2) < std::min(b1, b2) || std::max(b1, b2) < std::min(a1, a2);
    };
    return !apart(a.first.first, a.second.first, b.first.first, b.second.first) &&
           !apart(a.first.second, a.second.second, b.first.second, b.second.second);
}

/// True for a spot of the segment that is not one of its ends.
bool is_within(const Segment& s, const Spot& spot) {
    return spot != s.first && spot != s.second && share_a_box(s, {spot, spot}) && turn_of(s.first, s.second, spot) == 0;
}

int sign(std::int64_t number) {
    return number > 0 ? 1 : number < 0 ? -1 : 0;
}

/// The crossing of two segments, rounded, if it is inside both.
std::optional<Spot> crossing_of(const Segment& a, const Segment& b) {
    const auto from = turn_of(a.first, a.second, b.first), to = turn_of(a.first, a.second, b.second);
    if (sign(from) * sign(to) >= 0) return std::nullopt;
    if (sign(turn_of(b.first, b.second, a.first)) * sign(turn_of(b.first, b.second, a.second)) >= 0)
        return std::nullopt;
    const double share = double(from) / (double(from) - double(to));
    return Spot{b.first.first + rounded(double(b.second.first - b.first.first) * share),
                b.first.second + rounded(double(b.second.second - b.first.second) * share)};
}

/// Pieces of a segment between its cuts, in order.
void append_pieces(const Segment& segment, std::vector<Spot>& cuts, std::vector<Segment>& pieces) {
    const auto away = [&](const Spot& spot) {
        const double x = double(spot.first - segment.first.first), y = double(spot.second - segment.first.second);
        return x * x + y * y;
    };
    std::ranges::sort(cuts,
                      [&](const Spot& a, const Spot& b) { return std::pair(away(a), a) < std::pair(away(b), b); });
    cuts.push_back(segment.second);
    auto from = segment.first;
    for (const auto& cut : cuts) {
        if (cut != from) pieces.push_back({from, cut});
        from = cut;
    }
}

/// Where each segment has to be cut.
std::vector<std::vector<Spot>> cuts_of(const std::vector<Segment>& segments) {
    std::vector<std::vector<Spot>> cuts(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (std::size_t k = i + 1; k < segments.size(); ++k) {
            const auto &a = segments[i], &b = segments[k];
            if (!share_a_box(a, b)) continue;
            for (const auto& end : {b.first, b.second})
                if (is_within(a, end)) cuts[i].push_back(end);
            for (const auto& end : {a.first, a.second})
                if (is_within(b, end)) cuts[k].push_back(end);
            const auto crossing = crossing_of(a, b);
            if (!crossing) continue;
            if (*crossing != a.first && *crossing != a.second) cuts[i].push_back(*crossing);
            if (*crossing != b.first && *crossing != b.second) cuts[k].push_back(*crossing);
        }
    return cuts;
}

} // namespace

Spot spot_of(const Vec2<double>& point) {
    return {rounded(point[0] * cells_a_pixel), rounded(point[1] * cells_a_pixel)};
}

Vec2<double> place_of(const Spot& spot) {
    return {{double(spot.first) / cells_a_pixel, double(spot.second) / cells_a_pixel}};
}

std::int64_t turn_of(const Spot& a, const Spot& b, const Spot& c) {
    return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
}

std::optional<std::vector<Segment>> cut_at_crossings(std::vector<Segment> segments) {
    for (int round = 0; round < max_rounds; ++round) {
        auto cuts = cuts_of(segments);
        std::size_t count = segments.size();
        for (const auto& of_one : cuts) count += of_one.size();
        if (count == segments.size()) return segments;
        if (count > max_pieces) return std::nullopt;
        std::vector<Segment> pieces;
        for (std::size_t i = 0; i < segments.size(); ++i) append_pieces(segments[i], cuts[i], pieces);
        segments = std::move(pieces);
    }
    return std::nullopt;
}

} // namespace sinew::files
