#include "bench/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace sinew::bench {
namespace {

constexpr double panel_height = 360, left = 70, right = 30, top = 64, gap = 90, below = 60, legend_row = 20;
constexpr std::array<const char*, 8> colors = {"#e4572e", "#8a8378", "#c9b8a0", "#2e6fb7",
                                               "#3f9b6c", "#9a5fb0", "#d19a2a", "#4a4e69"};

bool is_shown(double value) {
    return std::isfinite(value) && value > 0;
}

/// A logarithmic axis over whole powers of ten.
struct Axis {
    double low = 1e300, high = 0;

    void include(double value) {
        if (!is_shown(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void round_outwards() {
        if (high == 0) low = high = 1;
        low = std::floor(std::log10(low) + 1e-9);
        high = std::max(std::ceil(std::log10(high) - 1e-9), low + 1);
    }
    /// 0 at the low end, 1 at the high end; values without a logarithm are at the high end.
    double share(double value) const { return is_shown(value) ? (std::log10(value) - low) / (high - low) : 1; }
};

std::string number(int power) {
    return power >= -3 && power <= 4 ? fmt::format("{:g}", std::pow(10.0, power)) : fmt::format("1e{}", power);
}

class Drawing {
  public:
    explicit Drawing(const Plot& plot) : plot_(plot), panel_width(plot.panels.size() > 1 ? 420 : 640) {
        for (const auto& panel : plot.panels)
            for (const auto& curve : panel.curves)
                for (const auto& point : curve.points) x_.include(point.x);
        x_.round_outwards();
    }

    std::string svg() {
        const double width = left + double(plot_.panels.size()) * (panel_width + gap) - gap + right;
        const auto rows = legend_rows(width - left - right);
        const double height = top + panel_height + below + double(rows.size()) * legend_row;
        add(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="12">)",
            width, height);
        add(R"(<rect width="{}" height="{}" fill="#fbfaf6"/>)", width, height);
        text(left, 26, plot_.title, R"(font-size="16" fill="#2b2d42")");
        for (std::size_t i = 0; i < plot_.panels.size(); ++i)
            draw(plot_.panels[i], left + double(i) * (panel_width + gap));
        for (std::size_t i = 0; i < rows.size(); ++i)
            legend(rows[i], top + panel_height + below + (double(i) + 0.3) * legend_row);
        out_ += "</svg>\n";
        return std::move(out_);
    }

  private:
    const Plot& plot_;
    const double panel_width;
    Axis x_;
    std::vector<std::array<double, 2>> labels_; ///< origins of the present panel's labels
    std::string out_;

    template <class... Part> void add(fmt::format_string<Part...> form, Part&&... part) {
        fmt::format_to(std::back_inserter(out_), form, std::forward<Part>(part)...);
        out_ += '\n';
    }
    void text(double x, double y, const std::string& words, const char* style) {
        add(R"(<text x="{:.1f}" y="{:.1f}" {}>{}</text>)", x, y, style, words);
    }

    void draw(const Panel& panel, double x0) {
        Axis y;
        for (const auto& curve : panel.curves)
            for (const auto& point : curve.points) y.include(point.y);
        y.round_outwards();
        const double bottom = top + panel_height;
        text(x0, top - 14, panel.title, R"(font-size="13" fill="#2b2d42")");
        for (int power = int(y.low); power <= int(y.high); ++power) {
            const double at = bottom - (power - y.low) / (y.high - y.low) * panel_height;
            add(R"(<line x1="{0:.1f}" x2="{1:.1f}" y1="{2:.1f}" y2="{2:.1f}" stroke="#ddd8cc"/>)", x0, x0 + panel_width,
                at);
            text(x0 - 8, at + 4, number(power), R"(text-anchor="end" fill="#666")");
        }
        for (int power = int(x_.low); power <= int(x_.high); ++power) {
            const double at = x0 + (power - x_.low) / (x_.high - x_.low) * panel_width;
            add(R"(<line x1="{0:.1f}" x2="{0:.1f}" y1="{1:.1f}" y2="{2:.1f}" stroke="#ddd8cc"/>)", at, top, bottom);
            text(at, bottom + 18, number(power), R"(text-anchor="middle" fill="#666")");
        }
        text(x0 + panel_width / 2, bottom + 36, plot_.x_title, R"(text-anchor="middle" fill="#333")");
        labels_.clear();
        for (std::size_t i = panel.curves.size(); i-- > 0;) draw(panel.curves[i], colors[i % colors.size()], x0, y);
    }

    void draw(const Curve& curve, const char* color, double x0, const Axis& y) {
        std::string path;
        for (const auto& point : curve.points) {
            const double px = x0 + x_.share(point.x) * panel_width;
            const double py = top + (1 - y.share(point.y)) * panel_height;
            if (!point.beaten) path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", px, py);
            if (is_shown(point.y))
                add(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" fill-opacity="{}"/>)", px, py,
                    point.beaten ? 2.5 : 3.5, color, point.beaten ? 0.45 : 1);
            else
                text(px, py + 5, "lost", R"(text-anchor="middle" fill="#b00020" font-size="10")");
            if (!point.label.empty()) label(px, py, point.label);
        }
        add(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="1.8"/>)", path, color);
    }

    /// Places a label beside a point, at the first free of four positions: right above, right below, left above, left
    /// below.
    void label(double px, double py, const std::string& words) {
        constexpr double height = 9, letter = 5.5, near = 6;
        const double width = letter * double(words.size());
        const std::array<std::array<double, 2>, 4> choices = {{{px + near, py - 5},
                                                               {px + near, py + 5 + height},
                                                               {px - near - width, py - 5},
                                                               {px - near - width, py + 5 + height}}};
        const auto is_free = [&](const std::array<double, 2>& at) {
            return std::ranges::none_of(labels_, [&](const auto& other) {
                return std::abs(at[0] - other[0]) < width + near && std::abs(at[1] - other[1]) < height;
            });
        };
        const auto* const found = std::ranges::find_if(choices, is_free);
        const auto& at = found == choices.end() ? choices.front() : *found;
        labels_.push_back(at);
        text(at[0], at[1], words, R"(fill="#777" font-size="9")");
    }

    static double legend_width(const Curve& curve) { return 44 + 6.6 * double(curve.name.size()); }

    /// Indices of curves, by row below the panels.
    std::vector<std::vector<std::size_t>> legend_rows(double width) const {
        std::vector<std::vector<std::size_t>> rows;
        double x = width;
        for (std::size_t i = 0; !plot_.panels.empty() && i < plot_.panels[0].curves.size(); ++i) {
            const double wide = legend_width(plot_.panels[0].curves[i]);
            if (x + wide > width) rows.emplace_back(), x = 0;
            rows.back().push_back(i);
            x += wide;
        }
        return rows;
    }

    void legend(const std::vector<std::size_t>& row, double y) {
        double x = left;
        for (const auto i : row) {
            const auto& curve = plot_.panels[0].curves[i];
            add(R"(<rect x="{:.1f}" y="{:.1f}" width="14" height="10" rx="2" fill="{}"/>)", x, y - 9,
                colors[i % colors.size()]);
            text(x + 20, y, curve.name, R"(fill="#333")");
            x += legend_width(curve);
        }
    }
};

} // namespace

void mark_beaten(Curve& curve) {
    for (auto& point : curve.points)
        point.beaten = std::ranges::any_of(curve.points, [&](const PlotPoint& other) {
            return other.x <= point.x && (other.y < point.y || (std::isfinite(other.y) && !std::isfinite(point.y)));
        });
}

std::string to_svg(const Plot& plot) {
    return Drawing(plot).svg();
}

} // namespace sinew::bench
