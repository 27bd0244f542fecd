// SPDX-License-Identifier: MIT
#include "exporter/text.h"

#include <algorithm>
#include <utility>

namespace threefold {

std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

std::string reason(std::string text) {
    text = one_line(std::move(text));
    return text.empty() ? "unknown reason" : text;
}

std::string lower_case(std::string text) {
    for (char &c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

} // namespace threefold
