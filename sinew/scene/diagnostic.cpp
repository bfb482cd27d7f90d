#include "sinew/scene/diagnostic.h"

#include "sinew/math/sort.h"
#include "sinew/scene/foreign_words.h"
#include "sinew/scene/utf8.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace sinew {

std::uint32_t Diagnostics::add_source(std::string name, std::string text) {
    sources_.push_back({std::move(name), std::move(text)});
    return std::uint32_t(sources_.size() - 1);
}

std::string_view Diagnostics::text(Span span) const {
    return std::string_view(sources_[span.source].text).substr(span.begin, span.end - span.begin);
}

void Diagnostics::error(Span span, std::string path, std::string message, std::string help) {
    if (full()) return count_one_more();
    kept_.push_back({span, std::move(path), std::move(message), std::move(help)});
}

void Diagnostics::warn(Span span, std::string path, std::string message, std::string help) {
    if (warnings_.size() < max_kept) warnings_.push_back({span, std::move(path), std::move(message), std::move(help)});
}

namespace {

/// Sorted by position, without duplicates.
std::vector<Diagnostic> sorted(std::vector<Diagnostic> all) {
    const auto key = [](const Diagnostic& d) { return std::tie(d.span.source, d.span.begin, d.span.end, d.message); };
    sinew::stable_sort(all.begin(), all.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
    all.erase(std::unique(all.begin(), all.end(), [&](auto& a, auto& b) { return key(a) == key(b); }), all.end());
    return all;
}

} // namespace

std::vector<Diagnostic> Diagnostics::in_order() const {
    return sorted(kept_);
}

std::vector<Diagnostic> Diagnostics::warnings_in_order() const {
    return sorted(warnings_);
}

namespace {

/// Converts byte offsets to lines and columns. The walk only goes forward, so sorted errors cost one pass over a file
/// of any size.
class LineFinder {
  public:
    explicit LineFinder(const Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    Place find(Span span) {
        if (span.source != source_ || span.begin < at_) *this = LineFinder(diagnostics_, span.source);
        const std::string& text = diagnostics_.source(source_).text;
        for (; at_ < span.begin; ++at_) {
            if (text[at_] == '\n') {
                place_ = {place_.line + 1, 1};
                line_begin_ = at_ + 1;
            } else if (!utf8::continues(text[at_])) {
                ++place_.column;
            }
        }
        return place_;
    }

    /// First byte of the line of the last place found.
    std::size_t line_begin() const { return line_begin_; }

  private:
    LineFinder(const Diagnostics& diagnostics, std::uint32_t source) : diagnostics_(diagnostics), source_(source) {
        if (diagnostics.source(source).text.starts_with("\xEF\xBB\xBF")) at_ = line_begin_ = 3;
    }
    LineFinder& operator=(const LineFinder& other) {
        std::tie(source_, at_, line_begin_, place_) =
            std::tie(other.source_, other.at_, other.line_begin_, other.place_);
        return *this;
    }

    const Diagnostics& diagnostics_;
    std::uint32_t source_ = ~std::uint32_t(0);
    std::size_t at_ = 0;
    std::size_t line_begin_ = 0;
    Place place_;
};

/// Part [begin, end) of a source line to print, and whether text before or after is cut off.
struct Window {
    std::size_t begin = 0, end = 0;
    bool cut_before = false, cut_after = false;
};

std::size_t step_back(std::string_view text, std::size_t at, std::size_t stop, std::size_t characters) {
    while (at > stop && characters > 0)
        if (!utf8::continues(text[--at])) --characters;
    return at;
}

std::size_t step_forward(std::string_view text, std::size_t at, std::size_t characters) {
    while (at < text.size() && text[at] != '\n' && characters > 0) {
        at += utf8::decode(text, at).bytes;
        --characters;
    }
    return at;
}

Window window_around(std::string_view text, std::size_t line_begin, std::size_t at, std::size_t width) {
    const auto is_line_end = [&](std::size_t i) { return i >= text.size() || text[i] == '\n'; };
    Window window{.begin = line_begin, .end = step_forward(text, line_begin, width)};
    if (!is_line_end(window.end)) {
        window.begin = step_back(text, at, line_begin, width / 2);
        window.end = step_forward(text, window.begin, width);
    }
    window.cut_before = window.begin > line_begin;
    window.cut_after = !is_line_end(window.end);
    if (!window.cut_after && window.end > window.begin && text[window.end - 1] == '\r') --window.end;
    return window;
}

constexpr std::string_view tab = "    ";
constexpr std::string_view cut = "...";

/// Two terminal lines: the source text and the marks below.
struct Excerpt {
    std::string source, marks;
};

/// Text a terminal prints for a character, and its width in columns.
std::pair<std::string_view, std::size_t> shown(std::string_view text, std::size_t at, utf8::Decoded character) {
    if (character.code == U'\t') return {tab, tab.size()};
    if (!character.valid || utf8::is_control(character.code)) return {"?", 1};
    return {text.substr(at, character.bytes), std::size_t(utf8::columns(character.code))};
}

Excerpt excerpt_of(std::string_view text, const Window& window, Span span) {
    Excerpt excerpt;
    if (window.cut_before) excerpt = {std::string(cut), std::string(cut.size(), ' ')};
    for (std::size_t at = window.begin; at < window.end;) {
        const auto character = utf8::decode(text, at);
        const auto [printed, columns] = shown(text, at, character);
        excerpt.source += printed;
        if (at < span.begin) excerpt.marks.append(columns, ' ');
        if (at >= span.begin && at < span.end) excerpt.marks.append(columns, '~');
        at += character.bytes;
    }
    if (window.cut_after) excerpt.source += cut;

    const auto first = excerpt.marks.find('~');
    if (first == std::string::npos)
        excerpt.marks += '^';
    else
        excerpt.marks[first] = '^';
    return excerpt;
}

struct Paint {
    bool on;
    std::string operator()(std::string_view code, std::string_view text) const {
        if (!on) return std::string(text);
        return concat("\x1b[", code, "m", text, "\x1b[0m");
    }
};

std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.insert(0, width - text.size(), ' ');
    return text;
}

constexpr std::string_view error_word = "error:", warning_word = "warning:";

void print(std::string& out, std::string_view severity, const Diagnostics& diagnostics, const Diagnostic& diagnostic,
           LineFinder& finder, const PrintStyle& style) {
    const Paint paint{style.color};
    const Source& source = diagnostics.source(diagnostic.span.source);
    const Place place = finder.find(diagnostic.span);
    const auto window = window_around(source.text, finder.line_begin(), diagnostic.span.begin, style.width);
    const auto excerpt = excerpt_of(source.text, window, diagnostic.span);

    const std::string where = concat(source.name, ":", place.line, ":", place.column, ":");
    const std::string number = padded(std::to_string(place.line), 5);
    const std::string gutter(number.size() + 1, ' ');
    const std::string path = diagnostic.path.empty() ? "/" : printable(diagnostic.path, 500);
    out += concat(paint("1", where), " ", paint(severity == error_word ? "1;31" : "1;35", severity), " ",
                  diagnostic.message, " at ", path, "\n");
    out += concat(number, " | ", excerpt.source, "\n");
    out += concat(gutter, "| ", paint("1;32", excerpt.marks), "\n");
    if (!diagnostic.help.empty()) out += concat(gutter, "= ", paint("1", "help:"), " ", diagnostic.help, "\n");
}

} // namespace

Place place_of(const Diagnostics& diagnostics, Span span) {
    return LineFinder(diagnostics).find(span);
}

std::string to_text(const Diagnostics& diagnostics, const PrintStyle& style) {
    std::string out;
    LineFinder finder(diagnostics);
    const auto all = diagnostics.in_order();
    const auto shown = std::min(all.size(), style.max);
    for (std::size_t i = 0; i < shown; ++i) print(out, error_word, diagnostics, all[i], finder, style);
    if (const auto rest = diagnostics.count() - shown; rest > 0)
        out += concat("and ", rest, rest == 1 ? " more error\n" : " more errors\n");
    return out;
}

std::string warnings_text(const Diagnostics& diagnostics, const PrintStyle& style) {
    std::string out;
    LineFinder finder(diagnostics);
    for (const auto& warning : diagnostics.warnings_in_order())
        print(out, warning_word, diagnostics, warning, finder, style);
    return out;
}

namespace {

constexpr std::size_t longest_word = 40;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

/// Edit distance (optimal string alignment) between a and b, both at most `longest_word` long.
std::size_t edits(std::string_view a, std::string_view b) {
    std::array<std::array<std::size_t, longest_word + 1>, 3> rows{};
    auto *before = &rows[0], *last = &rows[1], *row = &rows[2];
    for (std::size_t j = 0; j <= b.size(); ++j) (*row)[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::tie(before, last, row) = std::tuple(last, row, before);
        (*row)[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const auto same = [&](std::size_t p, std::size_t q) { return lower(a[p - 1]) == lower(b[q - 1]); };
            (*row)[j] = std::min({(*last)[j] + 1, (*row)[j - 1] + 1, (*last)[j - 1] + (same(i, j) ? 0 : 1)});
            if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j))
                (*row)[j] = std::min((*row)[j], (*before)[j - 2] + 1);
        }
    }
    return (*row)[b.size()];
}

} // namespace

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
    if (word.size() > longest_word) return {};
    const auto difference = [](std::size_t a, std::size_t b) { return a < b ? b - a : a - b; };
    std::size_t tries = 500; // bounds the cost for files with thousands of names and as many misspellings
    std::size_t best_edits = std::max<std::size_t>(1, word.size() / 3) + 1;
    std::string_view best;
    for (const auto candidate : candidates) {
        const bool begins = word.size() >= 3 && candidate.starts_with(word);
        if (candidate.size() > longest_word || (!begins && difference(word.size(), candidate.size()) >= best_edits))
            continue;
        if (tries-- == 0) break;
        const auto cost = begins ? std::size_t(1) : edits(word, candidate);
        if (cost < best_edits && cost < std::max(word.size(), candidate.size())) {
            best_edits = cost;
            best = candidate;
        }
    }
    return best;
}

