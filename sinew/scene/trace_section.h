#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

/// Traces of past motion: the section "traces" of a scene file. Traces have no effect on motion.
namespace sinew {

/// Quantities a trace can show. A path is drawn where the motion took place, the others as a curve over time.
inline constexpr std::array<std::string_view, 5> trace_quantities = {"path", "energy", "kinetic", "potential", "speed"};

/// Maximum number of traces in a scene; each stores a bounded number of samples.
inline constexpr std::size_t max_traces = 64;

struct TraceSection {
    std::string of;
    std::string shows = "path";
    double seconds = 0;
    std::optional<std::array<Point, 2>> box;
    std::optional<double> low, high;
    std::string label;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.of, Field{.name = "of", .help = "Particle as figure/name, or a whole figure", .required = true});
        visit(self.shows, Field{.name = "shows",
                                .help = "Quantity: the path of the motion; or energy (total, kinetic or potential) or "
                                        "speed, as a curve over time",
                                .choices = trace_quantities});
        visit(self.seconds,
              Field{.name = "seconds", .help = "Length of the visible past; 0 for all", .low = 0, .high = 86400});
        visit(self.box,
              Field{.name = "box", .help = "Two opposite corners of a curve's frame (2D)", .unit = unit::length});
        visit(self.low,
              Field{.name = "low", .help = "Value at the bottom of the frame; the smallest so far if left out"});
        visit(self.high,
              Field{.name = "high", .help = "Value at the top of the frame; the largest so far if left out"});
        visit(self.label, Field{.name = "label", .help = "Text above the frame"});
    }
};

} // namespace sinew
