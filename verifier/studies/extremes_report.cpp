// SPDX-License-Identifier: MIT
#include "verifier/studies/extremes_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "verifier/report/json_value.h"
#include "verifier/report/table.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;
using report::markdown;
using report::Table;

std::string cell(const ExtremeFinding &f) {
    switch (f.standing) {
    case Standing::refused:
    case Standing::unresolved:
        return to_string(f.standing);
    case Standing::right:
    case Standing::degraded:
        return fmt::format("{} {:.0e}", to_string(f.standing), f.worst);
    case Standing::wrong:
        return fmt::format("WRONG {:.0e}, {} px", f.worst, f.wrong);
    }
    return {};
}

Table table_of(const ExtremesResult &result, const ExtremeSweepResult &sweep) {
    Table table{{sweep.number}};
    for (const ExtremeColumn &c : result.columns) table.front().push_back(c.title);
    if (sweep.probe == Probe::landing) table.front().push_back("condition");
    for (const ExtremeRow &row : sweep.rows) {
        std::vector<std::string> line{row.label};
        for (const ExtremeFinding &f : row.findings) line.push_back(cell(f));
        if (sweep.probe == Probe::landing)
            line.push_back(row.condition > 0 ? fmt::format("{:.0e}", row.condition) : "");
        table.push_back(std::move(line));
    }
    return table;
}

/// The reasons of refusals, each once, with the renderer and the first point that it was given at.
std::vector<std::string> refusals(const ExtremesResult &result, const ExtremeSweepResult &sweep) {
    std::vector<std::string> all;
    for (std::size_t k = 0; k < result.columns.size(); ++k) {
        std::string last;
        for (const ExtremeRow &row : sweep.rows) {
            const ExtremeFinding &f = row.findings[k];
            if (f.standing != Standing::refused || f.reason == last) continue;
            last = f.reason;
            // What no renderer is asked is the same for all.
            const bool by_all = std::ranges::all_of(row.findings, [&f](const ExtremeFinding &other) {
                return other.standing == Standing::refused && other.reason == f.reason;
            });
            if (by_all && k > 0) continue;
            all.push_back(fmt::format("{} at {}: {}",
                                      by_all && result.columns.size() > 1 ? "everyone" : result.columns[k].title,
                                      row.label, f.reason));
            if (!by_all || result.columns.size() == 1) break; // those further out are refused alike
        }
    }
    return all;
}

/// How far each column is right, from the ordinary on.
std::string reach(const ExtremesResult &result, const ExtremeSweepResult &sweep, std::size_t column) {
    const auto &rows = sweep.rows;
    std::size_t n = 0;
    while (n < rows.size() && rows[n].findings[column].standing == Standing::right) ++n;
    const std::string &title = result.columns[column].title;
    if (n == rows.size()) return fmt::format("{}: right everywhere", title);
    const ExtremeFinding &next = rows[n].findings[column];
    std::string then = fmt::format("{} at {}", to_string(next.standing), rows[n].label);
    if (next.standing == Standing::degraded || next.standing == Standing::wrong)
        then += fmt::format(" (by {:.1e}, stated {:.1e})", next.worst, next.bound);
    return n == 0 ? fmt::format("{}: {}", title, then)
                  : fmt::format("{}: right to {}, {}", title, rows[n - 1].label, then);
}

Json to_json(const ExtremeFinding &f) {
    using report::real;
    return {{"standing", to_string(f.standing)},
            {"pixels",
             {{"judged", f.judged},
              {"lit", f.lit},
              {"unresolved", f.unresolved},
              {"wrong", f.wrong},
              {"forgiven", f.forgiven}}},
            {"worst_error", real(f.worst)},
            {"median_error", real(f.median)},
            {"stated_bound", real(f.bound)},
            {"times_the_bound", real(f.times)},
            {"reason", f.reason}};
}

} // namespace

std::string conclusion(const ExtremesResult &result) {
    std::map<Standing, int> count;
    int promised = 0, kept = 0;
    for (const ExtremeSweepResult &sweep : result.sweeps)
        for (const ExtremeRow &row : sweep.rows)
            for (std::size_t k = 0; k < result.columns.size(); ++k) {
                ++count[row.findings[k].standing];
                if (!result.columns[k].is_own || !row.promised) continue;
                ++promised;
                kept += row.findings[k].standing == Standing::right;
            }
    return fmt::format(
        "{} renders asked: {} right, {} degraded, {} unresolved, {} refused, {} wrong. Our tracer in double "
        "precision is right at {} of the {} points that it answers for.",
        count[Standing::right] + count[Standing::degraded] + count[Standing::unresolved] + count[Standing::refused] +
            count[Standing::wrong],
        count[Standing::right], count[Standing::degraded], count[Standing::unresolved], count[Standing::refused],
        count[Standing::wrong], kept, promised);
}

