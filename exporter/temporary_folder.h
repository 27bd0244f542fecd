// SPDX-License-Identifier: MIT
// A folder that goes away with the object.
#pragma once

#include <filesystem>

namespace threefold {

class TemporaryFolder {
public:
    TemporaryFolder(); ///< throws Error(input_output)
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    const std::filesystem::path &path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace threefold
