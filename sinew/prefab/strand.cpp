#include "sinew/prefab/strand.h"

namespace sinew {

double half_turn_of_slack(int pieces, double slack) {
    if (!(slack > 0)) return 0;
    const double n = pieces;
    double low = 0, high = pi<double> / n; // a straight strand, and one closed to a ring
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        const bool longer = sine(n * middle) * (1 + slack) > n * sine(middle);
        (longer ? low : high) = middle;
    }
    return low;
}

} // namespace sinew
