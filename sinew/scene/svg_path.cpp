#include "sinew/scene/svg_path.h"

#include "sinew/math/bezier.h"
#include "sinew/math/decimal.h"
#include "sinew/math/trig.h"
#include "sinew/scene/text.h"
#include "sinew/scene/utf8.h"

#include <array>
#include <utility>
#include <variant>

namespace sinew {
namespace svg {
namespace {

using Vector = Vec2<double>;
using Cubic = CubicBezier<2, double>;

/// Arc of an ellipse: center + x cos(t) + y sin(t), from an angle on by a turn, radians.
struct Arc {
    Vector center{}, x{}, y{};
    double from = 0, turn = 0;

    Vector at(double share) const {
        const double angle = from + turn * share;
        return center + x * cosine(angle) + y * sine(angle);
    }
};

struct Line {
    Vector a, b;
    Vector at(double share) const { return a + (b - a) * share; }
};

using Curve = std::variant<Line, Cubic, Arc>;

/// A curve and its exact end.
struct Piece {
    Curve curve;
    Vector end{};
};

struct Subpath {
    Vector start{};
    std::vector<Piece> pieces;
    bool closed = false;
};

/// From two ends to centre and angles, by the implementation notes of SVG, B.2.4; m, c and the two directions are in
/// the frame in which the ellipse is the unit circle. Radii too small for the ends are made large enough.
///
///     m = (a - b) / 2        c = -+ sqrt(1 / |m|^2 - 1) (m_y, -m_x)        directions m - c, -m - c
Arc arc_between(const Vector& a, const Vector& b, Vector radii, double rotation, bool is_large, bool is_positive) {
    const Vector axis{{cosine(rotation), sine(rotation)}};
    const auto half = (a - b) * 0.5;
    const auto unit = [&] { return Vector{{dot(axis, half) / radii[0], dot(perpendicular(axis), half) / radii[1]}}; };
    radii = radii * max(1.0, norm(unit()));
    const auto m = unit();
    const double away = square_root(max(0.0, 1 / dot(m, m) - 1)) * (is_large == is_positive ? -1 : 1);
    const auto c = Vector{{m[1], -m[0]}} * away, first = m - c, last = -m - c;
    double turn = arctangent(cross(first, last), dot(first, last));
    if (is_positive && turn < 0) turn += 2 * pi<double>;
    if (!is_positive && turn > 0) turn -= 2 * pi<double>;
    const auto x = axis * radii[0], y = perpendicular(axis) * radii[1];
    return {(a + b) * 0.5 + x * c[0] + y * c[1], x, y, arctangent(first[1], first[0]), turn};
}

int chords_of(double least) {
    return 1 + int(clamp(least, 0.0, 1000.0));
}
/// Chords of a curve that stay within a distance of it.
int chords_of(const Line&, double) {
    return 1;
}
/// 6 `bent` bounds the second derivative: n chords have an error of at most 0.75 bent / n^2.
int chords_of(const Cubic& curve, double off) {
    const double bent = max(norm(curve.a - curve.b * 2 + curve.c), norm(curve.b - curve.c * 2 + curve.d));
    return chords_of(square_root(0.75 * bent / off));
}
/// A chord over an angle u of a circle of radius r is off by r (1 - cos(u / 2)) <= r u^2 / 8.
int chords_of(const Arc& arc, double off) {
    return chords_of(absolute(arc.turn) * square_root(max(norm(arc.x), norm(arc.y)) / (8 * off)));
}

/// Diagonal of the box around a path, by a few points of each curve.
double size_of(const std::vector<Subpath>& subpaths) {
    Vector low = subpaths.front().start, high = low;
    const auto include = [&](const Vector& point) {
        for (int i = 0; i < 2; ++i) low[i] = min(low[i], point[i]), high[i] = max(high[i], point[i]);
    };
    for (const auto& [start, pieces, closed] : subpaths) {
        include(start);
        for (const auto& piece : pieces)
            for (const double share : {0.25, 0.5, 0.75, 1.0})
                include(std::visit([&](const auto& curve) { return curve.at(share); }, piece.curve));
    }
    return norm(high - low);
}

/// Points closer than a millionth of the tolerance are one.
SvgOutline flattened(const Subpath& subpath, double off) {
    SvgOutline outline{{subpath.start}, subpath.closed};
    const double near = 1e-6 * off;
    const auto add = [&](const Vector& point) {
        if (distance(point, outline.points.back()) > near) outline.points.push_back(point);
    };
    for (const auto& [held, end] : subpath.pieces) {
        std::visit(
            [&](const auto& curve) {
                const int chords = chords_of(curve, off);
                for (int i = 1; i < chords; ++i) add(curve.at(double(i) / chords));
            },
            held);
        add(end);
    }
    if (outline.points.size() > 1 && distance(outline.points.front(), outline.points.back()) <= near) {
        outline.points.pop_back();
        outline.closed = true;
    }
    return outline;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_lower(char c) {
    return c >= 'a' && c <= 'z';
}
char upper(char c) {
    return is_lower(c) ? char(c - 'a' + 'A') : c;
}

/// Numbers, flags and commands of a path. Reading stops at the first mistake.
class PathText {
  public:
    explicit PathText(std::string_view text) : text_(text) { skip_space(); }

    const std::string& error() const { return error_; }
    bool is_good() const { return error_.empty(); }
    bool at_end() const { return at_ >= text_.size(); }
    bool at_number() const { return is_digit(here()) || here() == '-' || here() == '+' || here() == '.'; }

    void fail(std::string_view expected) {
        if (!is_good()) return;
        const auto found =
            at_end() ? std::string("the end") : in_quotes(text_.substr(at_, utf8::decode(text_, at_).bytes));
        error_ = concat("character ", at_ + 1, " of the path: expected ", expected, ", found ", found);
    }

    char next() const { return here(); }
    char take_command() {
        const char command = here();
        ++at_;
        skip_space();
        return command;
    }

    double number() {
        const auto begin = at_;
        if (here() == '-' || here() == '+') ++at_;
        auto digits = skip_digits();
        if (here() == '.') ++at_, digits += skip_digits();
        if (digits == 0) return refuse(begin, "a number");
        skip_exponent();
        const double value = decimal::parse(text_.substr(begin, at_ - begin));
        return absolute(value) <= largest ? value : refuse(begin, "a number between -1e9 and 1e9");
    }

    /// A flag needs no space after it.
    double flag() {
        if (here() != '0' && here() != '1') return refuse(at_, "a flag, 0 or 1");
        return text_[at_++] - '0';
    }

    /// True if another number has to follow: after a comma.
    bool skip_separator() {
        skip_space();
        if (here() != ',') return false;
        ++at_;
        skip_space();
        return true;
    }

  private:
    static constexpr double largest = 1e9;
    std::string_view text_;
    std::size_t at_ = 0;
    std::string error_;

    char here(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    double refuse(std::size_t place, std::string_view expected) {
        at_ = place;
        fail(expected);
        return 0;
    }
    void skip_space() {
        while (here() == ' ' || here() == '\t' || here() == '\n' || here() == '\r' || here() == '\f') ++at_;
    }
    std::size_t skip_digits() {
        const auto begin = at_;
        while (is_digit(here())) ++at_;
        return at_ - begin;
    }
    void skip_exponent() {
        const std::size_t sign = here(1) == '-' || here(1) == '+' ? 1 : 0;
        if (upper(here()) != 'E' || !is_digit(here(1 + sign))) return;
        at_ += 1 + sign;
        skip_digits();
    }
};

/// Follows the commands of a path with a pen.
class PathPen {
  public:
    void draw(char command, const std::array<double, 7>& numbers) {
        const char kind = upper(command);
        base_ = is_lower(command) ? pen_ : Vector{};
        numbers_ = numbers;
        follow(kind, pulls_on(kind) ? pen_ * 2 - control_ : pen_);
        before_ = kind;
    }

    const std::vector<Subpath>& subpaths() const { return subpaths_; }

  private:
    std::vector<Subpath> subpaths_;
    Vector pen_{}, base_{}, control_{};
    std::array<double, 7> numbers_{};
    char before_ = 'M'; ///< kind of the last command

    Vector point(std::size_t first) const { return base_ + Vector{{numbers_[first], numbers_[first + 1]}}; }

    void follow(char kind, const Vector& mirrored) {
        if (kind == 'M') return move(point(0));
        if (kind == 'L') return line(point(0));
        if (kind == 'H') return line({{base_[0] + numbers_[0], pen_[1]}});
        if (kind == 'V') return line({{pen_[0], base_[1] + numbers_[0]}});
        if (kind == 'C') return cubic(point(0), point(2), point(4));
        if (kind == 'S') return cubic(mirrored, point(0), point(2));
        if (kind == 'Q') return quadratic(point(0), point(2));
        if (kind == 'T') return quadratic(mirrored, point(0));
        if (kind == 'A') return arc(point(5));
        close();
    }

    /// True if a smooth command goes on from a curve of its own kind.
    bool pulls_on(char kind) const {
        if (kind == 'S') return before_ == 'C' || before_ == 'S';
        return kind == 'T' && (before_ == 'Q' || before_ == 'T');
    }

    void move(const Vector& to) {
        subpaths_.push_back({to, {}, false});
        pen_ = to;
    }
    void add(const Curve& curve, const Vector& end) {
        if (before_ == 'Z') move(pen_); // the next subpath begins where the last one did
        subpaths_.back().pieces.push_back({curve, end});
        pen_ = end;
    }
    void line(const Vector& to) { add(Line{pen_, to}, to); }
    void cubic(const Vector& leaving, const Vector& arriving, const Vector& to) {
        add(Cubic{pen_, leaving, arriving, to}, to);
        control_ = arriving;
    }
    void quadratic(const Vector& control, const Vector& to) {
        add(elevated(QuadraticBezier<2, double>{pen_, control, to}), to);
        control_ = control;
    }
    void arc(const Vector& to) {
        constexpr double none = 1e-100, little = 1e-12; // squares and quotients of all others are finite
        const Vector radii{{absolute(numbers_[0]), absolute(numbers_[1])}};
        if (min(radii[0], radii[1]) < none || distance(pen_, to) <= little * max(radii[0], radii[1])) return line(to);
        const double rotation = numbers_[2] * (pi<double> / 180);
        add(arc_between(pen_, to, radii, rotation, numbers_[3] != 0, numbers_[4] != 0), to);
    }
    void close() {
        subpaths_.back().closed = true;
        pen_ = subpaths_.back().start;
    }
};

/// Numbers that a command takes; negative for what is none.
int numbers_of(char command) {
    constexpr std::string_view kinds = "MLHVCSQTAZ";
    constexpr std::array<int, kinds.size()> numbers = {2, 2, 1, 1, 6, 4, 4, 2, 7, 0};
    const auto kind = kinds.find(upper(command));
    return kind == kinds.npos ? -1 : numbers[kind];
}

/// Reads a command with all its repeats. After a comma another number follows.
void read_command(PathText& text, PathPen& pen) {
    char command = text.take_command();
    const int count = numbers_of(command);
    bool goes_on = false;
    do {
        std::array<double, 7> numbers{};
        for (int i = 0; i < count && text.is_good(); ++i) {
            const bool is_flag = upper(command) == 'A' && (i == 3 || i == 4);
            numbers[std::size_t(i)] = is_flag ? text.flag() : text.number();
            goes_on = text.skip_separator();
        }
        if (!text.is_good()) return;
        pen.draw(command, numbers);
        if (upper(command) == 'M') command = command == 'm' ? 'l' : 'L';
    } while (count > 0 && (goes_on || text.at_number()));
}

} // namespace
} // namespace svg

SvgPath read_svg_path(std::string_view data) {
    svg::PathText text(data);
    svg::PathPen pen;
    for (bool is_first = true; !text.at_end() && text.is_good(); is_first = false) {
        const char next = text.next();
        if (is_first && svg::upper(next) != 'M')
            text.fail("M, which begins a path");
        else if (svg::numbers_of(next) < 0)
            text.fail("a command (one of MLHVCSQTAZ, or small)");
        else
            svg::read_command(text, pen);
    }
    if (!text.is_good()) return {{}, text.error()};
    SvgPath path;
    if (pen.subpaths().empty()) return path;
    const double off = svg_tolerance * svg::size_of(pen.subpaths());
    if (!(off > 0)) return path;
    for (const auto& subpath : pen.subpaths())
        if (auto outline = svg::flattened(subpath, off); outline.points.size() > 1)
            path.outlines.push_back(std::move(outline));
    return path;
}

} // namespace sinew