namespace {

/// Length of the longest common substring, ignoring case.
std::size_t common_stretch(std::string_view a, std::string_view b) {
    std::size_t longest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            std::size_t n = 0;
            while (i + n < a.size() && j + n < b.size() && lower(a[i + n]) == lower(b[j + n])) ++n;
            longest = std::max(longest, n);
        }
    return longest;
}

} // namespace

std::vector<std::string_view> similar(std::string_view word, std::span<const std::string_view> candidates,
                                      std::size_t max) {
    constexpr std::size_t min_stretch = 3;
    struct Scored {
        std::size_t stretch, edits;
        std::string_view name;
    };
    std::vector<Scored> scored;
    if (word.size() > longest_word) return {};
    for (const auto candidate : candidates)
        if (candidate.size() <= longest_word)
            if (const auto stretch = common_stretch(word, candidate); stretch >= min_stretch)
                scored.push_back({stretch, edits(word, candidate), candidate});
    sinew::stable_sort(scored.begin(), scored.end(), [](const Scored& a, const Scored& b) {
        return std::tuple(b.stretch, a.edits) < std::tuple(a.stretch, b.edits);
    });
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < std::min(max, scored.size()); ++i) names.push_back(scored[i].name);
    return names;
}

namespace {

struct Renamed {
    std::string_view from, to;
};
constexpr std::array<Renamed, 9> renamed_words = {{{"angle", "turn"},
                                                   {"cuts_within", "cut_radius"},
                                                   {"lead", "damping_time"},
                                                   {"over", "duration"},
                                                   {"pulls_times", "grab_gain"},
                                                   {"pulls_within", "grab_radius"},
                                                   {"snip", "remove"},
                                                   {"toughness", "damage_limit"},
                                                   {"wheel_quickens", "wheel_time_scale"}}};

/// Words of other engines and of everyday speech; a path leads on from a word that is allowed, and a value from a key.
constexpr std::array<Renamed, 62> foreign_words = {{{"anchored", "pinned"},
                                                    {"ball", "sphere"},
                                                    {"bounce", "contact.bounce"},
                                                    {"center", "at"},
                                                    {"center", "to"},
                                                    {"circle", "sphere"},
                                                    {"circle", "ball"},
                                                    {"circle", "shape: sphere"},
                                                    {"color", "looks"},
                                                    {"colour", "color"},
                                                    {"crate", "box"},
                                                    {"density", "mass"},
                                                    {"dimensions", "dimension"},
                                                    {"disc", "ball"},
                                                    {"disk", "ball"},
                                                    {"drivers", "pins"},
                                                    {"edge", "chain"},
                                                    {"elasticity", "bounce"},
                                                    {"elasticity", "compliance"},
                                                    {"fixed", "pinned"},
                                                    {"floor", "half_space"},
                                                    {"friction", "contact.friction"},
                                                    {"ground", "half_space"},
                                                    {"heightfield", "height_field"},
                                                    {"hinge", "angle"},
                                                    {"joint", "distance"},
                                                    {"keys", "driver"},
                                                    {"max", "high"},
                                                    {"min", "low"},
                                                    {"motor", "drive"},
                                                    {"particles", "between"},
                                                    {"path", "driver"},
                                                    {"period", "rate"},
                                                    {"pin", "pinned"},
                                                    {"pins", "pinned"},
                                                    {"plane", "half_space"},
                                                    {"points", "particles"},
                                                    {"pos", "at"},
                                                    {"position", "at"},
                                                    {"prismatic", "rail"},
                                                    {"rectangle", "box"},
                                                    {"restitution", "bounce"},
                                                    {"restitution", "contact.bounce"},
                                                    {"rod", "distance"},
                                                    {"rotation", "turn"},
                                                    {"slider", "rail"},
                                                    {"softbody", "jelly"},
                                                    {"speed", "driver"},
                                                    {"speed", "drive"},
                                                    {"sphere", "shape: sphere"},
                                                    {"spring", "distance"},
                                                    {"static", "pinned"},
                                                    {"stiffness", "compliance"},
                                                    {"string", "rope"},
                                                    {"terrain", "height_field"},
                                                    {"type", "shape"},
                                                    {"type", "kind"},
                                                    {"type", "prefab"},
                                                    {"type", "driver"},
                                                    {"type", "force"},
                                                    {"wall", "half_space"},
                                                    {"wheel", "prefab: wheel"}}};

} // namespace

