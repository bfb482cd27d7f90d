#pragma once

#include "player/scene_library.h"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace sinew::window {

/// Small pictures of scenes, drawn one after the other by a background thread.
class Thumbnails {
  public:
    static constexpr int width = 192, height = 144; ///< pixels

    explicit Thumbnails(const play::SceneLibrary& library) : library_(library) {}
    ~Thumbnails();

    /// OpenGL texture of a scene in a theme, requested at the first call; 0 until drawn.
    std::uint32_t of(const std::string& name, const std::string& theme);
    /// Forgets all textures, of a context that is gone; thumbnails are drawn again on request.
    void forget() { textures_.clear(); }

  private:
    struct DrawItem {
        std::string key;
        std::vector<std::byte> pixels;
    };

    void work(const std::stop_token& stop);

    const play::SceneLibrary& library_;
    std::map<std::string, std::uint32_t> textures_; ///< by name and theme; 0: not drawn yet
    std::mutex mutex_;
    std::condition_variable_any wanted_changed_;
    std::vector<std::pair<std::string, std::string>> wanted_;
    std::vector<DrawItem> drawn_;
    std::jthread thread_;
};

} // namespace sinew::window
