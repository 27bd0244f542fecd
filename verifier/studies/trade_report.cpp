// SPDX-License-Identifier: MIT
#include "verifier/studies/trade_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "verifier/report/json_value.h"
#include "verifier/report/numbers.h"
#include "verifier/report/table.h"
#include "verifier/report/text.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;
using report::markdown;
using report::Table;

/// A root with its uncertainty; where it does not stand out of it, what it is under.
std::string root_text(const Square &s) {
    if (s.seen()) return fmt::format("{:.2g}", s.root());
    return fmt::format("< {:.1g}", std::sqrt(std::max(0.0, s.value) + 2 * s.standard_error));
}

std::string seconds_text(double s) { return s <= 0 ? "-" : fmt::format("{:.3g}", s); }

Json to_json(const Square &s) {
    return {{"value", report::real(s.value)}, {"standard_error", report::real(s.standard_error)}};
}
Json to_json(const RunCost &c) {
    return {{"own_cpu_s", c.own_cpu_s},
            {"process_cpu_s", c.process_cpu_s},
            {"process_wall_s", c.wall_s},
            {"peak_memory_mb", c.memory_mb > 0 ? Json(c.memory_mb) : Json()}};
}

std::string csv_field(const std::string &text) {
    if (text.find_first_of(",\"\n\r") == text.npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

/// The sweep's row of this knob and renderer; the first one.
const TradeRow *row_of(const TradeResult &result, Knob knob) {
    const auto found =
        std::ranges::find_if(result.rows, [&](const TradeRow &r) { return r.knob == knob && r.difference; });
    return found == result.rows.end() ? nullptr : &*found;
}

} // namespace

std::vector<std::string> answers(const TradeResult &result) {
    std::vector<std::string> all;
    for (const double tolerance : result.tolerances) {
        const TradeChoice *ours = nullptr;
        for (const TradeChoice &c : result.choices)
            if (c.tolerance == tolerance && c.witness == "tracer" && c.met) ours = &c;
        for (const TradeChoice &c : result.choices) {
            if (c.tolerance != tolerance) continue;
            const std::string &title = result.title(c.witness);
            if (c.met)
                all.push_back(fmt::format(
                    "{} meets {:g} at least cost with {}: {:.3g} CPU s of rendering, {:.3g} of the whole process; with "
                    "fresh seeds its error is {:.3g} +- {:.1g}{}.",
                    title, tolerance, c.setting, c.cost.own_cpu_s, c.cost.process_cpu_s, c.measured.root(),
                    c.measured.standard_error / (2 * std::max(c.measured.root(), 1e-300)),
                    c.tried > 1 ? fmt::format(" ({} settings were tried)", c.tried) : ""));
            else if (c.setting.empty())
                all.push_back(fmt::format("{} does not meet {:g}: {}.", title, tolerance, c.note));
            else
                all.push_back(
                    fmt::format("{} was not seen to meet {:g}: {}. By the law: {}, {:.3g} CPU s of rendering.", title,
                                tolerance, c.note, c.setting, c.cost.own_cpu_s));
            if (ours && ours != &c && !c.setting.empty() && ours->cost.own_cpu_s > 0)
                all.push_back(
                    fmt::format("  For {:g} it takes {:.3g} times the tracer's time of rendering, {:.3g} times "
                                "that of whole processes{}.",
                                tolerance, c.cost.own_cpu_s / ours->cost.own_cpu_s,
                                c.cost.process_cpu_s / ours->cost.process_cpu_s, c.met ? "" : " (predicted)"));
        }
    }
    if (const TradeRow *single = row_of(result, Knob::precision)) {
        const auto twin = std::ranges::find_if(result.rows, [&](const TradeRow &r) {
            return r.witness == single->witness && r.setting == single->difference_from;
        });
        if (twin != result.rows.end())
            all.push_back(fmt::format(
                "float against double ({}): {:.2f} times the time of rendering; it moves the picture by {} of the mean "
                "radiance (RMS, same seeds), and its efficiency 1/(MSE x seconds) is {:.2f} times that of double.",
                single->setting, single->cost.own_cpu_s / twin->cost.own_cpu_s, root_text(*single->difference),
                single->efficiency() / twin->efficiency()));
    }
    return all;
}

Table settings_table(const TradeResult &result) {
    Table table{{"renderer", "setting", "own CPU s", "process CPU s", "MB", "error", "noise", "bias", "8 x 8 means",
                 "1/(MSE s)", "front"}};
    for (const TradeRow &r : result.rows)
        table.push_back({result.title(r.witness), r.setting, seconds_text(r.cost.own_cpu_s),
                         seconds_text(r.cost.process_cpu_s),
                         r.cost.memory_mb > 0 ? fmt::format("{:.0f}", r.cost.memory_mb) : "-",
                         fmt::format("{:.3g}", r.error.mse.root()), fmt::format("{:.2g}", r.error.variance.root()),
                         root_text(r.error.bias2), fmt::format("{:.2g}", std::sqrt(std::max(0.0, r.error.tile_mse))),
                         fmt::format("{:.2g}", r.efficiency()),
                         r.on_front           ? (r.on_process_front ? "both" : "own")
                         : r.on_process_front ? "process"
                                              : ""});
    return table;
}

Table parts_table(const TradeResult &result) {
    Table table{{"renderer", "setting", "knob", "moves the picture by", "from", "quantisation"}};
    for (const TradeRow &r : result.rows)
        if (r.difference)
            table.push_back({result.title(r.witness), r.setting, std::string(to_string(r.knob)),
                             root_text(*r.difference), r.difference_from, fmt::format("{:.1g}", r.quantisation)});
    return table;
}

std::string to_csv(const TradeResult &result) {
    std::string out =
        "renderer,setting,knob,samples_per_pixel,cut_weight,surface_mm,bounces,precision,transport,"
        "own_cpu_s,process_cpu_s,process_wall_s,peak_memory_mb,mse,mse_se,variance,bias2,bias2_se,tile_mse,"
        "quantisation,difference2,difference2_se,difference_from,efficiency,front,process_front\n";
    for (const TradeRow &r : result.rows) {
        const auto &k = r.knobs;
        out += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.witness,
            csv_field(r.setting), to_string(r.knob), r.samples_per_pixel, k.cut_weight, k.surface_mm,
            k.bounces ? fmt::format("{}", *k.bounces) : "",
            k.tracer.precision == Precision::single_precision ? "float" : "double",
            k.tracer.transport == Transport::roulette ? "roulette" : "tree", r.cost.own_cpu_s, r.cost.process_cpu_s,
            r.cost.wall_s, r.cost.memory_mb, r.error.mse.value, r.error.mse.standard_error, r.error.variance.value,
            r.error.bias2.value, r.error.bias2.standard_error, r.error.tile_mse, r.quantisation,
            r.difference ? fmt::format("{}", r.difference->value) : "",
            r.difference ? fmt::format("{}", r.difference->standard_error) : "", csv_field(r.difference_from),
            r.efficiency(), r.on_front ? 1 : 0, r.on_process_front ? 1 : 0);
    }
    return out;
}

