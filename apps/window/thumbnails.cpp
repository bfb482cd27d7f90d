#include "apps/window/thumbnails.h"

#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include "canvas/raster.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <epoxy/gl.h>

namespace sinew::window {
namespace {

/// Draws the scene after a fifth of its time, at most 4 s, or as far as 0.3 s of work lead.
std::vector<std::byte> draw(const play::SceneLibrary& library, const std::string& name, const std::string& theme) {
    const std::vector<Override> overrides = {{"view.theme=" + theme, "the panel"}};
    auto fetched = library.fetch(name, overrides);
    if (!fetched.opened) return {};
    Session session(std::move(*fetched.opened));
    constexpr double part = 0.2, longest = 4; // simulated seconds
    const double until = std::min(session.scene().seconds * part, longest);
    const auto begin = std::chrono::steady_clock::now();
    while (session.seconds() < until && std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(300))
        session.step();
    Picture picture;
    const auto& size = session.scene().view.size;
    const double scale = std::min(Thumbnails::width / double(size[0]), Thumbnails::height / double(size[1]));
    picture.width = std::max(1, int(size[0] * scale + 0.5));
    picture.height = std::max(1, int(size[1] * scale + 0.5));
    draw(session, picture);
    canvas::Raster raster(Thumbnails::width, Thumbnails::height);
    if (raster.paint(picture)) return {};
    const auto bytes = raster.bytes();
    return {bytes.begin(), bytes.end()};
}

} // namespace

Thumbnails::~Thumbnails() {
    thread_.request_stop();
    wanted_changed_.notify_all();
}

void Thumbnails::work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        std::pair<std::string, std::string> next;
        {
            std::unique_lock lock(mutex_);
            if (!wanted_changed_.wait(lock, stop, [&] { return !wanted_.empty(); })) return;
            next = wanted_.front();
            wanted_.erase(wanted_.begin());
        }
        auto pixels = draw(library_, next.first, next.second);
        const std::lock_guard lock(mutex_);
        drawn_.push_back({next.first + '\n' + next.second, std::move(pixels)});
    }
}

std::uint32_t Thumbnails::of(const std::string& name, const std::string& theme) {
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    std::vector<DrawItem> drawn;
    const auto key = name + '\n' + theme;
    {
        const std::lock_guard lock(mutex_);
        drawn.swap(drawn_);
        if (!textures_.contains(key)) {
            textures_[key] = 0;
            wanted_.emplace_back(name, theme);
            wanted_changed_.notify_one();
        }
    }
    for (const auto& one : drawn) {
        if (one.pixels.empty()) continue;
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                     one.pixels.data());
        textures_[one.key] = texture;
    }
    return textures_[key];
}

} // namespace sinew::window
