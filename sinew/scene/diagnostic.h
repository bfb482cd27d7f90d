#pragma once

#include "sinew/scene/text.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Bytes [begin, end) of one source.
struct Span {
    std::uint32_t source = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    friend constexpr bool operator==(const Span&, const Span&) = default;
};

/// A text that values come from: a scene file, or one key=value pair of a command line.
struct Source {
    std::string name;
    std::string text;
};

/// Something the author of a source has to mend.
struct Diagnostic {
    Span span;
    std::string path;    ///< of the value, as a JSON pointer: "/figures/0/mass"
    std::string message; ///< says what was expected and what was found
    std::string help;    ///< may be empty
};

/// Everything that is wrong with some sources, all of it in one run.
class Diagnostics {
  public:
    /// Errors beyond this many are counted but not kept: they cost memory and nobody reads them.
    static constexpr std::size_t most_kept = 200;

    std::uint32_t add_source(std::string name, std::string text);
    const Source& source(std::uint32_t id) const { return sources_[id]; }
    std::size_t source_count() const { return sources_.size(); }
    std::string_view text(Span span) const;

    void error(Span span, std::string path, std::string message, std::string help = {});
    /// Where `full`, callers can spare themselves the message.
    bool full() const { return kept_.size() >= most_kept; }
    void count_one_more() { ++uncounted_; }

    bool ok() const { return kept_.empty() && uncounted_ == 0; }
    std::size_t count() const { return in_order().size() + uncounted_; }
    /// Sorted by place, each once.
    std::vector<Diagnostic> in_order() const;

  private:
    std::vector<Source> sources_;
    std::vector<Diagnostic> kept_;
    std::size_t uncounted_ = 0;
};

struct Place {
    std::size_t line = 1;
    std::size_t column = 1; ///< in characters, not bytes
};
Place place_of(const Diagnostics& diagnostics, Span span);

struct PrintStyle {
    bool color = false;
    std::size_t most = 100;  ///< then "and N more errors"
    std::size_t width = 100; ///< of the part of a long source line that is shown, in characters
};

/// For people, in the shape of a compiler's messages:
///
///     ragdoll.json:8:33: error: unknown property "masss" at /points/2
///         8 |     {"id": "hip", "pos": [0.3], "masss": 1.0 }
///           |                                 ^~~~~~~
///           = help: did you mean "mass"? (allowed here: id, mass, pinned, pos)
std::string to_text(const Diagnostics& diagnostics, const PrintStyle& style = {});

/// The candidate that `word` is most likely a slip of, or nothing where none is close: insertions, deletions, changes
/// and swaps of neighbours count (optimal string alignment), case does not.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// The candidates most like `word`, best first: those that share a stretch of at least three letters with it, the
/// longest first, then those of the fewest edits.
std::vector<std::string_view> similar(std::string_view word, std::span<const std::string_view> candidates,
                                      std::size_t most);

/// `did you mean "mass"? (allowed here: id, mass, pinned, pos)`
std::string suggest(std::string_view word, std::vector<std::string_view> candidates);

} // namespace sinew
