#pragma once

#include "sinew/math/record.h"

#include <string>
#include <string_view>

namespace sinew {

/// Units of the numbers of a scene. Records declare defaults and ranges in metres, kilograms and seconds; a scene in
/// pixels and frames gets them scaled. Numbers stated in the file are used unchanged.
struct Units {
    std::string_view length = "m", mass = "kg", time = "s";
    double per_metre = 1;    ///< length units in a metre: 100 in a scene in px
    double per_kilogram = 1; ///< mass units in a kilogram
    double per_second = 1;   ///< time units in a second: 60 in a scene in frames

    /// Value of one SI unit of such a quantity in these units.
    double scale(Unit unit) const;
    /// Name of a unit: "px/frame^2", "degrees"; empty for a plain number.
    std::string text(Unit unit) const;
};

/// Factor from a number in the program to the number in a file, apart from the scene's scale: degrees for radians.
double in_file(Unit unit);
/// Factor from a number in a file to the number in the program.
double in_program(Unit unit);

/// The number rounded to 15 decimal digits, as a person would write it.
double rounded(double number);

/// Range of a field as a file in these units states it, rounded to 15 digits: 0.02 m is 2 px, not 2.0000000000000004.
struct Range {
    double low, high;
};
Range range_in_file(const Field& field, const Units& units);

/// Range in words: "from 0 to 1", "of at least 2", "of at most 180"; empty for an unlimited range.
std::string range_text(const Range& range);

} // namespace sinew
