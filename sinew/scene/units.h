#pragma once

#include "sinew/math/record.h"

#include <string>
#include <string_view>

namespace sinew {

/// The units that the numbers of a scene are in. Records declare their defaults and ranges in metres, kilograms and
/// seconds; a scene in pixels and frames has them multiplied by what a metre and a second are worth there. Numbers that
/// the file states are kept as they are.
struct Units {
    std::string_view length = "m", mass = "kg", time = "s";
    double per_metre = 1;    ///< how many lengths make a metre: 100 in a scene in px
    double per_kilogram = 1; ///< how many masses make a kilogram
    double per_second = 1;   ///< how many times make a second: 60 in a scene in frames

    /// What one SI unit of such a quantity is worth here.
    double scale(Unit unit) const;
    /// "px/frame^2", "degrees"; empty for a plain number.
    std::string text(Unit unit) const;
};

/// What the program's number is multiplied by to give the file's, apart from the scene's scale: angles are in degrees
/// there.
double in_file(Unit unit);
/// And what the file's number is multiplied by to give the program's.
double in_program(Unit unit);

/// The number rounded to 15 decimal digits, as a person would have written it.
double rounded(double number);

/// The range of a field as a file of these units states it, rounded to 15 digits: 0.02 m are 2 px,
/// not 2.0000000000000004.
struct Range {
    double low, high;
};
Range range_in_file(const Field& field, const Units& units);

/// "from 0 to 1", "of at least 2", "of at most 180"; empty where nothing is excluded.
std::string range_text(const Range& range);

} // namespace sinew
