#pragma once

#include "files/in/import.h"
#include "files/in/names.h"
#include "files/in/notes.h"
#include "files/in/role.h"
#include "files/in/simplify.h"

#include <functional>

namespace sinew::files {

struct DrawnLine {
    Outline points;
    bool closed = false;
};

/// A shape of a drawing, in the scene's coordinates: pixels, y downwards.
struct DrawnShape {
    std::string name, place;
    Role role = Role::solid;
    std::vector<DrawnLine> lines; ///< subpaths
    std::string_view fill_rule = "nonzero";
    std::string fill, stroke; ///< colours of scenes; "none" or empty: none
    double stroke_width = 0;
    std::optional<double> circle{};    ///< radius, if it is exactly a circle about `middle`
    std::optional<Vec2<double>> box{}; ///< size, if it is exactly a rectangle about `middle`
    Vec2<double> middle{};
    double turn = 0; ///< of the box, degrees, clockwise on screen
    bool is_sensor = false;
};

/// An image that a stiff figure wears as a whole, and a soft one in pieces.
struct Worn {
    std::string file;          ///< PNG beside the scene
    Vec2<double> at{}, size{}; ///< its top left corner and size, in the scene
    /// Writes the part of the image in a quadrilateral to a side file, and returns the file's name.
    std::function<std::string(const std::array<Vec2<double>, 4>&)> tile{};
    std::string mean{}; ///< mean colour: beneath the pieces
};

/// A 2D scene made of drawn shapes.
class Drawing {
  public:
    /// `size`: of the page, pixels. `error`: largest distance of a simplified outline.
    Drawing(Vec2<double> size, double error) : size_(size), error_(error) {}

    /// Adds what the shape becomes by its role; notes tell what it cannot become. Throws ImportError beyond a limit.
    void add(const DrawnShape& shape, const Worn* worn = nullptr);

    Notes& notes() { return notes_; }
    /// The scene: the page is a room. Without colliders it is made wider and deeper, for figures to fall. Throws
    /// ImportError where nothing was added.
    Imported finish(std::string about);

  private:
    Vec2<double> size_;
    double error_;
    Notes notes_;
    json::Array figures_, colliders_;
    json::Object looks_; ///< of colliders, by their names
    NewNames names_;
    std::size_t particles_ = 0;

    void count(std::size_t particles, const std::string& place);
    void add_collider(const DrawnShape& shape);
    void add_collider(json::Object shape, const DrawnShape& drawn);
    void add_area(const DrawnShape& shape, const Worn* worn);
    void add_rope(const DrawnShape& shape);
    std::vector<Outline> outlines_of(const DrawnShape& shape);
    std::vector<std::vector<Outline>> areas_of(const DrawnShape& shape);
    std::string without_area() const;
    double thickness() const;
};

} // namespace sinew::files
