// SPDX-License-Identifier: MIT
#include "verifier/studies/power_report.h"

#include <algorithm>
#include <cmath>

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

/// The size as a person says it: "0.21 %", "0.04 px", "power 1 + 0.01", "17".
std::string size_text(const FaultEntry &entry, double size) {
    if (entry.kind == "gamma") return fmt::format("power 1 + {:.2g}", size - 1);
    if (entry.sizes == FaultEntry::Sizes::whole) return fmt::format("{:g}", size);
    if (!entry.unit.empty()) return fmt::format("{:.2g} {}", size, entry.unit);
    return fmt::format("{:.2g} %", 100 * size);
}

std::string smallest_text(const PowerRow &row) {
    if (!row.smallest) return "";
    const FaultEntry &entry = entry_of(row.fault.fault);
    // Where the search gave up, a smaller one may be caught as well.
    return fmt::format("{}{} ({})", row.smallest->missed ? "" : "at most ", size_text(entry, row.smallest->caught),
                       row.smallest->evaluations);
}

bool any(const PowerRow &row, ImageJudgement PictureJudgement::*judge) {
    return std::ranges::any_of(row.pictures, [judge](const PictureJudgement &p) { return (p.*judge).fails; });
}

std::string word(bool caught) { return caught ? "caught" : "-"; }

Table fault_table(const PowerResult &result) {
    Table table{{"fault", "our check", "idiff 0.016/1 %", "RMS -22 dB", "z-test", "smallest that ours catches (tries)",
                 "the claims that fail"}};
    for (const PowerRow &row : result.rows)
        table.push_back({to_string(row.fault), row.caught() ? "caught" : fmt::format("- ({})", to_string(row.verdict)),
                         word(any(row, &PictureJudgement::idiff)), word(any(row, &PictureJudgement::rms)),
                         word(any(row, &PictureJudgement::z_test)), smallest_text(row),
                         fmt::format("{}", fmt::join(row.caught_by, ", "))});
    return table;
}

Table alarm_table(const FalseAlarms &f) {
    const auto share = [&f](int count) {
        return f.runs > 0 ? fmt::format("{} of {} ({:.1f} %, under {:.1f} %)", count, f.runs, 100.0 * count / f.runs,
                                        100 * FalseAlarms::upper_bound(count, f.runs))
                          : "-";
    };
    return {{"runs without a fault", "our check", "idiff 0.016/1 %", "RMS -22 dB", "z-test"},
            {"fail", share(f.ours), share(f.idiff), share(f.rms), share(f.z_test)},
            {"undecided", share(f.undecided), "-", "-", "-"}};
}

std::string conclusion(const PowerResult &result) {
    std::vector<std::string> missed;
    for (const PowerRow &row : result.rows)
        if (!row.caught()) missed.push_back(to_string(row.fault));
    std::string text =
        missed.empty() ? fmt::format("Our check catches all {} faults", result.rows.size())
                       : fmt::format("Our check catches {} of {} faults, and misses {}",
                                     result.rows.size() - missed.size(), result.rows.size(), fmt::join(missed, ", "));
    const FalseAlarms &f = result.false_alarms;
    text += f.runs > 0
                ? fmt::format(
                      "; {} of {} runs without a fault fail (the rate is under {:.1f} % with 95 % confidence), {} are "
                      "undecided.",
                      f.ours, f.runs, 100 * FalseAlarms::upper_bound(f.ours, f.runs), f.undecided)
                : "; no run without a fault was made.";
    if (!result.honest_failures.empty())
        text += fmt::format(" These claims fail without any fault, and catch nothing: {}.",
                            fmt::join(result.honest_failures, ", "));
    return text;
}

Json to_json(const ImageJudgement &j) {
    return {{"caught", j.fails}, {"value", report::real(j.value)}, {"limit", j.limit}};
}

Json to_json(const PowerRow &row) {
    const FaultEntry &entry = entry_of(row.fault.fault);
    Json pictures = Json::array();
    for (const PictureJudgement &p : row.pictures)
        pictures.push_back({{"scene", p.scene},
                            {"idiff", to_json(p.idiff)},
                            {"rms_db", to_json(p.rms)},
                            {"z_test", to_json(p.z_test)}});
    Json smallest;
    if (row.smallest)
        smallest = {{"caught", row.smallest->caught},
                    {"missed", row.smallest->missed ? Json(*row.smallest->missed) : Json()},
                    {"evaluations", row.smallest->evaluations}};
    return {{"fault", entry.name},
            {"description", entry.description},
            {"kind", entry.kind},
            {"size", entry.sizes == FaultEntry::Sizes::one ? Json() : Json(row.fault.size)},
            {"unit", entry.unit},
            {"ours", {{"caught", row.caught()}, {"verdict", to_string(row.verdict)}, {"claims", row.caught_by}}},
            {"idiff", any(row, &PictureJudgement::idiff)},
            {"rms", any(row, &PictureJudgement::rms)},
            {"z_test", any(row, &PictureJudgement::z_test)},
            {"pictures", pictures},
            {"smallest", smallest}};
}

} // namespace

