#include "apps/window/gl_painter.h"

#include "apps/window/triangles.h"
#include "canvas/cairo_handle.h"
#include "canvas/cairo_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <epoxy/gl.h>
#include <initializer_list>

namespace sinew::window {
namespace {

constexpr const char* vertex_text = R"(#version 330 core
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 local;
layout(location = 2) in vec2 shape;
layout(location = 3) in vec4 color;
uniform vec2 size;
out vec2 at;
flat out vec2 form;
out vec4 paint;
void main() {
    at = local;
    form = shape;
    paint = color;
    gl_Position = vec4(position.x / size.x * 2.0 - 1.0, 1.0 - position.y / size.y * 2.0, 0.0, 1.0);
}
)";

// Compiled with and without IMAGES, because a software renderer evaluates both sides of every branch, and texture reads
// cost the most. Vertex colours have straight alpha; images and the output are premultiplied.
constexpr const char* fragment_text = R"(
in vec2 at;
flat in vec2 form;
in vec4 paint;
uniform sampler2D image;
out vec4 result;
void main() {
    if (form.x >= 0.0) {
        float away = length(vec2(max(abs(at.x) - form.x, 0.0), at.y)) - form.y;
        float cover = clamp(0.5 - away, 0.0, 1.0) * paint.a;
        result = vec4(paint.rgb * cover, cover);
#ifdef IMAGES
    } else if (form.x < -1.5) {
        vec4 texel = texture(image, at);
        vec2 inside = min(at, 1.0 - at) / max(fwidth(at), vec2(1e-6)) + 0.5;
        float cover = clamp(min(inside.x, inside.y), 0.0, 1.0);
        result = mix(texel, vec4(paint.rgb * texel.a, texel.a), paint.a) * cover;
#endif
    } else {
        result = vec4(paint.rgb * paint.a, paint.a);
    }
}
)";

constexpr Vec2<float> flat{{-1, 0}}, textured{{-2, 0}};

std::uint32_t rgba_of(const Color& color) {
    const auto byte = [](float channel) { return std::uint32_t(std::clamp(channel, 0.0F, 1.0F) * 255 + 0.5F); };
    return byte(color.red) | byte(color.green) << 8U | byte(color.blue) << 16U | byte(color.alpha) << 24U;
}

std::uint32_t without_alpha(std::uint32_t color) {
    return color & 0xffffffU;
}

GLuint compiled(GLenum stage, std::initializer_list<const char*> parts, std::string& problem) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, GLsizei(parts.size()), parts.begin(), nullptr);
    glCompileShader(shader);
    GLint good = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char log[1024] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        problem = std::string("the graphics driver refuses a shader: ") + log;
    }
    return shader;
}

bool is_paintable(std::span<const Vec2<float>> outline) {
    return !outline.empty() && std::ranges::all_of(outline, [](const auto& p) { return is_finite(p); });
}

/// Offset of the shared corner of two strips of half width `wide` at the turn a-b-c, from b to the left. Empty if the
/// turn is so sharp that the corner would reach beyond the middle of a side.
std::optional<Vec2<float>> mitre(Vec2<float> a, Vec2<float> b, Vec2<float> c, float wide) {
    const auto along = direction(b - a), next = direction(c - b);
    const float straight = 1 + dot(along, next);
    const auto out = (perpendicular(along) + perpendicular(next)) * (wide / max(straight, 1e-3F));
    const float inwards = absolute(dot(out, along)); // length of the corner along its sides
    if (straight < 1.5F || inwards > distance(a, b) / 2 || inwards > distance(b, c) / 2) return std::nullopt;
    return out;
}

} // namespace

GlPainter::Program GlPainter::linked(const char* defined) {
    Program program{.name = glCreateProgram()};
    for (const GLuint shader :
         {compiled(GL_VERTEX_SHADER, {vertex_text}, problem_),
          compiled(GL_FRAGMENT_SHADER, {"#version 330 core\n", defined, fragment_text}, problem_)}) {
        glAttachShader(program.name, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program.name);
    program.size = glGetUniformLocation(program.name, "size");
    return program;
}

GlPainter::GlPainter() {
    shapes_ = linked("");
    images_ = linked("#define IMAGES\n");
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &vertices_buffer_);
    glGenBuffers(1, &indices_buffer_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_buffer_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_buffer_);
    const auto column = [](GLuint number, GLint parts, GLenum type, GLboolean scaled, std::size_t offset) {
        glEnableVertexAttribArray(number);
        glVertexAttribPointer(number, parts, type, scaled, sizeof(Vertex), reinterpret_cast<const void*>(offset));
    };
    column(0, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    column(1, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, local));
    column(2, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, shape));
    column(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, color));
    glBindVertexArray(0);
}

