#pragma once

#include "sinew/scene/reader.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// A small scene format that has every type a field can have.
namespace sinew::sample {

struct Rope {
    static constexpr std::string_view name = "rope";
    static constexpr std::string_view about = "Pieces in a row.";
    int segments = 20;
    double length = 1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.segments, Field{.name = "segments", .help = "How many pieces", .low = 1, .high = 1000});
        visit(self.length,
              Field{.name = "length", .help = "Of the whole", .unit = unit::length, .low = 0.02, .high = 100});
    }
};

struct Ragdoll {
    static constexpr std::string_view name = "ragdoll";
    double height = 1.8;
    double bend = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.height, Field{.name = "height", .help = "Head to foot", .unit = unit::length, .low = 0});
        visit(self.bend,
              Field{.name = "bend", .help = "Of the knees", .unit = unit::angle, .low = 0, .high = pi<double>});
    }
};

struct Figure {
    std::string name;
    Point at{};
    std::optional<double> mass;
    std::optional<std::variant<Rope, Ragdoll>> prefab;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.name, Field{.name = "name", .help = "Its name"});
        visit(self.at, Field{.name = "at", .help = "Where it stands", .unit = unit::length});
        visit(self.mass, Field{.name = "mass", .help = "Of the whole", .unit = unit::mass, .low = 0});
        visit(self.prefab, Field{.name = "prefab", .help = "What it is"});
    }
};

struct Drag {
    static constexpr std::string_view name = "drag";
    double strength = 0;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.strength, Field{.name = "strength", .help = "Force over speed", .unit = unit::drag, .low = 0});
    }
};

struct Wind {
    static constexpr std::string_view name = "wind";
    Point velocity{};
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.velocity, Field{.name = "velocity", .help = "Of the air", .unit = unit::speed, .required = true});
    }
};

struct Force {
    std::variant<Drag, Wind> law;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.law, Field{.name = "force", .help = "Which law it follows", .required = true});
    }
};

struct Grab {
    static constexpr std::string_view name = "grab";
    std::string grab;
    Point to{};
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.grab, Field{.name = "grab", .help = "The particle held", .required = true});
        visit(self.to, Field{.name = "to", .help = "Where it is taken", .unit = unit::length, .required = true});
    }
};

struct Release {
    static constexpr std::string_view name = "release";
    std::string release;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.release, Field{.name = "release", .help = "The particle let go", .required = true});
    }
};

struct Event {
    double at = 0;
    std::variant<Grab, Release> action;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at, Field{.name = "at", .help = "When", .unit = unit::time, .low = 0});
        visit(self.action, Field{.required = true});
    }
};

struct Solver {
    static constexpr std::array<std::string_view, 2> precisions = {"float", "double"};
    std::string mode = "physical", precision = "double";
    int substeps = 8;
    bool tethers = true;
    std::int64_t seed = 0;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.mode, Field{.name = "mode", .help = "Whose rules", .choices = modes_allowed});
        visit(self.precision, Field{.name = "precision", .help = "Of the numbers", .choices = precisions});
        visit(self.substeps, Field{.name = "substeps", .help = "Per step", .low = 1, .high = 1024});
        visit(self.tethers, Field{.name = "tethers", .help = "Whether cloth is kept from sagging"});
        visit(self.seed, Field{.name = "seed", .help = "Of what is random"});
    }
    static constexpr std::array<std::string_view, 2> modes_allowed = {"physical", "classic"};
};

struct Scene {
    int version = 1;
    std::string about;
    std::array<Point, 2> box{};
    Vec<2, double> size{{640, 480}};
    Solver solver;
    std::vector<Figure> figures;
    std::vector<Force> forces;
    std::vector<Event> events;
    std::vector<std::pair<std::string, double>> masses;
    json::Value extra;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.version, Field{.name = "sinew", .help = "Version", .low = 1, .high = 1, .required = true});
        visit(self.about, Field{.name = "about", .help = "One line"});
        visit(self.box, Field{.name = "box", .help = "Two corners", .unit = unit::length});
        visit(self.size, Field{.name = "size", .help = "Pixels of the view", .low = 1});
        visit(self.solver, Field{.name = "solver", .help = "How it is solved"});
        visit(self.figures, Field{.name = "figures", .help = "What is in it"});
        visit(self.forces, Field{.name = "forces", .help = "What acts on it"});
        visit(self.events, Field{.name = "events", .help = "What happens"});
        visit(self.masses, Field{.name = "masses", .help = "By name", .unit = unit::mass, .low = 0});
        visit(self.extra, Field{.name = "extra", .help = "Anything"});
    }
};

inline constexpr std::string_view good_scene = R"({
  // A scene that uses everything.
  "sinew": 1, "about": "Bob and a rope: größer, 日本",
  "box": [[0, 0], [640, 480]], "size": [800, 600],
  "solver": {"mode": "physical", "substeps": 16, "tethers": false, "seed": 9007199254740993},
  "figures": [
    {"prefab": "ragdoll", "name": "bob", "at": [320, 200], "height": 180, "bend": 90},
    {"prefab": "rope", "name": "left", "segments": 1e2, "mass": 0.5},
    {"name": "bare", "at": [1.5, -2e-3]}
  ],
  "forces": [{"force": "drag", "strength": 0.1}, {"force": "wind", "velocity": [1, 0]}],
  "events": [{"at": 60, "grab": "bob/hand", "to": [500, 100]}, {"at": 90, "release": "bob/hand"}],
  "masses": {"head": 4, "hand": 2},
  "extra": {"anything": [true, null, "x", {"y": 1}]},
  "modes": {"classic": {"solver": {"substeps": 1}, "figures": {"bob": {"height": 160}}}}
}
)";

} // namespace sinew::sample
