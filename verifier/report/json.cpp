// SPDX-License-Identifier: MIT
#include "verifier/report/json.h"

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "verifier/report/json_value.h"
#include "verifier/report/text.h"
#include "verifier/report/time_table.h"

namespace threefold {

namespace {

using namespace report;

using Json = nlohmann::ordered_json;

Json text(std::string_view value) { return valid_utf8(value); }

Json text_or_null(std::string_view value) { return value.empty() ? Json(nullptr) : text(value); }

template <class T>
Json or_null(const std::optional<T> &value) {
    return value ? Json(*value) : Json(nullptr);
}

Json real_or_null(const std::optional<double> &value) { return value ? real(*value) : Json(nullptr); }

Json strings(const std::vector<std::string> &values) {
    Json list = Json::array();
    for (const std::string &value : values) list.push_back(text(value));
    return list;
}

Json string_map(const std::map<std::string, std::string> &values) {
    Json object = Json::object();
    for (const auto &[key, value] : values) object[valid_utf8(key)] = text(value);
    return object;
}

template <class T, class Convert>
Json list_of(const std::vector<T> &values, Convert convert) {
    Json list = Json::array();
    for (const T &value : values) list.push_back(convert(value));
    return list;
}

std::string_view to_string(ReportPicture::Kind kind) {
    switch (kind) {
    case ReportPicture::Kind::render:
        return "render";
    case ReportPicture::Kind::difference:
        return "difference";
    case ReportPicture::Kind::map:
        return "map";
    }
    return "";
}

Json from_budget(const std::vector<BudgetItem> &budget) {
    return list_of(budget, [](const BudgetItem &item) {
        return Json{{"name", text(item.name)}, {"value", real(item.value)}, {"reason", text(item.reason)}};
    });
}

Json from_witness(const WitnessRecord &w) {
    return {
        {"name", text(w.name)},
        {"title", text(w.title)},
        {"version", text_or_null(w.version)},
        {"program", text_or_null(w.program)},
        {"present", w.present},
        {"calibrated", or_null(w.calibrated)},
        {"problem", text_or_null(w.problem)},
        {"seconds", real(w.seconds)},
        {"injected_fault", text_or_null(w.injected_fault)},
    };
}

Json from_experiment(const ExperimentRecord &e) {
    return {
        {"name", text(e.name)},
        {"title", text(e.title)},
        {"scene", text(e.scene)},
        {"scene_hash", text(e.scene_hash)},
        {"parameters", string_map(e.parameters)},
    };
}

Json from_row(const Row &row) {
    return {
        {"experiment", text(row.experiment)},
        {"quantity", text(row.quantity)},
        {"unit", text(row.unit)},
        {"witness", text(row.witness)},
        {"versus", text_or_null(row.versus)},
        {"relation", to_string(row.relation)},
        {"measured",
         {{"mean", real(row.measured.mean)},
          {"standard_error", real(row.measured.standard_error)},
          {"degrees_of_freedom", real(row.measured.degrees_of_freedom)},
          {"replicates", row.measured.replicates}}},
        {"interval",
         {{"low", real(row.interval.low)}, {"high", real(row.interval.high)}, {"coverage", 1 - 2 * row.level}}},
        {"expected", real(row.expected)},
        {"tolerance", real(row.tolerance)},
        {"budget", from_budget(row.budget)},
        {"verdict", to_string(row.verdict)},
        {"replicates_to_decide", or_null(row.replicates_to_decide)},
    };
}

Json from_tiles(const TileComparison &t) {
    return {
        {"experiment", text(t.experiment)},
        {"witness", text(t.witness)},
        {"versus", text(t.versus)},
        {"tile_px", t.tile_px},
        {"columns", t.columns},
        {"rows", t.rows},
        {"mean_radiance", real(t.mean_radiance)},
        {"tolerance", real(t.tolerance)},
        {"budget", from_budget(t.budget)},
        {"worst_difference", real(t.worst_difference)},
        {"worst_column", t.worst_column},
        {"worst_row", t.worst_row},
        {"holding", t.holding},
        {"failing", t.failing},
        {"open", t.open},
        {"needed_share", real(t.needed_share)},
        {"allowed", t.allowed},
        {"problem", text(t.problem)},
        {"replicates", t.replicates},
        {"level", real(t.level)},
        {"verdict", to_string(t.verdict)},
        {"replicates_to_decide", or_null(t.replicates_to_decide)},
    };
}

Json from_picture(const ReportPicture &p) {
    return {{"kind", to_string(p.kind)}, {"experiment", text(p.experiment)}, {"title", text(p.title)}};
}

Json from_flip(const FlipPoint &f) {
    return {{"parameter", text(f.parameter)}, {"unit", text(f.unit)},       {"value", real(f.value)},
            {"here", real(f.here)},           {"meaning", text(f.meaning)}, {"bracket", strings(f.bracket)}};
}

Json from_scope(const ScopeFinding &f) {
    return {{"effect", text(f.effect)},    {"quantity", text(f.quantity)}, {"unit", text(f.unit)},
            {"value", real(f.value)},      {"bound", real(f.bound)},       {"margin", real(f.margin)},
            {"sentence", text(f.sentence)}};
}

Json from_claim(const ClaimResult &claim) {
    return {
        {"name", text(claim.name)},
        {"statement", text(claim.statement)},
        {"preset", text(claim.preset)},
        {"verdict", to_string(claim.verdict)},
        {"summary", text(claim.summary)},
        {"notes", strings(claim.notes)},
        {"flips", list_of(claim.flips, from_flip)},
        {"scope", list_of(claim.scope, from_scope)},
        {"blamed", strings(claim.blamed)},
        {"experiments", list_of(claim.experiments, from_experiment)},
        {"rows", list_of(claim.rows, from_row)},
        {"tiles", list_of(claim.tiles, from_tiles)},
        {"pictures", list_of(claim.pictures, from_picture)},
    };
}

Json from_render(const RenderRecord &r) {
    return {
        {"experiment", text(r.experiment)},
        {"witness", text(r.witness)},
        {"preset", text(r.preset)},
        {"folder", text(r.folder)},
        {"command", text_or_null(r.command)},
        {"width_px", r.width_px},
        {"height_px", r.height_px},
        {"replicates", r.replicates},
        {"samples_per_pixel", r.samples_per_pixel},
        {"seconds", real(r.seconds)},
        {"cpu_seconds", real(r.cpu_seconds)},
        {"peak_memory_mb", real(r.peak_memory_mb)},
        {"from_cache", r.from_cache},
        {"missing_weight_mean", real_or_null(r.missing_weight_mean)},
        {"missing_weight_greatest", real_or_null(r.missing_weight_greatest)},
        {"accuracy",
         {{"radiance_step", real(r.accuracy.radiance_step)},
          {"surface_mm", real(r.accuracy.surface_mm)},
          {"rounding_mm", real(r.accuracy.rounding_mm)},
          {"filter_px", real(r.accuracy.filter_px)},
          {"cut_weight", real(r.accuracy.cut_weight)},
          {"lost_paths", real(r.accuracy.lost_paths)}}},
        {"scene_hash", text(r.scene_hash)},
    };
}

Json from_times(const ExperimentTime &t) {
    Json renderers = Json::object();
    for (const auto &[name, time] : t.renderers)
        renderers[valid_utf8(name)] = {{"cpu_seconds", real(time.cpu_seconds)},
                                       {"own_cpu_seconds", real(time.own_cpu_seconds)},
                                       {"replicates", time.replicates},
                                       {"samples_per_pixel", time.samples_per_pixel}};
    return {{"experiment", text(t.experiment)}, {"preset", text(t.preset)}, {"renderers", std::move(renderers)}};
}

} // namespace

Json to_json(const RunResult &result) {
    const double overhead = result.seconds - result.renderer_seconds;
    return {
        {"schema_version", RunResult::schema_version},
        {"threefold_version", text(result.threefold_version)},
        {"started", text(result.started)},
        {"command", text(result.command)},
        {"preset", text(result.preset)},
        {"quick", result.quick},
        {"assignments", string_map(result.assignments)},
        {"versions", list_of(result.versions,
                             [](const std::pair<std::string, std::string> &v) {
                                 return Json{{"name", text(v.first)}, {"version", text(v.second)}};
                             })},
        {"verdict", to_string(result.verdict)},
        {"summary", text(result.summary)},
        {"timing",
         {{"seconds", real(result.seconds)},
          {"renderer_seconds", real(result.renderer_seconds)},
          {"tracer_seconds", real(result.tracer_seconds)},
          {"overhead_seconds", real(overhead)},
          {"overhead_share", real(overhead / result.seconds)},
          {"by_experiment", list_of(times_of(result), from_times)}}},
        {"witnesses", list_of(result.witnesses, from_witness)},
        {"claims", list_of(result.claims, from_claim)},
        {"renders", list_of(result.renders, from_render)},
    };
}

} // namespace threefold
