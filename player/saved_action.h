#pragma once

#include "sinew/math/record.h"
#include "sinew/scene/json.h"
#include "sinew/scene/scene.h"

#include "player/action_log.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

/// Actions as records of a file (state_file.h). Particles are identified by rows, because the particles of figures
/// drawn by hand have no names.
namespace sinew::play {

struct SavedPointer {
    static constexpr std::string_view name = "point";
    static constexpr std::string_view about = "Moves the pointer.";
    Point position;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.position, Field{.name = name, .help = "Position of the pointer", .required = true});
    }
};

struct SavedGrab {
    static constexpr std::string_view name = "grab";
    static constexpr std::string_view about = "Grabs particles.";
    std::vector<std::int64_t> members;
    Point position;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.members,
              Field{.name = name, .help = "Rows of particles", .low = 0, .high = 4294967295.0, .required = true});
        visit(self.position, Field{.name = "position", .help = "Grabbed position", .required = true});
    }
};

struct SavedDrag {
    static constexpr std::string_view name = "drag";
    static constexpr std::string_view about = "Drags the grabbed particles.";
    Point position;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.position, Field{.name = name, .help = "New position", .required = true});
    }
};

struct SavedRelease {
    static constexpr std::string_view name = "let_go";
    static constexpr std::string_view about = "Releases the grabbed particles.";
    bool all = true;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.all, Field{.name = name, .help = "Always true", .required = true});
    }
};

struct SavedCut {
    static constexpr std::string_view name = "cut";
    static constexpr std::string_view about = "Cuts along a line as seen in a view.";
    std::array<Point, 2> line{};
    ViewSection view;
    std::array<Point, 2> focus{};
    std::array<int, 2> picture = {1, 1};
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.line, Field{.name = name, .help = "Both ends of the line", .required = true});
        visit(self.view, Field{.name = "view", .help = "View, as in a scene file"});
        visit(self.focus, Field{.name = "focus", .help = "Two corners of a box around the scene at its start"});
        visit(
            self.picture,
            Field{.name = "picture", .help = "Width and height in pixels", .low = 1, .high = 65536, .required = true});
    }
};

struct SavedEdit {
    static constexpr std::string_view name = "become";
    static constexpr std::string_view about = "Continues as another scene.";
    json::Value scene;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.scene, Field{.name = name, .help = "Scene, as in a scene file", .required = true});
    }
};

struct SavedQuicken {
    static constexpr std::string_view name = "quicken";
    static constexpr std::string_view about = "Changes the time scale.";
    double by = 0;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.by,
              Field{.name = name, .help = "Change of the time scale", .low = -1e3, .high = 1e3, .required = true});
    }
};

struct SavedTweak {
    static constexpr std::string_view name = "tweak";
    static constexpr std::string_view about = "Sets the state of a particle.";
    std::int64_t particle = 0;
    std::optional<Point> position, velocity;
    std::optional<double> mass;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle,
              Field{.name = name, .help = "Row of the particle", .low = 0, .high = 4294967295.0, .required = true});
        visit(self.position, Field{.name = "position", .help = "Position"});
        visit(self.velocity, Field{.name = "velocity", .help = "Velocity"});
        visit(self.mass, Field{.name = "mass", .help = "Mass", .low = 0, .high = 1e12});
    }
};

struct SavedSteer {
    static constexpr std::string_view name = "steer";
    static constexpr std::string_view about = "Steers characters and cars.";
    double along = 0, up = 0;
    bool jump = false, hold = false;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.along, Field{.name = name, .help = "To the right", .low = -1, .high = 1, .required = true});
        visit(self.up, Field{.name = "up", .help = "Upwards", .low = -1, .high = 1});
        visit(self.jump, Field{.name = "jump", .help = "Jumps; a car brakes"});
        visit(self.hold, Field{.name = "hold", .help = "Holds ropes and planks"});
    }
};

struct SavedAction {
    std::int64_t step = 0;
    std::variant<SavedPointer, SavedGrab, SavedDrag, SavedRelease, SavedCut, SavedEdit, SavedQuicken, SavedTweak,
                 SavedSteer>
        action;
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.step, Field{.name = "step", .help = "Step of the action", .low = 0, .high = 1e12, .required = true});
        visit(self.action, Field{.required = true});
    }
};

SavedAction saved(const LoggedAction& action);

/// The action of a record; nothing if a scene cannot be opened; `open` reports the failure.
std::optional<Action> action_of(const SavedAction& action,
                                const std::function<std::optional<Opened>(const json::Value& scene)>& open);

} // namespace sinew::play
