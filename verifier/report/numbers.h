// SPDX-License-Identifier: MIT
// Numbers as people read them: as many digits as the measurement supports, and no more.
#pragma once

#include <string>
#include <string_view>

#include "verifier/agreement/result.h"

namespace threefold::report {

/// `digits` significant digits, without trailing zeros: "0.004", "1.2e-5", "not a number", "infinite".
std::string number(double value, int digits = 3);
/// Two digits of `resolution` stay visible, so that numbers of one row line up: 1.04023 at 0.002 is "1.0402".
std::string number_at(double value, double resolution);
/// The same for a number that was chosen, not measured: without trailing zeros.
std::string bound_at(double value, double resolution);
/// The finest difference that matters when a row's numbers are compared: its noise, bounded by its tolerance.
double resolution(const Row &row);
/// A share as "0.42 %".
std::string percent(double share);
/// "0.42 s", "3 min 20 s", "1 h 12 min".
std::string duration(double seconds);
/// "1 tile", "3 tiles", "1,024 tiles".
std::string count(long long n, std::string_view singular);
/// The same number for a typeset page: a true minus sign and powers of ten as U+2212, U+00D7 and superscripts.
std::string typeset(std::string_view ascii);

} // namespace threefold::report
