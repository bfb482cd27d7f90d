#pragma once

#include "sinew/scene/document.h"
#include "sinew/scene/event_section.h"
#include "sinew/scene/figure_section.h"
#include "sinew/scene/image.h"
#include "sinew/scene/model.h"
#include "sinew/scene/trace_section.h"
#include "sinew/scene/units.h"
#include "sinew/scene/world_section.h"
#include "sinew/solver/world.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// A scene file as data: what it says, not what becomes of it. Every section is a record, which is all there is to know
/// about reading, checking, describing and writing it.
namespace sinew {

struct UnitsSection {
    std::string length = "m";
    std::string time = "s";
    std::string up = "+y";

    static constexpr std::array<std::string_view, 4> lengths = {"m", "cm", "mm", "px"};
    static constexpr std::array<std::string_view, 2> times = {"s", "frame"};
    static constexpr std::array<std::string_view, 2> ups = {"+y", "-y"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.length, Field{.name = "length", .help = "100 px are a metre", .choices = lengths});
        visit(self.time, Field{.name = "time", .help = "60 frames are a second", .choices = times});
        visit(self.up, Field{.name = "up", .help = "Which way is up: -y as on screens", .choices = ups});
    }
};

/// Where a 3D scene is looked at from.
struct CameraSection {
    Vec3<double> eye{{0, 1.5, 5}};
    Vec3<double> target{};
    double field_of_view = pi<double> / 4;
    std::string projection = "perspective";

    static constexpr std::array<std::string_view, 2> projections = {"perspective", "orthographic"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.eye, Field{.name = "eye", .help = "Where it is", .unit = unit::length});
        visit(self.target, Field{.name = "target", .help = "What it looks at", .unit = unit::length});
        visit(self.field_of_view, Field{.name = "field_of_view",
                                        .help = "From the top of the picture to its bottom",
                                        .unit = unit::angle,
                                        .low = pi<double> / 180,
                                        .high = 170 * pi<double> / 180});
        visit(self.projection, Field{.name = "projection",
                                     .help = "Orthographic: what is far is as large as what is at the target",
                                     .choices = projections});
    }
};

struct ViewSection {
    std::array<int, 2> size = {640, 480};
    std::optional<Point> center;
    std::optional<double> height;
    CameraSection camera;
    std::string theme = "light";

    static constexpr std::array<std::string_view, 2> themes = {"light", "dark"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.size, Field{.name = "size", .help = "Width and height in pixels", .low = 1, .high = 16384});
        visit(self.center, Field{.name = "center",
                                 .help = "Middle of the picture (2D); left out: half the size in px, else the origin",
                                 .unit = unit::length});
        visit(self.height, Field{.name = "height",
                                 .help = "How much of the scene the picture shows from top to bottom (2D)",
                                 .unit = unit::length,
                                 .low = 1e-6,
                                 .high = 1e8});
        visit(self.camera, Field{.name = "camera", .help = "Where a 3D scene is looked at from"});
        visit(self.theme, Field{.name = "theme", .help = "Colours of what has no looks of its own", .choices = themes});
    }
};

/// What a pointer does to the scene, in whatever window it is.
struct PointerSection {
    double cuts_within = 0;
    double pulls_within = 0;
    double pulls_times = 1;
    double wheel_quickens = 0;
    double hover_size = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.cuts_within, Field{.name = "cuts_within",
                                      .help = "How near to what it cuts along distances are cut too",
                                      .unit = unit::length,
                                      .low = 0,
                                      .high = 1e6});
        visit(self.pulls_within,
              Field{.name = "pulls_within",
                    .help = "How near to what it grabs the rest of its figure is pulled along; in "
                            "classic mode it holds nothing, but drags along what is as near to its way",
                    .unit = unit::length,
                    .low = 0,
                    .high = 1e6});
        visit(self.pulls_times, Field{.name = "pulls_times",
                                      .help = "How many times as fast as itself that goes (classic mode)",
                                      .low = 0,
                                      .high = 100});
        visit(self.wheel_quickens, Field{.name = "wheel_quickens",
                                         .help = "What a notch of its wheel adds to solver.rules.time_scale, up to 5; "
                                                 "0: the wheel zooms (classic mode)",
                                         .low = 0,
                                         .high = 5});
        visit(self.hover_size, Field{.name = "hover_size",
                                     .help = "Side of the square around a particle in which the pointer is over it, "
                                             "for solver.rules.hover_freezes (2D, classic mode)",
                                     .unit = unit::length,
                                     .low = 0,
                                     .high = 1e6});
    }
};

