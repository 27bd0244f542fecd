// SPDX-License-Identifier: MIT
// `threefold optics`: the closed forms as a calculator, for one ray or for a file of rows.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

namespace threefold {

/// Lengths and the index are decimal text, so that no digit is lost before the precision is chosen.
struct OpticsQuery {
    std::optional<std::string> rows_file;
    std::string precision = "quad"; ///< "double" or "quad"
    std::string outer_mm = "68", wall_mm = "1.36", index = "1.51714", impact_mm = "0";
    std::string eye_mm = "900", plane_mm = "250"; ///< distances from the orb's centre
    bool solid = false;                           ///< wall_mm is then ignored
    std::optional<std::string> json;              ///< a file, or "-" for `out`
};

/// Answers on `out` (a table; JSON for rows or json "-"), or in the file `json`, and returns the exit code. Throws
/// Error that names what is wrong: for rows the row (counted from 1) and the key.
int run_optics(const OpticsQuery &query, std::ostream &out);

} // namespace threefold
