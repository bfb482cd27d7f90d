#include "player/state_file.h"

#include "sinew/scene/check.h"
#include "sinew/scene/reader.h"
#include "sinew/scene/text.h"
#include "sinew/world/measure.h"

#include "player/saved_action.h"

#include <cstdio>

namespace sinew::play {
namespace {

constexpr std::int64_t max_steps = 100'000'000; // 19 days at 60 per second

struct StateFile {
    int version = 1;
    std::string from, hash;
    std::int64_t steps = 0;
    json::Value scene;
    std::vector<SavedAction> actions;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.version,
              Field{.name = "sinew_state", .help = "Version of the format", .low = 1, .high = 1, .required = true});
        visit(self.from,
              Field{.name = "from", .help = "File of the scene; paths of images and models are relative to it"});
        visit(self.steps, Field{.name = "steps",
                                .help = "Number of steps from the start of the scene",
                                .low = 0,
                                .high = double(max_steps),
                                .required = true});
        visit(self.hash, Field{.name = "hash", .help = "Hash of the final state", .required = true});
        visit(self.scene, Field{.name = "scene", .help = "Scene, as in a scene file", .required = true});
        visit(self.actions, Field{.name = "actions", .help = "Actions, in order"});
    }
};

std::string hash_of(const Session& session) {
    const auto bits = std::visit([](const auto& world) { return state_hash(world); }, session.world());
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
    return text;
}

/// Dimension of the file's points, needed before the scene is parsed.
int dimension_of(const json::Value& root) {
    const auto* dimension = json::find(root, "/scene/dimension");
    const auto* number = dimension ? dimension->as<json::Number>() : nullptr;
    return number && number->integer == 3 ? 3 : 2;
}

} // namespace

std::string state_text(const Recipe& recipe, const std::string& from, const std::string& hash) {
    StateFile file{.from = from,
                   .hash = hash,
                   .steps = std::int64_t(recipe.steps),
                   .scene = to_json(*recipe.scene),
                   .actions = {}};
    for (const auto& action : recipe.actions) file.actions.push_back(saved(action));
    return json::to_text(write(file, Writing{.dimension = recipe.scene->dimension})) + "\n";
}

bool is_state(const std::string& text) {
    constexpr std::size_t head = 200; // bytes: the key comes first
    return text.substr(0, head).find("\"sinew_state\"") != std::string::npos;
}

Restoration::Restoration(const std::string& text, const std::string& name, const SceneLibrary& library) : name_(name) {
    auto document = load(text, name);
    StateFile file;
    Reading reading{.diagnostics = document.diagnostics, .dimension = dimension_of(document.root)};
    if (document.diagnostics.ok()) read(document.root, file, reading);
    if (!document.diagnostics.ok()) {
        problem_ = to_text(document.diagnostics, {.color = false, .max = 5});
        return;
    }
    from_ = file.from, hash_ = file.hash;
    steps_ = std::uint64_t(file.steps);
    const auto opened_of = [&](const json::Value& scene) {
        auto fetched = library.read(json::to_text(scene), name + ": scene", from_);
        if (!fetched.opened) problem_ = std::move(fetched.problem);
        return std::move(fetched.opened);
    };
    for (std::size_t i = 0; i < file.actions.size() && problem_.empty(); ++i) {
        const auto& action = file.actions[i];
        const bool is_late = std::uint64_t(action.step) > steps_;
        if (is_late || (i > 0 && action.step < file.actions[i - 1].step))
            problem_ = concat(name, ": actions/", i, ": step ", action.step,
                              is_late ? " is after the last" : " is before that of the action above it");
        else if (auto loaded = action_of(action, opened_of))
            actions_.push_back({std::uint64_t(action.step), std::move(*loaded)});
    }
    if (!problem_.empty()) return;
    if (auto opened = opened_of(file.scene)) {
        session_.emplace(std::move(*opened));
        log_.emplace(*session_);
        act_now();
    }
}

void Restoration::act_now() {
    for (; next_ < actions_.size() && actions_[next_].step == taken_; ++next_) {
        carry_out(actions_[next_].action, *session_);
        log_->note(actions_[next_].action, *session_);
    }
}

void Restoration::advance(const std::function<bool()>& enough) {
    while (!done()) {
        session_->step();
        log_->step();
        ++taken_;
        act_now();
        if (enough && enough()) return;
    }
}

std::optional<Timeline> Restoration::finish() {
    if (!problem_.empty()) return std::nullopt;
    if (const auto hash = hash_of(*session_); hash != hash_) {
        problem_ = concat(name_, ": its actions lead to the state ", hash, ", not to ", in_quotes(hash_),
                          " that was saved: it was changed, or comes from another version of Sinew");
        return std::nullopt;
    }
    return Timeline(std::move(*session_), std::move(*log_));
}

} // namespace sinew::play
