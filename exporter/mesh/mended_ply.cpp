// SPDX-License-Identifier: MIT
#include "exporter/mesh/mended_ply.h"

#include <cstddef>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace threefold {

namespace {

std::size_t bytes_of(const std::string &type) {
    static const std::map<std::string, std::size_t> sizes{{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                                          {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                                          {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                                          {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = sizes.find(type);
    return found == sizes.end() ? 0 : found->second;
}

} // namespace

std::string mended_ply(const std::string &bytes) {
    constexpr std::string_view end_of_header = "\nend_header";
    const std::size_t end = bytes.find(end_of_header);
    if (!bytes.starts_with("ply") || end == std::string::npos || bytes.find("\nformat binary_") > end) return {};
    const std::size_t data = bytes.find('\n', end + end_of_header.size()) + 1, element = bytes.find("\nelement ");
    if (data == 0 || data >= bytes.size() || element > end) return {};

    std::istringstream header(bytes.substr(element + 1, end - element));
    std::string word, name, type;
    std::size_t count = 0, record = 0;
    header >> word >> name >> count;
    if (name != "vertex")
        throw std::runtime_error(fmt::format("it has the element '{}' before its vertices", name.substr(0, 40)));
    if (bytes[data] != '\n' && bytes[data] != '\r') return {};
    while (header >> word && word != "element") {
        if (word != "property") { // a comment
            std::getline(header, word);
            continue;
        }
        header >> type >> name;
        if (bytes_of(type) == 0) throw std::runtime_error(fmt::format("its vertices have a '{}'", type.substr(0, 40)));
        record += bytes_of(type);
    }
    if (record == 0 || count > (bytes.size() - data) / record) return {}; // for Assimp to say what is wrong
    // One more property at the front of each vertex, and the data begin otherwise.
    std::string made = bytes.substr(0, bytes.find('\n', element + 1));
    made.reserve(bytes.size() + count + 40);
    made += "\nproperty uchar before";
    made += bytes.substr(bytes.find('\n', element + 1), data - bytes.find('\n', element + 1));
    for (std::size_t k = 0; k < count; ++k) made.append(1, '\1').append(bytes, data + k * record, record);
    return made.append(bytes, data + count * record);
}

} // namespace threefold
