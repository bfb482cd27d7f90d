#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

/// What is drawn of the past: the section "traces" of a scene file. Nothing here moves anything.
namespace sinew {

/// What a trace can show. The first is drawn where it happened, the others as a curve over time.
inline constexpr std::array<std::string_view, 5> trace_quantities = {"path", "energy", "kinetic", "potential", "speed"};

/// Traces of one scene; each keeps a bounded number of samples.
inline constexpr std::size_t most_traces = 64;

struct TraceSection {
    std::string of;
    std::string shows = "path";
    double seconds = 0;
    std::optional<std::array<Point, 2>> box;
    std::optional<double> low, high;
    std::string label;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.of, Field{.name = "of", .help = "A particle as figure/name, or a whole figure", .required = true});
        visit(self.shows, Field{.name = "shows",
                                .help = "path: where it went; else its energy (all of it or a part) or its speed, "
                                        "as a curve over time",
                                .choices = trace_quantities});
        visit(self.seconds,
              Field{.name = "seconds", .help = "How much of the past is seen; 0: all of it", .low = 0, .high = 86400});
        visit(self.box,
              Field{.name = "box", .help = "Two opposite corners of a curve's frame (2D)", .unit = unit::length});
        visit(self.low, Field{.name = "low", .help = "Value at the bottom of the frame; left out: the least so far"});
        visit(self.high, Field{.name = "high", .help = "Value at its top; left out: the largest so far"});
        visit(self.label, Field{.name = "label", .help = "Written over the frame"});
    }
};

} // namespace sinew
