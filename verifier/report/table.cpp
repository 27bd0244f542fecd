// SPDX-License-Identifier: MIT
#include "verifier/report/table.h"

#include <algorithm>

#include <fmt/format.h>

namespace threefold::report {

std::string markdown(const Table &table) {
    std::vector<std::size_t> widths(table.front().size(), 3);
    for (const auto &row : table)
        for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
    std::string out;
    for (const auto &row : table) {
        for (std::size_t k = 0; k < row.size(); ++k) out += fmt::format("| {:<{}} ", row[k], widths[k]);
        out += "|\n";
        if (&row != &table.front()) continue;
        for (const std::size_t width : widths) out += fmt::format("|{:-<{}}", "", width + 2);
        out += "|\n";
    }
    return out;
}

} // namespace threefold::report
