// SPDX-License-Identifier: MIT
#include "tools/manual.h"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace threefold {

namespace {

/// Text that man(7) takes for nothing else: no escapes, and no requests at the start of a line.
std::string roff(std::string_view text) {
    std::string out;
    bool at_start = true;
    for (const char c : text) {
        if (at_start && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        at_start = c == '\n';
    }
    return out;
}

/// A text that is set out by hand keeps its lines.
std::string as_it_stands(std::string_view text) { return fmt::format(".nf\n{}\n.fi\n", roff(text)); }

std::vector<const CLI::Option *> options_of(const CLI::App &app) { return app.get_options({}); }

std::string entry(const CLI::Option &option) {
    const std::string name = option.get_positional() ? option.get_name(true, false) : option.get_name(false, true);
    std::string head = fmt::format(".TP\n\\fB{}\\fR{}\n", roff(name), roff(CLI::Formatter().make_option_opts(&option)));
    // Lines of a description are lines of the manual: a list of formats has one each.
    std::string description = roff(option.get_description());
    for (std::size_t at = 0; (at = description.find('\n', at)) != std::string::npos; at += 5)
        description.replace(at, 1, "\n.br\n");
    return head + description + "\n";
}

std::string usage(const CLI::App &program, const CLI::App &command) {
    std::string text = fmt::format("\\fB{} {}\\fR", roff(program.get_name()), roff(command.get_name()));
    for (const CLI::Option *option : options_of(command))
        if (option->get_positional()) text += fmt::format(" {}", roff(CLI::Formatter().make_option_usage(option)));
    return text + " [\\fIOPTION\\fR]...";
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// A name for a shell's function.
std::string identifier(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return "_" + text;
}

std::vector<std::string> names_of(const CLI::Option &option) {
    std::vector<std::string> names;
    for (const std::string &name : option.get_lnames()) names.push_back("--" + name);
    for (const std::string &name : option.get_snames()) names.push_back("-" + name);
    return names;
}

std::vector<std::string> option_names(const CLI::App &app) {
    std::vector<std::string> names;
    for (const CLI::Option *option : options_of(app))
        for (std::string &name : names_of(*option)) names.push_back(std::move(name));
    return names;
}

/// The words for an option's value, or for the other arguments where `option` is null; null: file names.
const CompletionWords *words_for(const std::vector<CompletionWords> &all, const CLI::App &command,
                                 const CLI::Option *option) {
    const CompletionWords *found = nullptr;
    for (const CompletionWords &w : all) {
        const bool here =
            option ? !w.option.empty() && std::ranges::count(names_of(*option), w.option) > 0 : w.option.empty();
        if (!here || (!w.command.empty() && w.command != command.get_name())) continue;
        if (!found || found->command.empty()) found = &w; // what is said of one command comes first
    }
    return found;
}

/// Single quotes: no word of ours has one, and a shell changes nothing between them.
std::string quoted(const std::vector<std::string> &words) { return fmt::format("'{}'", fmt::join(words, " ")); }

} // namespace

std::string to_man_page(const CLI::App &app) {
    const std::string &name = app.get_name();
    std::string page = fmt::format(".\\\" SPDX-License-Identifier: MIT\n.\\\" Made by {} --man-page\n"
                                   ".TH {} 1 \"\" \"{}\" \"User Commands\"\n",
                                   name, upper(name), name);
    page += fmt::format(".SH NAME\n{} \\- cross\\-check conclusions about a glass orb in three renderers\n"
                        ".SH SYNOPSIS\n\\fB{}\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR]...\n.SH DESCRIPTION\n{}\n",
                        roff(name), roff(name), roff(app.get_description()));
    page += ".SH OPTIONS\n";
    for (const CLI::Option *option : options_of(app)) page += entry(*option);
    page += ".SH COMMANDS\n";
    for (const CLI::App *command : app.get_subcommands({})) {
        page += fmt::format(".SS {}\n{}\n.PP\n{}\n", roff(command->get_name()), usage(app, *command),
                            roff(command->get_description()));
        for (const CLI::Option *option : options_of(*command)) page += entry(*option);
        if (!command->get_footer().empty() && command->get_footer() != app.get_footer())
            page += ".PP\n" + as_it_stands(command->get_footer());
    }
    page += ".SH EXAMPLES AND EXIT STATUS\n" + as_it_stands(app.get_footer());
    page += ".SH SEE ALSO\n.BR povray (1),\n.BR blender (1)\n";
    return page;
}

std::string to_bash_completion(const CLI::App &app, const std::vector<CompletionWords> &words) {
    std::vector<std::string> first;
    std::string options, values;
    for (const CLI::App *command : app.get_subcommands({})) {
        first.push_back(command->get_name());
        const CompletionWords *arguments = words_for(words, *command, nullptr);
        options += fmt::format("    {}) options={} words={} ;;\n", command->get_name(), quoted(option_names(*command)),
                               arguments ? quoted(arguments->words) : "''");
        for (const CLI::Option *option : options_of(*command)) {
            if (option->get_positional() || option->get_items_expected_min() == 0) continue; // an argument, a flag
            std::vector<std::string> places;
            for (const std::string &n : names_of(*option)) places.push_back(command->get_name() + ":" + n);
            const CompletionWords *w = words_for(words, *command, option);
            values += fmt::format("    {}) options= words={} {};;\n", fmt::join(places, " | "),
                                  w ? quoted(w->words) : "''", w && w->comma_separated ? "list=1 " : "");
        }
    }
    for (std::string &name : option_names(app)) first.push_back(std::move(name));
    const std::string function = identifier(app.get_name());
    return fmt::format(R"(# SPDX-License-Identifier: MIT
# Completion for bash; made by {name} --completion.
{function}() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command=${{COMP_WORDS[1]}}
    local options= words= list= kept=
    case $command in
{options}    esac
    case $command:$before in
{values}    esac
    [ "$COMP_CWORD" -gt 1 ] || words={first}
    [[ $word != -* || -z $options ]] || words=$options
    if [ -n "$list" ]; then
        kept=${{word%"${{word##*,}}"}}
        word=${{word##*,}}
    fi
    COMPREPLY=($(compgen -P "$kept" -W "$words" -- "$word"))
}}
complete -o default -F {function} {name}
)",
                       fmt::arg("name", app.get_name()), fmt::arg("function", function), fmt::arg("options", options),
                       fmt::arg("values", values), fmt::arg("first", quoted(first)));
}

} // namespace threefold
