#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include "apps/window/gl_painter.h"
#include "apps/window/screen.h"
#include "canvas/beside.h"
#include "canvas/png.h"
#include "canvas/raster.h"
#include "tests/canvas/ssim.h"
#include "tests/paths.h"
#include "tests/text_of.h"

#include <SDL.h>
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <limits>

/// The two painters of a picture show the same.
namespace sinew::window::SINEW_TEST_FILE {
namespace {

constexpr int width = 640, height = 480;

/// An OpenGL context that needs no display.
class GlPainterTest : public testing::Test {
  protected:
    void SetUp() override {
        SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
        if (SDL_Init(SDL_INIT_VIDEO) != 0) GTEST_SKIP() << "no OpenGL without a display here: " << SDL_GetError();
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
        window = SDL_CreateWindow("test", 0, 0, width, height, SDL_WINDOW_OPENGL | SDL_WINDOW_HIDDEN);
        context = window ? SDL_GL_CreateContext(window) : nullptr;
        if (!context) GTEST_SKIP() << "no OpenGL 3.3 here: " << SDL_GetError();
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        GLuint target = 0;
        glGenFramebuffers(1, &target);
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    }

    void TearDown() override {
        if (context) SDL_GL_DeleteContext(context);
        if (window) SDL_DestroyWindow(window);
        SDL_Quit();
    }

    static Image by_gl(const Picture& picture) {
        GlPainter painter;
        EXPECT_EQ(painter.problem(), "");
        painter.paint(picture, 0, 0);
        Image image{.width = width, .height = height, .pixels = std::vector<std::uint32_t>(width * height)};
        glReadPixels(0, 0, width, height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, image.pixels.data());
        for (int row = 0; row < height / 2; ++row)
            std::swap_ranges(image.pixels.begin() + row * width, image.pixels.begin() + (row + 1) * width,
                             image.pixels.begin() + (height - 1 - row) * width);
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
        return image;
    }

    static Image by_cairo(const Picture& picture) {
        canvas::Raster raster(width, height);
        EXPECT_FALSE(raster.paint(picture));
        Image image{.width = width, .height = height, .pixels = std::vector<std::uint32_t>(width * height)};
        std::memcpy(image.pixels.data(), raster.bytes().data(), image.pixels.size() * sizeof(std::uint32_t));
        return image;
    }

    SDL_Window* window = nullptr;
    SDL_GLContext context = nullptr;
};

Session session_of(const std::string& name) {
    const std::filesystem::path folder = test::scenes_dir();
    auto document = load(text_of(folder / (name + ".json")), name);
    return Session(std::move(*open_scene(document, [&](const std::string& image, const Limits& limits) {
        return canvas::read_png(folder / image, image, limits);
    })));
}

TEST_F(GlPainterTest, ShowsScenesAsCairoDoes) {
    for (const auto* name :
         {"ragdoll", "rope", "chains", "filled_forms", "cloth_wind", "cloth3d", "bezier_humanoid", "box"}) {
        auto session = session_of(name);
        for (int i = 0; i < 60; ++i) session.step();
        Picture picture;
        picture.width = width, picture.height = height;
        for (const unsigned long overlay : {0UL, ~0UL}) {
            draw(session, picture, OverlaySet(overlay));
            EXPECT_GE(ssim(by_gl(picture), by_cairo(picture)), 0.97) << name << " " << overlay;
        }
    }
}

TEST_F(GlPainterTest, ShowsPicturesBesideEachOtherAsCairoDoes) {
    auto session = session_of("chains");
    for (int i = 0; i < 60; ++i) session.step();
    Picture left, right, whole;
    for (auto* part : {&left, &right}) part->width = 318, part->height = 455;
    draw(session, left, OverlaySet(~0UL));
    session.set_theme("dark");
    draw(session, right);
    const std::array parts = {canvas::Labelled{&left, "left"}, canvas::Labelled{&right, "right"}};
    canvas::put_beside(parts, whole);
    ASSERT_EQ(whole.width, width);
    ASSERT_EQ(whole.height, height);
    EXPECT_GE(ssim(by_gl(whole), by_cairo(whole)), 0.97);
}

TEST_F(GlPainterTest, LeavesOutWhatCannotBePainted) {
    Picture picture;
    picture.width = width, picture.height = height;
    const float nan = std::numeric_limits<float>::quiet_NaN(), far = 1e30F;
    const std::array<Vec2<float>, 4> odd = {{{{nan, 1}}, {{far, -far}}, {{3, 3}}, {{3, 3}}}};
    for (const auto shape :
         {Shape::polyline, Shape::loop, Shape::disc, Shape::polygon, Shape::image, Shape::text, Shape::pane}) {
        picture.add(shape, std::span(odd), 3, {1, 0, 0, 1});
        picture.add(shape, std::span(odd).subspan(1), -1, {1, 0, 0, 1});
        picture.add(shape, std::span(odd).first(0), nan, {1, 0, 0, 1});
        picture.items.back().number = 77;
        picture.add(shape, std::span(odd).subspan(1, 2), 3, {1, 0, 0, 1});
    }
    by_gl(picture);
}

TEST(Screen, ShowsTheSameInANewContext) {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    const auto shown = [](Screen& screen, const Picture& picture) {
        GlPainter painter;
        EXPECT_EQ(painter.problem(), "");
        painter.paint(picture, 0, 0);
        std::vector<std::uint32_t> pixels(std::size_t(screen.width()) * std::size_t(screen.height()));
        glReadPixels(0, 0, screen.width(), screen.height(), GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels.data());
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
        return pixels;
    };
    {
        Screen screen;
        if (const auto problem = screen.open("test", width, height)) GTEST_SKIP() << *problem;
        auto session = session_of("ragdoll");
        Picture picture;
        picture.width = width, picture.height = height;
        draw(session, picture);
        const auto before = shown(screen, picture);
        EXPECT_GT(std::count_if(before.begin(), before.end(), [&](auto pixel) { return pixel != before[0]; }), 1000);
        EXPECT_FALSE(screen.lost());
        ASSERT_FALSE(screen.renew());
        EXPECT_FALSE(screen.lost());
        EXPECT_EQ(shown(screen, picture), before);
    }
    unsetenv("SDL_VIDEODRIVER");
}

} // namespace
} // namespace sinew::window::SINEW_TEST_FILE
