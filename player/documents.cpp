#include "sinew/scene/text.h"

#include "player/files.h"
#include "player/play.h"
#include "player/recording_format.h"
#include "player/scene_edit.h"

#include <algorithm>
#include <utility>

/// Files: opening, saving, path requests, drafts.
namespace sinew::play {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_bytes = 256u << 20; // limit of a saved state
constexpr std::size_t most_recent = 8;
constexpr double draft_every = 5; // seconds
constexpr std::size_t max_recordings = 8;
constexpr const char* recording_extension = ".rec";
constexpr std::string_view draft_origin = "// from ";

constexpr const char* empty_scene = R"({
  "sinew": 1,
  "about": "A scene of your own: draw ropes, forms and cloths, and put in prefabs with the tools at the left.",
  "view": {"center": [0, 1.4], "height": 3.4},
  "world": {"gravity": [0, -9.81], "damping": 0.2, "bounds": {"planes": [{"normal": [0, 1]}], "friction": 0.5}}
})";

bool is_file_name(const std::string& word) {
    return word.find_first_of("./") != std::string::npos;
}

std::string extension_for(Purpose purpose) {
    if (purpose == Purpose::picture) return ".png";
    if (purpose == Purpose::film) return ".mp4";
    return purpose == Purpose::save_state ? ".sinew" : ".json";
}

} // namespace

// --- opening ---------------------------------------------------------------------------------------------------------

void Play::open(const std::string& scene, std::vector<Override> overrides) {
    unless_lost("open another scene", [this, scene, overrides = std::move(overrides)] { open_now(scene, overrides); });
}

void Play::open_now(const std::string& scene, std::vector<Override> overrides) {
    if (is_file_name(scene))
        if (const auto text = read_file(scene, max_bytes)) {
            const auto bytes = std::as_bytes(std::span(*text));
            if (is_snapshot(bytes) || is_recording(bytes)) return open_running(scene);
            if (is_state(*text)) return open_state(scene);
            if (open_converted(scene)) return;
        }
    auto fetched = library_.fetch(scene, overrides);
    if (!fetched.opened) return report_problem(std::move(fetched.problem));
    let_go_of_everything();
    name_ = scene;
    overrides_ = std::move(overrides);
    begin(std::move(fetched));
    if (is_file_name(scene)) note_recent(scene);
    tell("scene", {{"name", name_}});
}

/// Opens the scene made of another program's file; false if the file is none.
bool Play::open_converted(const fs::path& file) {
    if (!library_.convert) return false;
    auto made = library_.convert(file);
    if (!made.problem.empty()) return report_problem(std::move(made.problem)), true;
    if (made.scene.empty()) return false;
    open_now(made.scene.string(), {});
    if (name_ == made.scene.string()) message = std::move(made.message);
    tell("imported", {{"path", made.scene.string()}});
    return true;
}

void Play::open_neighbour(int by) {
    const auto& names = library_.names;
    if (names.empty()) return;
    const auto found = std::find(names.begin(), names.end(), name_);
    const auto count = std::ptrdiff_t(names.size());
    const auto here = found == names.end() ? (by > 0 ? -1 : 0) : found - names.begin();
    open(names[std::size_t((here + by + count) % count)]);
}

void Play::open_text(const std::string& text, const std::string& name) {
    unless_lost("open another scene", [this, text, name] {
        auto fetched = library_.read(text, name, {});
        if (!fetched.opened) return report_problem(std::move(fetched.problem));
        let_go_of_everything();
        name_ = name;
        overrides_.clear();
        begin(std::move(fetched));
        tell("scene", {{"name", name_}});
    });
}

void Play::open_clipboard() {
    const auto text = clipboard ? clipboard() : std::string();
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        return report_problem("the clipboard holds no text: copy a scene file's text first");
    open_text(text, "clipboard");
}

void Play::copy_scene() {
    if (!set_clipboard) return;
    set_clipboard(saved_text());
    message = "copied the scene as text";
    tell("copied");
}

