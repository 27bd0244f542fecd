// SPDX-License-Identifier: MIT
#include "tools/restored_impact.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace threefold {

namespace {

constexpr int printed_digits = 25;
constexpr int fewest_digits = 20; // zeros at the end are not printed; shorter numbers were not cut off

/// Digits from the first that is not zero, exponent left out.
int significant_digits(std::string_view text) {
    text = text.substr(0, text.find_first_of("eE"));
    const std::size_t first = text.find_first_of("123456789");
    if (first == text.npos) return 0;
    text = text.substr(first);
    return static_cast<int>(std::ranges::count_if(text, [](unsigned char c) { return std::isdigit(c) != 0; }));
}

} // namespace

optics::Quad restored_impact(const optics::Quad &printed, std::string_view text, const optics::Quad &limit) {
    using optics::Quad;
    const int digits = significant_digits(text);
    if (digits < fewest_digits || digits > printed_digits || !(printed > 0) || !(limit > 0)) return printed;
    const Quad share(fmt::format("{}", static_cast<double>(printed / limit))); // its shortest decimal form
    const Quad product = share * limit;
    // Half a unit in the last printed digit.
    const Quad rounding = pow(Quad(10), floor(log10(printed)) - (printed_digits - 1)) / 2;
    return abs(product - printed) <= rounding * Quad("1.000001") ? product : printed;
}

} // namespace threefold
