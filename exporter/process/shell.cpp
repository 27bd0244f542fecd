// SPDX-License-Identifier: MIT
#include "exporter/process/shell.h"

#include <string_view>

namespace threefold {

std::string shell_quoted(const std::string &word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:+,%@";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string all = "'";
    for (const char c : word) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return all + "'";
}

} // namespace threefold
