#include "files/out/export_formats.h"
#include "files/out/vector_film.h"

#include <cmath>
#include <nlohmann/json.hpp>

/// Lottie 5.7: shape layers whose paths, colours and widths have keys.
namespace sinew::files {
namespace {

using Json = nlohmann::json;

/// Hundredths of a pixel, thousandths of a colour.
double rounded(float value, double places) {
    return std::round(double(value) * places) / places;
}

class LottieText {
  public:
    explicit LottieText(const VectorFilm& film) : film_(film) {}

    std::string text() const {
        Json layers = Json::array();
        const auto& tracks = film_.recorder.tracks();
        for (auto track = tracks.rbegin(); track != tracks.rend();) { // the first layer is on top
            Json shapes = Json::array();
            const auto first = track->first, end = track->end();
            for (; track != tracks.rend() && track->first == first && track->end() == end; ++track)
                if (track->shape != Shape::text) shapes.push_back(group(*track));
            if (!shapes.empty()) layers.push_back(layer(std::move(shapes), first, end, layers.size() + 1));
        }
        if (film_.background.alpha > 0) layers.push_back(backdrop(layers.size() + 1));
        const Json root{{"v", "5.7.0"},
                        {"fr", film_.fps},
                        {"ip", 0},
                        {"op", film_.recorder.frames()},
                        {"w", film_.size[0]},
                        {"h", film_.size[1]},
                        {"nm", "Sinew"},
                        {"ddd", 0},
                        {"assets", Json::array()},
                        {"layers", std::move(layers)}};
        return root.dump();
    }

  private:
    static Json still(Json value) { return {{"a", 0}, {"k", std::move(value)}}; }

    Json layer(Json shapes, std::size_t first, std::size_t end, std::size_t index) const {
        const Json placed{{"o", still(100)},
                          {"r", still(0)},
                          {"p", still({0, 0, 0})},
                          {"a", still({0, 0, 0})},
                          {"s", still({100, 100, 100})}};
        return {{"ddd", 0},
                {"ind", index},
                {"ty", 4},
                {"sr", 1},
                {"ks", placed},
                {"ao", 0},
                {"ip", first},
                {"op", end},
                {"st", 0},
                {"bm", 0},
                {"shapes", std::move(shapes)}};
    }

    Json backdrop(std::size_t index) const {
        const auto& b = film_.background;
        const auto w = film_.size[0], h = film_.size[1];
        Json items =
            Json::array({{{"ty", "rc"}, {"p", still({w / 2.0, h / 2.0})}, {"s", still({w, h})}, {"r", still(0)}},
                         {{"ty", "fl"}, {"c", still({b.red, b.green, b.blue, 1})}, {"o", still(100 * b.alpha)}},
                         placed()});
        return layer(Json::array({{{"ty", "gr"}, {"it", std::move(items)}}}), 0, film_.recorder.frames(), index);
    }

    static Json placed() {
        return {{"ty", "tr"},    {"p", still({0, 0})}, {"a", still({0, 0})}, {"s", still({100, 100})},
                {"r", still(0)}, {"o", still(100)}};
    }

    static const float* style(const Track& track, std::size_t frame) { return track.at(frame) + 2 * track.points; }

    /// A property with a key at each frame of `keys`, or still if it keeps its value.
    template <class Value> Json keyed(const Track& track, const std::vector<std::size_t>& keys, Value&& value) const {
        std::vector<Json> values;
        bool varies = false;
        for (const auto key : keys) {
            values.push_back(value(key));
            varies |= values.back() != values.front();
        }
        if (!varies) return still(std::move(values.front()));
        Json list = Json::array();
        for (std::size_t i = 0; i < keys.size(); ++i) {
            Json key{{"t", track.first + keys[i]}};
            const bool is_list = values[i].is_array() && !values[i].empty() && values[i][0].is_number();
            key["s"] = is_list ? std::move(values[i]) : Json::array({std::move(values[i])});
            if (film_.steps)
                key["h"] = 1;
            else if (i + 1 < keys.size())
                key["o"] = {{"x", 0}, {"y", 0}}, key["i"] = {{"x", 1}, {"y", 1}};
            list.push_back(std::move(key));
        }
        return {{"a", 1}, {"k", std::move(list)}};
    }

    Json group(const Track& track) const {
        const auto keys = keys_of(track, film_.tolerance, film_.steps);
        Json items = Json::array({outline(track, keys)});
        const auto color = keyed(track, keys, [&](std::size_t i) {
            const float* rgb = style(track, i) + 1;
            return Json{rounded(rgb[0], 1000), rounded(rgb[1], 1000), rounded(rgb[2], 1000), 1};
        });
        const auto opacity =
            keyed(track, keys, [&](std::size_t i) { return Json(rounded(style(track, i)[4], 1000) * 100); });
        if (track.shape == Shape::polyline || track.shape == Shape::loop)
            items.push_back(
                {{"ty", "st"}, {"c", color}, {"o", opacity}, {"lc", 2}, {"lj", 2}, {"w", width(track, keys)}});
        else
            items.push_back({{"ty", "fl"}, {"c", color}, {"o", opacity}, {"r", 2}});
        items.push_back(placed());
        return {{"ty", "gr"}, {"it", std::move(items)}};
    }

    Json width(const Track& track, const std::vector<std::size_t>& keys) const {
        return keyed(track, keys, [&](std::size_t i) { return Json(rounded(style(track, i)[0], 100)); });
    }

    Json outline(const Track& track, const std::vector<std::size_t>& keys) const {
        if (track.shape == Shape::disc) {
            const auto middle = keyed(track, keys, [&](std::size_t i) { return point(track.at(i)); });
            const auto size = keyed(track, keys, [&](std::size_t i) {
                const auto width = rounded(style(track, i)[0], 100);
                return Json{width, width};
            });
            return {{"ty", "el"}, {"d", 1}, {"p", middle}, {"s", size}};
        }
        return {{"ty", "sh"}, {"ks", keyed(track, keys, [&](std::size_t i) { return path(track, i); })}};
    }

    static Json point(const float* xy) { return {rounded(xy[0], 100), rounded(xy[1], 100)}; }

    static Json path(const Track& track, std::size_t frame) {
        Json corners = Json::array(), straight = Json::array();
        for (std::size_t i = 0; i < track.points; ++i) {
            corners.push_back(point(track.at(frame) + 2 * i));
            straight.push_back({0, 0});
        }
        return {{"i", straight}, {"o", straight}, {"v", std::move(corners)}, {"c", track.shape != Shape::polyline}};
    }

    const VectorFilm& film_;
};

std::string lottie_text(const VectorFilm& film) {
    return LottieText(film).text();
}

} // namespace

std::unique_ptr<Exporter> open_lottie(const ExportRequest& request) {
    return open_vectors(request, lottie_text);
}

} // namespace sinew::files
