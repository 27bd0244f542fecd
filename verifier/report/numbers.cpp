// SPDX-License-Identifier: MIT
#include "verifier/report/numbers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

namespace threefold::report {

namespace {

std::optional<std::string> word_for(double value) {
    if (std::isnan(value)) return "not a number";
    if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
    if (value == 0) return "0";
    return std::nullopt;
}

int exponent_of(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

std::string without_trailing_zeros(std::string text) {
    if (text.find('.') == std::string::npos || text.find_first_of("0123456789") == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

/// 1.50e-05 becomes 1.50e-5, or 1.5e-5.
std::string scientific(double value, int decimals, bool strip) {
    const std::string text = fmt::format("{:.{}e}", value, decimals);
    const std::size_t e = text.find('e');
    const std::string mantissa = text.substr(0, e);
    return fmt::format("{}e{}", strip ? without_trailing_zeros(mantissa) : mantissa, std::atoi(text.c_str() + e + 1));
}

std::string without_negative_zero(std::string text) {
    const bool zero = text.find_first_of("123456789") == std::string::npos;
    return zero && text.starts_with('-') ? text.substr(1) : text;
}

} // namespace

std::string number(double value, int digits) {
    if (const auto w = word_for(value)) return *w;
    const int exponent = exponent_of(value);
    if (exponent < -4 || exponent > 6) return scientific(value, digits - 1, true);
    return without_trailing_zeros(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent)));
}

std::string number_at(double value, double resolution) {
    if (const auto w = word_for(value)) return *w;
    if (!(resolution > 0) || !std::isfinite(resolution)) return number(value, 6);
    const int decimals = 1 - exponent_of(resolution), exponent = exponent_of(value);
    if (exponent + decimals < 0) return "0";
    if ((decimals > 7 && exponent < -3) || exponent > 8 || decimals > 12)
        return scientific(value, std::min(exponent + decimals, 15), false);
    return without_negative_zero(fmt::format("{:.{}f}", value, std::max(0, decimals)));
}

std::string bound_at(double value, double resolution) {
    const std::string text = number_at(value, resolution);
    const std::size_t e = text.find('e');
    return e == std::string::npos ? without_trailing_zeros(text)
                                  : without_trailing_zeros(text.substr(0, e)) + text.substr(e);
}

double resolution(const Row &row) {
    const double noise = (row.interval.high - row.interval.low) / 2;
    const double from_value = std::abs(row.measured.mean - row.expected);
    const double scale = row.relation == Relation::equal && row.tolerance > 0 ? row.tolerance : from_value;
    if (!(scale > 0) || !std::isfinite(scale)) return noise > 0 ? noise : std::abs(row.expected) * 1e-4;
    return noise > 0 ? std::clamp(noise, scale / 100, scale) : scale / 100;
}

std::string percent(double share) { return number(100 * share, std::abs(share) >= 1 ? 3 : 2) + " %"; }

std::string duration(double seconds) {
    if (!std::isfinite(seconds)) return number(seconds);
    if (seconds < 60) return number(seconds, seconds < 1 ? 2 : 3) + " s";
    const long long whole = std::llround(seconds);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string count(long long n, std::string_view singular) {
    std::string digits = std::to_string(std::llabs(n));
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return fmt::format("{}{} {}{}", n < 0 ? "-" : "", digits, singular, n == 1 ? "" : "s");
}

std::string typeset(std::string_view ascii) {
    static constexpr std::string_view superscript[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out;
    bool raised = false;
    for (std::size_t i = 0; i < ascii.size(); ++i) {
        const char c = ascii[i];
        const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        const bool power =
            c == 'e' && i > 0 && i + 1 < ascii.size() && std::isdigit(static_cast<unsigned char>(ascii[i - 1])) != 0;
        if (power)
            out += "×10";
        else if (c == '-')
            out += raised ? "⁻" : "−";
        else if (raised && digit)
            out += superscript[c - '0'];
        else
            out += c;
        raised = power || (raised && (c == '-' || digit));
    }
    return out;
}

} // namespace threefold::report
