#include "sinew/solver/edit.h"

#include "apps/play/keys.h"
#include "apps/play/tool.h"
#include "apps/window/window.h"
#include "tests/canvas/golden_picture.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/paths.h"
#include "tests/play/game.h"

#include <SDL.h>
#include <cstdlib>
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <link.h>
#include <sstream>
#include <vector>

/// The window itself, without a display: what SDL says happens reaches the game.
namespace sinew::window {
namespace {

play::Fetched fetch(const std::string& word, std::span<const Override> overrides) {
    const auto path = test::scenes_dir() + "/" + word + ".json";
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    auto document = load(text.str(), path, overrides);
    return {open_scene(document), to_text(document.diagnostics, {}), path};
}

/// Keeps what is loaded for good. An OpenGL driver holds memory until the process ends; unloaded with SDL, that would
/// be taken for our leak.
void keep_libraries() {
    std::vector<std::string> names;
    const auto list = [](dl_phdr_info* library, std::size_t, void* to) {
        static_cast<std::vector<std::string>*>(to)->emplace_back(library->dlpi_name);
        return 0;
    };
    dl_iterate_phdr(list, &names);
    for (const auto& name : names)
        if (!name.empty()) dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
}

class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        setenv("SDL_VIDEODRIVER", "offscreen", 1);
        for (const char* name : {"XDG_CONFIG_HOME", "XDG_STATE_HOME"}) setenv(name, folder.path.c_str(), 1);
        if (SDL_Init(SDL_INIT_VIDEO) != 0) GTEST_SKIP() << "no OpenGL without a display here: " << SDL_GetError();
        game.listener = [this](const play::Told& one) {
            told += one.what + " ";
            if (one.what != "end") return; // the context is still there
            shot = front();
            keep_libraries();
        };
    }
    void TearDown() override {
        SDL_Quit();
        for (const char* name : {"SDL_VIDEODRIVER", "XDG_CONFIG_HOME", "XDG_STATE_HOME"}) unsetenv(name);
    }

    /// A finger, in parts of the window.
    static void finger(Uint32 type, SDL_FingerID id, float x, float y) {
        SDL_Event event{};
        event.tfinger.type = type;
        event.tfinger.fingerId = id;
        event.tfinger.x = x;
        event.tfinger.y = y;
        SDL_PushEvent(&event);
    }
    static void key(SDL_Keycode code) {
        SDL_Event event{};
        event.key.type = SDL_KEYDOWN;
        event.key.keysym.sym = code;
        SDL_PushEvent(&event);
    }

    Vec2<double> pixel_of(const std::string& name) const {
        const auto& world = std::get<World<2, double>>(game.session().world());
        const auto place = *position_of(world, *find_particle(world, name));
        return cast<double>(game.view().see({{place[0], place[1], 0}})->pixel);
    }

    /// What the window shows, two pixels each way made one.
    static Image front() {
        std::vector<std::uint32_t> pixels(std::size_t(width * height));
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glReadPixels(0, 0, width, height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels.data());
        Image half{width / 2, height / 2, std::vector<std::uint32_t>(std::size_t(width * height / 4))};
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x) {
                std::uint32_t mean = 0;
                for (const unsigned shift : {0U, 8U, 16U}) {
                    std::uint32_t sum = 0;
                    for (const int row : {2 * y, 2 * y + 1})
                        for (const int column : {2 * x, 2 * x + 1})
                            sum += pixels[std::size_t((height - 1 - row) * width + column)] >> shift & 255U;
                    mean |= sum / 4 << shift;
                }
                half.pixels[std::size_t(y * half.width + x)] = mean;
            }
        take_few_shades(half);
        return half;
    }

    /// Shows it for a few frames, paused at the start.
    void look(const std::string& theme) {
        game.theme = theme;
        std::filesystem::create_directories(folder / "sinew");
        std::ofstream(folder / "sinew/window.json") << R"({"width": 1280, "height": 720, "theme": ")" << theme
                                                    << "\", \"panel\": " << (panel ? "true}" : "false}");
        key(SDLK_p);
        const auto quit = [](Uint32, void*) -> Uint32 { return key(SDLK_ESCAPE), 0; };
        SDL_AddTimer(150, quit, nullptr);
        const auto problem = show(game);
        if (problem) GTEST_SKIP() << *problem;
    }

    static constexpr int width = 1280, height = 720;
    ScratchFolder folder;
    Image shot;
    bool panel = true;
    play::Shelf shelf{{}, {}, fetch, play::games::read}; // no scenes, no thumbnails, which come when they come
    play::Play game{shelf, "ragdoll"};
    std::string told;
};

