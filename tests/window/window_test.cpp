#include "sinew/world/edit.h"

#include "apps/window/window.h"
#include "player/keys.h"
#include "player/tool.h"
#include "tests/canvas/golden_picture.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/paths.h"
#include "tests/play/game.h"
#include "tests/stepped.h"

#include <SDL.h>
#include <array>
#include <cstdint>
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
namespace sinew::window::SINEW_TEST_FILE {
namespace {

play::Fetched fetch(const std::string& word, std::span<const Override> overrides) {
    return play::games::fetch(word, overrides);
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
        std::filesystem::create_directories(folder / "sinew");
        std::ofstream(folder / "sinew/window.json") << "{\"hint\": false}"; // no tour, which Escape would end
        if (SDL_Init(SDL_INIT_VIDEO) != 0) GTEST_SKIP() << "no OpenGL without a display here: " << SDL_GetError();
        game.listener = [this](const play::Told& one) {
            told += one.what + " ";
            if (one.what == "restart") look_on();
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
        const auto position = *position_of(world, *find_particle(world, name));
        return cast<double>(game.view().see({{position[0], position[1], 0}})->pixel);
    }

    /// What the window shows, `shrink` pixels each way made one.
    Image front() const {
        std::vector<std::uint32_t> pixels(std::size_t(width * height));
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glReadPixels(0, 0, width, height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels.data());
        Image small{width / shrink, height / shrink, {}};
        for (int y = 0; y < small.height; ++y)
            for (int x = 0; x < small.width; ++x) {
                std::uint32_t mean = 0;
                for (const unsigned shift : {0U, 8U, 16U}) {
                    std::uint32_t sum = 0;
                    for (int row = shrink * y; row < shrink * (y + 1); ++row)
                        for (int column = shrink * x; column < shrink * (x + 1); ++column)
                            sum += pixels[std::size_t((height - 1 - row) * width + column)] >> shift & 255U;
                    mean |= sum / std::uint32_t(shrink * shrink) << shift;
                }
                small.pixels.push_back(mean);
            }
        take_few_shades(small);
        return small;
    }

    /// Makes the one window there is so large, whatever the display.
    void resize_window() const {
        for (Uint32 id = 1; id < 100; ++id)
            if (auto* window = SDL_GetWindowFromID(id)) SDL_SetWindowSize(window, width, height);
    }

    /// Each restart is told in a later picture than the one before, however slow the machine: the window has its size
    /// for some pictures before it is closed.
    void look_on() {
        constexpr int enough = 6;
        if (restarts == 0) resize_window();
        if (!looking) return;
        press_soon(++restarts >= enough ? SDLK_ESCAPE : SDLK_r);
    }
    /// Presses a key soon, and again each second until the next one: a busy machine may lose the first.
    void press_soon(SDL_Keycode code) {
        constexpr Uint32 soon = 40;
        const auto press = [](Uint32, void* which) -> Uint32 {
            constexpr Uint32 again = 1000;
            return key(SDL_Keycode(std::intptr_t(which))), again;
        };
        SDL_RemoveTimer(timer);
        timer = SDL_AddTimer(soon, press, reinterpret_cast<void*>(std::intptr_t(code)));
    }

    /// Shows it for a few frames, paused at the start.
    void look(const std::string& theme) {
        game.quit = false;
        game.theme = theme;
        std::filesystem::create_directories(folder / "sinew");
        std::ofstream(folder / "sinew/window.json")
            << "{\"width\": " << width << ", \"height\": " << height << R"(, "hint": false, "theme": ")" << theme
            << "\", \"panel\": " << (panel ? "true}" : "false}");
        game.pause(true);
        looking = true, restarts = 0;
        press_soon(SDLK_r);
        const auto problem = show(game);
        looking = false;
        SDL_RemoveTimer(timer);
        if (problem) GTEST_SKIP() << *problem;
    }

