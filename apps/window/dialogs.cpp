#include "apps/window/dialogs.h"

#include "apps/window/label.h"
#include "player/folder.h"
#include "player/tool.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace sinew::window {
namespace {

namespace fs = std::filesystem;

struct PurposeText {
    const char *title, *button, *ending;
};

PurposeText text_of(play::Purpose purpose) {
    switch (purpose) {
    case play::Purpose::open:
        return {"Open a scene or a running state", "Open", ".json"};
    case play::Purpose::save:
        return {"Save the scene as", "Save", ".json"};
    case play::Purpose::save_state:
        return {"Save the running state as", "Save", ".json"};
    case play::Purpose::picture:
        return {"Export this moment: PNG, SVG or PDF; OBJ or PLY", "Export", ".png"};
    default:
        return {"Export what happens: MP4, WebP, GIF; glb, pc2; moving svg, Lottie json", "Record", ".mp4"};
    }
}

} // namespace

void Dialogs::show(const Look& look, const Fonts& fonts, float scale, int width, int height) {
    look_ = &look, fonts_ = &fonts;
    scale_ = scale, width_ = float(width), height_ = float(height);
    if (!play_.path_request) typing_ = false;
    if (!play_.settings) rebinding_.clear();
    if (play_.question)
        question();
    else if (play_.path_request)
        path();
    else if (!play_.problem().empty())
        problem();
    else if (play_.settings)
        settings();
    else
        open_ = nullptr;
    if (play_.help && !open_) help();
    if (play_.restored_share() < 1) progress();
}

/// Begins a modal in the middle, no wider than the window.
bool Dialogs::begin(const char* title, float nominal_width) {
    if (open_ != title) ImGui::OpenPopup(title);
    open_ = title;
    const float margin = 12 * scale_;
    ImGui::SetNextWindowSize({std::min(width_ - margin, nominal_width * scale_), 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {width_ - margin, height_ - margin});
    ImGui::SetNextWindowPos({width_ / 2, height_ / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    const auto flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 10 * scale_);
    const bool shown = ImGui::BeginPopupModal(title, nullptr, flags);
    ImGui::PopStyleVar();
    if (shown) return true;
    open_ = nullptr; // closed by ImGui
    return false;
}

void Dialogs::end() {
    ImGui::EndPopup();
}

void Dialogs::question() {
    const auto asked = *play_.question;
    if (!begin("Sinew asks", 460)) return;
    ImGui::PushTextWrapPos();
    ImGui::PushFont(fonts_->large);
    ImGui::TextUnformatted(asked.title.c_str());
    ImGui::PopFont();
    ImGui::TextUnformatted(asked.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, 4 * scale_});
    for (std::size_t i = 0; i < asked.answers.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Button, i == 0 ? look_->accent : look_->raised);
        ImGui::PushStyleColor(ImGuiCol_Text, i == 0 ? look_->on_accent : look_->text);
        if (ImGui::Button(asked.answers[i].label.c_str())) play_.answer(i);
        ImGui::PopStyleColor(2);
    }
    end();
}

void Dialogs::path() {
    const auto request = *play_.path_request;
    const auto words = text_of(request.purpose);
    if (!typing_) {
        const auto text = request.suggested.string();
        typed_.fill(0);
        std::memcpy(typed_.data(), text.data(), std::min(text.size(), typed_.size() - 1));
    }
    if (!begin(words.title, 560)) return;
    if (!typing_) ImGui::SetKeyboardFocusHere();
    typing_ = true;
    ImGui::SetNextItemWidth(-1);
    bool chosen = ImGui::InputText("##path", typed_.data(), typed_.size(),
                                   ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    folder(words.ending);
    const fs::path typed(typed_.data());
    std::error_code unknown;
    const bool exists = fs::is_regular_file(typed, unknown), is_folder = fs::is_directory(typed, unknown);
    const bool opens = request.purpose == play::Purpose::open;
    ImGui::BeginDisabled(is_folder || typed.empty() || (opens && !exists));
    chosen = ImGui::Button(words.button) || (chosen && !is_folder && !typed.empty());
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) play_.path_request.reset();
    if (exists && !opens) {
        ImGui::SameLine();
        ImGui::TextColored(look_->accent, "replaces that file");
    }
    if (chosen && play_.path_request) play_.choose(typed);
    end();
}

/// Lists the folder of the typed path.
void Dialogs::folder(const std::string& ending) {
    const fs::path typed(typed_.data());
    std::error_code unknown;
    const auto here = fs::is_directory(typed, unknown) ? typed : typed.parent_path();
    const float height = std::clamp(height_ - 190 * scale_, 40 * scale_, 230 * scale_);
    ImGui::BeginChild("folder", {0, height}, true);
    for (const auto& entry : play::entries_of(here, ending)) {
        const auto shown = entry.is_folder ? entry.name + "/" : entry.name;
        if (ImGui::Selectable(shown.c_str(), !entry.is_folder && entry.name == typed.filename())) go_into(entry.name);
    }
    ImGui::EndChild();
}

/// Going into a folder keeps the typed file name.
void Dialogs::go_into(const std::string& name) {
    const fs::path typed(typed_.data());
    std::error_code unknown;
    const auto here = fs::is_directory(typed, unknown) ? typed : typed.parent_path();
    auto to = (here / name).lexically_normal();
    if (fs::is_directory(to, unknown) && !fs::is_directory(typed, unknown)) to /= typed.filename();
    const auto text = to.string();
    if (text.size() >= typed_.size()) return;
    typed_.fill(0);
    std::memcpy(typed_.data(), text.data(), text.size());
}

