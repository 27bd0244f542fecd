// SPDX-License-Identifier: MIT
#include "verifier/studies/smallest_fault.h"

#include <algorithm>
#include <cmath>

namespace threefold {

namespace {

SmallestFault smallest_real(const FaultEntry &entry, const std::function<bool(double)> &is_caught, double resolution) {
    constexpr double least_share = 1e-6;
    const double listed = entry.listed - entry.honest;
    SmallestFault found{entry.listed, std::nullopt, 0};
    const auto caught = [&](double share) {
        ++found.evaluations;
        const double size = entry.honest + share * listed;
        const bool is = is_caught(size);
        if (is)
            found.caught = size;
        else
            found.missed = size;
        return is;
    };
    double high = 1, low = 0.1; // shares of the listed departure; `high` is caught
    while (caught(low)) {
        high = low;
        if (low < 2 * least_share) return found;
        low /= 10;
    }
    while (high / low > resolution) {
        const double middle = std::sqrt(high * low);
        (caught(middle) ? high : low) = middle;
    }
    return found;
}

SmallestFault smallest_whole(const FaultEntry &entry, const std::function<bool(double)> &is_caught) {
    const double towards = entry.honest > entry.listed ? 1 : -1;
    SmallestFault found{entry.listed, std::nullopt, 0};
    const auto caught = [&](double size) {
        ++found.evaluations;
        const bool is = is_caught(size);
        if (is)
            found.caught = size;
        else
            found.missed = size;
        return is;
    };
    for (double step = 1; found.caught != entry.honest; step *= 2) {
        const double next = entry.listed + towards * step;
        if ((entry.honest - next) * towards <= 0) {
            found.missed = entry.honest; // nothing is wrong there
            break;
        }
        if (!caught(next)) break;
    }
    while (found.missed && std::abs(*found.missed - found.caught) > 1)
        caught(found.caught + towards * std::floor(std::abs(*found.missed - found.caught) / 2));
    return found;
}

} // namespace

std::optional<SmallestFault> smallest_fault(const FaultEntry &entry, const std::function<bool(double)> &is_caught,
                                            double resolution) {
    switch (entry.sizes) {
    case FaultEntry::Sizes::one:
        return std::nullopt;
    case FaultEntry::Sizes::real:
        return smallest_real(entry, is_caught, resolution);
    case FaultEntry::Sizes::whole:
        return smallest_whole(entry, is_caught);
    }
    return std::nullopt;
}

} // namespace threefold
