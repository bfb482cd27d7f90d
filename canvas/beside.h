#pragma once

#include "sinew/session/picture.h"

#include <span>
#include <string>

namespace sinew::canvas {

/// A picture with a line of text above it.
struct Labelled {
    const Picture* picture = nullptr;
    std::string label;
};

/// Sides of what put_beside() makes, in pixels.
struct BesideSize {
    int width = 0, height = 0;
};

/// Of so many pictures of one size beside each other.
BesideSize size_beside(std::size_t count, int width, int height);

/// Fills `whole` with pictures of one size from left to right, each with its label above it, as a display list: every
/// painter and every kind of file takes it. What sticks out of one is not seen in its neighbour.
void put_beside(std::span<const Labelled> parts, Picture& whole);

} // namespace sinew::canvas
