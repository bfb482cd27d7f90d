#pragma once

#include "sinew/picture/picture.h"

#include "player/clock.h"
#include "player/draft.h"
#include "player/film.h"
#include "player/input.h"
#include "player/keys.h"
#include "player/pane.h"
#include "player/pick.h"
#include "player/question.h"
#include "player/reshape.h"
#include "player/scene_library.h"
#include "player/state_file.h"
#include "player/tour.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew::play {

class Tool;

/// An event for listeners: "grab", and {"particle": "bob/right_hand"}.
struct Told {
    std::string what;
    json::Object more;
};

/// Interactive player of a scene: takes input, gives pictures. Independent of windows; a script drives a Play as a
/// window does.
class Play {
  public:
    /// Opens the scene; on failure problem() gives the reason and ready() is false.
    Play(SceneLibrary library, std::string scene, std::vector<Override> overrides = {});
    Play(const Play&) = delete;
    Play& operator=(const Play&) = delete;
    ~Play();

    bool ready() const { return !panes_.empty(); }
    const std::string& problem() const { return problem_; } ///< reason of the last failure; may be empty
    void dismiss_problem() { problem_.clear(); }
    void report_problem(std::string text);

    /// Size of the picture in pixels, and pixels per nominal pixel (2 on a dense display).
    void resize(int width, int height, double density = 1);
    void handle(const Input& input);
    /// Takes a key that steers characters, cars and levels; false for any other, and where there is nothing to steer.
    bool steer(const std::string& key, bool is_down);
    /// Advances real time and takes the steps due, until `enough` returns true.
    void advance(double seconds, const std::function<bool()>& enough = {});
    /// Fills the picture, of the size set by resize(); the picture of a split view is larger by the labels of
    /// canvas/beside.h.
    void draw(Picture& picture);
    /// Fills one picture per pane.
    void draw_panes(std::vector<Picture>& pictures);

    // --- for panels ----------------------------------------------------------------------------------------------

    const Session& session() const { return pane().timeline.session(); }
    /// Reports of the present scene's solver, until the time or the scene is changed.
    void report(const SolverReports& reports) { pane().timeline.report(reports); }
    const Timeline& timeline() const { return pane().timeline; }
    Timeline& timeline() { return pane().timeline; }
    Clock& clock() { return *clock_; }
    CameraController& camera() { return pane().camera; }
    View view() const { return pane().camera.view(session()); }
    const SceneLibrary& library() const { return library_; }
    const std::string& scene_name() const { return name_; }
    bool is_edited() const { return ready() && timeline().edits() != saved_edits_; }

    void restart();
    void pause(bool on);
    void step();
    void step_back();
    void go_to(std::uint64_t step);
    void undo();
    void redo();
    /// Continues as a changed scene; can be undone.
    void change(const std::function<void(Scene&)>& change, const std::string& name);
    /// Any other edit of the running session; can be undone.
    void edit(Action action, std::string name);
    /// Adds a figure, given as in a file, to the scene.
    bool add_figure(json::Object figure, const std::string& name);
    /// The same in any list of the scene.
    bool add(std::string_view list, json::Object element, const std::string& name);
    /// Sets one value of the scene by its path, as on the command line; false after reporting an invalid value.
    /// `goes_on` merges the edit with the preceding one of the same path.
    bool set(const std::string& path, const std::string& value, bool goes_on = false);
    void switch_mode();
    /// Shows the scene in the given mode alone.
    void show_mode(const std::string& mode);
    void toggle_gravity();
    void toggle_wind();
    void switch_theme();
    void zoom(double factor);
    /// Saves the next picture drawn; without a path, to a new file in out/.
    void screenshot(std::filesystem::path path = {});
    void toggle_recording(std::filesystem::path path = {});
    bool recording() const { return film_.recording(); }

    // --- files (documents.cpp) -----------------------------------------------------------------------------------

