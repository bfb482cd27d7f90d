#pragma once

#include "sinew/scene/text.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Bytes [begin, end) of a source.
struct Span {
    std::uint32_t source = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    friend constexpr bool operator==(const Span&, const Span&) = default;
};

/// A source text: a scene file, or one key=value pair of a command line.
struct Source {
    std::string name;
    std::string text;
};

/// An error in a source, or a warning of values that are allowed but seldom meant, for its author.
struct Diagnostic {
    Span span;
    std::string path;    ///< JSON pointer of the value: "/figures/0/mass"
    std::string message; ///< states the expected and the actual value
    std::string help;    ///< may be empty
};

/// Collects all errors of one or more sources in one run.
class Diagnostics {
  public:
    /// Errors beyond this number are counted but not stored.
    static constexpr std::size_t max_kept = 200;

    std::uint32_t add_source(std::string name, std::string text);
    const Source& source(std::uint32_t id) const { return sources_[id]; }
    std::size_t source_count() const { return sources_.size(); }
    std::string_view text(Span span) const;

    void error(Span span, std::string path, std::string message, std::string help = {});
    /// True if no further error is stored; callers can then skip composing the message and call count_one_more().
    bool full() const { return kept_.size() >= max_kept; }
    void count_one_more() { ++uncounted_; }

    /// Adds a warning; beyond `max_kept` they are dropped.
    void warn(Span span, std::string path, std::string message, std::string help = {});

    /// True without errors; warnings do not count.
    bool ok() const { return kept_.empty() && uncounted_ == 0; }
    std::size_t count() const { return in_order().size() + uncounted_; }
    /// The stored errors, sorted by position, without duplicates.
    std::vector<Diagnostic> in_order() const;
    std::vector<Diagnostic> warnings_in_order() const;

  private:
    std::vector<Source> sources_;
    std::vector<Diagnostic> kept_, warnings_;
    std::size_t uncounted_ = 0;
};

struct Place {
    std::size_t line = 1;
    std::size_t column = 1; ///< in characters, not bytes
};
Place place_of(const Diagnostics& diagnostics, Span span);

struct PrintStyle {
    bool color = false;
    std::size_t max = 100;   ///< then "and N more errors"
    std::size_t width = 100; ///< characters of a long source line to print
};

/// Formats the errors like a compiler's messages:
///
///     ragdoll.json:8:33: error: unknown property "masss" at /points/2
///         8 |     {"id": "hip", "pos": [0.3], "masss": 1.0 }
///           |                                 ^~~~~~~
///           = help: did you mean "mass"? (allowed here: id, mass, pinned, pos)
std::string to_text(const Diagnostics& diagnostics, const PrintStyle& style = {});
/// The warnings, in the same form.
std::string warnings_text(const Diagnostics& diagnostics, const PrintStyle& style = {});

/// The candidate closest to a misspelt `word`; empty where none is close. Distance: insertions, deletions,
/// substitutions and swaps of neighbours (optimal string alignment), ignoring case.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// The candidates most similar to `word`, best first: candidates that share a substring of at least three letters with
/// the word, sorted by decreasing length of the substring, then by edit distance. At most `max` of them.
std::vector<std::string_view> similar(std::string_view word, std::span<const std::string_view> candidates,
                                      std::size_t max);

/// Present name of a property that a former version of the format called `word`; empty for all others.
std::string_view new_name(std::string_view word);

/// The candidate that other engines call `word` ("restitution" for "bounce"); empty if there is none.
std::string_view own_name(std::string_view word, std::span<const std::string_view> candidates);

/// Help text for an unknown word: `did you mean "mass"? (allowed here: id, mass, pinned, pos)`
std::string suggest(std::string_view word, std::vector<std::string_view> candidates);

} // namespace sinew
