#pragma once

#include "sinew/math/record.h"

#include <cstdint>

namespace sinew {

/// What a scene may ask for before it is refused. Limits are stated, not discovered: an untrusted file is turned away
/// with the number it reached and the number allowed, and whoever trusts it raises the limit
/// (`limits.particles=5000000`). The defaults keep the reading of any file under a second and 200 MB.
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
        constexpr double most = 4e9; // places in a text are 32 bits wide
        visit(self.bytes, Field{.name = "bytes",
                                .help = "Size of the scene file, and of each image and model",
                                .low = 1,
                                .high = most});
        // An object can hold objects as deep as the stack of the program that walks them allows.
        visit(self.depth,
              Field{.name = "depth", .help = "Objects and arrays inside each other", .low = 1, .high = 1000});
        visit(self.values,
              Field{.name = "values", .help = "Values in the scene file, of any type", .low = 1, .high = most});
        visit(self.string_bytes,
              Field{.name = "string_bytes", .help = "Length of one string, word or number", .low = 1, .high = most});
        visit(self.memory, Field{.name = "memory",
                                 .help = "Bytes that the lists of the scene take once read",
                                 .low = 1,
                                 .high = 1e12});
        visit(self.errors,
              Field{.name = "errors", .help = "Errors shown before the rest is counted", .low = 1, .high = 200});
        visit(self.figures, Field{.name = "figures", .help = "Figures in the scene", .low = 0, .high = most});
        visit(self.particles, Field{.name = "particles", .help = "Particles of all figures", .low = 0, .high = most});
        visit(self.constraints,
              Field{.name = "constraints", .help = "Constraints of all figures", .low = 0, .high = most});
        visit(self.events, Field{.name = "events", .help = "Events on the timeline", .low = 0, .high = most});
        visit(self.pixels, Field{.name = "pixels", .help = "Pixels of all images together", .low = 0, .high = most});
    }
};

} // namespace sinew