Json to_json(const ExtremesResult &result) {
    Json columns = Json::array(), sweeps = Json::array();
    for (const ExtremeColumn &c : result.columns) columns.push_back({{"name", c.name}, {"title", c.title}});
    for (const ExtremeSweepResult &sweep : result.sweeps) {
        Json rows = Json::array();
        for (const ExtremeRow &row : sweep.rows) {
            Json findings = Json::object();
            for (std::size_t k = 0; k < result.columns.size(); ++k)
                findings[result.columns[k].name] = to_json(row.findings[k]);
            rows.push_back({{"label", row.label},
                            {"value", row.value},
                            {"promised", row.promised},
                            {"condition", row.condition},
                            {"findings", findings}});
        }
        sweeps.push_back({{"name", sweep.name},
                          {"title", sweep.title},
                          {"number", sweep.number},
                          {"probe", sweep.probe == Probe::landing ? "landing" : "light"},
                          {"points", rows}});
    }
    const std::vector<std::string> faults = result.faults();
    return {{"schema", "threefold extremes"},
            {"schema_version", ExtremesResult::schema_version},
            {"threefold_version", result.threefold_version},
            {"command", result.command},
            {"started", result.started},
            {"versions", report::object(result.versions)},
            {"quick", result.quick},
            {"verdict", faults.empty() ? "holds" : "fails"},
            {"summary", conclusion(result)},
            {"faults", faults},
            {"thresholds",
             {{"visible_landing_radii", visible_landing},
              {"visible_light", visible_light},
              {"double_floor_radii", double_floor},
              {"float_floor_radii", float_floor},
              {"roundings", roundings}}},
            {"quad_disagreement_radii", report::real(result.disagreement)},
            {"columns", columns},
            {"sweeps", sweeps},
            {"seconds", result.seconds}};
}

std::string to_text(const ExtremesResult &result) {
    std::string out;
    for (const ExtremeSweepResult &sweep : result.sweeps) {
        out += fmt::format("{} ({})\n{}", sweep.title, sweep.name, markdown(table_of(result, sweep)));
        for (const std::string &line : refusals(result, sweep)) out += fmt::format("  {}\n", line);
        out += "\n";
    }
    const std::vector<std::string> faults = result.faults();
    for (const std::string &fault : faults) out += fault + "\n";
    return out + fmt::format("{} {}\n", faults.empty() ? "holds" : "fails", conclusion(result));
}

std::string to_markdown(const ExtremesResult &result, const std::string &picture) {
    std::vector<std::string> versions;
    for (const auto &[name, version] : result.versions)
        if (std::ranges::any_of(result.columns, [&name = name](const ExtremeColumn &c) { return c.title == name; }))
            versions.push_back(fmt::format("{} {}", name, version));
    std::string out =
        fmt::format("# Where each renderer breaks, and whether it says so\n\n"
                    "Made by `{}` (Threefold {}{}{}, {}, {:.0f} minutes).\n\n{}\n\n![Map of the extremes]({})\n\n",
                    result.command, result.threefold_version, versions.empty() ? "" : ", ", fmt::join(versions, ", "),
                    result.started.substr(0, 10), std::ceil(result.seconds / 60), conclusion(result), picture);
    const std::vector<std::string> faults = result.faults();
    for (const std::string &fault : faults) out += fmt::format("- **{}**\n", fault);
    if (!faults.empty()) out += "\n";
    out += fmt::format(
        "## What is asked\n\n"
        "A plain scene (an orb of 68 mm, index 1.51714, wall 2 %, eye at 900 mm, coordinate card at 250 mm behind it) has "
        "one number led from the ordinary to where arithmetic ends. Every point is a real render of 13 x 13 pixels, one ray "
        "through each pixel's centre, by the same path as any picture: validation, the adapter, the program. The glass is "
        "coated, so that one ray stays one ray, and the card says where it landed. That place is computed in quad "
        "precision (113 bits) from the scene's own numbers in two ways, by the closed forms and by Snell's law at each "
        "surface; the two never differ by more than {:.0e} R here. The last two sweeps have glass that splits light, in "
        "surroundings of radiance 1: every pixel must be 1.\n\n"
        "## What the words mean\n\n"
        "Fixed before rendering. Each pixel has an error e and a bound a that was stated beforehand; an error is visible "
        "above {:g} R on the card, or {:g} of the light.\n\n"
        "- **right**: e within a, and not visible.\n"
        "- **degraded**: visible but stated (e within a), or beyond a but not visible.\n"
        "- **wrong**: visible and beyond a; no number; light of the card where there is none, or none where it is.\n"
        "- **unresolved**: all pixels lie nearer to an edge of the glass or of the card than the stated accuracy: nothing "
        "was promised there, nothing is judged; or less than a quarter of the judged ones show the card.\n"
        "- **refused**: in one line, with the limit and the reason, before anything is rendered.\n\n"
        "A point has the worst class of its pixels. The bound a is, for our tracer in double precision, the larger of "
        "{:g} R and {:g} roundings (2^-53) times the problem's condition number: what relative changes of all the scene's "
        "numbers do to the landing, summed. In float it is {:g} R, or as many roundings of 2^-24. For POV-Ray and Cycles it "
        "is what the adapter states before rendering (rounded positions, tessellated surfaces, spread of samples, stored "
        "radiances), each times what it does to the landing of that very pixel. Of paths that Cycles states to lose at "
        "edges of triangles, as many are forgiven as chance exceeds once in a thousand pictures.\n\n"
        "Our tracer in double answers for walls to 1e-9 R, indices from 1 + 1e-9 to 4, impacts to 1 - 1e-9 of the edge, "
        "offsets to 1e6 R and scales from 1e-6 to 1e6: it must be right there, and beyond it refused or degraded, never "
        "wrong. The command ends with 0 when that is so and nobody is wrong anywhere, else with 1.\n\n"
        "## How far each goes\n\n",
        result.disagreement, visible_landing, visible_light, double_floor, roundings, float_floor);
    for (const ExtremeSweepResult &sweep : result.sweeps) {
        out += fmt::format("### {} (`{}`)\n\n", sweep.title, sweep.name);
        for (std::size_t k = 0; k < result.columns.size(); ++k) out += fmt::format("- {}\n", reach(result, sweep, k));
        out += fmt::format("\n{}\n", markdown(table_of(result, sweep)));
        for (const std::string &line : refusals(result, sweep)) out += fmt::format("- {}\n", line);
        out += "\n";
    }
    return out;
}

} // namespace threefold