Json to_json(const PowerResult &result) {
    Json rows = Json::array();
    for (const PowerRow &row : result.rows) rows.push_back(to_json(row));
    const FalseAlarms &f = result.false_alarms;
    return {{"schema", "threefold power"},
            {"schema_version", PowerResult::schema_version},
            {"threefold_version", result.threefold_version},
            {"command", result.command},
            {"started", result.started},
            {"versions", report::object(result.versions)},
            {"faulty", result.faulty},
            {"witnesses", result.witnesses},
            {"claims", result.claims},
            {"picture_scenes", result.picture_scenes},
            {"precision", result.precision},
            {"quick", result.quick},
            {"resolution", result.resolution},
            {"verdict", to_string(result.verdict())},
            {"summary", conclusion(result)},
            {"honest", {{"verdict", to_string(result.honest)}, {"failing_claims", result.honest_failures}}},
            {"faults", rows},
            {"false_alarms",
             {{"runs", f.runs},
              {"ours", f.ours},
              {"ours_upper_bound", FalseAlarms::upper_bound(f.ours, f.runs)},
              {"undecided", f.undecided},
              {"idiff", f.idiff},
              {"rms", f.rms},
              {"z_test", f.z_test},
              {"failing_claims", f.failing_claims}}},
            {"evaluations", result.evaluations},
            {"seconds", result.seconds}};
}

std::string to_text(const PowerResult &result) {
    return fmt::format("{}\n{}\n{} {}\n", markdown(fault_table(result)), markdown(alarm_table(result.false_alarms)),
                       to_string(result.verdict()), conclusion(result));
}

std::string to_markdown(const PowerResult &result) {
    std::string out = fmt::format(
        "# What the check would have caught\n\n"
        "Made by `{}` (Threefold {}, {}, {:.0f} minutes, {} checks).\n\n{}\n\n"
        "Each fault is put into one renderer alone, {}. *Our check* is every claim ({}) in its quick form under the "
        "preset `text`{}, with {}; it catches a fault when its verdict is `fails`. A claim that fails without a fault "
        "would count as catching none.\n\n",
        result.command, result.threefold_version, result.started.substr(0, 10), std::ceil(result.seconds / 60),
        result.evaluations, conclusion(result), result.faulty, fmt::join(result.claims, ", "),
        result.quick ? " and without the renders on both sides of flip points" : "", fmt::join(result.witnesses, ", "));
    out += markdown(fault_table(result));
    out += fmt::format(
        "\n*Smallest that ours catches*: the size is brought down until no claim fails any more, to within a factor of "
        "{:g}; once for faults that differ in their size alone. A percentage is of the index, of the wall, of one "
        "light's irradiance, of the inner surface's loss, or of the radiance; for `bounces-4` it is the greatest limit "
        "on the glass surfaces of a path that is still caught. The faulty renderer computes in {} precision; where the "
        "search gave up, at a millionth of the listed size, it says at most.\n\n## Runs without a fault\n\n",
        result.resolution, result.precision == "float" ? "single" : "double");
    out += markdown(alarm_table(result.false_alarms));
    out += fmt::format(
        "\nOnly the seed of {} changes from run to run. \"Under\": with 95 % confidence, by Clopper and Pearson.\n\n"
        "## The other judges\n\n"
        "They look at one picture each of {} (64 samples a pixel, glass that takes 11 % at each surface, longest side "
        "128 px), against the mean of 16 honest pictures of other seeds. One that fails in any scene has caught the "
        "fault.\n\n"
        "- **idiff 0.016/1 %**, as Blender tests Cycles: 8-bit sRGB; fails when more than 1 % of the pixels differ by "
        "more than 0.016 in some channel.\n"
        "- **RMS -22 dB**, as Khronos render fidelity and model-viewer: the root mean square of the squared YIQ "
        "distances as a share of the greatest one, in decibels; fails above -22.\n"
        "- **z-test**, as Mitsuba 3: each pixel against a stored mean and variance (at least 1e-4 a sample), level 1 % "
        "by Sidak over the pixels; fails when more than 0.25 % of the pixels do.\n",
        result.faulty, fmt::join(result.picture_scenes, " and "));
    return out;
}

} // namespace threefold
