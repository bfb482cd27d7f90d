#include "sinew/math/format.h"

#include "files/out/export_formats.h"
#include "files/out/vector_film.h"

#include <algorithm>
#include <cmath>

/// One SVG that moves by itself (SMIL), in a loop: browsers play it in a page and in an <img>.
namespace sinew::files {
namespace {

/// Hundredths of a pixel, without zeros at the end.
std::string number(float value) {
    const long hundredths = std::lround(double(value) * 100), size = std::abs(hundredths);
    auto text = (hundredths < 0 ? "-" : "") + std::to_string(size / 100);
    if (size % 100 > 0) text += '.', text += char('0' + size % 100 / 10);
    if (size % 10 > 0) text += char('0' + size % 10);
    return text;
}

int channel(float share) {
    return int(share * 255 + 0.5F);
}

std::string color_text(const float* rgb) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text = "#";
    for (int i = 0; i < 3; ++i)
        for (const int shift : {4, 0}) text += digits[channel(rgb[i]) >> shift & 15];
    return text;
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else
            safe += c;
    }
    return safe;
}

class SvgText {
  public:
    explicit SvgText(const VectorFilm& film) : film_(film), frames_(double(film.recorder.frames())) {}

    std::string text() {
        const auto& b = film_.background;
        put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" "
            "stroke-linecap=\"round\" stroke-linejoin=\"round\" fill-rule=\"evenodd\" "
            "font-family=\"sans-serif\" text-anchor=\"middle\">\n",
            film_.size[0], film_.size[1], film_.size[0], film_.size[1]);
        const float rgb[] = {b.red, b.green, b.blue};
        if (b.alpha > 0)
            put("<rect width=\"100%\" height=\"100%\" fill=\"{}\"{}/>\n", color_text(rgb), opacity("fill", b.alpha));
        for (const auto& track : film_.recorder.tracks()) add(track);
        return text_ + "</svg>\n";
    }

  private:
    template <class... Part> void put(detail::Format<std::type_identity_t<Part>...> form, const Part&... part) {
        text_ += format_text<Part...>(form, part...);
    }

    static std::string opacity(const char* what, float alpha) {
        return alpha < 1 ? format_text(" {}-opacity=\"{}\"", what, number(alpha)) : "";
    }

    using Value = std::string (*)(const Track&, std::size_t frame);

    static const float* style(const Track& track, std::size_t frame) { return track.at(frame) + 2 * track.points; }
    static std::string x(const Track& t, std::size_t f) { return number(t.at(f)[0]); }
    static std::string y(const Track& t, std::size_t f) { return number(t.at(f)[1]); }
    static std::string width(const Track& t, std::size_t f) { return number(style(t, f)[0]); }
    static std::string radius(const Track& t, std::size_t f) { return number(style(t, f)[0] / 2); }
    static std::string color(const Track& t, std::size_t f) { return color_text(style(t, f) + 1); }
    static std::string alpha(const Track& t, std::size_t f) { return number(style(t, f)[4]); }
    static std::string points(const Track& t, std::size_t f) {
        std::string text;
        for (std::size_t i = 0; i < t.points; ++i)
            text += (i > 0 ? " " : "") + number(t.at(f)[2 * i]) + "," + number(t.at(f)[2 * i + 1]);
        return text;
    }

    void add(const Track& track) {
        const bool is_stroke = track.shape == Shape::polyline || track.shape == Shape::loop;
        const auto keys = keys_of(track, film_.tolerance, film_.steps);
        switch (track.shape) {
        case Shape::disc:
            return write(track, keys, "circle", {{"cx", x}, {"cy", y}, {"r", radius}}, false);
        case Shape::text:
            return write(track, keys, "text", {{"x", x}, {"y", y}, {"font-size", width}}, false);
        case Shape::polyline:
            if (track.points == 1) return write(track, keys, "circle", {{"cx", x}, {"cy", y}, {"r", radius}}, false);
            return write(track, keys, "polyline", {{"points", points}, {"stroke-width", width}}, is_stroke);
        default:
            if (is_stroke) return write(track, keys, "polygon", {{"points", points}, {"stroke-width", width}}, true);
            return write(track, keys, "polygon", {{"points", points}}, false);
        }
    }

    struct Attribute {
        const char* name;
        Value value;
    };

    void write(const Track& track, const std::vector<std::size_t>& keys, const char* element,
               std::vector<Attribute> attributes, bool is_stroke) {
        attributes.push_back({is_stroke ? "stroke" : "fill", color});
        const bool is_clear = std::any_of(keys.begin(), keys.end(), [&](auto key) { return style(track, key)[4] < 1; });
        if (is_clear) attributes.push_back({is_stroke ? "stroke-opacity" : "fill-opacity", alpha});
        std::string inside;
        put("<{}{}", element, is_stroke ? " fill=\"none\"" : "");
        for (const auto& [name, value] : attributes) {
            put(" {}=\"{}\"", name, value(track, keys[0]));
            inside += animation(track, keys, name, value);
        }
        inside += visibility(track);
        put(">{}{}</{}>\n", inside, escaped(track.text), element);
    }

    /// Share of the whole time at a frame of a track.
    double share(const Track& track, std::size_t frame) const { return double(track.first + frame) / frames_; }

    /// An <animate> of an attribute; empty if it keeps its value.
    std::string animation(const Track& track, const std::vector<std::size_t>& keys, const char* name, Value value) {
        std::string values, times;
        bool varies = false;
        const auto first = value(track, keys[0]);
        const auto add_key = [&](double time, const std::string& text) {
            if (!times.empty()) times += ';', values += ';';
            times += format_text("{:5}", time), values += text;
            varies |= text != first;
        };
        if (track.first > 0) add_key(0, first);
        for (const auto key : keys) add_key(share(track, key), value(track, key));
        if (!varies) return {};
        if (!film_.steps) add_key(1, value(track, keys.back()));
        return animate(name, values, times, film_.steps);
    }

    /// Hides a track before its first frame and after its last.
    std::string visibility(const Track& track) {
        const bool begins = track.first == 0, ends = track.end() == film_.recorder.frames();
        if (begins && ends) return {};
        std::string values = begins ? "visible" : "hidden;visible", times = begins ? "0" : "0;";
        if (!begins) times += format_text("{:5}", share(track, 0));
        if (!ends) values += ";hidden", times += format_text(";{:5}", share(track, track.frames()));
        return animate("visibility", values, times, true);
    }

    std::string animate(const char* name, const std::string& values, const std::string& times, bool steps) const {
        return format_text("<animate attributeName=\"{}\" dur=\"{:6}s\" repeatCount=\"indefinite\" {}keyTimes=\"{}\" "
                           "values=\"{}\"/>",
                           name, frames_ / film_.fps, steps ? "calcMode=\"discrete\" " : "", times, values);
    }

    const VectorFilm& film_;
    const double frames_;
    std::string text_;
};

std::string svg_text(const VectorFilm& film) {
    return SvgText(film).text();
}

} // namespace

std::unique_ptr<Exporter> open_animated_svg(const ExportRequest& request) {
    return open_vectors(request, svg_text);
}

} // namespace sinew::files