GlPainter::~GlPainter() {
    for (const auto& texture : textures_) glDeleteTextures(1, &texture.name);
    glDeleteBuffers(1, &vertices_buffer_);
    glDeleteBuffers(1, &indices_buffer_);
    glDeleteVertexArrays(1, &array_);
    for (const auto& program : {shapes_, images_}) glDeleteProgram(program.name);
}

void GlPainter::paint(const Picture& picture, int left, int bottom) {
    if (picture.width < 1 || picture.height < 1) return;
    ++frame_;
    gather(picture);
    glViewport(left, bottom, picture.width, picture.height);
    glScissor(left, bottom, picture.width, picture.height);
    glEnable(GL_SCISSOR_TEST);
    glClearColor(picture.background.red, picture.background.green, picture.background.blue, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_buffer_);
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices_.size() * sizeof(Vertex)), vertices_.data(), GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices_.size() * sizeof(std::uint32_t)), indices_.data(),
                 GL_STREAM_DRAW);
    glActiveTexture(GL_TEXTURE0);
    for (const auto& batch : batches_) {
        const auto& program = batch.texture == 0 ? shapes_ : images_;
        glUseProgram(program.name);
        glUniform2f(program.size, float(picture.width), float(picture.height));
        const auto [x, y, wide, high] = batch.pane;
        if (wide > 0) glScissor(left + x, bottom + picture.height - y - high, wide, high);
        glBindTexture(GL_TEXTURE_2D, batch.texture);
        glDrawElements(GL_TRIANGLES, GLsizei(batch.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(std::size_t(batch.first) * sizeof(std::uint32_t)));
    }
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    forget_unused();
}

void GlPainter::gather(const Picture& picture) {
    vertices_.clear(), indices_.clear(), batches_.clear();
    batches_.push_back({});
    paper_ = picture.background;
    for (const auto& item : picture.items) {
        const auto outline = picture.points_of(item);
        if (!is_paintable(outline)) continue;
        if (item.shape == Shape::image) {
            add_image(picture, item);
            continue;
        }
        if (item.color.alpha <= 0) continue;
        const float width = item.width >= 1 ? item.width : 1;
        const auto color = rgba_of(item.color);
        switch (item.shape) {
        case Shape::disc:
            add_line(outline[0], outline[0], width, color);
            break;
        case Shape::polygon:
            add_polygon(outline, color);
            break;
        case Shape::text:
            add_text(picture, item);
            break;
        case Shape::pane:
            begin_pane(outline, item.color);
            break;
        default:
            add_stroke(outline, item.shape == Shape::loop, width, color);
        }
    }
}

std::uint32_t GlPainter::put(const Vertex& vertex) {
    vertices_.push_back(vertex);
    return std::uint32_t(vertices_.size() - 1);
}

void GlPainter::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices_.push_back(a), indices_.push_back(b), indices_.push_back(c);
    batches_.back().count += 3;
}

/// Selects the texture for the following triangles. Untextured triangles join any batch.
void GlPainter::use(std::uint32_t texture) {
    if (batches_.back().texture != texture)
        batches_.push_back({texture, std::uint32_t(indices_.size()), 0, batches_.back().pane});
}

void GlPainter::begin_pane(std::span<const Vec2<float>> corners, const Color& paper) {
    if (corners.size() != 2) return;
    constexpr float far = 1e6F; // pixels
    const auto low = [&](int i) { return clamp(std::floor(min(corners[0][i], corners[1][i])), -far, far); };
    const auto high = [&](int i) { return clamp(std::ceil(max(corners[0][i], corners[1][i])), -far, far); };
    const auto side = [&](int i) { return high(i) - low(i); };
    batches_.push_back({batches_.back().texture,
                        std::uint32_t(indices_.size()),
                        0,
                        {int(low(0)), int(low(1)), int(side(0)), int(side(1))}});
    const std::array<Vec2<float>, 4> rectangle = {
        {{{low(0), low(1)}}, {{high(0), low(1)}}, {{high(0), high(1)}}, {{low(0), high(1)}}}};
    add_polygon(rectangle, rgba_of(paper));
    paper_ = paper;
}