void Play::copy_hash() {
    if (!set_clipboard) return;
    set_clipboard(hash());
    message = "copied the hash";
    tell("copied", {{"hash", hash()}});
}

void Play::open_new() {
    open_text(empty_scene, "untitled");
}

void Play::note_recent(const fs::path& path) {
    auto full = full_path(path);
    std::erase(recent, full);
    recent.insert(recent.begin(), std::move(full));
    if (recent.size() > most_recent) recent.resize(most_recent);
}

// --- running states --------------------------------------------------------------------------------------------------

void Play::open_state(const fs::path& path) {
    const auto text = read_file(path, max_bytes);
    Restoration restoration(text.value_or(""), path.string(), library_);
    if (!restoration.problem().empty()) return report_problem(restoration.problem());
    let_go_of_everything();
    restoration_ = std::move(restoration);
    restored_from_ = path;
    tell("restoring", {{"path", path.string()}});
    if (ready()) return; // advance() continues between pictures
    restoration_->advance();
    end_restoration();
}

void Play::end_restoration() {
    auto timeline = restoration_->finish();
    auto problem = restoration_->problem();
    const auto from = restoration_->from();
    restoration_.reset();
    if (!timeline) return report_problem(std::move(problem));
    begin_running(restored_from_, std::move(*timeline), from);
}

void Play::begin_running(const fs::path& path, Timeline timeline, const std::string& from) {
    std::vector<Pane> panes;
    panes.push_back({std::move(timeline), {}});
    name_ = path.string();
    overrides_.clear();
    path_.clear();
    beside_ = from;
    begin(std::move(panes));
    note_recent(path);
    tell("restored", {{"path", name_}, {"hash", hash()}});
}

/// Builds the scene of a file `name`; `from` and `problem` receive where its pictures are, and its fault.
SceneOpener Play::opener(const std::string& name, std::string& from, std::string& problem) const {
    return [this, name, &from, &problem](const std::string& scene, const std::string& beside) {
        from = beside;
        auto fetched = library_.read(scene, name + ": scene", beside);
        if (!fetched.opened) problem = std::move(fetched.problem);
        return std::move(fetched.opened);
    };
}

/// A snapshot, or a recording from its first step on.
void Play::open_running(const fs::path& path) {
    const auto text = read_file(path, max_bytes).value_or("");
    const auto bytes = std::as_bytes(std::span(text));
    std::string from, problem;
    SnapshotError error;
    const auto open = opener(path.string(), from, problem);
    std::optional<Timeline> timeline;
    if (is_snapshot(bytes)) {
        if (auto session = session_of(bytes, open, error)) {
            if (session->steering().player() != Controls{}) session->steering().play({}); // keys that nobody holds now
            timeline.emplace(std::move(*session), std::vector<LoggedAction>{}, 0);
        }
    } else if (auto recording = read_recording(bytes, open, error)) {
        auto actions = actions_of(*recording, open);
        const auto steps = recording->steps;
        if (auto replay = Replay::begin(std::move(*recording), open, error))
            timeline.emplace(std::move(replay->session()), std::move(actions), steps);
    }
    if (!timeline) return report_problem(problem.empty() ? path.string() + ": " + error.text() : std::move(problem));
    let_go_of_everything();
    begin_running(path, std::move(*timeline), from);
}

// --- recordings ------------------------------------------------------------------------------------------------------

void Play::record_in(const fs::path& folder) {
    recordings_ = folder;
    begin_recording();
}

/// Begins a file for the running session, and removes the oldest of many.
void Play::begin_recording() {
    if (recordings_.empty() || panes_.empty() || session().level()) return;
    recording_ = new_file_in(recordings_, fs::path(name_).stem().string(), recording_extension, max_recordings - 1);
    if (recording_.empty()) return;
    const auto from = beside_.empty() ? std::string() : full_path(beside_);
    timeline().record(std::make_shared<Recorder>(append_to(recording_), session(), from));
}