Json to_json(const TradeResult &result) {
    Json parameters = Json::object(), rows = Json::array(), choices = Json::array(), laws = Json::array();
    for (const auto &[name, value] : result.parameters) parameters[name] = report::valid_utf8(value);
    for (const TradeRow &r : result.rows) {
        const auto &k = r.knobs;
        rows.push_back({{"renderer", r.witness},
                        {"setting", r.setting},
                        {"knob", to_string(r.knob)},
                        {"samples_per_pixel", r.samples_per_pixel},
                        {"cut_weight", k.cut_weight},
                        {"surface_mm", k.surface_mm},
                        {"bounces", k.bounces ? Json(*k.bounces) : Json()},
                        {"precision", k.tracer.precision == Precision::single_precision ? "float" : "double"},
                        {"transport", k.tracer.transport == Transport::roulette ? "roulette" : "tree"},
                        {"cost", to_json(r.cost)},
                        {"own_cpu_spread_s", r.own_cpu_spread_s},
                        {"runs", r.error.runs},
                        {"mse", to_json(r.error.mse)},
                        {"variance", to_json(r.error.variance)},
                        {"bias2", to_json(r.error.bias2)},
                        {"tile_mse", report::real(r.error.tile_mse)},
                        {"quantisation", r.quantisation},
                        {"difference2", r.difference ? to_json(*r.difference) : Json()},
                        {"difference_from", r.difference_from},
                        {"efficiency", report::real(r.efficiency())},
                        {"on_front", r.on_front},
                        {"on_process_front", r.on_process_front}});
    }
    for (const TradeLaw &l : result.laws)
        laws.push_back({{"renderer", l.witness},
                        {"noise_factor", l.noise.factor},
                        {"noise_rate", l.noise.rate},
                        {"systematic_offset", l.bias}});
    for (const TradeChoice &c : result.choices)
        choices.push_back({{"renderer", c.witness},
                           {"tolerance", c.tolerance},
                           {"setting", c.setting},
                           {"samples_per_pixel", c.samples_per_pixel},
                           {"met", c.met},
                           {"rendered", c.rendered},
                           {"tried", c.tried},
                           {"predicted_error", report::real(c.predicted)},
                           {"measured_mse", c.rendered ? to_json(c.measured) : Json()},
                           {"measured_bias", c.rendered ? Json(c.bias) : Json()},
                           {"cost", to_json(c.cost)},
                           {"note", c.note}});
    return {{"schema", "threefold trade"},
            {"schema_version", TradeResult::schema_version},
            {"threefold_version", result.threefold_version},
            {"command", report::valid_utf8(result.command)},
            {"started", result.started},
            {"versions", report::object(result.versions)},
            {"scene", report::valid_utf8(result.scene)},
            {"scene_hash", result.scene_hash},
            {"parameters", parameters},
            {"width_px", result.width_px},
            {"height_px", result.height_px},
            {"runs", result.runs},
            {"threads", result.threads},
            {"quick", result.quick},
            {"tracer_as_process", result.whole_processes},
            {"reference",
             {{"kind", result.reference},
              {"error", result.reference_error},
              {"cpu_s", result.reference_cpu_s},
              {"mean_radiance", result.mean_radiance}}},
            {"tolerances", result.tolerances},
            {"answers", answers(result)},
            {"choices", choices},
            {"laws", laws},
            {"settings", rows},
            {"notes", result.notes},
            {"seconds", result.seconds}};
}

