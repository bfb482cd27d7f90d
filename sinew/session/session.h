#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/driver.h"
#include "sinew/session/hand.h"
#include "sinew/session/history.h"
#include "sinew/session/overlay.h"
#include "sinew/session/picture.h"
#include "sinew/session/stroke.h"
#include "sinew/session/winder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// What a session can tell about its world, in the scene's own units.
struct Report {
    double seconds = 0; ///< simulated
    std::uint64_t steps = 0;
    std::size_t particles = 0, constraints = 0;
    std::uint64_t hash = 0;
    double kinetic = 0, potential = 0, stored = 0;
    double energy_lost = 0;                   ///< since the start, to blows (measure.h)
    double stretch_max = 0, stretch_mean = 0; ///< of distances, as fractions of their rest length
    double max_speed = 0;
};

/// Something that happened, and when.
struct Happening {
    double seconds = 0;
    std::string what;        ///< "torn", "parted", "quarantined", or the name of a scene event ("grab")
    std::string where;       ///< the figure or particle, as the scene calls it; may be empty
    std::size_t islands = 0; ///< of "parted": into how many the figure fell (islands.h); else 0
};

/// Two corners around what a world shows.
std::array<Point, 2> focus_of(const Scene& scene, const AnyWorld& world);

/// A scene that runs: its world, a clock, the scene's events and a pointer. Headless; the window, the command and the
/// web page feed it and paint its picture.
class Session {
  public:
    explicit Session(Opened opened);

    const Scene& scene() const { return scene_; }
    const AnyWorld& world() const { return world_; }
    AnyWorld& world() { return world_; }

    /// Back to the start, as the scene says.
    void restart();

    /// One step of the scene's rate: what is due happens, then the world moves.
    void step();
    /// Steps until at least this many seconds are simulated.
    void run_until(double seconds);
    double seconds() const;

    /// Where the pointer is, for pins that follow it; nothing: where their scenes say a pointer would be.
    void point_at(std::optional<Point> place) { pointer_ = place; }
    /// Where it is, or where the scene says a pointer would be.
    std::optional<Point> pointer() const;

    /// Takes hold of one particle, or of the place between several; false where one is gone or nothing moves it. What
    /// was held before is let go.
    bool grab(std::span<const ParticleId> members, const Point& place);
    /// Where what is held shall be when the next step ends.
    void drag(const Point& place);
    void let_go();
    /// What is held, or nothing.
    const Hand* hand() const { return hand_ ? &*hand_ : nullptr; }
    /// Whether the pointer does something to what it is dragged along: it holds it, or strokes it (classic mode).
    bool holds() const { return hand_ || stroke_; }

    /// Draws it in another theme than the scene says.
    void set_theme(std::string name) { scene_.view.theme = std::move(name); }

    /// Time passes faster by as much, or slower: classic mode's time scale, from 0 to 5.
    void quicken(double by);

    /// Goes on as another scene: figures that are the same in both keep where they are, how they move, and what was
    /// cut.
    void become(Scene scene);

    /// Cuts every distance that crosses the line from one place to the other or comes within some length of it, as seen
    /// in the picture; tells how many. What a pointer draws is a row of such lines, within what the scene says.
    std::size_t cut(const std::array<Point, 2>& line, std::optional<double> within = {});
    std::size_t cut(const std::array<Point, 2>& line, std::optional<double> within, const View& view);

    Report report() const;
    /// All that happened so far; at most `most_happenings`, then only counted.
    const std::vector<Happening>& happenings() const { return happenings_; }
    std::size_t happening_count() const { return happening_count_; }
    static constexpr std::size_t most_happenings = 10000;

    /// Where a pixel of a picture of that size is in a 2D scene.
    Vec2<double> place_of(Vec2<double> pixel, int width, int height) const;

    /// Two corners around what the scene shows at its start.
    const std::array<Point, 2>& focus() const { return focus_; }

    /// The picture of now, filling `picture` (whose width and height the caller sets), with overlays on it.
    void draw(Picture& picture, OverlaySet overlay = {}) const;
    void draw(Picture& picture, OverlaySet overlay, const View& view) const;

  private:
    struct Held {
        std::string particle;
        PinId pin;
        Point from, to;
        double since = 0, over = 0;
        std::optional<Stroke> stroke{}; ///< instead of a pin
    };
    struct Blowing {
        std::size_t force = 0;
        double until = 0;
    };

    /// A pin that moves by itself.
    struct Driven {
        PinId pin;
        std::size_t section = 0; ///< of the scene's pins
        Point rest;
    };

    void find_driven();
    void drive();
    /// An event that is still to come.
    struct Due {
        double at = 0;
        std::size_t event = 0;    ///< of the scene's events
        std::uint64_t before = 0; ///< how often it has happened already
        /// Later, so that the first is on top of the heap; of those at once the scene's first.
        bool operator<(const Due& other) const { return at != other.at ? at > other.at : event > other.event; }
    };

    void plan_events();
    void skip_past_events();
    void happen_now();
    void happen(const EventSection& event, std::uint64_t before);
    template <class WorldT> void hold_around(WorldT& world, ParticleId middle, const GrabEvent& grab, const Held& held);
    void carry_held();
    std::optional<PinId> freeze_hovered();
    void still_gusts();
    void keep_going(const AnyWorld& old);
    void note(std::string what, std::string where, std::size_t islands = 0);
    void note_events();
    void note_parted();

    Scene scene_;
    AnyWorld world_;
    Images images_;
    std::array<Point, 2> focus_; ///< two corners around what the scene shows at its start
    std::vector<Due> due_;       ///< a heap
    std::vector<Driven> driven_;
    Winder winder_;
    std::optional<Point> pointer_;
    std::optional<Hand> hand_;
    std::optional<Stroke> stroke_; ///< of the pointer, instead of a hand
    Point stroke_to_{};
    bool taken_over_ = false; ///< by a pointer: the scene's own hand keeps away until a restart
    std::vector<Held> held_;
    std::vector<Blowing> blowing_;
    History history_;
    std::vector<std::size_t> islands_; ///< of each figure, when last told of
    std::vector<Happening> happenings_;
    std::size_t happening_count_ = 0;
};

} // namespace sinew
