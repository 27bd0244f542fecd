// SPDX-License-Identifier: MIT
// A folder of a test's own, gone with the test.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace threefold {
// Another entity than the exporter's class of the same name, which is linked into the same program.
inline namespace tests {

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = std::filesystem::temp_directory_path() / "threefold-test-XXXXXX";
        if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make " + name);
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    const std::filesystem::path &path() const { return path_; }
    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

    /// An executable shell script.
    std::filesystem::path write_program(std::string_view name, std::string_view commands) const {
        const std::filesystem::path program = path_ / name;
        std::ofstream(program) << "#!/bin/sh\n" << commands << "\n";
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        return program;
    }

private:
    std::filesystem::path path_;
};

} // namespace tests
} // namespace threefold
