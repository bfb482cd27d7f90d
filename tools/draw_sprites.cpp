/// draw_sprites FOLDER: draws the images of the catalogue as PNG files (scenes/sprites), at four times the displayed
/// size. Skin, denim, steel, hemp and red are colours of the light theme (sinew/picture/theme.cpp).
#include <cairo.h>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr unsigned ink = 0x4a4038, skin = 0xf2b58c, denim = 0x35507d, steel = 0x7b8794, hemp = 0xc0935a, red = 0xe4572e;

/// A drawing in nominal pixels, with the origin in the middle.
struct Sprite {
    cairo_surface_t* surface;
    cairo_t* pen;
    double width, height;
    static constexpr double fine = 4;

    Sprite(double w, double h)
        : surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, int(w * fine), int(h * fine))),
          pen(cairo_create(surface)), width(w), height(h) {
        cairo_scale(pen, fine, fine);
        cairo_translate(pen, w / 2, h / 2);
        cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
        cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
    }
    Sprite(const Sprite&) = delete;
    Sprite& operator=(const Sprite&) = delete;
    ~Sprite() {
        cairo_destroy(pen);
        cairo_surface_destroy(surface);
    }

    void color(unsigned hex, double alpha = 1) {
        cairo_set_source_rgba(pen, (hex >> 16U & 255U) / 255.0, (hex >> 8U & 255U) / 255.0, (hex & 255U) / 255.0,
                              alpha);
    }
    void fill(unsigned hex, double alpha = 1) {
        color(hex, alpha);
        cairo_fill_preserve(pen);
    }
    void line(unsigned hex, double thick, double alpha = 1) {
        color(hex, alpha);
        cairo_set_line_width(pen, thick);
        cairo_stroke(pen);
    }
    void rounded(double x, double y, double w, double h, double r) {
        cairo_new_path(pen);
        cairo_arc(pen, x + w - r, y + r, r, -turn / 4, 0);
        cairo_arc(pen, x + w - r, y + h - r, r, 0, turn / 4);
        cairo_arc(pen, x + r, y + h - r, r, turn / 4, turn / 2);
        cairo_arc(pen, x + r, y + r, r, turn / 2, -turn / 4);
        cairo_close_path(pen);
    }
    void ellipse(double x, double y, double rx, double ry) {
        cairo_new_path(pen);
        cairo_save(pen);
        cairo_translate(pen, x, y);
        cairo_scale(pen, rx, ry);
        cairo_arc(pen, 0, 0, 1, 0, turn);
        cairo_restore(pen);
    }
    void segment(double x0, double y0, double x1, double y1) {
        cairo_new_path(pen);
        cairo_move_to(pen, x0, y0);
        cairo_line_to(pen, x1, y1);
    }
    bool save(const std::string& path) const {
        const auto status = cairo_surface_write_to_png(surface, path.c_str());
        if (status != CAIRO_STATUS_SUCCESS)
            std::fprintf(stderr, "%s: %s\n", path.c_str(), cairo_status_to_string(status));
        return status == CAIRO_STATUS_SUCCESS;
    }
};

constexpr double outline = 1.4;

/// A link seen from the broad side, between two links seen from the narrow side, which neighbouring images share.
/// Distance from link to link: 26.
void link(Sprite& s) {
    constexpr double pitch = 26, wire = 5, length = 24, height = 17;
    s.rounded(-(length - wire) / 2, -(height - wire) / 2, length - wire, height - wire, (height - wire) / 2);
    s.color(ink);
    cairo_set_line_width(s.pen, wire);
    cairo_stroke_preserve(s.pen);
    s.color(steel);
    cairo_set_line_width(s.pen, wire - 2 * outline);
    cairo_stroke(s.pen);
    s.rounded(-(length - wire) / 2, -(height - wire) / 2 - 0.6, length - wire, height - wire, (height - wire) / 2);
    s.line(0xdfe5ec, 0.8, 0.8);
    for (const double side : {-1.0, 1.0}) {
        s.rounded(side * pitch / 2 - 6.5, -wire / 2, 13, wire, wire / 2);
        s.fill(0x66717d);
        s.line(ink, outline);
        s.segment(side * pitch / 2 - 4, -0.7, side * pitch / 2 + 4, -0.7);
        s.line(0xdfe5ec, 0.8, 0.7);
    }
}