    /// Opens a scene of the catalogue, a scene file or a saved state. Asks first if unsaved edits would be lost.
    void open(const std::string& scene, std::vector<Override> overrides = {});
    void open_neighbour(int by);
    /// Opens a scene from its text, called `name` in messages.
    void open_text(const std::string& text, const std::string& name);
    void open_clipboard();
    void copy_scene();
    void copy_hash();
    void open_new();
    /// Saves to the scene's own file; asks for a path if there is none.
    void save_or_ask();
    bool save(const std::filesystem::path& path);
    /// Saves the running session: as a snapshot, or with all actions since the start of its scene as text where the
    /// name ends in .json.
    bool save_state(const std::filesystem::path& path);
    /// Records everything in files of a folder, of which the latest are kept.
    void record_in(const std::filesystem::path& folder);
    /// Copies the recording of the running session, for the report of a fault; by default to out/.
    bool save_recording(std::filesystem::path path = {});
    void ask_for_path(Purpose purpose, std::function<void()> then = {});
    /// Answers the path request.
    void choose(const std::filesystem::path& path);
    /// True if opening another scene would lose unsaved edits.
    bool would_lose() const;
    /// Closes the topmost dialog or page; without one, quits, and asks first if unsaved edits would be lost.
    void close();
    void ask_to_quit();

    /// True while a dialog, a page or a problem is in front: nothing moves, and no key acts.
    bool has_dialog() const { return question || path_request || settings || help || shows_problem(); }
    bool shows_problem() const { return shows_problems && !problem_.empty(); }
    bool shows_problems = true; ///< the host holds a problem up until it is dismissed; without, everything goes on
    std::optional<Question> question;
    std::optional<PathRequest> path_request;
    void answer(std::size_t number);
    bool answer(std::string_view name);

    /// Saves unsaved edits to this file every few seconds.
    void keep_draft_in(std::filesystem::path path) { draft_.path = std::move(path); }
    /// Offers the unsaved edits of an earlier run.
    void offer_draft();
    void write_draft();

    std::vector<std::string> recent;                       ///< files, the latest first
    std::function<std::string()> clipboard;                ///< reads the clipboard
    std::function<void(const std::string&)> set_clipboard; ///< copies a text to the clipboard
    double restored_share() const { return restoration_ ? restoration_->share() : 1; }

    // --- split view (split.cpp) ----------------------------------------------------------------------------------

    /// Shows classic and physical mode side by side, from the start; a second call keeps the pane under the pointer
    /// alone.
    void toggle_split();
    bool is_split() const { return panes_.size() > 1; }
    std::size_t pane_count() const { return panes_.size(); }
    std::size_t active_pane() const { return active_; } ///< number of the pane under the pointer
    int pane_left(std::size_t number) const;            ///< pixels from the left of the picture
    int pane_width(std::size_t number) const { return pane_left(number + 1) - pane_left(number); }
    /// Calls act() for every pane, made the active one in turn. Events of panes away from the pointer are not reported.
    void each_pane(const std::function<void()>& act);

    // --- selection (selection.cpp)

    std::vector<Part> chosen;     ///< by the select tool
    std::optional<Part> followed; ///< by the camera
    bool shift_held = false;
    void choose(const std::optional<Part>& part, bool adds);
    void choose_all();
    bool is_chosen(const Part& part) const;
    std::optional<Part> part_here() const;               ///< under the pointer
    std::string figure_name(const Picked& picked) const; ///< empty if none
    /// Moves, turns and scales parts of the scene as they are; `goes_on` as in set(). False after reporting a failure.
    bool reshape(const std::vector<Part>& parts, const Reshape& by, const std::string& name, bool goes_on);
    void duplicate_chosen();
    void remove(const std::vector<Part>& parts);
    /// Displacement in the scene of something at `from` that moves by pixels.
    Point shift_of(const Point& from, Vec2<double> pixels) const;
    void toggle_follow();

    OverlaySet overlay;
    std::string tool = "grab";        ///< a name of all_tools()
    std::string prefab = "box";       ///< made by the spawn tool
    json::Object prefab_parameters{}; ///< parameters of `prefab`
    std::string joint = "hinge";      ///< made by the join tool: a name of `joints`
    std::string theme;                ///< replaces the scene's theme unless empty
    std::string shown_theme() const { return theme.empty() ? session().scene().view.theme : theme; }
    bool panel = true, help = false;
    bool settings = false;     ///< the settings page is open
    bool free_running = false; ///< pictures do not wait for the display
    bool quit = false;
    Keys keys;

    Tour tour;

    std::optional<Picked> hovered, selected;
    /// Selects particles; the selection survives edits of the scene while the particles have names.
    void select(std::optional<Picked> picked);
    std::string message; ///< one line about the last action

