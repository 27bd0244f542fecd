// SPDX-License-Identifier: MIT
#include "verifier/claims/unshadowed.h"

#include "verifier/claims/prediction.h"
#include "verifier/claims/visible.h"

namespace threefold {

double unshadowed_mean_radiance(const Scene &full) {
    const std::vector<SeenPoint> seen = first_seen(coarse(full));
    double sum = 0;
    for (const SeenPoint &point : seen) sum += point.radiance;
    return sum / static_cast<double>(seen.size());
}

} // namespace threefold
