// SPDX-License-Identifier: MIT
// Text that is safe to print: names in a result come from users and may hold anything, even bytes that are no text.
#pragma once

#include <string>
#include <string_view>

namespace threefold::report {

/// The same text with every byte that is not UTF-8 replaced by U+FFFD.
std::string valid_utf8(std::string_view text);
/// Valid UTF-8 without control characters (terminal escapes, NUL), which are replaced by U+FFFD; line breaks and tabs
/// stay.
std::string printable(std::string_view text);
/// Printable, on one line: line breaks and tabs become spaces.
std::string one_line(std::string_view text);
/// Printable and escaped, for HTML text and for attributes in double or single quotes.
std::string html_text(std::string_view text);
/// The same on one line.
std::string plain(std::string_view text);
/// RFC 4648, section 4.
std::string base64(std::string_view bytes);
/// Lower-case letters, digits and hyphens only.
std::string slug(std::string_view text);

} // namespace threefold::report
