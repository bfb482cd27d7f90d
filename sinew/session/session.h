#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/added_figures.h"
#include "sinew/session/collider_motion.h"
#include "sinew/session/contact_rules.h"
#include "sinew/session/driver.h"
#include "sinew/session/event_grabs.h"
#include "sinew/session/history.h"
#include "sinew/session/level.h"
#include "sinew/session/motors.h"
#include "sinew/session/pointer_grab.h"
#include "sinew/session/steering.h"
#include "sinew/session/stroke.h"
#include "sinew/session/view.h"
#include "sinew/solver/solver.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace sinew {

/// State of a session's world, in the scene's own units.
struct Report {
    double seconds = 0; ///< simulated time
    std::uint64_t steps = 0;
    std::size_t particles = 0, constraints = 0;
    std::uint64_t hash = 0;
    double kinetic = 0, potential = 0, stored = 0;
    double energy_lost = 0;                   ///< dissipated in impacts since the start (measure.h)
    double stretch_max = 0, stretch_mean = 0; ///< strain of distances: fractions of rest length
    double max_speed = 0;
};

/// Names of what a world reports, in the order of EventType.
inline constexpr std::array<std::string_view, 5> world_event_names = {"torn", "quarantined", "touched", "parted",
                                                                      "hit"};

/// Entry of a session's log.
struct SessionEvent {
    double seconds = 0;
    /// "torn", "parted", "quarantined", "touched" (a sensor), the phase of a contact for which the scene waits
    /// ("begin", "persist", "end", "hit"), or the name of a scene event ("grab").
    std::string what{};
    std::string where{};     ///< name of the figure or particle in the scene, or the text of a note; may be empty
    std::size_t islands = 0; ///< "parted": number of islands the figure now has (islands.h); else 0
    std::string with{};      ///< contacts: name of the collider or figure touched; may be empty
    double impulse = 0;      ///< contacts: in the step, or of a hit, in the scene's units

    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [seconds, what, where, islands, with, impulse] = self;
        visit(seconds, what, where, islands, with, impulse);
    }
};

using AnySolver = EveryWorld<std::variant, Solver>;

/// A running scene: a world, a clock, the scene's events and a pointer. Headless: the window, the command line and the
/// web page feed a session, and draw() makes its picture.
class Session {
  public:
    explicit Session(Opened opened);
    // Special members are defined in session.cpp, because each one generates a lot of code.
    Session(const Session&);
    Session(Session&&) noexcept;
    Session& operator=(const Session&);
    Session& operator=(Session&&) noexcept;
    ~Session();

    const Scene& scene() const { return scene_; }
    const AnyWorld& world() const { return world_; }
    AnyWorld& world() { return world_; }
    /// Goes on with a new solver, with these options. Results do not depend on solver or options.
    void set_options(const SolverOptions& options);
    SolverOptions options() const;
    /// Asks the program about contacts from now on (contact_filter.h); an empty filter: all act.
    void set_contact_filter(const ContactFilter& filter);
    /// Reports of the solver, from now on.
    void set_reports(const SolverReports& reports);
    /// Prepares the world for the first step, which otherwise does so: Solver::prepare.
    void prepare();

    /// Returns to the scene's initial state.
    void restart();

    /// Begins anew with code beside the scene; null: without. Copies share the code, and snapshots have none.
    void play(std::shared_ptr<Level> level);
    const std::shared_ptr<Level>& level() const { return level_; }
    /// Goes on without the code beside the scene.
    void leave_level() { level_ = nullptr; }
    /// Goes on with other code, as `become` does with another scene: figures whose parts are the same keep their state.
    std::string become(Scene scene, std::shared_ptr<Level> level);
    /// Builds a figure beside those of the scene; its name is free. `model`: the figure whose events steer it as well.
    FigureIndex add(const FigureSection& section, const std::string& model = {});
    /// Figures that were added, and still are.
    const AddedFigures& added() const { return added_; }
    /// Gives an added figure another description, both opened as the only figure of a scene: change_figure().
    std::string change(FigureIndex figure, const Opened& before, const Opened& after);
    /// Controls of characters and cars, for the next steps.
    Steering& steering() { return steering_; }
    const Steering& steering() const { return steering_; }
    /// Memory of the level's code, a part of the session's state.
    std::span<std::byte> level_memory() { return level_memory_; }