std::string_view new_name(std::string_view word) {
    const auto found = std::ranges::find(renamed_words, word, &Renamed::from);
    return found == renamed_words.end() ? std::string_view() : found->to;
}

std::string_view own_name(std::string_view word, std::span<const std::string_view> candidates) {
    for (const auto& [from, to] : foreign_words)
        if (from == word && std::ranges::find(candidates, to.substr(0, to.find_first_of(".:"))) != candidates.end())
            return to;
    return {};
}

std::vector<std::string_view> own_names(std::string_view word) {
    std::vector<std::string_view> names;
    for (const auto& [from, to] : foreign_words)
        if (from == word) names.push_back(to);
    return names;
}

std::string suggest(std::string_view word, std::vector<std::string_view> candidates) {
    if (candidates.empty()) return "nothing is allowed here";
    constexpr std::size_t max_listed = 32, few_more = 8; // "and 1 more" would take as much space as the name itself
    constexpr std::size_t max_sorted = 1000;
    const auto unsorted = candidates.size() - std::min(candidates.size(), max_sorted);
    std::string help;
    const auto renamed = new_name(word);
    const bool is_renamed = std::ranges::find(candidates, renamed) != candidates.end();
    const auto own = own_name(word, candidates);
    const auto near = is_renamed ? renamed : !own.empty() ? own : nearest(word, candidates);
    if (!near.empty())
        help = concat(is_renamed ? "renamed to " : "did you mean ", in_quotes(near), is_renamed ? " " : "? ");

    candidates.resize(candidates.size() - unsorted);
    sinew::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    help += near.empty() ? "allowed here: " : "(allowed here: ";
    const auto all = candidates.size() + unsorted;
    const auto listed = all <= max_listed + few_more ? all : max_listed;
    for (std::size_t i = 0; i < listed; ++i) help += concat(i > 0 ? ", " : "", printable(candidates[i]));
    if (all > listed) help += concat(" and ", all - listed, " more");
    if (!near.empty()) help += ")";
    return help;
}

} // namespace sinew
