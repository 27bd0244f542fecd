// SPDX-License-Identifier: MIT
// A Mitsuba scene file as a tree: includes put in place, $parameters filled in, each element with where it stands.
// Hostile files are bounded: bytes, elements, depth of nesting and of includes, length of a filled-in value.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace threefold::mitsuba {

struct Place {
    std::string file; ///< as it was named
    int line = 0, column = 0;

    std::string text() const; ///< "file:line:column", fit for a message
};

struct Node {
    std::string tag;
    std::vector<std::pair<std::string, std::string>> attributes; ///< in the file's order, parameters filled in
    std::vector<Node> children;
    Place place;
    std::filesystem::path folder; ///< of the file it stands in

    const std::string *attribute(std::string_view name) const;
};

struct Tree {
    Node root;                                                 ///< the scene; its children in order, includes in place
    std::vector<std::pair<std::string, std::string>> defaults; ///< $parameters that the files give a value
    std::map<std::string, std::string> said;                   ///< our own instruction `<?threefold key="value"?>`
    double version = 0;                                        ///< of the dialect: 0.5, 0.6, 2.1, 3
    std::vector<std::string> notes;
    std::vector<std::string> problems; ///< such as an unknown $parameter
};

/// `given` comes before the defaults of the files. Throws Error(input_output) for a file that cannot be read,
/// Error(bad_data) for what is no XML, no scene, or beyond the bounds.
Tree read_tree(const std::filesystem::path &path, const std::map<std::string, std::string> &given);

/// "intIOR" as "int_ior": newer versions write all names so.
std::string snake(std::string_view name);

/// The folder of the element, then that of the scene's own file.
std::filesystem::path resolved(const std::filesystem::path &named, const Node &node, const Node &root);

} // namespace threefold::mitsuba
