#pragma once

#include "sinew/scene/image.h"

#include <array>
#include <cstddef>

namespace sinew {

/// Mean structural similarity of two images of the same size (Wang, Bovik, Sheikh and Simoncelli 2004): 1 where they
/// are equal. Windows of 8 x 8 pixels, 4 apart, in each of red, green and blue. 0 for images of different sizes.
inline double ssim(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height) return 0;
    constexpr int window = 8, step = 4;
    constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    double sum = 0;
    std::size_t count = 0;
    for (int top = 0; top + window <= a.height; top += step)
        for (int left = 0; left + window <= a.width; left += step)
            for (const unsigned shift : {0U, 8U, 16U}) {
                double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
                for (int y = top; y < top + window; ++y)
                    for (int x = left; x < left + window; ++x) {
                        const auto at = std::size_t(y) * std::size_t(a.width) + std::size_t(x);
                        const double pa = a.pixels[at] >> shift & 255U, pb = b.pixels[at] >> shift & 255U;
                        sa += pa, sb += pb, saa += pa * pa, sbb += pb * pb, sab += pa * pb;
                    }
                constexpr double n = window * window;
                const double ma = sa / n, mb = sb / n;
                const double va = saa / n - ma * ma, vb = sbb / n - mb * mb, both = sab / n - ma * mb;
                sum += (2 * ma * mb + c1) * (2 * both + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
                ++count;
            }
    return count == 0 ? 0 : sum / double(count);
}

} // namespace sinew
