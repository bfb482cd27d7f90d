#include "sinew/scene/text.h"

#include "files/in/formats.h"
#include "files/in/json_building.h"
#include "files/in/json_file.h"
#include "files/in/notes.h"

#include <algorithm>
#include <map>

namespace sinew::files {
namespace {

// Constants of Coding Math, episodes 36 to 39: a canvas of 640 x 480, five sweeps a frame.
constexpr int canvas_width = 640, canvas_height = 480, sweeps = 5;
constexpr double frame_gravity = 0.5, frame_keep = 0.999, wall_bounce = 0.9;
constexpr std::size_t most_corners_of_a_form = 1000;

class PointsReader {
  public:
    PointsReader(const ImportFile& file) : file_(file), json_(file.name, file.bytes), root_(json_) {}

    Imported read() {
        if (!root_.object()) root_.fail("expected an object with points and sticks");
        if (root_["points"].size() > ImportLimits::particles)
            root_["points"].fail(concat("at most ", ImportLimits::particles, " points are imported"));
        for (std::size_t i = 0; i < root_["points"].size(); ++i) add_point(root_["points"][i], i);
        if (particles_.empty()) root_.fail("there is no point in it");
        constexpr std::size_t most = 5 * ImportLimits::particles;
        for (const auto* const part : {"sticks", "forms"})
            if (root_[part].size() > most) root_[part].fail(concat("at most ", most, " ", part, " are imported"));
        for (std::size_t i = 0; i < root_["sticks"].size(); ++i) add_stick(root_["sticks"][i], i);
        for (std::size_t i = 0; i < root_["forms"].size(); ++i) add_form(root_["forms"][i], i);
        pass_over(root_, {"points", "sticks", "forms"});
        return {scene(), notes_.taken(), {}};
    }

  private:
    const ImportFile& file_;
    JsonFile json_;
    JsonNode root_;
    Notes notes_;
    json::Object particles_, looks_;
    json::Array constraints_, pieces_;
    std::size_t corners_ = 0;                               ///< of all forms
    std::map<std::string, std::string, std::less<>> names_; ///< particle of each id

    void pass_over(const JsonNode& node, std::initializer_list<std::string_view> known) {
        for (const auto& member : *node.object())
            if (std::ranges::find(known, std::string_view(member.key)) == known.end())
                notes_.count(node[member.key].place(), concat(in_quotes(member.key), " is not taken"));
    }

    void add_point(const JsonNode& node, std::size_t i) {
        if (!node.object()) node.fail("a point is an object with x and y");
        const auto name = concat("p", i);
        const auto id = node["id"].exists() ? node["id"] : node["name"];
        if (const auto* text = id.exists() ? id.value()->as<std::string>() : nullptr) names_.emplace(*text, name);
        const Vec2<double> at{{coordinate(node["x"]), coordinate(node["y"])}};
        json::Object particle{{"at", point_json(at)}};
        const auto old_x = node["oldx"].exists() ? node["oldx"] : node["oldX"];
        const auto old_y = node["oldy"].exists() ? node["oldy"] : node["oldY"];
        if (old_x.exists() || old_y.exists())
            particle.push_back({"previous", point_json(Vec2<double>{{old_x.exists() ? coordinate(old_x) : at[0],
                                                                     old_y.exists() ? coordinate(old_y) : at[1]}})});
        if (node["pinned"].truth_or(false)) particle.push_back({"pinned", true});
        particles_.push_back({name, particle});
        pass_over(node, {"x", "y", "oldx", "oldy", "oldX", "oldY", "pinned", "id", "name"});
    }

    static double coordinate(const JsonNode& node) {
        constexpr double most = 1e6;
        const double number = node.number();
        if (!(absolute(number) <= most)) node.fail("a coordinate is at most a million pixels");
        return number;
    }

    /// The particle that a stick or a form names, by its number or its id.
    std::string particle(const JsonNode& node) const {
        if (!node.exists()) node.fail("a point is missing here");
        if (const auto* text = node.value()->as<std::string>()) {
            const auto found = names_.find(*text);
            if (found == names_.end()) node.fail(concat("no point is called ", in_quotes(*text)));
            return found->second;
        }
        return concat("p", node.index(particles_.size() - 1));
    }

    void add_stick(const JsonNode& node, std::size_t i) {
        const bool is_pair = node.exists() && node.value()->as<json::Array>();
        if (!is_pair && !node.object()) node.fail("a stick is an object with p0 and p1");
        const auto first = particle(is_pair ? node[0] : node["p0"]), second = particle(is_pair ? node[1] : node["p1"]);
        if (first == second) node.fail("a stick joins two points, found one twice");
        const auto name = concat("stick_", i);
        json::Object stick{{"name", name}, {"between", json::Array{first, second}}};
        if (const auto length = node["length"]; length.exists()) {
            if (!(length.number() >= 0 && length.number() <= 1e6))
                length.fail("a length is from 0 to a million pixels");
            stick.push_back({"rest", rounded_number(length.number())});
        }
        if (node["hidden"].truth_or(false)) stick.push_back({"hidden", true});
        constraints_.push_back(stick);
        if (is_pair) return;
        pass_over(node, {"p0", "p1", "length", "hidden"});
    }

    void add_form(const JsonNode& node, std::size_t i) {
        const auto path = node["path"];
        if (!path.exists()) return notes_.count(node.place(), "a form without a path, such as an image, is not taken");
        if (path.size() < 3 || path.size() > most_corners_of_a_form)
            path.fail(concat("a form has 3 to ", most_corners_of_a_form, " points"));
        if ((corners_ += path.size()) > 5 * ImportLimits::particles) path.fail("the forms have too many points");
        json::Array through;
        for (std::size_t k = 0; k < path.size(); ++k) through.push_back(particle(path[k]));
        const auto part = concat("form_", i);
        pieces_.push_back(json::Object{{"mark", "fill"}, {"part", part}, {"through", through}});
        pass_over(node, {"path"});
    }

    json::Object scene() {
        json::Object figure{{"name", "figure"}, {"particles", std::move(particles_)}};
        if (!constraints_.empty()) figure.push_back({"constraints", std::move(constraints_)});
        if (!pieces_.empty()) figure.push_back({"pieces", std::move(pieces_)});
        const json::Array low{0, 0}, high{canvas_width, canvas_height};
        const json::Object bounds{{"box", json::Array{low, high}}, {"bounce", wall_bounce}};
        return {{"sinew", 1},
                {"about", concat("Imported from ", file_.name)},
                {"units", json::Object{{"length", "px"}, {"time", "frame"}, {"up", "-y"}}},
                {"view", json::Object{{"size", high}}},
                {"world",
                 json::Object{{"gravity", json::Array{0, frame_gravity}}, {"damping", frame_keep}, {"bounds", bounds}}},
                {"solver", json::Object{{"mode", "classic"}, {"passes", sweeps}}},
                {"figures", json::Array{std::move(figure)}},
                {"seconds", 10}};
    }
};

bool has_points_and_sticks(std::string_view bytes) {
    const auto begin = bytes.find_first_not_of(" \t\r\n");
    return begin != bytes.npos && bytes[begin] == '{' && bytes.find("\"points\"") != bytes.npos &&
           bytes.find("\"sticks\"") != bytes.npos;
}

} // namespace

const ImportFormat reader::points_and_sticks{
    "points and sticks", "json", "Coding Math's {points, sticks, forms}, with its rules", has_points_and_sticks,
    [](const ImportFile& file, const ImportOptions&) { return PointsReader(file).read(); }};

} // namespace sinew::files