    /// Called with every event.
    std::function<void(const Told&)> listener;
    void tell(std::string what, json::Object more = {});
    std::string hash() const;

    /// Position in the active pane, pixels.
    Vec2<double> pointer() const { return pointer_; }
    double density() const { return density_; }
    /// The particles to be grabbed by a press.
    std::optional<Picked> pick_here() const;

  private:
    Pane& pane() { return panes_[active_]; }
    const Pane& pane() const { return panes_[active_]; }
    void begin(Fetched fetched);
    void begin(std::vector<Pane> panes);
    void go_on_with(Fetched fetched);
    void look_at_level();
    void open_now(const std::string& scene, std::vector<Override> overrides);
    bool open_converted(const std::filesystem::path& file);
    void open_state(const std::filesystem::path& path);
    void open_running(const std::filesystem::path& path);
    void begin_running(const std::filesystem::path& path, Timeline timeline, const std::string& from);
    void end_restoration();
    void begin_recording();
    SceneOpener opener(const std::string& name, std::string& from, std::string& problem) const;
    void note_recent(const std::filesystem::path& path);
    void unless_lost(const std::string& verb, std::function<void()> go_on);
    void save_then(std::function<void()> go_on);
    std::string saved_text() const;
    void tend_draft(double seconds);
    void drop_draft();
    void become(const std::vector<Scene>& scenes, const std::string& name, bool goes_on);
    void tell_what_is_lost();
    void apply(const std::vector<Scene>& scenes, const std::string& name, bool goes_on);
    void forget_missing_parts();
    void follow(double seconds);
    void switch_pane(std::size_t number);
    void resize_eyes();
    void moved(Vec2<double> to);
    void pressed(Button button);
    void released(Button button);
    void key(const std::string& name);
    void let_go_of_everything();
    void tell_happenings();
    void look_at_file(double seconds);
    void read_again();
    void find_selected_again();
    void paint_scene(std::size_t number, Picture& picture);
    void paint_pointer(std::size_t number, Picture& picture);
    void label_pane(std::size_t number, Picture& picture) const;
    void lay_side_by_side(Picture& picture);
    void highlight(Picture& picture) const;
    std::unique_ptr<files::Exporter> open_export(const std::filesystem::path& path, std::array<int, 2> size,
                                                 double fps) const;
    canvas::Failure take_picture(const std::filesystem::path& path, const Picture& picture) const;
    bool wants_pictures() const { return !screenshots_.empty() || film_.wants_frame(); }
    void take_pictures(const Picture& picture);
    Tool& current_tool();

    SceneLibrary library_;
    std::string name_, problem_;
    std::vector<Override> overrides_;
    std::filesystem::path path_;   ///< the scene's own file; empty if none
    std::filesystem::path beside_; ///< file to which the paths of the scene's pictures and models are relative
    std::filesystem::file_time_type written_{}; ///< time of the version that was read
    std::filesystem::file_time_type seen_{};    ///< time at the last look; none while there is no file
    double since_look_ = 0;
    std::vector<Pane> panes_;
    std::size_t active_ = 0;
    std::size_t own_pane_ = 0; ///< pane in the mode of the scene before the split; the one saved
    bool muted_ = false;       ///< events of other panes are not reported
    std::optional<Clock> clock_;
    std::optional<Restoration> restoration_;
    std::filesystem::path recordings_; ///< folder of recordings; empty: nothing is recorded
    std::filesystem::path recording_;  ///< of the running session
    std::filesystem::path restored_from_;
    Vec2<double> pointer_{};
    std::vector<std::string> selected_names_; ///< names of the selected particles
    bool over_ = false;                       ///< the pointer is over the picture
    int width_ = 1280, height_ = 720;
    double density_ = 1;
    std::vector<std::string> steering_keys_; ///< held down, of those that steer
    std::optional<Button> held_;
    std::vector<std::unique_ptr<Tool>> tools_;
    Tool* busy_ = nullptr;                          ///< tool between press and release
    static constexpr std::int64_t never_saved = -1; ///< a count of edits that no timeline has
    std::int64_t saved_edits_ = 0;                  ///< the timeline's edits at the last save
    std::string saved_as_;                          ///< the scene's text at the last save
    Draft draft_;
    Point gravity_; ///< gravity to restore when switched on again
    std::vector<std::filesystem::path> screenshots_;
    Film film_;
};

} // namespace sinew::play
