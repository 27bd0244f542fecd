// SPDX-License-Identifier: MIT
#include "verifier/report/time_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "verifier/report/text.h"

namespace threefold::report {

double ExperimentTime::cpu_seconds() const {
    double sum = 0;
    for (const auto &[name, time] : renderers) sum += time.cpu_seconds;
    return sum;
}

std::vector<ExperimentTime> times_of(const RunResult &result) {
    std::vector<ExperimentTime> times;
    for (const RenderRecord &r : result.renders) {
        auto found = std::ranges::find_if(
            times, [&](const ExperimentTime &t) { return t.experiment == r.experiment && t.preset == r.preset; });
        if (found == times.end()) found = times.insert(times.end(), {r.experiment, r.preset, {}});
        RendererTime &time = found->renderers[r.witness];
        time.replicates += r.replicates;
        time.samples_per_pixel = r.samples_per_pixel;
        if (r.from_cache) continue;
        time.cpu_seconds += r.cpu_seconds;
        time.own_cpu_seconds += r.own_cpu_seconds;
    }
    return times;
}

std::string time_table(const RunResult &result) {
    std::vector<ExperimentTime> times = times_of(result);
    std::ranges::stable_sort(times, std::ranges::greater(), &ExperimentTime::cpu_seconds);
    ExperimentTime all{"all", "", {}};
    std::size_t width = 10;
    for (const ExperimentTime &t : times) {
        width = std::max(width, t.experiment.size());
        for (const auto &[name, time] : t.renderers) {
            all.renderers[name].cpu_seconds += time.cpu_seconds;
            all.renderers[name].replicates += time.replicates;
        }
    }
    times.push_back(all);
    std::string text = fmt::format("  {:<{}}", "CPU seconds (replicates)", width + 12);
    for (const WitnessRecord &w : result.witnesses) text += fmt::format("{:>16}", one_line(w.name));
    text += '\n';
    for (const ExperimentTime &t : times) {
        text += fmt::format("  {:<{}}{:<12}", one_line(t.experiment), width, result.preset == "both" ? t.preset : "");
        for (const WitnessRecord &w : result.witnesses) {
            const auto time = t.renderers.find(w.name);
            text += time == t.renderers.end()
                        ? fmt::format("{:>16}", "-")
                        : fmt::format("{:>10.2f} ({:>3})", time->second.cpu_seconds, time->second.replicates);
        }
        text += '\n';
    }
    return text;
}

} // namespace threefold::report