    int width = 1280, height = 720, shrink = 2;
    ScratchFolder folder;
    Image shot;
    bool panel = true, looking = false;
    int restarts = 0;
    SDL_TimerID timer = 0;
    play::SceneLibrary library{{}, {}, fetch, play::games::read}; // no scenes, no thumbnails, which come when they come
    play::Play game{library, "ragdoll"};
    std::string told;
};

// The whole window, panel and all. What is not as it was is far from it: without its panel by half.
TEST_F(WindowTest, LooksAsItDid) {
    if (!std::filesystem::exists("/usr/share/fonts/truetype/inter-vf/Inter-roman.var.ttf"))
        GTEST_SKIP() << "the panel's font is not installed (packages.apt, window)";
    constexpr double min_ssim = 0.97;
    const std::filesystem::path kept = test::source_dir() + "/tests/golden/window";
    look("light");
    if (IsSkipped()) return;
    expect_looks_like(kept / "light.png", shot, min_ssim);
    look("dark");
    expect_looks_like(kept / "dark.png", shot, min_ssim);
    panel = false;
    look("light");
    const auto light = canvas::read_png(kept / "light.png", "light", {});
    ASSERT_TRUE(light.image);
    EXPECT_LT(ssim(*light.image, shot), 0.8) << "a window without its panel looks otherwise";
}

// Bars shrink in small windows, and on a dense display everything is twice as large.
TEST_F(WindowTest, LooksWellInSmallWindowsAndOnDenseDisplays) {
    if (!std::filesystem::exists("/usr/share/fonts/truetype/inter-vf/Inter-roman.var.ttf"))
        GTEST_SKIP() << "the panel's font is not installed (packages.apt, window)";
    constexpr double min_ssim = 0.97;
    const std::filesystem::path kept = test::source_dir() + "/tests/golden/window";
    struct Size {
        const char* name;
        int width, height, shrink;
        const char *scale, *theme;
    };
    for (const auto& size :
         {Size{"640x400.png", 640, 400, 2, "1", "dark"}, Size{"760x480.png", 760, 480, 2, "1", "light"},
          Size{"760x480_at_2.png", 760, 480, 2, "2", "light"},
          Size{"3840x2160_at_2.png", 3840, 2160, 4, "2", "light"}}) {
        width = size.width, height = size.height, shrink = size.shrink;
        setenv("SINEW_SCALE", size.scale, 1);
        look(size.theme);
        unsetenv("SINEW_SCALE");
        if (IsSkipped()) return;
        expect_looks_like(kept / size.name, shot, min_ssim);
    }
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
            if (action.key != "s" && action.key != "v" && action.key != "escape" && action.key != "f2" &&
                !action.key.starts_with("ctrl"))
                for (int again = 0; again < (action.key == "f1" ? 2 : 1); ++again) // the help holds other keys back
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
    EXPECT_TRUE(told.ends_with("end ")) << told << ": whatever was switched on is off again";
}

// Tab shows and hides the panel, and goes into none of its fields, which would take the keys that follow.
TEST_F(WindowTest, TabHasOneMeaning) {
    struct Typing {
        std::vector<SDL_Keycode> keys = {SDLK_p, SDLK_TAB, SDLK_TAB, SDLK_TAB, SDLK_TAB, SDLK_o, SDLK_ESCAPE};
        std::size_t next = 0;
    } typing;
    const auto type = [](Uint32 interval, void* data) -> Uint32 {
        auto& left = *static_cast<Typing*>(data);
        SDL_Event event{};
        event.key.keysym.sym = left.keys[left.next / 2];
        event.key.type = left.next % 2 == 0 ? SDL_KEYDOWN : SDL_KEYUP;
        SDL_PushEvent(&event);
        return ++left.next < 2 * left.keys.size() ? interval : 0;
    };
    SDL_AddTimer(60, type, &typing);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_EQ(told, "pause step end ");
}

// Settings, questions and requests for a path come and go, over the help and without the bars too.
TEST_F(WindowTest, PagesLieOverEachOtherWithoutHarm) {
    struct Typing {
        std::vector<SDL_Keycode> keys = {SDLK_p,  SDLK_F1, SDLK_F2,  SDLK_F1,     SDLK_F2, SDLK_F1,    SDLK_TAB,
                                         SDLK_F2, SDLK_F2, SDLK_TAB, SDLK_F2,     SDLK_F2, SDLK_g,     SDLK_ESCAPE,
                                         SDLK_F1, SDLK_F2, SDLK_TAB, SDLK_ESCAPE, SDLK_g,  SDLK_ESCAPE};
        std::size_t next = 0;
    } typing;
    const auto type = [](Uint32 interval, void* data) -> Uint32 {
        auto& left = *static_cast<Typing*>(data);
        key(left.keys[left.next++]);
        return left.next < left.keys.size() ? interval : 0;
    };
    game.listener = [&](const play::Told& one) {
        told += one.what + " ";
        if (one.what == "end") keep_libraries();
    };
    SDL_AddTimer(60, type, &typing);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_EQ(told, "pause edit asks answer edit end ");
}

// Of a window that is closed while an edit would be lost.
TEST_F(WindowTest, AsksBeforeAnEditIsLost) {
    int asked = 0;
    game.listener = [&](const play::Told& one) {
        told += one.what + " ";
        if (one.what == "asks") game.answer(++asked == 1 ? "cancel" : "discard");
        if (one.what == "answer" && asked == 1) {
            SDL_Event event{};
            event.type = SDL_QUIT;
            SDL_PushEvent(&event);
        }
        if (one.what == "end") keep_libraries();
    };
    key(SDLK_g);
    key(SDLK_ESCAPE);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_EQ(told, "edit asks answer asks answer end ") << told;
    EXPECT_FALSE(std::filesystem::exists(folder / "sinew/autosave.json")) << "it was thrown away on purpose";
}

// On a slow machine a key goes down and up between two pictures.
TEST_F(WindowTest, AKeyThatIsPressedForLessThanAPictureCounts) {
    game.listener = [&](const play::Told& one) {
        told += one.what + " ";
        if (one.what == "saved_state") game.quit = true;
        if (one.what == "end") keep_libraries();
    };
    game.ask_for_path(play::Purpose::save_state);
    game.path_request->suggested = folder / "now.state.json";
    const auto enter = [](Uint32 interval, void*) -> Uint32 {
        std::array<SDL_Event, 2> both{};
        for (auto& event : both) event.key.keysym = {SDL_SCANCODE_RETURN, SDLK_RETURN, 0, 0};
        both[0].key.type = SDL_KEYDOWN, both[1].key.type = SDL_KEYUP;
        SDL_PeepEvents(both.data(), 2, SDL_ADDEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT);
        return interval;
    };
    const auto give_up = [](Uint32 interval, void*) -> Uint32 { return key(SDLK_ESCAPE), interval; };
    SDL_AddTimer(500, enter, nullptr);
    SDL_AddTimer(20000, give_up, nullptr);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_NE(told.find("saved_state "), std::string::npos) << told;
    EXPECT_TRUE(std::filesystem::exists(folder / "now.state.json"));
}

TEST_F(WindowTest, OpensTheFileThatIsDroppedOnIt) {
    std::ofstream(folder / "dropped.json") << R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "line"}]})";
    SDL_Event event{};
    event.type = SDL_DROPFILE;
    event.drop.file = SDL_strdup((folder / "dropped.json").c_str());
    SDL_PushEvent(&event);
    key(SDLK_ESCAPE);
    if (const auto problem = show(game)) GTEST_SKIP() << *problem;
    EXPECT_EQ(game.session().scene().figures.at(0).name, "line") << game.problem();
    ASSERT_FALSE(game.recent.empty());
    EXPECT_EQ(game.recent.front(), (folder / "dropped.json").string());
    std::ifstream settings(folder / "sinew/window.json");
    const std::string kept{std::istreambuf_iterator<char>(settings), {}};
    EXPECT_NE(kept.find("dropped.json"), std::string::npos) << "recent files are remembered: " << kept;
}

// The scene lies between the tools (52 pixels wide) and the panel (340), between menu (28) and bar (64), of 1280x720.
TEST_F(WindowTest, OneFingerIsThePointerAndTwoMoveTheView) {
    game.resize(888, 628);
    const auto head = pixel_of("bob/head");
    const auto x = float((head[0] + 52) / 1280), y = float((head[1] + 28) / 720);
    key(SDLK_p);
    finger(SDL_FINGERDOWN, 1, x, y);
    finger(SDL_FINGERUP, 1, x, y);
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
    game.camera() = {};
    game.resize(888, 628);
    EXPECT_NEAR(norm(hand - after), 2 * norm(pixel_of("bob/right_hand") - pixel_of("bob/head")), 0.1);
}

} // namespace
} // namespace sinew::window::SINEW_TEST_FILE
