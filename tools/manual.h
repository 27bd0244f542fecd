// SPDX-License-Identifier: MIT
// The manual page and the completion for bash, both made from the options themselves: they cannot fall behind.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace threefold {

/// What can stand in a place of a command line.
struct CompletionWords {
    std::string command; ///< empty: of any command
    std::string option;  ///< "--with"; empty: the arguments that are no option's
    std::vector<std::string> words;
    bool comma_separated = false;
};

struct Shop; // tools/commands.h
/// Of the scenes and claims there are.
std::vector<CompletionWords> completion_words(const Shop &shop);

/// In the language of man(7).
std::string to_man_page(const CLI::App &app);
/// Where `words` says nothing of an option's value, file names are offered.
std::string to_bash_completion(const CLI::App &app, const std::vector<CompletionWords> &words);

} // namespace threefold
