// SPDX-License-Identifier: MIT
// Digits of an impact parameter that a table's print has cut off.
#pragma once

#include <string_view>

#include "verifier/optics/quad.h"

namespace threefold {

/// Tables of closed forms are made from impact parameters that are a share of the clear radius, b = share * limit, with
/// a share of at most 17 digits (a double), and print b with 25. Close to grazing 25 digits do not settle 18 of the
/// answer: transmittance goes with limit - b. Where the printed b is, to its last digit, such a product, this returns
/// the product: the same number within the rounding of its print. Everything else is returned as it stands; a b of 25
/// digits that is no such product is taken for one with a chance of about one in ten million.
optics::Quad restored_impact(const optics::Quad &printed, std::string_view text, const optics::Quad &limit);

} // namespace threefold
