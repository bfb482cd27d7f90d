#pragma once

#include "sinew/scene/collider_section.h"
#include "sinew/scene/document.h"
#include "sinew/scene/event_section.h"
#include "sinew/scene/figure_section.h"
#include "sinew/scene/image.h"
#include "sinew/scene/model.h"
#include "sinew/scene/pair_section.h"
#include "sinew/scene/trace_section.h"
#include "sinew/scene/units.h"
#include "sinew/scene/world_section.h"
#include "sinew/world/world.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// A scene file as data. Every section is a record; reading, checking, description and writing follow from its fields.
namespace sinew {

struct UnitsSection {
    std::string length = "m";
    std::string time = "s";
    std::string up = "+y";

    static constexpr std::array<std::string_view, 4> lengths = {"m", "cm", "mm", "px"};
    static constexpr std::array<std::string_view, 2> times = {"s", "frame"};
    static constexpr std::array<std::string_view, 2> ups = {"+y", "-y"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.length, Field{.name = "length", .help = "Length unit: 100 px are a metre", .choices = lengths});
        visit(self.time, Field{.name = "time", .help = "Time unit: 60 frames are a second", .choices = times});
        visit(self.up, Field{.name = "up", .help = "Upward direction: -y as on screens", .choices = ups});
    }
};

/// Camera of a 3D scene.
struct CameraSection {
    Vec3<double> eye{{0, 1.5, 5}};
    Vec3<double> target{};
    double field_of_view = pi<double> / 4;
    std::string projection = "perspective";

    static constexpr std::array<std::string_view, 2> projections = {"perspective", "orthographic"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.eye, Field{.name = "eye", .help = "Position of the camera", .unit = unit::length});
        visit(self.target, Field{.name = "target", .help = "Point the camera looks at", .unit = unit::length});
        visit(self.field_of_view, Field{.name = "field_of_view",
                                        .help = "Vertical angle of view",
                                        .unit = unit::angle,
                                        .low = pi<double> / 180,
                                        .high = 170 * pi<double> / 180});
        visit(self.projection, Field{.name = "projection",
                                     .help = "Projection; orthographic draws everything at the scale of the target",
                                     .choices = projections});
    }
};

struct ViewSection {
    std::array<int, 2> size = {640, 480};
    std::optional<Point> center;
    std::optional<double> height;
    CameraSection camera;
    std::string theme = "light";
    bool plain = false;

    static constexpr std::array<std::string_view, 2> themes = {"light", "dark"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.size, Field{.name = "size", .help = "Width and height in pixels", .low = 1, .high = 16384});
        visit(
            self.center,
            Field{.name = "center",
                  .help = "Middle of the picture (2D); left out: half the size in px, else the middle of what is shown",
                  .unit = unit::length});
        visit(
            self.height,
            Field{.name = "height",
                  .help = "Height of the visible part of the scene (2D); left out: the size in px, else what shows all",
                  .unit = unit::length,
                  .low = 1e-6,
                  .high = 1e8});
        visit(self.camera, Field{.name = "camera", .help = "Camera of a 3D scene"});
        visit(self.theme,
              Field{.name = "theme", .help = "Default colours, for parts without looks", .choices = themes});
        visit(self.plain, Field{.name = "plain", .help = "Plain drawing: no outlines, shadows or highlights"});
    }
};

/// Effects of the pointer on a scene, in any window.
struct PointerSection {
    double cut_radius = 0;
    double grab_radius = 0;
    double grab_gain = 1;
    double wheel_time_scale = 0;
    double hover_size = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.cut_radius, Field{.name = "cut_radius",
                                     .help = "Distance from the pointer's cut within which links are cut too",
                                     .unit = unit::length,
                                     .low = 0,
                                     .high = 1e6});
        visit(
            self.grab_radius,
            Field{
                .name = "grab_radius",
                .help =
                    "Distance around the grabbed particle within which the rest of its figure is pulled along; in "
                    "classic mode the pointer grabs nothing and drags along particles within this distance of its path",
                .unit = unit::length,
                .low = 0,
                .high = 1e6});
        visit(self.grab_gain,
              Field{.name = "grab_gain",
                    .help = "Speed of dragged particles, as a multiple of the pointer's speed (classic mode)",
                    .low = 0,
                    .high = 100});
        visit(self.wheel_time_scale,
              Field{.name = "wheel_time_scale",
                    .help = "Change of solver.rules.time_scale for each notch of the wheel, up to "
                            "a scale of 5; with 0 the wheel zooms (classic mode)",
                    .low = 0,
                    .high = 5});
        visit(self.hover_size, Field{.name = "hover_size",
                                     .help = "Side of the square around a particle in which the pointer hovers over "
                                             "it, for solver.rules.hover_freezes (2D, classic mode)",
                                     .unit = unit::length,
                                     .low = 0,
                                     .high = 1e6});
    }
};