bool Play::save_recording(fs::path path) {
    if (path.empty()) path = free_path(fs::path("out") / (fs::path(name_).stem().string() + recording_extension));
    const auto* recorder = timeline().recorder();
    if (!recorder) return report_problem("nothing is recorded"), false;
    if (recorder->failure()) return report_problem(*recorder->failure()), false;
    const auto bytes = read_file(recording_, max_bytes);
    if (!bytes) return report_problem("cannot read " + recording_.string()), false;
    if (auto failure = write_file(path, *bytes)) return report_problem(std::move(*failure)), false;
    message = "saved " + full_path(path);
    tell("saved_recording", {{"path", path.string()}, {"hash", hash()}});
    return true;
}

/// The actions as text where the name ends in .json; else a snapshot, which opens at once.
bool Play::save_state(const fs::path& path) {
    let_go_of_everything();
    const auto from = beside_.empty() ? std::string() : full_path(beside_);
    const bool is_text = path.extension() == ".json";
    if (is_text && !timeline().has_recipe())
        return report_problem("this run began in the midst of its scene: save it as .sinew, not as .json"), false;
    const auto bytes = is_text ? std::vector<std::byte>() : sinew::save(session(), from);
    const auto text = is_text ? state_text(timeline().recipe(), from, hash())
                              : std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (auto failure = write_file(path, text)) return report_problem(std::move(*failure)), false;
    message = "saved " + full_path(path);
    note_recent(path);
    tell("saved_state", {{"path", path.string()}, {"hash", hash()}});
    return true;
}

// --- saving ----------------------------------------------------------------------------------------------------------

std::string Play::saved_text() const {
    return text_of(panes_[own_pane_].timeline.session());
}

bool Play::would_lose() const {
    return is_edited() && saved_text() != saved_as_;
}

bool Play::save(const fs::path& path) {
    if (auto failure = write_file(path, saved_text())) return report_problem(std::move(*failure)), false;
    if (!session().level()) { // a level goes on with its own file
        path_ = beside_ = path;
        written_ = time_written(path_);
        name_ = path.string();
        overrides_.clear();
    }
    saved_edits_ = timeline().edits();
    saved_as_ = saved_text();
    drop_draft();
    note_recent(path);
    message = "saved " + full_path(path);
    const auto left_out = std::uint64_t(figures_beside_scene(panes_[own_pane_].timeline.session()));
    if (left_out > 0)
        message += concat(", which leaves out figures of code and events: ", left_out, "; a state has all");
    tell("saved", {{"path", path.string()}, {"left_out", left_out}});
    return true;
}

void Play::save_or_ask() {
    save_then({});
}

/// Scenes of the catalogue are never overwritten.
void Play::save_then(std::function<void()> go_on) {
    const bool own = !path_.empty() && is_file_name(name_) && !session().level();
    if (!own) return ask_for_path(Purpose::save, std::move(go_on));
    if (save(path_) && go_on) go_on();
}

void Play::ask_for_path(Purpose purpose, std::function<void()> then) {
    let_go_of_everything();
    const auto stem = fs::path(name_).stem().stem().string();
    const auto folder = !path_.empty() && is_file_name(name_) ? path_.parent_path() : fs::path();
    const auto wanted = purpose == Purpose::open ? folder / "" : free_path(folder / (stem + extension_for(purpose)));
    path_request = PathRequest{purpose, full_path(wanted), std::move(then)};
    constexpr std::array names = {"open", "save", "save_state", "picture", "film"};
    tell("asks_for_path", {{"purpose", names[std::size_t(purpose)]}, {"suggested", path_request->suggested.string()}});
}

