#pragma once

#include "sinew/picture/picture.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sinew::window {

/// Paints pictures with OpenGL 3.3. Lines and discs are quads shaded by the signed distance to the line, which smooths
/// edges without multisampling. A picture is one vertex buffer, drawn with one call per run of the same texture.
class GlPainter {
  public:
    /// Requires a current OpenGL context, as do all members. If a shader does not compile, problem() gives the reason.
    GlPainter();
    GlPainter(const GlPainter&) = delete;
    GlPainter& operator=(const GlPainter&) = delete;
    ~GlPainter();

    const std::string& problem() const { return problem_; }

    /// Paints into a rectangle of the target, of the picture's size, with its lower left corner at (left, bottom).
    void paint(const Picture& picture, int left, int bottom);

  private:
    struct Vertex {
        Vec2<float> position;
        Vec2<float> local; ///< line: pixels along and across, from the middle; image: texture coordinates, 0 to 1
        Vec2<float> shape; ///< line: {half length, half width}, pixels; {-1, 0}: flat; {-2, 0}: image
        std::uint32_t color;
    };
    struct Program {
        std::uint32_t name = 0;
        int size = -1; ///< location of the uniform for the picture's size
    };
    struct Batch {
        std::uint32_t texture = 0, first = 0, count = 0;
        std::array<int, 4> pane{}; ///< left, top, width, height in pixels; width 0: the whole picture
    };
    struct Texture {
        std::uint32_t name = 0;
        int width = 0, height = 0;
        std::uint64_t used = 0;        ///< number of the last frame that used the texture
        std::weak_ptr<const Image> of; ///< source; empty for a text
        std::string text;
    };

    Program linked(const char* defined);
    void gather(const Picture& picture);
    void add_line(Vec2<float> a, Vec2<float> b, float width, std::uint32_t color);
    void add_stroke(std::span<const Vec2<float>> outline, bool closed, float width, std::uint32_t color);
    void add_polygon(std::span<const Vec2<float>> outline, std::uint32_t color);
    void add_image(const Picture& picture, const Picture::Item& item);
    void add_text(const Picture& picture, const Picture::Item& item);
    void begin_pane(std::span<const Vec2<float>> corners, const Color& paper);
    void use(std::uint32_t texture);
    std::uint32_t put(const Vertex& vertex);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    const Texture& texture_of(const std::shared_ptr<const Image>& image);
    const Texture& texture_of(const std::string& key, const Picture& picture, const Picture::Item& item);
    Texture& fresh_texture(int width, int height, const void* pixels, bool fine);
    void forget_unused();

    std::string problem_;
    Program shapes_, images_;
    std::uint32_t array_ = 0, vertices_buffer_ = 0, indices_buffer_ = 0;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::vector<Batch> batches_;
    std::vector<Texture> textures_;
    std::vector<std::uint32_t> rest_; // scratch: remaining corners of a polygon
    std::vector<Vec2<float>> way_;    // scratch: points of a stroke
    Color paper_;                     ///< background at the current item
    std::uint64_t frame_ = 0;
};

} // namespace sinew::window
