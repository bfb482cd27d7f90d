#pragma once

#include "sinew/session/picture.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sinew::window {

/// Paints pictures with OpenGL 3.3. Lines and discs are quads whose fragments know how far they are from the line
/// (signed distance), which smooths edges without multisampling. Everything of a picture is one buffer, drawn in as few
/// calls as its textures allow.
class GlPainter {
  public:
    /// Needs a current context, and so do all calls. What cannot be compiled is the problem.
    GlPainter();
    GlPainter(const GlPainter&) = delete;
    GlPainter& operator=(const GlPainter&) = delete;
    ~GlPainter();

    const std::string& problem() const { return problem_; }

    /// Into the rectangle at the left and the bottom of the target, as large as the picture.
    void paint(const Picture& picture, int left, int bottom);

  private:
    struct Vertex {
        Vec2<float> place;
        Vec2<float> local; ///< of a line: along it from its middle, and across. Of an image: where in it, 0 to 1
        Vec2<float> shape; ///< of a line: half its length, half its width. Else {-1, 0}: flat; {-2, 0}: an image
        std::uint32_t color;
    };
    struct Program {
        std::uint32_t name = 0;
        int size = -1; ///< where it takes the picture's
    };
    struct Batch {
        std::uint32_t texture = 0, first = 0, count = 0;
        std::array<int, 4> pane{}; ///< left, top, width, height in pixels; no width: all of the picture
    };
    struct Texture {
        std::uint32_t name = 0;
        int width = 0, height = 0;
        std::uint64_t used = 0;        ///< the frame it was last seen in
        std::weak_ptr<const Image> of; ///< of a text: none
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
    std::vector<std::uint32_t> rest_; // scratch of a polygon's corners
    std::vector<Vec2<float>> way_;    // scratch of a stroke
    Color paper_;                     ///< behind what is painted now
    std::uint64_t frame_ = 0;
};

} // namespace sinew::window
