// SPDX-License-Identifier: MIT
#include "exporter/temporary_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "scenes/error.h"

namespace threefold {

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "threefold-XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error(Exit::input_output, fmt::format("cannot make a temporary folder {}", name));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace threefold
