// SPDX-License-Identifier: MIT
#include <charconv>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/options.h"

namespace threefold {

namespace {

struct RepeatedOption {
    std::string_view name;
    char between; ///< stands in each of its words; an argument without is not its
};
constexpr RepeatedOption repeated_options[] = {{"--set", '='}, {"--image", '='}, {"--inject", ':'}};

bool has_form(const std::string &word, char between) {
    return !word.starts_with('-') && word.find(between) != std::string::npos && !word.starts_with(between);
}

} // namespace

std::vector<std::string> repeat_options(const std::vector<std::string> &arguments) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == "--") { // nothing behind it is an option
            all.insert(all.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
            return all;
        }
        all.push_back(arguments[i]);
        for (const RepeatedOption &option : repeated_options) {
            const bool alone = arguments[i] == option.name;
            if (!alone && !arguments[i].starts_with(std::string(option.name) + "=")) continue;
            if (alone && i + 1 < arguments.size()) all.push_back(arguments[++i]); // judged by who takes it
            for (; i + 1 < arguments.size() && has_form(arguments[i + 1], option.between); ++i)
                all.insert(all.end(), {std::string(option.name), arguments[i + 1]});
            break;
        }
    }
    return all;
}

CLI::Option *one_or_many(CLI::Option *option, std::string_view form) {
    return option->allow_extra_args(false)->option_text(std::string(form) + " ...");
}

CLI::Option *comma_separated(CLI::Option *option, std::string_view what) {
    return option->delimiter(',')->allow_extra_args(false)->option_text(std::string(what) + ",...");
}

CLI::Option *add_set_option(CLI::App &command, std::vector<std::string> &assignments, std::string_view help) {
    return one_or_many(command.add_option("--set", assignments, std::string(help)), "NAME=VALUE");
}

CLI::Option *add_renderers_option(CLI::App &command, std::vector<std::string> &with, std::string_view help) {
    return comma_separated(command.add_option("--with", with, std::string(help)), "RENDERER");
}

CLI::Option *add_time_limit_option(CLI::App &command, double &seconds, std::string_view help) {
    return command.add_option("--timeout", seconds, std::string(help))
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
}

CLI::Option *add_seed_option(CLI::App &command, std::uint64_t &seed, std::string_view help) {
    // The parser takes -1 and greater numbers for 2^64 - 1, and 010 for 8.
    const auto as_written = [](const std::string &text) {
        std::uint64_t number = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
        const bool good =
            status == std::errc{} && end == text.data() + text.size() && text == fmt::format("{}", number);
        return good ? std::string() : fmt::format("must be a whole number from 0 to 2^64 - 1, not {}", text);
    };
    return command.add_option("--seed", seed, std::string(help))->capture_default_str()->check(as_written);
}

CLI::Option *add_json_option(CLI::App &command, std::optional<std::string> &file) {
    return command.add_option("--json", file, "Also write the result as JSON here (-: stdout)");
}

} // namespace threefold