struct Scene {
    // Defined once, in scene.cpp: it is a lot to make and to copy.
    Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    int version = 1;
    std::string about, source, category = "other";

    static constexpr std::array<std::string_view, 7> categories = {"basics",     "ropes",    "cloth", "bodies",
                                                                   "characters", "machines", "other"};

    int dimension = 2;
    UnitsSection units;
    ViewSection view;
    PointerSection pointer;
    WorldSection world;
    SolverSection solver;
    std::vector<FigureSection> figures;
    std::vector<ConstraintSection> constraints;
    std::vector<PinSection> pins;
    std::vector<std::pair<std::string, Look>> looks;
    std::vector<EventSection> events;
    std::vector<TraceSection> traces;
    double seconds = 10;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.version,
              Field{.name = "sinew", .help = "Version of the format", .low = 1, .high = 1, .required = true});
        visit(self.about, Field{.name = "about", .help = "What it shows, in a sentence or two"});
        visit(self.source, Field{.name = "source", .help = "Where the idea is from"});
        visit(self.category, Field{.name = "category", .help = "Which scenes it is shown with", .choices = categories});
        visit(self.dimension, Field{.name = "dimension", .help = "2 or 3", .low = 2, .high = 3});
        visit(self.units, Field{.name = "units", .help = "What the numbers of the file are in"});
        visit(self.view, Field{.name = "view", .help = "What is seen of it"});
        visit(self.pointer, Field{.name = "pointer", .help = "What a pointer does to it"});
        visit(self.world, Field{.name = "world", .help = "What acts on everything"});
        visit(self.solver, Field{.name = "solver", .help = "How it is solved"});
        visit(self.figures, Field{.name = "figures", .help = "What there is"});
        visit(self.constraints, Field{.name = "constraints", .help = "What joins figures"});
        visit(self.pins, Field{.name = "pins", .help = "What is held"});
        visit(self.looks, Field{.name = "looks", .help = "How parts look: by figure/part, by figure, by part"});
        visit(self.events, Field{.name = "events", .help = "What happens when"});
        visit(self.traces, Field{.name = "traces", .help = "What is drawn of the past: ways and curves"});
        visit(self.seconds, Field{.name = "seconds",
                                  .help = "How long it is worth watching; what render takes",
                                  .low = 0.01,
                                  .high = 86400});
    }

    /// What a metre and a second are worth in it.
    Units measures() const;
};

using AnyWorld = std::variant<World<2, float>, World<2, double>, World<3, float>, World<3, double>>;

/// How classic mode holds what is grabbed or driven.
Hold hold_rule(const Scene& scene);

/// The world of a good scene, at its start.
AnyWorld instantiate(const Scene& scene);

struct Opened {
    Scene scene;
    AnyWorld world; ///< at its start
    Images images;
};

/// Reads the scene of a document and builds its world. Nothing where anything is wrong with it, also beyond single
/// values (names that are used twice or stand for nothing, more than the limits allow, images that cannot be read):
/// then the document's diagnostics say what. Without a reader of images none is looked at, and shapes are drawn
/// instead; without one of models every mesh is the square it is without a file.
std::optional<Opened> open_scene(Document& document, const ImageReader& images = {}, const ModelReader& models = {});

/// As a file states it: what has its default is left out.
json::Value to_json(const Scene& scene);
/// One of its figures.
json::Value to_json(const Scene& scene, const FigureSection& figure);

/// How long a step of the scene is, in its own time unit.
double step_length(const Scene& scene);

} // namespace sinew
