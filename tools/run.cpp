// SPDX-License-Identifier: MIT
#include "tools/run.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <system_error>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "exporter/process/child.h"
#include "tools/manual.h"
#include "tools/options.h"
#include "verifier/witness/witness.h"

namespace threefold {

namespace {

/// The first signal asks everything to stop, children included; the second ends us at once.
void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupt_requested = true; };
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN); // a write that fails is answered where it is made
    std::signal(SIGXFSZ, SIG_IGN);
}

/// A file that is opened where stderr should be would be taken for it.
void open_missing_streams() {
    for (int stream = 0; stream <= 2; ++stream)
        if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", stream == 0 ? O_RDONLY : O_WRONLY) == -1)
            _exit(static_cast<int>(Exit::input_output));
}

/// The file name that we were started by: a user's own program is not called threefold.
std::string program_name(int argc, char **argv) {
    const std::string name = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
    return name.empty() ? "threefold" : name;
}

std::string command_line(int argc, char **argv) {
    std::string all = shell_quoted(program_name(argc, argv));
    for (int i = 1; i < argc; ++i) all += " " + shell_quoted(argv[i]);
    return all;
}

bool stdout_written() {
    std::cout.flush();
    return std::fflush(stdout) == 0 && std::cout;
}

} // namespace

int run(int argc, char **argv, const std::vector<SceneRecipe> &scenes, const std::vector<Claim> &claims) {
    open_missing_streams();
    CLI::App app{
        "Does a conclusion about a glass orb hold in physics, or only in one renderer?\n"
        "A scene is rendered by POV-Ray, Blender Cycles and Threefold's own tracer, measured by the same code, held\n"
        "against exact optics, and judged: holds, fails, or undecided.\n",
        program_name(argc, argv)};
    app.footer(
        "Start here:\n"
        "  threefold render hollow                  a first picture (hollow.exr, hollow.png)\n"
        "  threefold check --quick                  all claims in all renderers, with a report\n"
        "  threefold check solid-vs-hollow --set glass.index=1.1 -o water\n"
        "  threefold power --quick                  which known faults the check catches, and how small\n"
        "  threefold trade hollow --quick           what accuracy costs in each renderer\n"
        "  threefold scope                          what the claims leave out, and whether it matters\n"
        "  threefold optics --impact-mm 60          the closed forms for one ray\n\n"
        "Exit codes: 0 holds, 1 fails, 2 undecided, 64 usage, 65 bad input, 69 renderer missing, 70 a defect of ours,\n"
        "74 input or output failed, 124 a renderer ran out of time, 130 interrupted.");
    app.require_subcommand(1);
    app.set_version_flag("--version", [] {
        std::string all;
        for (const auto &[name, version] : library_versions()) all += fmt::format("{} {}\n", name, version);
        for (const Witness &w : find_witnesses(witness_names()))
            if (w.adapter) all += fmt::format("{} {}\n", w.title, w.installed ? w.installed->version : "not installed");
        return all.substr(0, all.size() - 1);
    });

    app.add_flag_callback(
        "--man-page", [&app] { throw CLI::CallForVersion(to_man_page(app), 0); }, "Print the manual page, for man -l");
    Shop shop{scenes, claims, program_name(argc, argv), command_line(argc, argv), 0, 0};
    app.add_flag_callback(
        "--completion",
        [&app, &shop] { throw CLI::CallForVersion(to_bash_completion(app, completion_words(shop)), 0); },
        "Print the completion for bash, to be sourced");
    Exit exit = Exit::holds;
    bool quiet = false, verbose = false;
    const auto add_common = [&](CLI::App &command) {
        command.add_flag("-q,--quiet", quiet, "Say only the result");
        command.add_flag("-v,--verbose", verbose, "Say more: every number, every note");
        command.add_option("--threads", shop.threads, "Threads to use (0: all cores)")->check(CLI::NonNegativeNumber);
    };

    bool list_json = false;
    CLI::App &list = *app.add_subcommand("list", "Scenes, claims and faults there are");
    list.add_flag("--json", list_json, "As JSON on stdout");

    SceneRequest show_scene;
    bool show_json = false;
    CLI::App &show =
        *app.add_subcommand("show", "A scene's parameters with units, ranges and both presets, and what it needs");
    add_scene_options(show, show_scene);
    show.add_flag("--json", show_json, "Parameters and the whole scene as JSON on stdout");
    show.add_flag("-v,--verbose", verbose, "Also say what in a Mitsuba file is read otherwise, or not used");

    CLI::App &doctor = *app.add_subcommand("doctor", "What is installed here, and does it work?");
    add_common(doctor);

    ExportRequest export_request;
    CLI::App &export_ = *app.add_subcommand("export", "A scene as files for another program, in a new folder");
    add_export_options(export_, export_request);
    add_common(export_);

    RenderRequest render_request;
    CLI::App &render = *app.add_subcommand("render", "One picture by one renderer");
    add_render_options(render, render_request);
    add_common(render);

    CheckCommand check_command;
    CLI::App &check = *app.add_subcommand("check", "Judge claims: render, measure, compare with exact optics, report");
    add_check_options(check, check_command);
    add_common(check);

    GalleryCommand gallery_command;
    CLI::App &gallery =
        *app.add_subcommand("gallery", "The study's figures, once per renderer, with an index and a contact sheet");
    add_gallery_options(gallery, gallery_command);
    add_common(gallery);

    PowerCommand power_command;
    CLI::App &power =
        *app.add_subcommand("power", "Known faults: which our check catches, how small, and which others' tests would");
    add_power_options(power, power_command);
    add_common(power);

    TradeCommand trade_command;
    CLI::App &trade =
        *app.add_subcommand("trade", "What accuracy costs: error against time for every renderer and knob");
    add_trade_options(trade, trade_command);
    add_common(trade);

    ExtremesCommand extremes_command;
    CLI::App &extremes = *app.add_subcommand(
        "extremes", "Where arithmetic ends in each renderer, and whether it says so: a map against quad precision");
    add_extremes_options(extremes, extremes_command);
    add_common(extremes);

    ScopeCommand scope_command;
    CLI::App &scope =
        *app.add_subcommand("scope", "What each claim leaves out, and how far it could move the claim's numbers");
    add_scope_options(scope, scope_command);
    add_common(scope);

    CompareRequest compare_request;
    CLI::App &compare = *app.add_subcommand("compare", "Two or three pictures, tile by tile");
    add_compare_options(compare, compare_request);
    add_common(compare);

    OpticsQuery optics_query;
    CLI::App &optics = *app.add_subcommand("optics", "The closed forms as a calculator: one ray, or a file of rows");
    add_optics_options(optics, optics_query);

    const auto refuse = [](const Error &error) {
        say(fmt::format("threefold: {}{}", error.what(), error.hint().empty() ? "" : " (" + error.hint() + ")"));
        return static_cast<int>(error.code());
    };
    try {
        // The parser would only say that a command is missing.
        std::vector<std::string> commands;
        for (const CLI::App *command : app.get_subcommands({})) commands.push_back(command->get_name());
        if (argc > 1 && argv[1][0] != '-' && std::ranges::count(commands, argv[1]) == 0)
            throw Error(Exit::usage, unknown_name("command", argv[1], commands));
        std::vector<std::string> arguments = repeat_options({argv + std::min(argc, 1), argv + argc});
        std::ranges::reverse(arguments); // as the parser takes them
        app.parse(std::move(arguments));
        shop.verbosity = quiet ? -1 : verbose ? 1 : 0;
        install_signal_handlers();
        if (list) exit = command_list(shop, list_json);
        if (show) exit = command_show(shop, show_scene, show_json);
        if (doctor) exit = command_doctor(shop);
        if (export_) exit = command_export(shop, export_request);
        if (render) exit = command_render(shop, render_request);
        if (check) exit = command_check(shop, check_command);
        if (gallery) exit = command_gallery(shop, gallery_command);
        if (power) exit = command_power(shop, power_command);
        if (trade) exit = command_trade(shop, trade_command);
        if (extremes) exit = command_extremes(shop, extremes_command);
        if (scope) exit = command_scope(shop, scope_command);
        if (compare) exit = command_compare(shop, compare_request);
        if (optics) exit = static_cast<Exit>(run_optics(optics_query, std::cout));
        if (!stdout_written()) throw Error(Exit::input_output, "cannot write to stdout");
        return static_cast<int>(exit);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == 0) { // --help, --version
            app.exit(error);
            return stdout_written() ? 0 : refuse(Error(Exit::input_output, "cannot write to stdout"));
        }
        return refuse(Error(Exit::usage, error.what()));
    } catch (const Error &error) {
        return refuse(error);
    } catch (const std::system_error &error) { // files, pipes, a full stdout
        return refuse(Error(Exit::input_output, error.what()));
    } catch (const std::bad_alloc &) {
        return refuse(Error(Exit::bad_data, "out of memory: make the picture smaller"));
    } catch (const std::exception &error) {
        return refuse(Error(Exit::internal, fmt::format("a defect of Threefold: {}", error.what())));
    }
}

} // namespace threefold
