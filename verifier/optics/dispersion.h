// SPDX-License-Identifier: MIT
// How a glass's index runs over the visible range, from its index and its Abbe number. Wavelengths in nanometres.
#pragma once

namespace threefold::optics {

/// Fraunhofer's lines: hydrogen F, helium d, hydrogen C.
inline constexpr double line_f_nm = 486.13, line_d_nm = 587.56, line_c_nm = 656.27;

/// Cauchy's two terms, n = A + B / lambda^2 (Cauchy, 1836; Born & Wolf 2.3.4), through the index at d and the
/// difference between F and C that the Abbe number (n_d - 1) / (n_F - n_C) states. Of a crown glass it is good to
/// 2e-4 from 400 to 700 nm (BK7: 1.53094 for 1.53085 at 400 nm, 1.51319 for 1.51306 at 700 nm).
inline double index_at_wavelength(double index_d, double abbe_number, double wavelength_nm) {
    const auto inverse_square = [](double nm) { return 1 / (nm * nm); };
    const double spread = (index_d - 1) / abbe_number;
    return index_d + spread * (inverse_square(wavelength_nm) - inverse_square(line_d_nm)) /
                         (inverse_square(line_f_nm) - inverse_square(line_c_nm));
}

} // namespace threefold::optics