void wire_ring(Sprite& s, double y, double diameter, double wire) {
    for (const auto& [hex, thick] : {std::pair(ink, wire), std::pair(steel, wire - 2 * outline)}) {
        s.ellipse(0, y, (diameter - wire) / 2, (diameter - wire) / 2);
        s.line(hex, thick);
    }
    s.ellipse(-0.3, y - 0.6, (diameter - wire) / 2, (diameter - wire) / 2);
    s.line(0xdfe5ec, 0.8, 0.8);
}

/// A loop of the Godot chain: 24 across.
void loop(Sprite& s) {
    wire_ring(s, 0, 24, 5.4);
}

/// Anchor of the Godot chain: the loop, with a bracket to the ceiling on top. The ring is in the middle.
void anchor(Sprite& s) {
    s.rounded(-5, -24, 10, 15, 2);
    s.fill(0x66717d);
    s.line(ink, outline);
    wire_ring(s, 0, 24, 5.4);
}

/// Side view of a link, from the wire of one loop to the next loop's wire.
void chain_link(Sprite& s) {
    s.rounded(-8, -3, 16, 6, 3);
    s.fill(0x9aa5b1);
    s.line(ink, outline);
    s.segment(-5, -1, 5, -1);
    s.line(0xeef2f6, 0.9, 0.9);
}

/// A full turn of a laid rope with three strands; tiles seamlessly.
void rope(Sprite& s) {
    const double w = s.width, h = s.height;
    cairo_rectangle(s.pen, -w / 2, -h / 2, w, h);
    s.fill(hemp);
    cairo_new_path(s.pen);
    for (int i = -4; i <= 4; ++i) { // each strand leans by a third of a turn
        const double x = i * w / 3;
        for (const auto& [thick, hex, alpha, shift] :
             {std::tuple{2.2, 0x7a5a30U, 0.75, 0.0}, std::tuple{1.6, 0xe8c48fU, 0.8, 2.6}}) {
            cairo_new_path(s.pen);
            cairo_move_to(s.pen, x + shift - w / 5, h / 2);
            cairo_curve_to(s.pen, x + shift - w / 14, h / 3, x + shift + w / 14, -h / 3, x + shift + w / 5, -h / 2);
            s.line(hex, thick, alpha);
        }
    }
    for (const double side : {-1.0, 1.0}) {
        s.segment(-w, side * (h / 2 - 0.4), w, side * (h / 2 - 0.4));
        s.line(ink, 0.9);
    }
}

/// A limb from shoulder to wrist, or from hip to ankle: cloth, a cuff, bare skin.
void limb(Sprite& s, unsigned cloth, unsigned bare, double cloth_share) {
    const double w = s.width - outline, h = s.height - outline, cuff = -w / 2 + w * cloth_share;
    s.rounded(-w / 2, -h / 2, w, h, h / 2);
    cairo_clip_preserve(s.pen);
    s.fill(bare);
    cairo_new_path(s.pen);
    cairo_rectangle(s.pen, -w, -h, w + cuff, 2 * h);
    s.fill(cloth);
    cairo_new_path(s.pen);
    cairo_rectangle(s.pen, -w, h * 0.16, 2 * w, h); // the side away from the light
    s.fill(ink, 0.16);
    s.segment(cuff, -h, cuff, h);
    s.line(ink, outline * 1.6);
    for (const double fold : {0.3, 0.62}) {
        cairo_new_path(s.pen);
        cairo_move_to(s.pen, -w / 2 + w * cloth_share * fold, -h / 2);
        cairo_curve_to(s.pen, -w / 2 + w * cloth_share * fold + 3, -h / 4, -w / 2 + w * cloth_share * fold + 3, 0,
                       -w / 2 + w * cloth_share * fold + 1, h / 8);
        s.line(ink, 1, 0.35);
    }
    cairo_reset_clip(s.pen);
    s.rounded(-w / 2, -h / 2, w, h, h / 2);
    s.line(ink, outline);
}