void Play::choose(const fs::path& path) {
    if (!path_request || path.empty()) return;
    const auto request = *std::exchange(path_request, std::nullopt);
    switch (request.purpose) {
    case Purpose::open:
        return open(path.string());
    case Purpose::save:
        if (save(path) && request.then) request.then();
        return;
    case Purpose::save_state:
        return void(save_state(path));
    case Purpose::picture:
        return screenshot(path);
    case Purpose::film:
        return toggle_recording(path);
    }
}

// --- questions -------------------------------------------------------------------------------------------------------

void Play::unless_lost(const std::string& verb, std::function<void()> go_on) {
    if (!would_lose()) return go_on();
    let_go_of_everything();
    const auto saves = [this, go_on] { save_then(go_on); };
    const auto drops = [this, go_on] {
        saved_edits_ = timeline().edits();
        drop_draft();
        go_on();
    };
    question = Question{"Save the changes to " + fs::path(name_).stem().string() + "?",
                        "They are lost if you " + verb + " without saving.",
                        {{"save", "Save", saves}, {"discard", "Don't save", drops}, {"cancel", "Cancel", {}}}};
    tell("asks", {{"question", question->title}});
}

void Play::answer(std::size_t number) {
    if (!question || number >= question->answers.size()) return;
    const auto taken = std::exchange(question, std::nullopt)->answers[number];
    tell("answer", {{"answer", taken.name}});
    if (taken.act) taken.act();
}

bool Play::answer(std::string_view name) {
    if (!question) return false;
    for (std::size_t i = 0; i < question->answers.size(); ++i)
        if (question->answers[i].name == name) return answer(i), true;
    return false;
}

void Play::close() {
    if (question)
        answer(question->answers.size() - 1);
    else if (path_request)
        path_request.reset();
    else if (!problem_.empty())
        problem_.clear();
    else if (help)
        help = false;
    else if (settings)
        settings = false;
    else if (restoration_)
        restoration_.reset();
    else if (tour.is_on())
        tour.end();
    else if (!chosen.empty())
        chosen.clear();
    else
        ask_to_quit();
}

void Play::ask_to_quit() {
    unless_lost("quit", [this] { quit = true; });
}

// --- drafts ----------------------------------------------------------------------------------------------------------

void Play::write_draft() {
    if (draft_.path.empty() || !would_lose()) return;
    const auto origin = beside_.empty() ? "" : concat(draft_origin, full_path(beside_), "\n");
    if (!write_file(draft_.path, origin + saved_text())) tell("draft", {{"path", draft_.path.string()}});
    draft_.edits = timeline().edits();
}

/// Writes the draft while edits are unsaved; otherwise removes it.
void Play::tend_draft(double seconds) {
    draft_.age += seconds;
    if (draft_.path.empty() || draft_.age < draft_every || draft_.edits == timeline().edits()) return;
    draft_.age = 0;
    if (would_lose()) return write_draft();
    drop_draft();
}

void Play::drop_draft() {
    if (!draft_.path.empty()) remove_file(draft_.path);
    draft_.edits = timeline().edits();
}

void Play::offer_draft() {
    const auto text = read_file(draft_.path, max_bytes);
    if (!text) return;
    const auto forget = [this] { drop_draft(); };
    const auto open = [this, text = *text] {
        const auto line = text.substr(0, text.find('\n'));
        const fs::path origin = line.starts_with(draft_origin) ? line.substr(draft_origin.size()) : "";
        auto fetched = library_.read(text, "draft", origin);
        if (!fetched.opened) return report_problem(std::move(fetched.problem));
        name_ = "unsaved " + origin.stem().string();
        overrides_.clear();
        begin(std::move(fetched));
        beside_ = origin;
        saved_edits_ = never_saved;
        saved_as_.clear();
        tell("scene", {{"name", name_}});
    };
    question = Question{"Open what was not saved last time?",
                        "Sinew ended while a scene had changes that were not saved. They were kept.",
                        {{"open", "Open them", open}, {"discard", "Discard", forget}, {"later", "Later", {}}}};
    tell("asks", {{"question", question->title}});
}

} // namespace sinew::play