namespace {

std::string law_text(const TradeResult &result) {
    std::string out;
    for (const TradeLaw &l : result.laws)
        out += fmt::format("- {}: the square of the noise falls as samples^-{:.2f}; systematic offset: {}\n",
                           result.title(l.witness), l.noise.rate, l.bias);
    return out;
}

} // namespace

std::string to_text(const TradeResult &result) {
    std::string out =
        fmt::format("{} ({} x {} px, {} runs of each setting, in turn)\nreference: {}, itself good to {:.1e}\n\n{}\n",
                    report::one_line(result.scene), result.width_px, result.height_px, result.runs, result.reference,
                    result.reference_error, markdown(settings_table(result)));
    if (const Table parts = parts_table(result); parts.size() > 1) out += markdown(parts) + "\n";
    out += law_text(result) + "\n";
    for (const std::string &line : answers(result)) out += line + "\n";
    for (const std::string &line : result.notes) out += "note: " + line + "\n";
    return out;
}

std::string to_markdown(const TradeResult &result) {
    std::vector<std::string> parameters;
    std::string out = fmt::format(
        "# Speed against accuracy: {}\n\n"
        "Made by `{}` (Threefold {}, {}, {:.0f} minutes): {} x {} pixels, {} runs of each setting with other seeds, all "
        "settings of all renderers in turn. Reference: {}, itself good to {:.1e}.\n\n",
        report::one_line(result.scene), report::one_line(result.command), result.threefold_version,
        result.started.substr(0, 10), std::ceil(result.seconds / 60), result.width_px, result.height_px, result.runs,
        result.reference, result.reference_error);
    for (const std::string &line : answers(result)) out += fmt::format("- {}\n", report::one_line(line));
    out += "\n## Settings\n\n" + markdown(settings_table(result));
    out += fmt::format(
        "\nErrors are RMS over pixels and channels, relative to the mean radiance {:.4g}. *error*: of one run, the "
        "reference's own noise taken off; *noise*: what another seed changes; *bias*: what none does, by bias^2 = MSE - "
        "variance, without bias for {} runs (`<`: not told from zero, and under this); *8 x 8 means*: of the means of 8 x 8 "
        "pixels. Seconds are CPU seconds of all threads: *own* of rendering alone, *process* with start-up, reading and "
        "writing. *front*: no other setting of this renderer beats it in time and error, by own seconds, by processes, or "
        "both.\n",
        result.mean_radiance, result.runs);
    if (const Table parts = parts_table(result); parts.size() > 1)
        out +=
            "\n## What each knob does\n\n" + markdown(parts) +
            "\nThe same seeds with another value of one knob: the RMS of the mean difference, with what noise adds to it "
            "taken off. *quantisation*: of the picture's number format, by computation.\n";
    out += "\n## Noise and offsets\n\n" + law_text(result);
    for (const std::string &line : result.notes) out += "\n" + line + "\n";
    return out;
}

} // namespace threefold