/// A hand with the fingers to the right, along the arm.
void hand(Sprite& s) {
    s.rounded(-8.5, -6, 16.5, 12, 5.5);
    s.fill(skin);
    s.line(ink, outline);
    for (const double y : {-2.0, 2.0}) {
        s.segment(3, y, 7, y);
        s.line(ink, 0.9, 0.6);
    }
    s.rounded(-4, -8.8, 9, 5, 2.4); // thumb
    s.fill(skin);
    s.line(ink, outline);
}

/// A shoe with the toe to the left for a leg from above: across the limb.
void shoe(Sprite& s) {
    s.rounded(-7.5, -14, 14, 23, 6);
    s.fill(0x3a3636);
    s.line(ink, outline);
    s.rounded(4, -14, 3.4, 23, 1.6); // sole
    s.fill(0xe9dcc4);
    s.line(ink, outline);
    s.segment(-3, -4, -3, 1);
    s.line(0xe9dcc4, 1.4);
    s.segment(0, -6, 0, -1);
    s.line(0xe9dcc4, 1.4);
}

/// A pullover with a belt below.
void body(Sprite& s) {
    s.rounded(-23, -23, 46, 46, 13);
    cairo_clip_preserve(s.pen);
    s.fill(red);
    cairo_new_path(s.pen);
    cairo_rectangle(s.pen, -24, 12, 48, 12);
    s.fill(denim);
    cairo_new_path(s.pen);
    cairo_rectangle(s.pen, 9, -24, 16, 48);
    s.fill(ink, 0.14);
    for (const double y : {-9.0, -2.0}) {
        s.segment(-24, y, 24, y);
        s.line(0xfbe3c0, 3.2);
    }
    s.segment(-24, 12, 24, 12);
    s.line(ink, 4);
    s.rounded(-4, 9.4, 8, 5.2, 1);
    s.fill(0xe9a820);
    s.line(ink, 1);
    cairo_reset_clip(s.pen);
    s.rounded(-23, -23, 46, 46, 13);
    s.line(ink, outline);
}

void head(Sprite& s) {
    s.ellipse(0, 0, 18, 20);
    s.fill(skin);
    s.line(ink, outline);
    cairo_new_path(s.pen); // hair
    cairo_arc(s.pen, 0, -1, 18.4, turn / 2 - 0.1, turn + 0.1);
    cairo_curve_to(s.pen, 10, -11, 4, -6, -4, -9);
    cairo_curve_to(s.pen, -9, -11, -14, -6, -18.3, 0);
    cairo_close_path(s.pen);
    s.fill(0x6b4a32);
    s.line(ink, outline);
    for (const double x : {-6.5, 6.5}) {
        s.ellipse(x, 2, 1.7, 2.3);
        s.fill(0x2b2d42);
        s.ellipse(x + 0.6, 1.2, 0.6, 0.7);
        s.fill(0xffffff);
    }
    cairo_new_path(s.pen);
    cairo_arc(s.pen, 0, 7, 6, 0.5, turn / 2 - 0.5);
    s.line(ink, outline);
    cairo_new_path(s.pen);
}

/// A framed landscape, mapped onto four points.
void painting(Sprite& s) {
    const double w = s.width, h = s.height;
    cairo_rectangle(s.pen, -w / 2, -h / 2, w, h);
    s.fill(0x8a5a2b);
    s.line(ink, 2 * outline);
    cairo_rectangle(s.pen, -w / 2 + 8, -h / 2 + 8, w - 16, h - 16);
    cairo_clip_preserve(s.pen);
    s.fill(0xbfe0ea);
    s.ellipse(w * 0.2, -h * 0.17, 13, 13);
    s.fill(0xffcb52);
    const auto hill = [&](double x, double y, double r, unsigned hex) {
        s.ellipse(x, y + r, r * 1.5, r);
        s.fill(hex);
    };
    hill(-w * 0.28, -h * 0.08, 60, 0x93b7a0);
    hill(w * 0.3, h * 0.02, 60, 0x74a37f);
    hill(-w * 0.05, h * 0.16, 70, 0x5c8d4e);
    for (const double x : {-0.3, -0.2, 0.12}) {
        s.rounded(w * x - 1.5, h * 0.12, 3, 16, 1);
        s.fill(0x6b4a32);
        s.ellipse(w * x, h * 0.08, 8, 11);
        s.fill(0x3f6b3a);
    }
    cairo_new_path(s.pen);
    cairo_reset_clip(s.pen);
    cairo_rectangle(s.pen, -w / 2 + 8, -h / 2 + 8, w - 16, h - 16);
    s.line(ink, outline);
}

