// SPDX-License-Identifier: MIT
// The end of the page: what anyone needs to repeat the run.
#include <iterator>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold::report {

namespace {

void add_settings(Out &out, const RunResult &result) {
    if (!result.command.empty())
        fmt::format_to(std::back_inserter(out), "<h3>Command</h3>\n<pre><code>{}</code></pre>\n",
                       html_text(result.command));
    out += "<dl class=\"parameters\">";
    const auto add = [&](std::string_view name, const std::string &value) {
        if (!value.empty())
            fmt::format_to(std::back_inserter(out), "<div><dt>{}</dt><dd>{}</dd></div>", plain(name), plain(value));
    };
    add("started", result.started);
    add("parameters", result.preset.empty()     ? ""
                      : result.preset == "both" ? "both presets"
                                                : "preset " + result.preset);
    for (const auto &[name, value] : result.assignments) add(name, value + " (--set)");
    add("run", result.quick ? "quick: fewer replicates, smaller pictures" : "");
    out += "</dl>\n";
    if (result.versions.empty()) return;
    out += "<h3>Versions</h3>\n<dl class=\"parameters\">";
    for (const auto &[name, version] : result.versions) add(name, version);
    out += "</dl>\n";
}

void add_timing(Out &out, const RunResult &result) {
    if (!(result.seconds > 0)) return;
    const double overhead = result.seconds - result.renderer_seconds;
    fmt::format_to(std::back_inserter(out), "<h3>Time</h3>\n<p>{} in all", typeset(duration(result.seconds)));
    if (result.renderer_seconds > 0) {
        fmt::format_to(std::back_inserter(out), ", {} of it with renderers at work, side by side",
                       typeset(duration(result.renderer_seconds)));
        if (result.tracer_seconds > 0)
            fmt::format_to(std::back_inserter(out), " (our own tracer: {})", typeset(duration(result.tracer_seconds)));
    }
    out += ".";
    if (overhead >= 0 && result.renderer_seconds > 0) {
        fmt::format_to(std::back_inserter(out), " Overhead {}, {} of the run.</p>\n", typeset(duration(overhead)),
                       percent(overhead / result.seconds));
        fmt::format_to(
            std::back_inserter(out),
            R"(<svg class="time" viewBox="0 0 400 10" preserveAspectRatio="none" role="img" aria-label="share of the time in renderers and outside them"><rect class="renderers" width="{:.1f}" height="10"/></svg>)"
            "\n",
            400 * result.renderer_seconds / result.seconds);
    } else {
        out += "</p>\n";
    }
}

std::string missing_weight(const RenderRecord &r) {
    if (!r.missing_weight_mean && !r.missing_weight_greatest) return "";
    std::string text;
    if (r.missing_weight_mean) text += "mean " + number(*r.missing_weight_mean, 2);
    if (r.missing_weight_greatest)
        text += (text.empty() ? "greatest " : ", greatest ") + number(*r.missing_weight_greatest, 2);
    return typeset(text);
}

void add_render(Out &out, const RunResult &result, const RenderRecord &r) {
    const auto cell = [&](std::string_view label, const std::string &content) {
        fmt::format_to(std::back_inserter(out), R"(<td data-label="{}" class="number">{}</td>)", label, content);
    };
    fmt::format_to(std::back_inserter(out),
                   "<tbody class=\"row\"><tr><th scope=\"row\">{} <span class=\"quiet\">{}</span></th>",
                   plain(r.experiment), plain(title_of(result, r.witness)));
    cell("picture", fmt::format("{} × {} px", r.width_px, r.height_px));
    cell("samples", fmt::format("{} × {}", r.replicates, r.samples_per_pixel));
    cell("time", r.from_cache ? "from the cache" : typeset(duration(r.seconds)));
    cell("processor", r.cpu_seconds > 0 ? typeset(duration(r.cpu_seconds)) : "");
    cell("memory", r.peak_memory_mb > 0 ? number(r.peak_memory_mb) + " MB" : "");
    cell("left out", missing_weight(r));
    out += "</tr>\n<tr class=\"why\"><td colspan=\"7\"><details><summary>Command, folder, accuracy</summary>";
    if (!r.command.empty()) fmt::format_to(std::back_inserter(out), "<pre><code>{}</code></pre>", html_text(r.command));
    out += "<dl class=\"parameters\">";
    const auto item = [&](std::string_view name, const std::string &value) {
        if (!value.empty()) fmt::format_to(std::back_inserter(out), "<div><dt>{}</dt><dd>{}</dd></div>", name, value);
    };
    const auto bound = [&](double value, std::string_view unit) {
        return value > 0 ? typeset(number(value)) + std::string(unit) : std::string("none");
    };
    item("folder", plain(r.folder));
    item("scene hash", plain(r.scene_hash));
    item("step of a stored radiance", bound(r.accuracy.radiance_step, ""));
    item("glass surface off by at most", bound(r.accuracy.surface_mm, " mm"));
    item("rounding of a position", bound(r.accuracy.rounding_mm, " mm"));
    item("spread of a pixel's sample", bound(r.accuracy.filter_px, " px"));
    item("branches dropped below weight", bound(r.accuracy.cut_weight, ""));
    out += "</dl></details></td></tr></tbody>\n";
}

void add_renders(Out &out, const RunResult &result) {
    if (result.renders.empty()) return;
    out += "<h3>Renders</h3>\n<p class=\"quiet\">Folders are relative to this page. Samples: replicates × samples a "
           "pixel. Left out: the weight of the branches of the ray tree that were cut.</p>\n<div "
           "class=\"scroll\"><table class=\"numbers renders\"><thead><tr><th scope=\"col\">Experiment</th><th "
           "scope=\"col\">Picture</th><th scope=\"col\">Samples</th><th scope=\"col\">Time</th><th "
           "scope=\"col\">Processor</th><th scope=\"col\">Memory</th><th scope=\"col\">Left out</th></tr></thead>\n";
    for (const RenderRecord &render : result.renders) add_render(out, result, render);
    out += "</table></div>\n";
}

} // namespace

void add_record(Out &out, const RunResult &result) {
    out += "<section class=\"record\" id=\"record\">\n<h2>How to repeat this</h2>\n";
    add_settings(out, result);
    add_renders(out, result);
    add_timing(out, result);
    out += "</section>\n";
}

} // namespace threefold::report