    /// Advances by one step of the scene's rate: applies due events, then steps the world.
    void step();
    /// Steps until `seconds` of simulated time have passed, to within half a step.
    void run_until(double seconds);
    double seconds() const;

    /// Position of the pointer, for pins with a pointer driver; empty: the driver's own path.
    void point_at(std::optional<Point> position) { pointer_ = position; }
    /// Position of the pointer, or of the first pin with a pointer driver; empty if there is neither.
    std::optional<Point> pointer() const;

    /// Grabs one particle, or a point between several; releases an earlier grab. False if a particle has been removed
    /// or none can move. In classic mode with a grab radius, starts a stroke (stroke.h).
    bool grab(std::span<const ParticleId> members, const Point& position);
    /// Target of the held point at the end of the next step.
    void drag(const Point& position);
    void let_go();
    /// Grabs as the pointer does, but for strokes, beside all other grabs. Returns the id of the grab, that of its pin;
    /// nothing where grab() is false.
    std::optional<PinId> hold(std::span<const ParticleId> members, const Point& position);
    /// Target of such a grab at the end of the next step; false if it has ended.
    bool carry(PinId grab, const Point& position);
    /// Ends such a grab; false if it has ended.
    bool release(PinId grab);
    /// The pointer's grab, or null.
    const PointerGrab* hand() const { return hand_ ? &*hand_ : nullptr; }
    /// True if the pointer holds particles or strokes them (classic mode).
    bool holds() const { return hand_ || stroke_; }

    /// Overrides the scene's theme.
    void set_theme(std::string name) { scene_.view.theme = std::move(name); }

    /// Adds `by` to classic mode's time scale, clamped to [0, 5].
    void quicken(double by);

    /// Replaces the scene while running: figures unchanged between both scenes keep positions, velocities and cuts, and
    /// changes by calls and events stay (keep_changes.h), unless code builds the world. Ids hold. Returns the
    /// reason why something cannot go on; empty if all does.
    std::string become(Scene scene);

    /// Cuts every distance that crosses the line, as seen in the picture, or comes within `within` of the line
    /// (default: the scene's pointer setting). Returns the number of distances cut. A pointer's cut is a row of such
    /// lines.
    std::size_t cut(const std::array<Point, 2>& line, std::optional<double> within = {});
    std::size_t cut(const std::array<Point, 2>& line, std::optional<double> within, const View& view);

    Report report() const;
    /// Log of the session, at most `max_happenings` entries; later ones are only counted.
    const std::vector<SessionEvent>& happenings() const { return happenings_; }
    std::size_t happening_count() const { return happening_count_; }
    static constexpr std::size_t max_happenings = 10000;

    /// Position of a pixel of a `width` x `height` picture in a 2D scene.
    Vec2<double> position_of(Vec2<double> pixel, int width, int height) const;

    /// Two opposite corners around everything shown at the start: before the first step with something to show, at
    /// present.
    std::array<Point, 2> focus() const;

    /// The view that the scene asks for in a picture of that size, in pixels.
    View view(int width, int height) const { return {scene_, focus(), width, height}; }

    /// Files of images by name, as the looks of the scene call them.
    const Images& images() const { return images_; }
    /// Samples of the scene's traces.
    const History& history() const { return history_; }
    /// Particles held by the pointer and by events of the scene.
    std::vector<ParticleId> held_particles() const;

