// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "tools/options.h"

namespace threefold {

CLI::Option *add_renderers_option(CLI::App &command, std::vector<std::string> &with, std::string_view help) {
    return command.add_option("--with", with, std::string(help))->delimiter(',')->allow_extra_args(false);
}

CLI::Option *add_time_limit_option(CLI::App &command, double &seconds, std::string_view help) {
    return command.add_option("--timeout", seconds, std::string(help))
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
}

CLI::Option *add_json_option(CLI::App &command, std::optional<std::string> &file) {
    return command.add_option("--json", file, "Also write the result as JSON here (-: stdout)");
}

} // namespace threefold
