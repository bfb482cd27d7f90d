#include "apps/window/screen.h"

#include "apps/window/window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <epoxy/gl.h>
#include <string_view>

namespace sinew::window {
namespace {

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value && *value;
}

std::string because(const std::string& what) {
    return what + " (" + SDL_GetError() + ")";
}

} // namespace

bool has_display() {
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

Screen::~Screen() {
    if (context_) SDL_GL_DeleteContext(context_);
    if (window_) SDL_DestroyWindow(window_);
    if (started_) SDL_Quit();
}

std::optional<std::string> Screen::open(const std::string& title, int width, int height) {
    // Explicit order: SDL's default may choose a driver without visible output.
    SDL_SetHint(SDL_HINT_VIDEODRIVER, is_set("DISPLAY") ? "x11,wayland" : "wayland,x11");
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) return because("the display cannot be opened");
    started_ = true;
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    window_ = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height,
                               SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (!window_) return because("no window can be opened");
    for (const auto event : {SDL_DROPFILE, SDL_DROPTEXT}) SDL_EventState(event, SDL_ENABLE);
    if (auto problem = renew()) return problem;
    fit(width, height);
    return std::nullopt;
}

/// Scales the window for a dense display, whose density is known only once the window is open.
void Screen::fit(int width, int height) {
    const double scale = size_scale();
    if (scale == 1) return;
    SDL_Rect room{0, 0, 16384, 16384};
    const int display = SDL_GetWindowDisplayIndex(window_);
    if (display >= 0) SDL_GetDisplayUsableBounds(display, &room);
    SDL_SetWindowSize(window_, std::min(int(width * scale), room.w), std::min(int(height * scale), room.h));
    SDL_SetWindowPosition(window_, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED);
}

/// Creates a context that reports its loss, or a plain one if the driver cannot.
std::optional<std::string> Screen::renew() {
    if (context_) SDL_GL_DeleteContext(context_);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_RESET_NOTIFICATION, SDL_GL_CONTEXT_RESET_LOSE_CONTEXT);
    context_ = SDL_GL_CreateContext(window_);
    if (!context_) {
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_RESET_NOTIFICATION, SDL_GL_CONTEXT_RESET_NO_NOTIFICATION);
        context_ = SDL_GL_CreateContext(window_);
    }
    if (!context_) return because("the display has no OpenGL 3.3");
    can_tell_ = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_robustness");
    SDL_GL_SetSwapInterval(waits_ ? 1 : 0);
    return std::nullopt;
}

void Screen::wait_for_display(bool on) {
    if (on == waits_) return;
    waits_ = on;
    SDL_GL_SetSwapInterval(on ? 1 : 0);
}

bool Screen::lost() const {
    if (!can_tell_) return false;
    return (epoxy_gl_version() >= 45 ? glGetGraphicsResetStatus() : glGetGraphicsResetStatusARB()) != GL_NO_ERROR;
}

int Screen::width() const {
    int width = 0, height = 0;
    SDL_GL_GetDrawableSize(window_, &width, &height);
    return width;
}

int Screen::height() const {
    int width = 0, height = 0;
    SDL_GL_GetDrawableSize(window_, &width, &height);
    return height;
}

double Screen::pointer_scale() const {
    int width = 0, height = 0;
    SDL_GetWindowSize(window_, &width, &height);
    return width > 0 ? double(this->width()) / width : 1;
}

/// Order: SINEW_SCALE, GDK_SCALE, pixels per unit of the window, dots per inch over 96.
double Screen::density() const {
    for (const char* variable : {"SINEW_SCALE", "GDK_SCALE"})
        if (is_set(variable))
            if (const double scale = std::atof(std::getenv(variable)); scale >= 0.5 && scale <= 4) return scale;
    if (const double scale = pointer_scale(); scale > 1) return scale;
    float dpi = 0;
    const int display = SDL_GetWindowDisplayIndex(window_);
    if (display < 0 || SDL_GetDisplayDPI(display, nullptr, &dpi, nullptr) != 0 || dpi < 140 || dpi > 400) return 1;
    return std::round(double(dpi) / 96 * 4) / 4;
}

bool Screen::minimized() const {
    return (SDL_GetWindowFlags(window_) & (SDL_WINDOW_MINIMIZED | SDL_WINDOW_HIDDEN)) != 0;
}

} // namespace sinew::window
