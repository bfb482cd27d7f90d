#include "apps/window/look.h"

#include <array>
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <filesystem>

namespace sinew::window {
namespace {

ImVec4 rgb(unsigned hex) {
    return {float(hex >> 16U & 255U) / 255, float(hex >> 8U & 255U) / 255, float(hex & 255U) / 255, 1};
}

const Look light = {.surface = rgb(0xfdfaf3),
                    .raised = rgb(0xefe7d7),
                    .line = rgb(0xded4c0),
                    .text = rgb(0x2b2d42),
                    .faint = rgb(0x8b8474),
                    .accent = rgb(0xd9481f),
                    .on_accent = rgb(0xffffff),
                    .good = rgb(0x1f8a8a),
                    .cool = rgb(0x3f6fb5)};
const Look dark = {.surface = rgb(0x20242f),
                   .raised = rgb(0x2e3443),
                   .line = rgb(0x3a4153),
                   .text = rgb(0xe8e4da),
                   .faint = rgb(0x8d94a5),
                   .accent = rgb(0xff7a52),
                   .on_accent = rgb(0x1b1e27),
                   .good = rgb(0x43c6b9),
                   .cool = rgb(0x74a7ff)};

/// The first font of the list that is installed; ImGui's own if none is.
template <std::size_t N> ImFont* font_of(const std::array<const char*, N>& paths, float size) {
    auto& fonts = *ImGui::GetIO().Fonts;
    static const ImWchar letters[] = {0x20, 0xff, 0x2013, 0x2026, 0x2190, 0x2193, 0}; // Latin, dashes, ellipsis, arrows
    std::error_code unknown;
    for (const char* path : paths)
        if (std::filesystem::exists(path, unknown))
            if (auto* font = fonts.AddFontFromFileTTF(path, size, nullptr, letters)) return font;
    ImFontConfig config;
    config.SizePixels = size;
    return fonts.AddFontDefault(&config);
}

constexpr std::array text_fonts = {"/usr/share/fonts/truetype/inter-vf/Inter-roman.var.ttf",
                                   "/usr/share/fonts/truetype/open-sans/OpenSans-Regular.ttf",
                                   "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                   "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr std::array fixed_fonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                                    "/usr/share/fonts/truetype/noto/NotoSansMono-Regular.ttf"};

void make_fonts(float density, Fonts& fonts) {
    auto& io = ImGui::GetIO();
    io.Fonts->Clear();
    // Fractional line heights add up to a needless scroll bar.
    fonts.normal = font_of(text_fonts, std::round(15 * density));
    fonts.large = font_of(text_fonts, std::round(22 * density));
    fonts.small = font_of(text_fonts, 12.5F * density);
    fonts.fixed = font_of(fixed_fonts, std::round(13 * density));
    io.Fonts->Build();
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

ImVec4 blend(const ImVec4& a, const ImVec4& b, float share) {
    return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share, 1};
}

void set_sizes(ImGuiStyle& style, float density) {
    style.WindowPadding = {16, 14};
    style.FramePadding = {9, 5};
    style.ItemSpacing = {8, 7};
    style.ItemInnerSpacing = {7, 5};
    style.ScrollbarSize = 10;
    style.GrabMinSize = 12;
    style.WindowRounding = 0;
    style.FrameRounding = 6;
    style.GrabRounding = 6;
    style.PopupRounding = 8;
    style.ChildRounding = 8;
    style.ScrollbarRounding = 6;
    style.WindowBorderSize = 0;
    style.FrameBorderSize = 0;
    style.PopupBorderSize = 1;
    style.IndentSpacing = 12;
    style.ScaleAllSizes(density);
}

void set_colors(ImVec4* colors, const Look& look) {
    for (int i = 0; i < ImGuiCol_COUNT; ++i) colors[i] = look.raised;
    const auto hovered = blend(look.raised, look.text, 0.08F), pressed = blend(look.raised, look.accent, 0.35F);
    colors[ImGuiCol_Text] = look.text;
    colors[ImGuiCol_TextDisabled] = look.faint;
    colors[ImGuiCol_WindowBg] = colors[ImGuiCol_PopupBg] = look.surface;
    colors[ImGuiCol_ChildBg] = {0, 0, 0, 0};
    colors[ImGuiCol_Border] = colors[ImGuiCol_Separator] = look.line;
    colors[ImGuiCol_BorderShadow] = {0, 0, 0, 0};
    colors[ImGuiCol_FrameBg] = colors[ImGuiCol_Button] = colors[ImGuiCol_Header] = look.raised;
    for (const int i : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered}) colors[i] = hovered;
    for (const int i : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive}) colors[i] = pressed;
    colors[ImGuiCol_CheckMark] = colors[ImGuiCol_SliderGrab] = colors[ImGuiCol_SliderGrabActive] = look.accent;
    colors[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
    colors[ImGuiCol_ScrollbarGrab] = look.line;
    colors[ImGuiCol_TextSelectedBg] = blend(look.surface, look.accent, 0.4F);
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = look.surface;
    colors[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.45F};
}

} // namespace

const Look& look_called(const std::string& theme) {
    return theme == "dark" ? dark : light;
}

void dress(const Look& look, double density, double& dressed_density, Fonts& fonts) {
    if (density != dressed_density) make_fonts(float(density), fonts);
    dressed_density = density;
    ImGuiStyle style;
    set_sizes(style, float(density));
    set_colors(style.Colors, look);
    ImGui::GetStyle() = style;
}

} // namespace sinew::window