    /// THE list of a snapshot's fields beside scene, world and images (session_snapshot.h): a new member does not
    /// compile until listed. Whoever writes calls is_sound() afterwards.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [scene, world, solver, images, focus, due, rules, driven, winder, pointer, hand, stroke, stroke_to,
               taken_over, grabs, collider_moves, blowing, history, islands, happenings, happening_count, level,
               level_memory, steering, hands, added] = self;
        visit(focus, due, rules, driven, winder, pointer, hand, stroke, stroke_to, taken_over, grabs, collider_moves,
              blowing, history, islands, happenings, happening_count, steering, hands, added);
    }
    /// Gives gusts the ids of their forces: before snapshot::version_with_force_ids, these were rows.
    void name_gusts();
    /// False unless all indices are of this scene and world.
    bool is_sound() const;

  private:
    struct Blowing {
        ForceId force{};  ///< in the world
        double until = 0; ///< end, in the scene's unit of time

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [force, until] = self;
            visit(force, until);
        }
    };

    /// A pin with a driver.
    struct Driven {
        PinId pin;
        std::size_t section = 0; ///< index of the scene's pin
        Point rest;

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [pin, section, rest] = self;
            visit(pin, section, rest);
        }
    };

    void find_driven();
    void build_level();
    void drive();
    /// A future occurrence of an event.
    struct Due {
        double at = 0;            ///< in the scene's unit of time
        std::size_t event = 0;    ///< index of the scene's event
        std::uint64_t before = 0; ///< number of earlier occurrences
        /// Inverted order: the earliest is on top of the heap, ties in the scene's order.
        bool operator<(const Due& other) const { return at != other.at ? at > other.at : event > other.event; }

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [at, event, before] = self;
            visit(at, event, before);
        }
    };

    void plan_events();
    void skip_past_events();
    void happen_now();
    void happen(const EventSection& event, std::uint64_t before);
    /// Place to note of an event that happened; empty if nothing did, or all is noted already.
    using Noted = std::optional<std::string>;
    /// Applies an event that has happened `before` times.
    Noted apply(const GrabEvent& grab, std::uint64_t before);
    Noted apply(const ReleaseEvent& release, std::uint64_t before);
    Noted apply(const GustEvent& gust, std::uint64_t before);
    Noted apply(const CutEvent& event, std::uint64_t before);
    Noted apply(const AddEvent& event, std::uint64_t before);
    Noted apply(const ColliderEvent& event, std::uint64_t before);
    template <class Event> Noted apply(const Event& event, std::uint64_t before);
    FigureId id_of(FigureIndex figure) const;
    void remember(FigureIndex figure, const FigureSection& section, const std::string& model);
    std::optional<PointerGrab> grip(std::span<const ParticleId> members, const Point& position);
    std::optional<PinId> freeze_hovered();
    void still_gusts();
    std::string keep_changes_of(const Scene& scene, const AnyWorld& old, std::span<const FigureIndex> going_on);
    void keep_going(const AnyWorld& old);
    void forget_lost_grabs();
    void happen_on_contact();
    void note(SessionEvent event);
    void note(std::string what, std::string where, std::size_t islands = 0);
    void note_events();
    void note_parted();

    Scene scene_;
    AnyWorld world_;
    AnySolver solver_;
    Images images_;
    std::array<Point, 2> focus_; ///< no extent, at the origin: nothing was there yet
    std::vector<Due> due_;       ///< a heap
    ContactRules rules_;
    std::vector<Driven> driven_;
    Motors winder_;
    std::optional<Point> pointer_;
    std::optional<PointerGrab> hand_;
    std::optional<Stroke> stroke_; ///< the pointer's, in place of hand_
    Point stroke_to_{};
    bool taken_over_ = false; ///< after the pointer's first grab, until a restart: grab events are ignored
    EventGrabs grabs_;
    ColliderMoves collider_moves_;
    std::vector<Blowing> blowing_;
    History history_;
    std::vector<std::size_t> islands_; ///< per figure, as last noted
    std::vector<SessionEvent> happenings_;
    std::size_t happening_count_ = 0;
    std::shared_ptr<Level> level_; ///< none: the scene alone
    std::vector<std::byte> level_memory_;
    Steering steering_;
    std::vector<PointerGrab> hands_; ///< of calls, beside the pointer's
    AddedFigures added_;
};

} // namespace sinew
