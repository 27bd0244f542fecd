// SPDX-License-Identifier: MIT
// The real type of the reference values: IEEE binary128, 113 bits, about 34 decimal digits.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace threefold::optics {

/// cpp_bin_float and not float128: header-only, the same bits on every compiler and machine, no libquadmath to link.
/// An inverse sine takes tens of microseconds, an order of magnitude more than there; a reference value needs a dozen.
/// Outside this namespace write optics::Quad: a scene's rectangle has the same name.
using Quad = boost::multiprecision::cpp_bin_float_quad;

} // namespace threefold::optics
