#pragma once

#include "sinew/math/record.h"

#include <cstdint>

namespace sinew {

/// Limits on the size of a scene. A file beyond a limit is refused with a message that states the number found and the
/// number allowed; a user who trusts the file raises the limit (`limits.particles=5000000`). With the defaults, reading
/// any file takes less than a second and 200 MB.
struct Limits {
    std::int64_t bytes = 16'000'000;
    std::int64_t depth = 64;
    std::int64_t values = 500'000;
    std::int64_t string_bytes = 65'536;
    std::int64_t memory = 100'000'000;
    std::int64_t errors = 100;
    std::int64_t figures = 10'000;
    std::int64_t particles = 1'000'000;
    std::int64_t constraints = 4'000'000;
    std::int64_t events = 100'000;
    std::int64_t pixels = 16'000'000;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double max = 4e9; // offsets in a text have 32 bits
        visit(self.bytes, Field{.name = "bytes",
                                .help = "Size of the scene file, and of each image and model",
                                .low = 1,
                                .high = max});
        // Recursion over nested objects uses the program's stack, which bounds the depth.
        visit(self.depth,
              Field{.name = "depth", .help = "Nesting depth of objects and arrays", .low = 1, .high = 1000});
        visit(
            self.values,
            Field{.name = "values", .help = "Number of values in the scene file, of any type", .low = 1, .high = max});
        visit(self.string_bytes,
              Field{.name = "string_bytes", .help = "Length of one string, word or number", .low = 1, .high = max});
        visit(
            self.memory,
            Field{.name = "memory", .help = "Bytes taken by the lists of the scene once read", .low = 1, .high = 1e12});
        visit(self.errors,
              Field{.name = "errors", .help = "Errors shown before the rest is counted", .low = 1, .high = 200});
        visit(self.figures, Field{.name = "figures", .help = "Figures in the scene", .low = 0, .high = max});
        visit(self.particles, Field{.name = "particles", .help = "Particles of all figures", .low = 0, .high = max});
        visit(self.constraints,
              Field{.name = "constraints", .help = "Constraints of all figures", .low = 0, .high = max});
        visit(self.events, Field{.name = "events", .help = "Events on the timeline", .low = 0, .high = max});
        visit(self.pixels, Field{.name = "pixels", .help = "Pixels of all images together", .low = 0, .high = max});
    }
};

} // namespace sinew
