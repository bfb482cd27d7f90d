#pragma once

#include "sinew/session/picture.h"

#include "apps/play/clock.h"
#include "apps/play/input.h"
#include "apps/play/keys.h"
#include "apps/play/pane.h"
#include "apps/play/pick.h"
#include "apps/play/question.h"
#include "apps/play/shelf.h"
#include "apps/play/state_file.h"
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

    bool ready() const { return !panes_.empty(); }
    const std::string& problem() const { return problem_; } ///< with the last scene that was asked for; may be empty
    void dismiss_problem() { problem_.clear(); }
    void report_problem(std::string text);

    /// The picture's size in pixels, and how many of them a nominal pixel has (2 on a dense display).
    void resize(int width, int height, double density = 1);
    void handle(const Input& input);
    /// Real time passes. Steps until all that is due is done, or `enough` says that it took too long.
    void advance(double seconds, const std::function<bool()>& enough = {});
    /// Fills the picture, whose size is set by resize(); panes of a split view lie in it as images.
    void draw(Picture& picture);
    /// Fills a picture for each pane.
    void draw_panes(std::vector<Picture>& pictures);

    // --- what panels show and do ---------------------------------------------------------------------------------

    const Session& session() const { return pane().tape.session(); }
    const Tape& tape() const { return pane().tape; }
    Tape& tape() { return pane().tape; }
    Clock& clock() { return *clock_; }
    Eye& eye() { return pane().eye; }
    View view() const { return pane().eye.view(session()); }
    const Shelf& shelf() const { return shelf_; }
    const std::string& scene_name() const { return name_; }
    bool is_edited() const { return ready() && tape().edits() != saved_edits_; }

    void restart();
    void pause(bool on);
    void step();
    void step_back();
    void go_to(std::uint64_t step);
    void undo();
    void redo();
    /// Goes on as a changed scene; can be undone.
    void change(const std::function<void(Scene&)>& change, const std::string& name);
    /// Any other edit of what runs.
    void edit(Deed deed, std::string name);
    /// Puts a figure, as a file says it, into the scene.
    bool add_figure(json::Object figure, const std::string& name);
    /// Sets one value of the scene by its path, as on the command line; what is wrong with it is the problem.
    bool set(const std::string& path, const std::string& value, bool goes_on = false);
    void switch_mode();
    /// Shows the scene in that mode alone.
    void show_mode(const std::string& mode);
    void toggle_gravity();
    void toggle_wind();
    void switch_theme();
    void zoom(double factor);
    /// Of the picture as it is drawn next; where no path is given, beside others in out/.
    void screenshot(std::filesystem::path path = {});
    void toggle_recording(std::filesystem::path path = {});
    bool recording() const { return film_ != nullptr; }

    // --- files (documents.cpp) -----------------------------------------------------------------------------------

    /// Opens a scene of the catalogue, a scene file or a saved state. Asks first where something would be lost.
    void open(const std::string& scene, std::vector<Override> overrides = {});
    void open_neighbour(int by);
    /// Opens a scene from its text, which messages call `name`.
    void open_text(const std::string& text, const std::string& name);
    void open_clipboard();
    void copy_scene();
    void copy_hash();
    void open_new();
    /// To the scene's own file; asks where, if it has none.
    void save_or_ask();
    bool save(const std::filesystem::path& path);
    /// The running session, with all that led to it.
    bool save_state(const std::filesystem::path& path);
    void ask_for_path(Purpose purpose, std::function<void()> then = {});
    /// Does what the path was asked for.
    void choose(const std::filesystem::path& path);
    /// Whether anything would be lost by opening another scene.
    bool would_lose() const;
    /// Closes what lies over the scene; where nothing does, quits, and asks first where something would be lost.
    void close();
    void ask_to_quit();

    std::optional<Question> question;
    std::optional<PathRequest> path_request;
    void answer(std::size_t number);
    bool answer(std::string_view name);

    /// Unsaved edits are kept in this file every few seconds.
    void keep_draft_in(std::filesystem::path path) { draft_ = std::move(path); }
    /// Offers the edits that an earlier game left there.
    void offer_draft();
    void write_draft();

    std::vector<std::string> recent;                       ///< files, the latest first
    std::function<std::string()> clipboard;                ///< reads it
    std::function<void(const std::string&)> set_clipboard; ///< copies a text
    double restored_share() const { return restoration_ ? restoration_->share() : 1; }

    // --- split view (split.cpp) ----------------------------------------------------------------------------------

    /// Classic and physical mode side by side, from the start; or the half under the pointer alone.
    void toggle_split();
    bool is_split() const { return panes_.size() > 1; }
    std::size_t pane_count() const { return panes_.size(); }
    std::size_t active_pane() const { return active_; } ///< the one under the pointer
    int pane_left(std::size_t number) const;            ///< pixels
    int pane_width(std::size_t number) const { return pane_left(number + 1) - pane_left(number); }
    /// Calls act() for every pane, which then is the active one. Only what happens in the one under the pointer is
    /// told.
    void each_pane(const std::function<void()>& act);

    OverlaySet overlay;
    std::string tool = "grab";        ///< by name in tools()
    std::string prefab = "box";       ///< that the spawn tool makes
    json::Object prefab_parameters{}; ///< of that
    std::string theme;                ///< instead of the scene's; empty leaves that
    std::string shown_theme() const { return theme.empty() ? session().scene().view.theme : theme; }
    bool panel = true, help = false;
    bool settings = false;     ///< their page lies over the scene
    bool free_running = false; ///< pictures do not wait for the display
    bool quit = false;
    Keys keys;

    /// A line for who has never dragged anything.
    bool hint = false;
    /// How visible it is: 1 at first, 0 soon after the first drag or ten seconds.
    double hint_strength() const;

    std::optional<Picked> hovered, selected;
    /// It stays selected through edits of the scene, as long as its particles have names.
    void select(std::optional<Picked> picked);
    std::string message; ///< a line about what was just done

    /// Called with everything that happens.
    std::function<void(const Told&)> listener;
    void tell(std::string what, json::Object more = {});
    std::string hash() const;

    /// In the active pane.
    Vec2<double> pointer() const { return pointer_; }
    double density() const { return density_; }
    /// What the pointer would take hold of.
    std::optional<Picked> pick_here() const;

  private:
    Pane& pane() { return panes_[active_]; }
    const Pane& pane() const { return panes_[active_]; }
    void begin(Fetched fetched);
    void begin(std::vector<Pane> panes);
    void open_now(const std::string& scene, std::vector<Override> overrides);
    void open_state(const std::filesystem::path& path);
    void end_restoration();
    void note_recent(const std::filesystem::path& path);
    void unless_lost(const std::string& verb, std::function<void()> go_on);
    void save_then(std::function<void()> go_on);
    std::string saved_text() const;
    void tend_draft(double seconds);
    void drop_draft();
    void become(const std::vector<Scene>& scenes, const std::string& name, bool goes_on);
    void switch_pane(std::size_t number);
    void resize_eyes();
    void moved(Vec2<double> to);
    void pressed(Button button);
    void released(Button button);
    void key(const std::string& name);
    void let_go_of_everything();
    void tell_happenings();
    void look_at_file(double seconds);
    void find_selected_again();
    void paint_scene(std::size_t number, Picture& picture);
    void paint_pointer(std::size_t number, Picture& picture);
    void lay_side_by_side(Picture& picture);
    void highlight(Picture& picture) const;
    bool wants_pictures() const { return !screenshots_.empty() || (film_ && film_due_ <= 0); }
    void take_pictures(const Picture& picture);
    Tool& current_tool();

    Shelf shelf_;
    std::string name_, problem_;
    std::vector<Override> overrides_;
    std::filesystem::path path_;   ///< of the scene's own file; empty where it has none
    std::filesystem::path beside_; ///< file beside which the scene's pictures are
    std::filesystem::file_time_type written_{};
    double since_look_ = 0;
    std::vector<Pane> panes_;
    std::size_t active_ = 0;
    bool muted_ = false; ///< what happens in other panes is not told
    std::optional<Clock> clock_;
    std::optional<Restoration> restoration_;
    std::filesystem::path restored_from_;
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
    std::string saved_as_;         ///< the scene's text then
    std::filesystem::path draft_;
    std::int64_t draft_edits_ = 0; ///< the tape's, when the draft was written
    double since_draft_ = 0;       ///< seconds
    double hint_age_ = 0;          ///< seconds since it appeared
    Point gravity_;                ///< while it is off
    std::vector<std::filesystem::path> screenshots_;
    std::unique_ptr<canvas::Writer> film_;
    std::filesystem::path film_path_;
    double film_due_ = 0; ///< seconds until its next frame
};

} // namespace sinew::play