void Dialogs::problem() {
    if (!begin("This cannot be done", 780)) return;
    const float height = std::clamp(height_ - 120 * scale_, 40 * scale_, 240 * scale_);
    ImGui::BeginChild("text", {0, height}, false, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::PushFont(fonts_->fixed);
    ImGui::TextUnformatted(play_.problem().c_str());
    ImGui::PopFont();
    ImGui::EndChild();
    if (ImGui::Button("Go on with the scene that runs")) play_.dismiss_problem();
    end();
}

void Dialogs::settings() {
    if (!begin("Settings", 520)) return;
    const float height = std::clamp(height_ - 100 * scale_, 60 * scale_, 440 * scale_);
    ImGui::BeginChild("page", {0, height});
    label("text size", "of letters, buttons and bars", look_->text, 0.3F);
    constexpr std::array sizes = {0.8, 1.0, 1.25, 1.5, 2.0};
    int now = -1;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        if (sizes[i] == text_size) now = int(i);
    const int size = choice("size", {{"80 %"}, {"100 %"}, {"125 %"}, {"150 %"}, {"200 %"}}, now, *look_,
                            ImGui::GetContentRegionAvail().x);
    if (size >= 0) text_size = sizes[std::size_t(size)];
    label("theme", "colours of the window and of scenes", look_->text, 0.3F);
    const int theme = play_.theme.empty() ? 0 : play_.theme == "light" ? 1 : 2;
    const int chosen =
        choice("theme", {{"as scenes say"}, {"light"}, {"dark"}}, theme, *look_, ImGui::GetContentRegionAvail().x);
    if (chosen >= 0) play_.theme = std::array{"", "light", "dark"}[std::size_t(chosen)];
    label("fast as can be", "pictures do not wait for the display", look_->text, 0.3F);
    ImGui::Checkbox("##free", &play_.free_running);
    ImGui::Dummy({0, 4 * scale_});
    key_rows();
    ImGui::EndChild();
    if (ImGui::Button("Done")) play_.settings = false;
    ImGui::SameLine();
    if (ImGui::Button("Usual keys")) play_.keys.reset();
    if (!rebind_problem_.empty()) {
        ImGui::SameLine();
        ImGui::TextColored(look_->accent, "%s", rebind_problem_.c_str());
    }
    end();
}

void Dialogs::key_rows() {
    ImGui::TextColored(look_->faint, "keys: press one of them, then the key it shall be");
    for (const auto& action : play::key_actions()) key_row(action.name, action.about);
    static const auto tools = play::all_tools();
    for (const auto& tool : tools) key_row(tool->name(), tool->about());
}

void Dialogs::key_row(std::string_view name, std::string_view about) {
    const std::string action(name);
    label(std::string(about), std::string(about), look_->text, 0.68F);
    const auto word = rebinding_ == action ? "a key..." : play_.keys.of(name);
    ImGui::PushStyleColor(ImGuiCol_Text, rebinding_ == action ? look_->accent : look_->text);
    if (ImGui::Button((word + "##" + action).c_str(), {-1, 0})) rebinding_ = action, rebind_problem_.clear();
    ImGui::PopStyleColor();
}

bool Dialogs::take_key(const std::string& key) {
    if (rebinding_.empty()) return false;
    const auto taken = key == "escape" ? std::string() : play_.keys.choose(rebinding_, key);
    rebind_problem_ = taken.empty() ? "" : key + " stands for " + taken;
    rebinding_.clear();
    return true;
}

/// Shows the keys in as many columns as fit, over a dimmed window.
void Dialogs::help() {
    const bool wide = width_ > 680 * scale_;
    dim();
    ImGui::SetNextWindowPos({width_ / 2, height_ / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {width_ - 12 * scale_, height_ - 12 * scale_});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 12 * scale_);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(26 * scale_, 22 * scale_));
    ImGui::Begin("help", &play_.help,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushFont(fonts_->large);
    ImGui::TextUnformatted("Keys");
    ImGui::PopFont();
    const auto line = [&](std::string_view key, std::string_view about) {
        ImGui::TableNextColumn();
        ImGui::TextColored(look_->accent, "%.*s", int(key.size()), key.data());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(about.data(), about.data() + about.size());
    };
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(10 * scale_, 3 * scale_));
    if (ImGui::BeginTable("keys", wide ? 4 : 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& action : play::key_actions()) line(play_.keys.of(action.name), action.about);
        for (const auto& tool : play::all_tools())
            line(play_.keys.of(tool->name()), std::string(tool->name()) + " tool");
        line("1 to " + std::to_string(overlays.size()), "overlays");
        line("drag", "take hold and throw");
        line("right drag", "cut");
        line("middle drag", "look elsewhere");
        line("wheel", "zoom");
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::End();
    ImGui::PopStyleVar(2);
}

/// Covers everything begun before with a dimming window.
void Dialogs::dim() const {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({width_, height_});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_ModalWindowDimBg));
    ImGui::Begin("dimmed", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

void Dialogs::progress() {
    const auto text = "restoring: " + std::to_string(int(play_.restored_share() * 100)) + " %";
    const auto size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 at{(width_ - size.x) / 2, (height_ - size.y) / 2};
    auto& list = *ImGui::GetForegroundDrawList();
    const float margin = 14 * scale_;
    list.AddRectFilled({at.x - margin, at.y - margin}, {at.x + size.x + margin, at.y + size.y + margin},
                       packed(look_->text, 0.9F), margin);
    list.AddText(at, packed(look_->surface), text.c_str());
}

} // namespace sinew::window