void GlPainter::add_line(Vec2<float> a, Vec2<float> b, float width, std::uint32_t color) {
    const auto way = b - a;
    const float length = norm(way), half = length / 2, radius = width / 2;
    const auto along = length > 1e-6F ? way * (1 / length) : Vec2<float>{{1, 0}};
    const auto across = perpendicular(along);
    const auto middle = (a + b) * 0.5F;
    const float far = half + radius + 1, wide = radius + 1; // with a pixel for the faded edge
    const auto corner = [&](float x, float y) {
        return put({middle + along * x + across * y, {{x, y}}, {{half, radius}}, color});
    };
    const auto first = corner(-far, -wide);
    corner(far, -wide), corner(far, wide), corner(-far, wide);
    triangle(first, first + 1, first + 2), triangle(first, first + 2, first + 3);
}

/// A strip of quads with round ends, which share their corners at gentle turns; at a sharp turn the strip ends and
/// another begins.
void GlPainter::add_stroke(std::span<const Vec2<float>> outline, bool closed, float width, std::uint32_t color) {
    way_.clear();
    for (const auto& point : outline)
        if (way_.empty() || distance(way_.back(), point) > 1e-3F) way_.push_back(point);
    if (closed && way_.size() > 2) way_.push_back(way_.front());
    if (way_.size() < 3) return add_line(way_.front(), way_.back(), width, color);
    const float radius = width / 2, wide = radius + 1; // with a pixel for the faded edge
    const auto pair = [&](Vec2<float> position, Vec2<float> across, float beyond) {
        put({position - across, {{beyond, -wide}}, {{0, radius}}, color});
        return put({position + across, {{beyond, wide}}, {{0, radius}}, color});
    };
    const auto quad_to_last = [&](std::uint32_t last) {
        triangle(last - 3, last - 1, last), triangle(last - 3, last, last - 2);
    };
    const auto begin = [&](Vec2<float> position, Vec2<float> along) {
        const auto across = perpendicular(along) * wide;
        pair(position - along * wide, across, wide);
        quad_to_last(pair(position, across, 0));
    };
    const auto end = [&](Vec2<float> position, Vec2<float> along) {
        const auto across = perpendicular(along) * wide;
        quad_to_last(pair(position, across, 0));
        quad_to_last(pair(position + along * wide, across, wide));
    };
    const auto side = [&](std::size_t i) { return direction(way_[i + 1] - way_[i]); };
    begin(way_[0], side(0));
    for (std::size_t i = 1; i + 1 < way_.size(); ++i)
        if (const auto out = mitre(way_[i - 1], way_[i], way_[i + 1], wide)) {
            quad_to_last(pair(way_[i], *out, 0));
        } else {
            end(way_[i], side(i - 1));
            begin(way_[i], side(i));
        }
    end(way_.back(), side(way_.size() - 2));
}

/// Triangles, and a rim around them that fades to transparent.
void GlPainter::add_polygon(std::span<const Vec2<float>> outline, std::uint32_t color) {
    constexpr float fade = 0.75F; // pixels
    const auto count = std::uint32_t(outline.size());
    if (count < 3) return;
    const auto first = std::uint32_t(vertices_.size());
    for (const auto& position : outline) put({position, {}, flat, color});
    triangulate(outline, rest_,
                [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangle(first + a, first + b, first + c); });
    const float side = signed_area(outline) < 0 ? -1.0F : 1.0F;
    const auto outer = std::uint32_t(vertices_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto before = direction(outline[i] - outline[(i + count - 1) % count]);
        const auto after = direction(outline[(i + 1) % count] - outline[i]);
        const auto out = direction(perpendicular(before) + perpendicular(after)) * (-side * fade);
        put({outline[i] + out, {}, flat, without_alpha(color)});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto next = (i + 1) % count;
        triangle(first + i, first + next, outer + i);
        triangle(first + next, outer + next, outer + i);
    }
}