// The whole window, panel and all. What is not as it was is far from it: without its panel by half.
TEST_F(WindowTest, LooksAsItDid) {
    if (!std::filesystem::exists("/usr/share/fonts/truetype/inter-vf/Inter-roman.var.ttf"))
        GTEST_SKIP() << "the panel's font is not installed (packages.apt, window)";
    constexpr double least_ssim = 0.97;
    const std::filesystem::path kept = test::source_dir() + "/tests/golden/window";
    look("light");
    if (IsSkipped()) return;
    expect_looks_like(kept / "light.png", shot, least_ssim);
    game.quit = false;
    look("dark");
    expect_looks_like(kept / "dark.png", shot, least_ssim);
    game.quit = false;
    panel = false;
    look("light");
    const auto light = canvas::read_png(kept / "light.png", "light", {});
    ASSERT_TRUE(light.image);
    EXPECT_LT(ssim(*light.image, shot), 0.8) << "a window without its panel looks otherwise";
}

// Each with a picture or two after it, the help over the scene among them; twice, so that what is on goes off. What
// writes files is left out, and what ends it comes last.
TEST_F(WindowTest, ShowsWhatEveryKeyDoes) {
    struct Typing {
        std::vector<SDL_Keycode> keys;
        std::size_t next = 0;
    } typing;
    for (int times = 0; times < 2; ++times) {
        for (const auto& action : play::key_actions())
            if (action.key != "s" && action.key != "v" && action.key != "escape" && !action.key.starts_with("ctrl"))
                typing.keys.push_back(SDL_GetKeyFromName(std::string(action.key).c_str()));
        for (const auto& tool : play::all_tools())
            typing.keys.push_back(SDL_GetKeyFromName(std::string(tool->key()).c_str()));
        for (const char overlay : {'1', '2', '3', '4'}) typing.keys.push_back(overlay);
    }
    typing.keys.push_back(SDLK_ESCAPE);
    const auto type = [](Uint32 interval, void* data) -> Uint32 {
        auto& left = *static_cast<Typing*>(data);
        key(left.keys[left.next++]);
        return left.next < left.keys.size() ? interval : 0;
    };
    SDL_AddTimer(10, type, &typing);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_EQ(typing.next, typing.keys.size());
    EXPECT_FALSE(game.help);
    EXPECT_TRUE(told.ends_with("end saved ")) << told << " and what was edited is kept";
}

// The scene lies between the tools (56 pixels wide) and the panel (340), above the bar (64), of 1280x720.
TEST_F(WindowTest, OneFingerIsThePointerAndTwoMoveTheView) {
    game.resize(884, 656);
    const auto head = pixel_of("bob/head");
    const auto x = float((head[0] + 56) / 1280), y = float(head[1] / 720);
    key(SDLK_p);
    finger(SDL_FINGERDOWN, 1, x, y);
    finger(SDL_FINGERMOTION, 1, x + 0.1F, y);
    finger(SDL_FINGERUP, 1, x + 0.1F, y);
    finger(SDL_FINGERDOWN, 1, 1270.0F / 1280, 0.5F); // on the panel
    finger(SDL_FINGERUP, 1, 1270.0F / 1280, 0.5F);
    finger(SDL_FINGERDOWN, 2, x, y);
    finger(SDL_FINGERDOWN, 3, x + 0.1F, y);
    finger(SDL_FINGERMOTION, 3, x + 0.2F, y);
    key(SDLK_ESCAPE);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_EQ(told, "pause grab let_go grab let_go end ");
    const auto after = pixel_of("bob/head");
    EXPECT_NEAR(after[0], head[0], 0.1) << "it was under the finger that stayed";
    const auto hand = pixel_of("bob/right_hand");
    EXPECT_GT(norm(hand - after), 0);
    game.eye() = {};
    game.resize(884, 656);
    EXPECT_NEAR(norm(hand - after), 2 * norm(pixel_of("bob/right_hand") - pixel_of("bob/head")), 0.1);
}

} // namespace
} // namespace sinew::window
