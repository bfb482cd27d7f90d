#pragma once

#include "sinew/scene/json.h"

#include "apps/play/clock.h"
#include "apps/play/eye.h"
#include "apps/play/input.h"
#include "apps/play/pick.h"
#include "apps/play/shelf.h"
#include "apps/play/tape.h"
#include "canvas/writer.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew::play {

class Tool;

/// Something that happened, for whoever listens: "grab", and {"particle": "bob/right_hand"}.
struct Told {
    std::string what;
    json::Object more;
};

/// A game with a scene: input goes in, pictures come out. Knows no window; a script plays it just as well.
class Play {
  public:
    /// Opens the scene; where it cannot be opened, problem() says why and there is nothing to play.
    Play(Shelf shelf, std::string scene, std::vector<Override> overrides = {});
    Play(const Play&) = delete;
    Play& operator=(const Play&) = delete;
    ~Play();

    bool ready() const { return tape_.has_value(); }
    const std::string& problem() const { return problem_; } ///< with the last scene that was asked for; may be empty
    void dismiss_problem() { problem_.clear(); }
    void report_problem(std::string text);

    /// The picture's size in pixels, and how many of them a nominal pixel has (2 on a dense display).
    void resize(int width, int height, double density = 1);
    void handle(const Input& input);
    /// Real time passes. Steps until all that is due is done, or `enough` says that it took too long.
    void advance(double seconds, const std::function<bool()>& enough = {});
    /// Fills the picture, whose size is set by resize().
    void draw(Picture& picture);

    // --- what panels show and do ---------------------------------------------------------------------------------

    const Session& session() const { return tape_->session(); }
    Tape& tape() { return *tape_; }
    Clock& clock() { return *clock_; }
    Eye& eye() { return eye_; }
    View view() const { return eye_.view(session()); }
    const Shelf& shelf() const { return shelf_; }
    const std::string& scene_name() const { return name_; }
    bool is_edited() const { return tape_ && tape_->edits() != saved_edits_; }

    void open(const std::string& scene, std::vector<Override> overrides = {});
    void open_neighbour(int by);
    /// What lies over the scene, or else all of it.
    void close();
    void restart();
    void pause(bool on);
    void step();
    void step_back();
    void go_to(std::uint64_t step);
    void undo();
    void redo();
    /// Goes on as another scene; can be undone.
    void become(Scene scene, std::string name, bool goes_on = false);
    /// Any other edit of what runs.
    void edit(Deed deed, std::string name);
    /// Puts a figure, as a file says it, into the scene.
    bool add_figure(json::Object figure, const std::string& name);
    /// Sets one value of the scene by its path, as on the command line; what is wrong with it is the problem.
    bool set(const std::string& path, const std::string& value, bool goes_on = false);
    void switch_mode();
    void toggle_gravity();
    void toggle_wind();
    void switch_theme();
    /// Of the picture as it is drawn next; where no path is given, beside others in out/.
    void screenshot(std::filesystem::path path = {});
    void toggle_recording(std::filesystem::path path = {});
    bool recording() const { return film_ != nullptr; }
    /// To the scene's own file, or where a catalogue scene is kept for oneself: ./NAME.json.
    void save_beside();
    bool save(const std::filesystem::path& path);

    OverlaySet overlay;
    std::string tool = "grab";        ///< by name in tools()
    std::string prefab = "box";       ///< that the spawn tool makes
    json::Object prefab_parameters{}; ///< of that
    std::string theme;                ///< instead of the scene's; empty leaves that
    std::string shown_theme() const { return theme.empty() ? session().scene().view.theme : theme; }
    bool panel = true, help = false;
    bool free_running = false; ///< pictures do not wait for the display
    bool quit = false;

    std::optional<Picked> hovered, selected;
    /// It stays selected through edits of the scene, as long as its particles have names.
    void select(std::optional<Picked> picked);
    std::string message; ///< a line about what was just done

    /// Called with everything that happens.
    std::function<void(const Told&)> listener;
    void tell(std::string what, json::Object more = {});
    std::string hash() const;

    Vec2<double> pointer() const { return pointer_; }
    double density() const { return density_; }
    /// What the pointer would take hold of.
    std::optional<Picked> pick_here() const;

  private:
    void begin(Fetched fetched);
    void moved(Vec2<double> to);
    void pressed(Button button);
    void released(Button button);
    void key(const std::string& name);
    void let_go_of_everything();
    void tell_happenings();
    void look_at_file(double seconds);
    void find_selected_again();
    void highlight(Picture& picture) const;
    void take_pictures(const Picture& picture);
    Tool& current_tool();

    Shelf shelf_;
    std::string name_, problem_;
    std::vector<Override> overrides_;
    std::filesystem::path path_;
    std::filesystem::file_time_type written_{};
    double since_look_ = 0;
    std::optional<Tape> tape_;
    std::optional<Clock> clock_;
    Eye eye_;
    Vec2<double> pointer_{};
    std::vector<std::string> selected_names_; ///< of its members
    bool over_ = false;                       ///< the pointer is over the picture
    int width_ = 1280, height_ = 720;
    double density_ = 1;
    bool space_ = false;
    std::optional<Button> held_;
    std::vector<std::unique_ptr<Tool>> tools_;
    Tool* busy_ = nullptr;         ///< between press and release
    std::int64_t saved_edits_ = 0; ///< the tape's, when it was saved last
    std::size_t told_ = 0;         ///< of the session's happenings
    Point gravity_;                ///< while it is off
    std::vector<std::filesystem::path> screenshots_;
    std::unique_ptr<canvas::Writer> film_;
    std::filesystem::path film_path_;
    double film_due_ = 0; ///< seconds until its next frame
};

} // namespace sinew::play
