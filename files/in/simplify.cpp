#include "files/in/simplify.h"

#include <algorithm>
#include <cmath>

namespace sinew::files {
namespace {

double distance_to_segment(const Vec2<double>& p, const Vec2<double>& a, const Vec2<double>& b) {
    const auto ab = b - a;
    const double length = dot(ab, ab);
    const double t = length > 0 ? std::clamp(dot(p - a, ab) / length, 0.0, 1.0) : 0;
    return norm(p - a - ab * t);
}

/// Marks the points between two kept ones that have to stay. Parts wait in a list: a spiral would nest calls deeply.
void keep_between(const Outline& points, std::size_t first, std::size_t last, double error, std::vector<bool>& kept) {
    std::vector<std::pair<std::size_t, std::size_t>> parts{{first, last}};
    while (!parts.empty()) {
        const auto [a, b] = parts.back();
        parts.pop_back();
        std::size_t furthest = a;
        double most = error;
        for (std::size_t i = a + 1; i < b; ++i)
            if (const double away = distance_to_segment(points[i], points[a], points[b]); away > most)
                most = away, furthest = i;
        if (furthest == a) continue;
        kept[furthest] = true;
        parts.push_back({a, furthest});
        parts.push_back({furthest, b});
    }
}

Outline kept_of(const Outline& points, const std::vector<bool>& kept) {
    Outline result;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (kept[i]) result.push_back(points[i]);
    return result;
}

} // namespace

Outline simplified_line(const Outline& line, double error) {
    if (line.size() < 3) return line;
    std::vector<bool> kept(line.size());
    kept.front() = kept.back() = true;
    keep_between(line, 0, line.size() - 1, error, kept);
    return kept_of(line, kept);
}

Outline simplified_loop(const Outline& loop, double error) {
    if (loop.size() < 4) return loop;
    // The corner furthest from the middle is on the hull, and so is the point furthest from it.
    Vec2<double> middle{};
    for (const auto& p : loop) middle += p * (1 / double(loop.size()));
    const auto furthest_from = [](const Outline& points, const Vec2<double>& from) {
        return std::ranges::max_element(points, {}, [&](const auto& p) { return norm(p - from); }) - points.begin();
    };
    Outline line = loop;
    std::ranges::rotate(line, line.begin() + furthest_from(loop, middle));
    const auto far = std::size_t(furthest_from(line, line.front()));
    line.push_back(line.front());
    std::vector<bool> kept(line.size());
    kept.front() = kept[far] = true;
    keep_between(line, 0, far, error, kept);
    keep_between(line, far, line.size() - 1, error, kept);
    return kept_of(line, kept);
}

double length_of(const Outline& outline, bool closed) {
    double length = 0;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < outline.size(); ++i)
        length += distance(outline[i], outline[(i + 1) % outline.size()]);
    return length;
}

Outline subdivided(const Outline& outline, double spacing, bool closed) {
    Outline result;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        result.push_back(outline[i]);
        if (!closed && i + 1 == outline.size()) break;
        const auto& next = outline[(i + 1) % outline.size()];
        const double parts = std::ceil(distance(outline[i], next) / spacing - 1e-9);
        for (int k = 1; k < parts; ++k) result.push_back(outline[i] + (next - outline[i]) * (k / parts));
    }
    return result;
}

} // namespace sinew::files
