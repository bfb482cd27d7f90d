#include "sinew/picture/traces.h"

#include "sinew/picture/style_resolver.h"
#include "sinew/picture/theme.h"
#include "sinew/scene/check.h"

#include <algorithm>

namespace sinew {
namespace {

/// Sizes at the nominal height of a picture, nominal pixels; proportional to the height.
constexpr float path_width = 2, curve_width = 2, rule_width = 1, text_size = 11, inset = 5;

constexpr float palest = 0.12F; ///< share of colour at the oldest end of a path
constexpr int shades = 24;      ///< colour steps along a fading path

/// Values at the bottom and at the top of a frame.
struct Range {
    double low = 0, high = 1;
};

class TraceDrawer {
  public:
    TraceDrawer(const Scene& scene, const View& view, Picture& picture)
        : scene_(scene), view_(view), picture_(picture), theme_(theme_called(scene.view.theme)),
          unit_(float(picture.height / Picture::nominal_height)) {}

    /// `shares`: true if an earlier trace has drawn the same frame.
    void draw(const TraceSection& trace, std::span<const Sample> samples, bool shares) {
        if (samples.empty()) return;
        const double begin = trace.seconds > 0 ? samples.back().seconds - trace.seconds : samples.front().seconds;
        while (samples.size() > 1 && samples[1].seconds <= begin) samples = samples.subspan(1);
        if (trace.shows == trace_quantities.front()) return path(samples, color_of(trace));
        if (trace.box) chart(trace, samples, begin, shares);
    }

  private:
    const Scene& scene_;
    const View& view_;
    Picture& picture_;
    const Theme& theme_;
    const float unit_;
    std::vector<Vec2<float>> line_;

    /// Colour of the part named like the particle, or of the figure.
    Color color_of(const TraceSection& trace) const {
        const auto slash = std::min(trace.of.find('/'), trace.of.size());
        const auto name = trace.of.substr(0, slash), part = trace.of.substr(std::min(slash + 1, trace.of.size()));
        const auto found = std::ranges::find(scene_.figures, name, [](const auto& figure) { return name_of(figure); });
        return StyleResolver(scene_, theme_, std::size_t(found - scene_.figures.begin()), name).of(part).color;
    }

    /// A polyline that fades towards the oldest sample.
    void path(std::span<const Sample> samples, const Color& color) {
        const std::size_t last = samples.size() - 1, parts = std::min(std::size_t(shades), last);
        for (std::size_t part = 0; part < parts; ++part) {
            line_.clear();
            for (std::size_t i = last * part / parts; i <= last * (part + 1) / parts; ++i)
                if (const auto seen = view_.see(samples[i].value)) line_.push_back(seen->pixel);
            const float share = palest + (1 - palest) * float(part + 1) / float(parts);
            if (line_.size() > 1)
                picture_.add(Shape::polyline, line_, path_width * unit_, mix(theme_.background, color, share));
        }
    }

    void chart(const TraceSection& trace, std::span<const Sample> samples, double begin, bool shares) {
        const auto first = view_.see((*trace.box)[0].as<3, double>());
        const auto second = view_.see((*trace.box)[1].as<3, double>());
        if (!first || !second) return;
        const auto a = first->pixel, b = second->pixel;
        const Vec2<float> low{{min(a[0], b[0]), max(a[1], b[1])}}; // bottom left; y points down
        const Vec2<float> high{{max(a[0], b[0]), min(a[1], b[1])}};
        const double length = trace.seconds > 0 ? trace.seconds : max(scene_.seconds, samples.back().seconds - begin);
        const auto range = range_of(trace, samples);
        const auto at = [&](double seconds, double value) {
            const double x = clamp((seconds - begin) * inverse_or_zero(length), 0.0, 1.0);
            const double y = clamp((value - range.low) * inverse_or_zero(range.high - range.low), 0.0, 1.0);
            return Vec2<float>{{low[0] + float(x) * (high[0] - low[0]), low[1] + float(y) * (high[1] - low[1])}};
        };
        if (!shares) frame(low, high);
        if (!shares) words(trace, low, high);
        rule(low[0], high[0], at(begin, samples.front().value[0])[1]);
        curve(samples, at, color_of(trace));
    }

    static Range range_of(const TraceSection& trace, std::span<const Sample> samples) {
        const auto [min, max] = std::ranges::minmax(samples, {}, [](const Sample& sample) { return sample.value[0]; });
        const double low = trace.low.value_or(min.value[0]), high = trace.high.value_or(max.value[0]);
        if (low < high) return {low, high};
        return {low - 0.5, low + 0.5}; // constant so far
    }

    void frame(Vec2<float> low, Vec2<float> high) {
        const std::array<Vec2<float>, 4> corners = {{low, {{high[0], low[1]}}, high, {{low[0], high[1]}}}};
        picture_.add(Shape::polygon, corners, 0, mix(theme_.background, theme_.ground, 0.35F));
        picture_.add(Shape::loop, corners, rule_width * unit_, theme_.ground);
    }

    /// Dashed line at the value of the first sample shown.
    void rule(float left, float right, float y) {
        constexpr float dash = 4, gap = 3;
        for (float x = left; x < right; x += (dash + gap) * unit_) {
            const std::array<Vec2<float>, 2> ends = {{{{x, y}}, {{min(x + dash * unit_, right), y}}}};
            picture_.add(Shape::polyline, ends, rule_width * unit_, mix(theme_.background, theme_.pen, 0.45F));
        }
    }

    template <class At> void curve(std::span<const Sample> samples, At&& at, const Color& color) {
        line_.clear();
        for (const auto& sample : samples) line_.push_back(at(sample.seconds, sample.value[0]));
        picture_.add(Shape::polyline, line_, curve_width * unit_, color);
        picture_.add(Shape::disc, std::span(&line_.back(), 1), 2.5F * curve_width * unit_, color);
    }

    /// Label above the frame; the quantity in the upper right corner.
    void words(const TraceSection& trace, Vec2<float> low, Vec2<float> high) {
        constexpr float letter_width = 0.6F; // as a fraction of the height
        const float size = text_size * unit_;
        const float half = float(trace.shows.size()) * letter_width * size / 2;
        picture_.add_text(trace.shows, {{high[0] - inset * unit_ - half, high[1] + inset * unit_ + size / 2}}, size,
                          mix(theme_.background, theme_.pen, 0.6F));
        if (!trace.label.empty())
            picture_.add_text(trace.label, {{(low[0] + high[0]) / 2, high[1] - size}}, 1.15F * size, theme_.pen);
    }
};

} // namespace

void draw_traces(const Scene& scene, const History& history, const View& view, Picture& picture) {
    TraceDrawer drawer(scene, view, picture);
    const std::span traces(scene.traces.data(), std::min(history.size(), scene.traces.size()));
    for (std::size_t i = 0; i < traces.size(); ++i) {
        const auto has_frame = [&](const TraceSection& other) { return other.box && other.box == traces[i].box; };
        drawer.draw(traces[i], history.of(i), std::ranges::any_of(traces.first(i), has_frame));
    }
}

} // namespace sinew
