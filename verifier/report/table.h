// SPDX-License-Identifier: MIT
// A table of words for the terminal and for a page of Markdown.
#pragma once

#include <string>
#include <vector>

namespace threefold::report {

/// Rows of cells, the head first; no row is longer than the head.
using Table = std::vector<std::vector<std::string>>;

/// With columns lined up, so that it reads well as it stands.
std::string markdown(const Table &table);

} // namespace threefold::report
