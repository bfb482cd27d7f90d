#pragma once

#include <string>
#include <vector>

/// Plots of cost against accuracy.
namespace sinew::bench {

struct PlotPoint {
    double x = 0, y = 0;
    std::string label{}; ///< beside the point; may be empty
    bool beaten = false; ///< true: drawn faintly, and left out of the line
};
struct Curve {
    std::string name;
    std::vector<PlotPoint> points;
};
struct Panel {
    std::string title;
    std::vector<Curve> curves; ///< coloured by index
};

struct Plot {
    std::string title, x_title;
    std::vector<Panel> panels; ///< side by side, of the same curves
};

/// Marks every dominated point: another point is lower and no further right.
void mark_beaten(Curve& curve);

/// An SVG file. Both axes are logarithmic; points that are not finite or not positive stand on the upper edge.
std::string to_svg(const Plot& plot);

} // namespace sinew::bench