struct Scene {
    // Special members are defined in scene.cpp, because each one generates a lot of code.
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
    std::vector<ColliderSection> colliders;
    std::vector<FigureSection> figures;
    std::vector<ConstraintSection> constraints;
    std::vector<PinSection> pins;
    std::vector<PairSection> pairs;
    std::vector<std::pair<std::string, Look>> looks;
    std::vector<EventSection> events;
    std::vector<TraceSection> traces;
    double seconds = 10;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.version,
              Field{.name = "sinew", .help = "Version of the format", .low = 1, .high = 1, .required = true});
        visit(self.about, Field{.name = "about", .help = "Description in a sentence or two"});
        visit(self.source, Field{.name = "source", .help = "Source of the idea"});
        visit(self.category, Field{.name = "category", .help = "Group of scenes in lists", .choices = categories});
        visit(self.dimension, Field{.name = "dimension", .help = "Number of dimensions: 2 or 3", .low = 2, .high = 3});
        visit(self.units, Field{.name = "units", .help = "Units of the numbers in the file"});
        visit(self.view, Field{.name = "view", .help = "Visible part of the scene, camera and theme"});
        visit(self.pointer, Field{.name = "pointer", .help = "Effects of the pointer"});
        visit(self.world, Field{.name = "world", .help = "Gravity, damping, walls and forces"});
        visit(self.solver, Field{.name = "solver", .help = "Mode, precision and settings of the solver"});
        visit(self.colliders,
              Field{.name = "colliders", .help = "Rigid shapes that figures touch: obstacles, terrain"});
        visit(self.figures, Field{.name = "figures", .help = "Figures: prefabs, or particles by hand"});
        visit(self.constraints, Field{.name = "constraints", .help = "Constraints between figures"});
        visit(self.pins, Field{.name = "pins", .help = "Pins: particles that are held or driven"});
        visit(self.pairs, Field{.name = "pairs", .help = "Bounce and friction of pairs that touch (physical mode)"});
        visit(self.looks, Field{.name = "looks", .help = "Looks by figure/part, by figure or by part"});
        visit(self.events, Field{.name = "events", .help = "Events at given times, or on contact"});
        visit(self.traces, Field{.name = "traces", .help = "Traces of the past: paths and curves"});
        visit(self.seconds, Field{.name = "seconds",
                                  .help = "Duration worth watching; the default duration of render",
                                  .low = 0.01,
                                  .high = 86400});
    }

    /// Conversion from SI units to the scene's units.
    Units measures() const;
};

using AnyWorld = EveryWorld<std::variant, World>;

/// Rule by which classic mode holds a grabbed or driven particle.
Hold hold_rule(const Scene& scene);

/// True if this build has worlds of the dimension and the precision, float or double.
bool has_world(int dimension, std::string_view precision);

/// Builds the world of a valid scene, at the start of the scene.
AnyWorld instantiate(const Scene& scene);
/// Adds a figure to the world of a scene, as one more.
void add_figure(const Scene& scene, const FigureSection& section, AnyWorld& world);

struct Opened {
    Scene scene;
    AnyWorld world; ///< state at the start of the scene
    Images images;
};

/// Reads the scene of a document and builds its world. Returns nothing if there is any error, including errors beyond
/// single values (names used twice or unknown, sizes above the limits, unreadable images); the document's diagnostics
/// then list the errors. Without an image reader, shapes are drawn instead of images; without a model reader, every
/// mesh is the default square.
std::optional<Opened> open_scene(Document& document, const ImageReader& images = {}, const ModelReader& models = {});

/// The scene as a file states it, without default values.
json::Value to_json(const Scene& scene);
/// A figure of the scene, as a file states it.
json::Value to_json(const Scene& scene, const FigureSection& figure);

/// Duration of a step, in the scene's time unit.
double step_length(const Scene& scene);

} // namespace sinew