/// A board with grain and a nail at either end.
void plank(Sprite& s) {
    const double w = s.width - outline, h = s.height - outline;
    s.rounded(-w / 2, -h / 2, w, h, 2);
    s.fill(0xb5793c);
    s.line(ink, outline);
    for (const double y : {-0.22, 0.05, 0.27}) {
        cairo_new_path(s.pen);
        cairo_move_to(s.pen, -w * 0.42, h * y);
        cairo_curve_to(s.pen, -w * 0.15, h * (y + 0.12), w * 0.15, h * (y - 0.12), w * 0.42, h * y);
        s.line(0x7d5226, 0.8, 0.8);
    }
    for (const double x : {-0.44, 0.44}) {
        s.ellipse(w * x, 0, 1.4, 1.4);
        s.fill(0x4a4038);
    }
    cairo_new_path(s.pen);
}

/// A wooden crate: boards in a frame with a brace across, nailed at the corners.
void crate(Sprite& s) {
    constexpr unsigned pale = 0xe0b077, wood = 0xc98d4f, dark = 0x8c5526;
    const double w = s.width - outline, rail = w * 0.15, inner = w / 2 - rail;
    s.rounded(-w / 2, -w / 2, w, w, 3);
    s.fill(pale);
    for (const double y : {-0.2, 0.0, 0.2}) {
        s.segment(-inner, y * w, inner, y * w);
        s.line(dark, 1.2, 0.7);
    }
    for (const double y : {-0.29, -0.12, 0.08, 0.27}) {
        cairo_new_path(s.pen);
        cairo_move_to(s.pen, -inner * 0.8, y * w);
        cairo_curve_to(s.pen, -inner * 0.3, (y + 0.05) * w, inner * 0.2, (y - 0.05) * w, inner * 0.7, y * w);
        s.line(dark, 0.8, 0.4);
    }
    const auto board = [&](double x, double y, double length, double thick) {
        s.rounded(x, y, length, thick, 2);
        s.fill(wood);
        s.line(ink, outline);
    };
    cairo_save(s.pen);
    cairo_rectangle(s.pen, -inner, -inner, 2 * inner, 2 * inner);
    cairo_clip(s.pen);
    cairo_rotate(s.pen, turn / 8);
    board(-w, -rail / 2, 2 * w, rail);
    cairo_restore(s.pen);
    board(-w / 2, -w / 2, rail, w);
    board(w / 2 - rail, -w / 2, rail, w);
    board(-w / 2, -w / 2, w, rail);
    board(-w / 2, w / 2 - rail, w, rail);
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            s.ellipse(x * (w - rail) / 2, y * (w - rail) / 2, 2, 2);
            s.fill(ink);
        }
    cairo_new_path(s.pen);
}

/// The five of a die.
void die(Sprite& s) {
    const double w = s.width - outline, pip = w * 0.25;
    s.rounded(-w / 2, -w / 2, w, w, w * 0.12);
    s.fill(0xfbf7ee);
    s.line(ink, outline);
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {0, 0}, {-1, 1}, {1, 1}}) {
        s.ellipse(x * pip, y * pip, w * 0.085, w * 0.085);
        s.fill(0xc0392b);
        s.line(ink, outline);
    }
    cairo_new_path(s.pen);
}

