#pragma once

#include <string>
#include <vector>

/// A picture of what was measured: what one pays, what one gets.
namespace sinew::bench {

struct PlotPoint {
    double x = 0, y = 0;
    std::string label{}; ///< beside it; may be empty
    bool beaten = false; ///< faint, and no line goes through it
};
struct Curve {
    std::string name;
    std::vector<PlotPoint> points;
};
struct Panel {
    std::string title;
    std::vector<Curve> curves; ///< a curve has the colour of its place in the list
};

struct Plot {
    std::string title, x_title;
    std::vector<Panel> panels; ///< side by side, of the same curves
};

/// Marks every point where another is lower and no further right: nobody would choose it.
void mark_beaten(Curve& curve);

/// An SVG file. Both axes are logarithmic; points that are not finite or not positive stand on the upper edge.
std::string to_svg(const Plot& plot);

} // namespace sinew::bench