void GlPainter::add_image(const Picture& picture, const Picture::Item& item) {
    const auto grid = picture.points_of(item);
    if (item.number >= picture.images.size() || !picture.images[item.number] || item.across < 2) return;
    const auto across = item.across, down = item.count / across;
    if (down < 2) return;
    use(texture_of(picture.images[item.number]).name);
    const auto color = rgba_of(item.color);
    const auto first = std::uint32_t(vertices_.size());
    for (std::uint32_t row = 0; row < down; ++row)
        for (std::uint32_t column = 0; column < across; ++column)
            put({grid[row * across + column],
                 {{float(column) / float(across - 1), float(row) / float(down - 1)}},
                 textured,
                 color});
    for (std::uint32_t row = 0; row + 1 < down; ++row)
        for (std::uint32_t column = 0; column + 1 < across; ++column) {
            const auto a = first + row * across + column;
            triangle(a, a + 1, a + across), triangle(a + 1, a + across + 1, a + across);
        }
}

void GlPainter::add_text(const Picture& picture, const Picture::Item& item) {
    if (item.number >= picture.texts.size() || picture.texts[item.number].empty()) return;
    const auto color = rgba_of(item.color);
    const auto key = picture.texts[item.number] + '\n' + std::to_string(color) + '\n' + std::to_string(item.width) +
                     '\n' + std::to_string(rgba_of(paper_));
    const auto& texture = texture_of(key, picture, item);
    use(texture.name);
    const auto middle = picture.points_of(item)[0];
    // Whole pixels keep letters sharp.
    const Vec2<float> corner{
        {std::round(middle[0] - float(texture.width) / 2), std::round(middle[1] - float(texture.height) / 2)}};
    const auto first = std::uint32_t(vertices_.size());
    for (const Vec2<float> uv : {Vec2<float>{{0, 0}}, Vec2<float>{{1, 0}}, Vec2<float>{{1, 1}}, Vec2<float>{{0, 1}}})
        put({corner + Vec2<float>{{uv[0] * float(texture.width), uv[1] * float(texture.height)}}, uv, textured, 0});
    triangle(first, first + 1, first + 2), triangle(first, first + 2, first + 3);
}

GlPainter::Texture& GlPainter::fresh_texture(int width, int height, const void* pixels, bool fine) {
    Texture texture{.width = width, .height = height, .used = frame_, .of = {}, .text = {}};
    glGenTextures(1, &texture.name);
    glBindTexture(GL_TEXTURE_2D, texture.name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, fine ? GL_LINEAR : GL_LINEAR_MIPMAP_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels);
    if (!fine) glGenerateMipmap(GL_TEXTURE_2D);
    textures_.push_back(std::move(texture));
    return textures_.back();
}

const GlPainter::Texture& GlPainter::texture_of(const std::shared_ptr<const Image>& image) {
    for (auto& texture : textures_)
        if (texture.of.lock() == image) return texture.used = frame_, texture;
    auto& texture = fresh_texture(image->width, image->height, image->pixels.data(), false);
    texture.of = image;
    return texture;
}

const GlPainter::Texture& GlPainter::texture_of(const std::string& key, const Picture& picture,
                                                const Picture::Item& item) {
    for (auto& texture : textures_)
        if (texture.text == key) return texture.used = frame_, texture;
    const auto& text = picture.texts[item.number];
    const auto size = canvas::size_of_text(text, double(item.width));
    const int width = std::clamp(int(std::ceil(size[0])), 1, 4096),
              height = std::clamp(int(std::ceil(size[1])), 1, 512);
    const canvas::CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
    const canvas::CairoContext context(cairo_create(surface.get()));
    canvas::write(context.get(), text, {{float(width) / 2, float(height) / 2}}, double(item.width), item.color, paper_);
    cairo_surface_flush(surface.get());
    auto& texture = fresh_texture(width, height, cairo_image_surface_get_data(surface.get()), true);
    texture.text = key;
    return texture;
}

void GlPainter::forget_unused() {
    constexpr std::uint64_t patience = 240; // frames
    std::erase_if(textures_, [&](const Texture& texture) {
        const bool gone = texture.used + patience < frame_;
        if (gone) glDeleteTextures(1, &texture.name);
        return gone;
    });
}

} // namespace sinew::window