/// A space creature, pixel by pixel: the left half is given, the right half mirrored.
void invader(Sprite& s, unsigned outline, unsigned body) {
    constexpr const char* rows[] = {"...#..", "#...##", "#.####", "##.##.", "######", ".#####", "..#.#.", ".#.#.."};
    constexpr int wide = 6, high = 8;
    const double pixel = s.height / high;
    for (const double grown : {0.9, 0.0}) { // the outline below, then the creature
        for (int y = 0; y < high; ++y)
            for (int x = 0; x < wide; ++x) {
                if (rows[y][x] != '#') continue;
                for (const int column : {x, 2 * wide - 2 - x})
                    cairo_rectangle(s.pen, (column - wide + 0.5) * pixel - grown, (y - high / 2) * pixel - grown,
                                    pixel + 2 * grown, pixel + 2 * grown);
            }
        s.color(grown > 0 ? outline : body);
        cairo_fill(s.pen);
    }
}

/// A spider from above, the head up: eight legs, two body parts, a cross on the back.
void spider(Sprite& s) {
    for (const double side : {-1.0, 1.0})
        for (int leg = 0; leg < 4; ++leg) {
            const double lean = -1.15 + 0.75 * leg; // from forwards to backwards
            const double knee_x = side * 11 * std::cos(lean * 0.8), knee_y = -3 + 9 * std::sin(lean * 0.8) - 3;
            const double foot_x = side * (17 - 3 * std::abs(lean)), foot_y = -1 + 17 * std::sin(lean);
            cairo_new_path(s.pen);
            cairo_move_to(s.pen, side * 2, -3);
            cairo_line_to(s.pen, knee_x, knee_y);
            cairo_line_to(s.pen, foot_x, foot_y);
            cairo_set_line_width(s.pen, 3);
            s.color(0x3a2a24);
            cairo_stroke_preserve(s.pen);
            s.line(0xb5733a, 1.6);
        }
    s.ellipse(0, 5, 6.5, 8.5);
    s.fill(0xa8642f);
    s.line(0x3a2a24, outline);
    s.segment(0, -0.5, 0, 9);
    s.line(0xf6e3c0, 1.6);
    s.segment(-3, 2.5, 3, 2.5);
    s.line(0xf6e3c0, 1.6);
    s.ellipse(0, -5, 4.4, 4.6);
    s.fill(0x7a4522);
    s.line(0x3a2a24, outline);
    for (const double x : {-1.6, 1.6}) {
        s.ellipse(x, -7.4, 0.9, 0.9);
        s.fill(0xf6e3c0);
    }
    cairo_new_path(s.pen);
}

} // namespace

int main(int count, char** words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: draw_sprites FOLDER\n");
        return 2;
    }
    const std::string folder = std::string(words[1]) + "/";
    bool good = true;
    const auto drawn = [&](const char* name, double width, double height, auto&& draw) {
        Sprite sprite(width, height);
        draw(sprite);
        good = sprite.save(folder + name) && good;
    };
    drawn("link.png", 42, 18, link);
    drawn("loop.png", 24, 24, loop);
    drawn("anchor.png", 24, 50, anchor);
    drawn("chain_link.png", 18, 8, chain_link);
    drawn("rope.png", 18, 10, rope);
    drawn("sleeve.png", 84, 18, [](Sprite& s) { limb(s, red, skin, 0.62); });
    drawn("trouser.png", 96, 20, [](Sprite& s) { limb(s, denim, 0xf4efe4, 0.86); });
    drawn("hand.png", 20, 20, hand);
    drawn("shoe.png", 18, 32, shoe);
    drawn("body.png", 48, 48, body);
    drawn("head.png", 40, 44, head);
    drawn("painting.png", 160, 120, painting);
    drawn("plank.png", 60, 12, plank);
    drawn("crate.png", 100, 100, crate);
    drawn("die.png", 100, 100, die);
    constexpr std::tuple<const char*, unsigned, unsigned> invaders[] = {{"invader.png", 0x1d3b2a, 0x7ddc84},
                                                                        {"invader_red.png", 0x3f1a16, 0xe8705a},
                                                                        {"invader_yellow.png", 0x3d3212, 0xe9c04a},
                                                                        {"invader_blue.png", 0x14303d, 0x5fb8e0},
                                                                        {"invader_violet.png", 0x321a3d, 0xc07ddc}};
    for (const auto& [name, outline, body] : invaders)
        drawn(name, 46, 32, [outline = outline, body = body](Sprite& s) { invader(s, outline, body); });
    drawn("spider.png", 40, 44, spider);
    return good ? 0 : 1;
}
